//! Turns checked tables into a plan: resolves overrides, placeholders, and names that refer to each
//! other.

mod builtin;
mod curves;
mod emulate;
mod figures;
mod gates;
mod guides;
mod methods;
mod metrics;
mod output;
mod placeholders;
mod plots;
mod regions;
mod report;
mod reproject;
mod scenes;
mod settings;
mod study;
mod sweep;
mod tables;
mod view;

pub(crate) use curves::curves;
pub(crate) use study::study;

use std::path::Path;

use metrics::Metrics;

use crate::fault::Faults;
use crate::node::Node;
use fovqa_plan::{Experiment, FigureSettings, Plan, WantedPictures};

/// The experiment. Mistakes are added to `faults`.
pub(crate) fn experiment(
    root: Node<'_>,
    path: &Path,
    text: &str,
    faults: &mut Faults,
) -> Experiment {
    let base = path.parent().map(Path::to_owned).unwrap_or_default();
    let Metrics { choice, params, order } = metrics::metrics(root, faults);
    let mut scenes = scenes::scenes(root, &base, &choice, faults);
    let methods = methods::methods(root, &base, &mut scenes, faults);
    let known =
        plots::Known { scenes: &scenes, methods: &methods, metrics: &choice, params: &params };
    let all = FigureSettings::default();
    let figures = figures::figure(root.table("figures"), &all, faults);
    let plots = plots::plots(root, &known, &figures, faults);
    let crops = regions::of_all(root, &plots, faults);
    let gates = gates::gates(root, text, &known, faults);
    let output = output::output(root, &choice, faults);
    Experiment {
        name: root.text("name").unwrap_or_default().to_owned(),
        about: root.text("about").map(str::to_owned),
        path: path.to_owned(),
        text: String::new(),
        study: study::opinions(root, (&choice, &output), faults),
        output,
        report: report::report(root, &choice, faults),
        metric_order: order,
        plots,
        figures,
        gates,
        baselines: gates::baselines(root, &base),
        plan: Plan {
            base,
            scenes: scenes.into_iter().map(|scene| scene.scene).collect(),
            methods: methods.names,
            sweeps: methods.sweeps,
            metrics: choice,
            params,
            frames: None,
            hash_inputs: true,
            maps: false,
            crops,
            pictures: WantedPictures::default(),
        },
    }
}

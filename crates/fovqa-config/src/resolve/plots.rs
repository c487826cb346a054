//! `[[plot]]`.

use super::scenes::Resolved;
use super::settings::VIEW_HELP;
use crate::fault::Fault;
use crate::grammar::quoted;
use crate::nearest::nearest;
use crate::node::Node;
use crate::plan::MetricChoice;
use crate::plots::{Plot, PlotKind};

/// What plots may refer to.
pub(super) struct Known<'a> {
    pub(super) scenes: &'a [Resolved],
    pub(super) methods: &'a [String],
    pub(super) metrics: &'a MetricChoice,
}

pub(super) fn plots(root: Node<'_>, known: &Known<'_>, faults: &mut Vec<Fault>) -> Vec<Plot> {
    let tables = root.tables("plot").into_iter();
    let plots = tables.map(|(table, _)| {
        let kind = match table.text("kind") {
            Some("profile") => PlotKind::Profile,
            Some("bars") => PlotKind::Bars,
            Some("frames") => PlotKind::Frames,
            _ => PlotKind::Table,
        };
        let metric = table.text("metric");
        if let Some(metric) = metric {
            scored(table, metric, kind, known, faults);
        }
        let scenes: Vec<&str> = known.scenes.iter().map(|s| s.scene.name.as_str()).collect();
        let methods: Vec<&str> = known.methods.iter().map(String::as_str).collect();
        let plot = Plot {
            kind,
            metric: metric.map(str::to_owned),
            scenes: subset(table, "scenes", &scenes, faults),
            methods: subset(table, "methods", &methods, faults),
        };
        if faults.is_empty() {
            shows_something(table, &plot, known, faults);
        }
        plot
    });
    plots.collect()
}

/// Whether any of a plot's methods is in any of its scenes and, for a profile, has bands there.
fn shows_something(table: Node<'_>, plot: &Plot, known: &Known<'_>, faults: &mut Vec<Fault>) {
    let wanted = |names: &Option<Vec<String>>, name: &str| {
        names.as_ref().is_none_or(|names| names.iter().any(|n| n == name))
    };
    let scenes = known.scenes.iter().filter(|scene| wanted(&plot.scenes, &scene.scene.name));
    let eyes: Vec<_> = scenes.flat_map(|scene| &scene.scene.eyes).collect();
    let scored = |(method, _): &(usize, _)| wanted(&plot.methods, &known.methods[*method]);
    let (message, help) = if !eyes.iter().any(|eye| eye.tests.iter().any(scored)) {
        ("the plot has nothing to show: none of its methods is in any of its scenes", "")
    } else if plot.kind == PlotKind::Profile && eyes.iter().all(|e| e.settings.view.is_none()) {
        ("a profile is by eccentricity, and none of its scenes has a view", VIEW_HELP)
    } else {
        return;
    };
    faults.push(Fault::new(table.span("kind"), message).help(help));
}

/// Whether a plot's metric is scored, and fits its kind.
fn scored(table: Node<'_>, key: &str, kind: PlotKind, known: &Known<'_>, faults: &mut Vec<Fault>) {
    let scored = known.metrics.metrics();
    let keys = || scored.iter().map(|metric| metric.key());
    let Some(metric) = scored.iter().find(|metric| metric.key() == key) else {
        let fault =
            Fault::new(table.span("metric"), format!("the plot's metric {key} is not scored"));
        faults.push(fault.help(format!("name it in [metrics]; these are: {}", quoted(keys()))));
        return;
    };
    if kind == PlotKind::Profile && !metric.info().per_band {
        let message = format!("{key} has no values per band, so that it has no profile");
        let banded = scored.iter().filter(|metric| metric.info().per_band);
        let help = format!("these have: {}", quoted(banded.map(|metric| metric.key())));
        faults.push(Fault::new(table.span("metric"), message).help(help));
    }
}

/// Names of a list that have to be known.
fn subset(
    table: Node<'_>,
    key: &str,
    known: &[&str],
    faults: &mut Vec<Fault>,
) -> Option<Vec<String>> {
    let wanted = table.names(key)?;
    for (name, span) in &wanted {
        if !known.contains(name) {
            let what = key.trim_end_matches('s');
            let names = || known.iter().copied();
            let near = nearest(name, names()).map(|near| format!("did you mean \"{near}\"?"));
            let fault = Fault::new(span.clone(), format!("there is no {what} \"{name}\""));
            let help = format!("the {key} are {}", quoted(names()));
            faults.push(fault.label(near.unwrap_or_default()).help(help));
        }
    }
    Some(wanted.into_iter().map(|(name, _)| name.to_owned()).collect())
}

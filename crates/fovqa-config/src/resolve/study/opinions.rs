//! `[study]` of an experiment.

use std::collections::BTreeMap;

use fovqa_metrics::{Better, Metric};
use fovqa_plan::{MetricChoice, OpinionScores, OutputSettings, TableFormat};

use super::{names, settings};
use crate::fault::{Fault, Faults};
use crate::node::Node;

/// The mean opinion scores of an experiment. Mistakes are added to `faults`.
pub(in crate::resolve) fn opinions(
    root: Node<'_>,
    (choice, output): (&MetricChoice, &OutputSettings),
    faults: &mut Faults,
) -> Option<OpinionScores> {
    let table = root.table("study")?;
    if !output.tables.contains(&TableFormat::Csv) {
        let message = "[study] compares with results.csv, which [output] leaves out";
        let fault = Fault::new(root.span("study"), message);
        faults.push(fault.help("write tables = [\"csv\", \"parquet\"] in [output]"));
    }
    let columns = ["scene", "method", "value", "se"].into_iter();
    let columns: BTreeMap<String, String> =
        columns.filter_map(|role| Some((role.to_owned(), table.text(role)?.to_owned()))).collect();
    let metrics = names(table, "metrics");
    if let MetricChoice::Named(scored) = choice {
        let is_scored = |key: &String| scored.iter().any(|metric: &Metric| metric.key() == key);
        if let Some(key) = metrics.iter().find(|key| !is_scored(key)) {
            let message = format!("[study] compares {key}, which [metrics] does not have");
            let fault = Fault::new(table.span("metrics"), message);
            faults.push(fault.help(format!("add {key} = {{}} to [metrics], or leave it out here")));
        }
    }
    let is_neither = |key: &&String| {
        Metric::find(key).is_some_and(|metric| metric.info().better == Better::Neither)
    };
    if let Some(key) = metrics.iter().find(is_neither) {
        let message = format!("{key} says neither that an image is better nor that it is worse");
        let fault = Fault::new(table.span("metrics"), message);
        faults.push(fault.help("leave it out of metrics in [study]"));
    }
    let settings = settings(table);
    Some(OpinionScores {
        file: table.text("file").unwrap_or_default().to_owned(),
        columns,
        metrics,
        confidence: settings.confidence,
        adjust: settings.adjust,
        bootstrap: settings.bootstrap,
        seed: settings.seed,
    })
}

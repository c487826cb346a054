//! `[output]`: how the results are written.

use fovqa_metrics::Metric;
use fovqa_params::Words;
use fovqa_plan::{MetricChoice, OutputSettings, TableFormat};

use crate::fault::{Fault, Faults};
use crate::node::Node;

/// The settings. A format or metric that appears twice is a mistake, and so are maps of a metric that has
/// none or is not scored.
pub(super) fn output(root: Node<'_>, chosen: &MetricChoice, faults: &mut Faults) -> OutputSettings {
    let Some(table) = root.table("output") else { return OutputSettings::default() };
    let mut tables: Vec<TableFormat> = Vec::new();
    for (name, span) in table.names("tables").unwrap_or_default() {
        match TableFormat::find(name) {
            Some(format) if tables.contains(&format) => {
                faults.push(Fault::new(span, format!("\"{name}\" appears twice")));
            }
            Some(format) => tables.push(format),
            None => {}
        }
    }
    let mut settings = OutputSettings::default();
    if !tables.is_empty() {
        settings.tables = tables;
    }
    settings.spreadsheet_safe = table.flag("spreadsheet_safe").unwrap_or(false);
    settings.maps = maps(table, chosen, faults);
    settings
}

fn maps(table: Node<'_>, chosen: &MetricChoice, faults: &mut Faults) -> Vec<Metric> {
    let mut maps: Vec<Metric> = Vec::new();
    for (name, span) in table.names("maps").unwrap_or_default() {
        let Some(metric) = Metric::find(name) else { continue };
        let key = metric.key();
        let fault = if metric.info().map.is_none() {
            let all = Metric::ALL.into_iter().filter(|metric| metric.info().map.is_some());
            let all = all.map(Metric::key).collect::<Vec<_>>().join(", ");
            Some((format!("{key} has no map"), format!("these metrics have one: {all}")))
        } else if !chosen.metrics().contains(&metric) {
            let help = format!("add {key} = {{}} to [metrics]");
            Some((format!("{key} has a map, but is not scored"), help))
        } else if maps.contains(&metric) {
            Some((format!("\"{name}\" appears twice"), "leave one of them out".to_owned()))
        } else {
            maps.push(metric);
            None
        };
        if let Some((message, help)) = fault {
            faults.push(Fault::new(span, message).help(help));
        }
    }
    maps
}

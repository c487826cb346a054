//! `[[plot]]`.

use fovqa_metrics::Metric;

use crate::fault::Fault;
use crate::grammar::quoted;
use crate::nearest::nearest;
use crate::node::Node;
use crate::plan::MetricChoice;
use crate::plots::{Plot, PlotKind};

/// What plots may refer to.
pub(super) struct Names {
    pub(super) scenes: Vec<String>,
    pub(super) methods: Vec<String>,
    pub(super) metrics: MetricChoice,
}

pub(super) fn plots(root: Node<'_>, names: &Names, faults: &mut Vec<Fault>) -> Vec<Plot> {
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
            scored(table, metric, kind, names, faults);
        }
        Plot {
            kind,
            metric: metric.map(str::to_owned),
            scenes: subset(table, "scenes", &names.scenes, faults),
            methods: subset(table, "methods", &names.methods, faults),
        }
    });
    plots.collect()
}

/// Whether a plot's metric is scored, and fits its kind.
fn scored(table: Node<'_>, key: &str, kind: PlotKind, names: &Names, faults: &mut Vec<Fault>) {
    let scored = match &names.metrics {
        MetricChoice::Default => Metric::DEFAULT.to_vec(),
        MetricChoice::Named(named) => named.clone(),
    };
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
    known: &[String],
    faults: &mut Vec<Fault>,
) -> Option<Vec<String>> {
    let wanted = table.names(key)?;
    for (name, span) in &wanted {
        if !known.iter().any(|known| known == name) {
            let what = key.trim_end_matches('s');
            let names = || known.iter().map(String::as_str);
            let near = nearest(name, names()).map(|near| format!("did you mean \"{near}\"?"));
            let fault = Fault::new(span.clone(), format!("there is no {what} \"{name}\""));
            let help = format!("the {key} are {}", quoted(names()));
            faults.push(fault.label(near.unwrap_or_default()).help(help));
        }
    }
    Some(wanted.into_iter().map(|(name, _)| name.to_owned()).collect())
}

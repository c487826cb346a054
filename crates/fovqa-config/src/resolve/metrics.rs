//! `[metrics]`.

use fovqa_metrics::{Metric, ParamSet};
use fovqa_params::ParamValue;
use serde_spanned::Spanned;
use toml::de::DeValue;

use crate::fault::{Fault, Faults};
use crate::grammar::number;
use crate::node::{Node, flag, numbers, pairs, table, text};
use fovqa_plan::MetricChoice;

/// The metrics of a file.
pub(super) struct Metrics {
    pub(super) choice: MetricChoice,
    pub(super) params: ParamSet,
    /// The metrics in the order of the file.
    pub(super) order: Vec<Metric>,
}

pub(super) fn metrics(root: Node<'_>, faults: &mut Faults) -> Metrics {
    let mut params = ParamSet::default();
    let Some(metrics) = root.table("metrics") else {
        return Metrics { choice: MetricChoice::Default, params, order: Vec::new() };
    };
    let mut named = Vec::new();
    for (key, span, value) in metrics.entries() {
        let Some(metric) = Metric::find(key) else { continue };
        named.push((span.start, metric));
        for (name, at, value) in table(value).iter().flat_map(|table| table.entries()) {
            let known = metric.info().params.iter().any(|param| param.name == name);
            let Some(value) = param_value(value).filter(|_| known) else { continue };
            if let Err(error) = params.set(metric, name, &value) {
                faults.push(Fault::new(at, error.to_string()));
            }
        }
        // A mistake that depends on several parameters is reported at their metric.
        if let Err(error) = params.check_of(metric) {
            faults.push(Fault::new(span, error.to_string()));
        }
    }
    // A table of the file is sorted by key; positions give the order that was written.
    named.sort_unstable();
    let order: Vec<Metric> = named.into_iter().map(|(_, metric)| metric).collect();
    let mut named = order.clone();
    named.sort_unstable();
    Metrics { choice: MetricChoice::Named(named), params, order }
}

pub(super) fn param_value(value: &Spanned<DeValue<'_>>) -> Option<ParamValue> {
    number(value.get_ref())
        .map(ParamValue::Number)
        .or_else(|| text(value).map(|text| ParamValue::Text(text.to_owned())))
        .or_else(|| numbers(value).map(ParamValue::List))
        .or_else(|| pairs(value).map(ParamValue::Pairs))
        .or_else(|| flag(value).map(ParamValue::Flag))
}

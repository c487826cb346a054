//! `[metrics]`.

use std::collections::BTreeMap;

use fovqa_metrics::{Metric, Params};
use fovqa_params::ParamValue;
use serde_spanned::Spanned;
use toml::de::DeValue;

use crate::fault::{Fault, Faults};
use crate::grammar::number;
use crate::node::{Node, flag, numbers, pairs, table, text};
use fovqa_plan::MetricChoice;

/// Parameters an experiment sets.
pub(super) type Set = BTreeMap<(Metric, &'static str), ParamValue>;

pub(super) fn metrics(root: Node<'_>, faults: &mut Faults) -> (MetricChoice, Params, Set) {
    let (mut params, mut set) = (Params::default(), BTreeMap::new());
    let Some(metrics) = root.table("metrics") else {
        return (MetricChoice::Default, params, set);
    };
    let mut named = Vec::new();
    for (key, span, value) in metrics.entries() {
        let Some(metric) = Metric::find(key) else { continue };
        named.push(metric);
        for (name, at, value) in table(value).iter().flat_map(|table| table.entries()) {
            let known = metric.info().params.iter().find(|param| param.name == name);
            let Some((known, value)) = known.zip(param_value(value)) else { continue };
            if let Err(error) = params.set(metric, name, &value) {
                faults.push(Fault::new(at, error.to_string()));
            }
            set.insert((metric, known.name), value);
        }
        // What only all parameters together can tell is said once, at the metric they belong to.
        if key == Metric::Fpsnr.key()
            && let Err(error) = params.check()
        {
            faults.push(Fault::new(span, error.to_string()));
        }
    }
    named.sort_unstable();
    (MetricChoice::Named(named), params, set)
}

pub(super) fn param_value(value: &Spanned<DeValue<'_>>) -> Option<ParamValue> {
    number(value.get_ref())
        .map(ParamValue::Number)
        .or_else(|| text(value).map(|text| ParamValue::Text(text.to_owned())))
        .or_else(|| numbers(value).map(ParamValue::List))
        .or_else(|| pairs(value).map(ParamValue::Pairs))
        .or_else(|| flag(value).map(ParamValue::Flag))
}

//! A plot of values that the file gives.

use std::collections::BTreeSet;

use fovqa_plan::{GivenSeries, GivenValues};

use crate::fault::{Fault, Faults};
use crate::node::Node;
use crate::resolve::scenes::unique;

/// The keys that only this kind has.
pub(super) const KEYS: &[&str] = &["quantity", "groups", "values", "sum"];

/// The name of the sum if the file gives none.
const SUM: &str = "Sum";

pub(super) fn values(table: Node<'_>, faults: &mut Faults) -> Option<GivenValues> {
    let tables = table.tables("values");
    let needed = [
        ("quantity", table.has("quantity"), "quantity = \"GPU time (ms)\""),
        ("groups", table.has("groups"), "groups = [\"Full\", \"RMFR\"]"),
        ("values", !tables.is_empty(), "values = [{ name = \"Left eye\", at = [24.4, 8.65] }]"),
    ];
    for (what, _, example) in needed.iter().filter(|(_, given, _)| !given) {
        let fault =
            Fault::new(table.span("kind"), format!("a plot of kind \"values\" needs {what}"));
        faults.push(fault.help(format!("write, for example, {example}")));
    }
    let names = table.names("groups")?;
    let mut seen = BTreeSet::new();
    for (name, span) in &names {
        if !seen.insert(*name) {
            faults.push(Fault::new(span.clone(), format!("there are two groups named \"{name}\"")));
        }
    }
    unique(&tables, "bar", faults);
    let series = tables.iter().filter_map(|(node, _)| series(*node, names.len(), faults));
    let series: Vec<GivenSeries> = series.collect();
    let sum = match (table.flag("sum"), table.text("sum")) {
        (Some(true), _) => Some(SUM.to_owned()),
        (_, name) => name.map(str::to_owned),
    };
    if let Some(sum) = &sum {
        let named = |series: &GivenSeries| series.name.to_lowercase() == sum.to_lowercase();
        let fault = |message: String| Fault::new(table.span("sum"), message);
        if tables.len() == 1 {
            let help = "remove sum, or give another series in values";
            faults.push(fault("a sum needs at least two series".to_owned()).help(help));
        } else if series.iter().any(named) {
            let fault = fault(format!("the sum and a series are both named \"{sum}\""));
            faults.push(fault.help("give the sum another name, such as sum = \"Both eyes\""));
        }
    }
    let quantity = table.text("quantity")?.to_owned();
    let groups = names.iter().map(|(name, _)| (*name).to_owned()).collect();
    Some(GivenValues { quantity, groups, series, sum })
}

/// A series that has a value, and an error or none, for each group.
fn series(node: Node<'_>, groups: usize, faults: &mut Faults) -> Option<GivenSeries> {
    let name = node.text("name")?.to_owned();
    let values = node.numbers("at")?;
    let errors = node.numbers("error").unwrap_or_default();
    for (key, what, count) in [("at", "values", values.len()), ("error", "errors", errors.len())] {
        if node.has(key) && count != groups {
            let message = format!("\"{name}\" has {count} {what}, but there are {groups} groups");
            faults.push(Fault::new(node.span(key), message).help("give one for each group"));
        }
    }
    Some(GivenSeries { name, values, errors })
}

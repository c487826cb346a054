//! Which options an analysis has, and how lists of names and assignments are read.

use crate::fault::{Fault, Faults};
use crate::grammar::ANALYSES;
use crate::node::{Node, text};

/// The keys of every analysis.
const ALL: &[&str] =
    &["kind", "name", "title", "figure", "printed", "confidence", "adjust", "bootstrap", "seed"];
/// The keys that each analysis with a table has.
const TABLE: &[&str] = &["file", "by", "where", "column"];

/// Options that are lists of names.
const LISTS: &[&str] =
    &["by", "order", "unit", "within", "grid", "metrics", "lower_is_better", "methods"];

/// The own options of an analysis.
fn own(kind: &str, plan: Option<&str>) -> &'static [&'static str] {
    match (kind, plan) {
        ("pairs", _) => &["ties", "order", "reference", "pseudo_votes"],
        ("ranks", _) => &["unit", "pairwise", "ties", "order"],
        ("anova", _) => &["within"],
        ("psychometric", _) => &[
            "sigmoid",
            "direction",
            "guess",
            "performance",
            "lapse",
            "lapse_max",
            "overdispersion",
        ],
        ("staircase", _) => &["drop_reversals", "mean"],
        ("ratings", _) => &["threshold", "grid", "smooth", "validation_expected", "max_errors"],
        ("metrics", _) => &["scores", "metrics", "lower_is_better"],
        ("plan", Some("pairs")) => &[
            "plan",
            "share",
            "results",
            "methods",
            "scene",
            "alpha",
            "power",
            "alternative",
            "trials",
            "width",
        ],
        ("plan", Some("staircase")) => &[
            "plan",
            "participants",
            "trials",
            "threshold",
            "width",
            "lapse",
            "between_sd",
            "sigmoid",
            "direction",
            "guess",
            "start",
            "steps",
            "lowest",
            "highest",
            "down",
            "studies",
            "drop_reversals",
            "mean",
        ],
        _ => &["plan"],
    }
}

/// Checks that each key of an analysis is one of its options. `None` if there are others.
pub(super) fn has_only(table: Node<'_>, faults: &mut Faults) -> Option<()> {
    let kind = table.text("kind").filter(|kind| ANALYSES.contains(kind))?;
    let plan = table.text("plan");
    let own = own(kind, plan);
    let table_keys = if kind == "plan" { &[][..] } else { TABLE };
    let mut fits = true;
    for (key, span, _) in table.entries() {
        if [ALL, table_keys, own].iter().any(|keys| keys.contains(&key)) {
            continue;
        }
        fits = false;
        let of = match plan.filter(|_| kind == "plan") {
            Some(plan) => format!("a plan of {plan}"),
            None => kind.to_owned(),
        };
        let options = [table_keys, own].concat().join(", ");
        let fault = Fault::new(span, format!("{key} has no effect on {of}"));
        faults.push(fault.help(format!("leave it out; the options of {of} are {options}")));
    }
    for key in LISTS {
        let names = names(table, key);
        let repeated = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name));
        if let Some((_, name)) = repeated {
            fits = false;
            let fault = Fault::new(table.span(key), format!("{key} names \"{name}\" twice"));
            faults.push(fault.help("leave one of them out"));
        }
    }
    if table.has("lapse") && table.has("lapse_max") {
        fits = false;
        let message = "lapse_max has no effect with lapse, which fixes the rate";
        faults.push(Fault::new(table.span("lapse_max"), message).help("leave out one of them"));
    }
    fits.then_some(())
}

/// A list of names: a list, or a text with commas between them, as on the command line.
pub(super) fn names(table: Node<'_>, key: &str) -> Vec<String> {
    if let Some(names) = table.names(key) {
        return names.into_iter().map(|(name, _)| name.to_owned()).collect();
    }
    let text = table.text(key).unwrap_or_default();
    text.split(',').map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

/// Names and their values: a table, or a list of texts such as `scene=hall`.
pub(super) fn assignments(
    table: Node<'_>,
    key: &str,
    faults: &mut Faults,
) -> Vec<(String, String)> {
    if let Some(assigned) = table.table(key) {
        let of = |(name, _, value)| Some((str::to_owned(name), text(value)?.to_owned()));
        return assigned.entries().filter_map(of).collect();
    }
    let mut found = Vec::new();
    for (text, span) in table.names(key).unwrap_or_default() {
        if let Some((name, value)) = text.split_once('=') {
            found.push((name.trim().to_owned(), value.trim().to_owned()));
        } else {
            let fault = Fault::new(span, format!("\"{text}\" assigns nothing"));
            faults.push(fault.help("write \"NAME=VALUE\", or a table { NAME = \"VALUE\" }"));
        }
    }
    found
}

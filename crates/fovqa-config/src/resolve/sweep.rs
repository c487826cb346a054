//! `[sweep]`: a grid over keys of emulated methods.

use std::collections::BTreeMap;
use std::ops::Range;

use fovqa_params::ParamValue;
use fovqa_plan::{SweptKey, shown_value, spaced};
use serde_spanned::Spanned;
use toml::de::DeValue;

use super::emulate::Emulated;
use super::metrics::param_value;
use crate::fault::{Fault, Faults};
use crate::grammar::{BUDGET, SWEEP_RANGE, check, first_quoted};
use crate::nearest::nearest;
use crate::node::{Node, table};

/// Maximum number of values of one key. A range could have any number of steps.
const MOST_VALUES: usize = 100_000;
/// Digits of a value in a range. More would only show rounding errors.
const RANGE_DIGITS: usize = 12;

/// A key to be swept with its values, each with its position in the file.
pub(super) struct Entry<'a> {
    pub(super) key: &'a str,
    pub(super) values: Vec<(ParamValue, Range<usize>)>,
    /// Position of the key.
    pub(super) span: Range<usize>,
}

impl Entry<'_> {
    pub(super) fn swept(&self) -> SweptKey {
        let values = self.values.iter().map(|(value, _)| value.clone()).collect();
        SweptKey { key: self.key.to_owned(), values }
    }
}

/// The keys to be swept, by the index of the method's table.
pub(super) struct Sweeps<'a> {
    of_method: BTreeMap<usize, Vec<Entry<'a>>>,
    /// The keys of `[sweep]`, from the first to the last.
    pub(super) span: Range<usize>,
}

impl<'a> Sweeps<'a> {
    /// Reads the table. `names` are those of the methods, and `emulated` what is emulated, in the order
    /// of the file.
    pub(super) fn new(
        root: Node<'a>,
        names: &[&str],
        emulated: &[Option<Emulated>],
        faults: &mut Faults,
    ) -> Self {
        let mut sweeps = Self { of_method: BTreeMap::new(), span: root.span("sweep") };
        let Some(swept) = root.table("sweep") else { return sweeps };
        if swept.entries().next().is_none() {
            let fault = Fault::new(root.span("sweep"), "[sweep] names nothing to sweep");
            faults.push(fault.help("add a key, such as \"RMFR.fx\" = [0.1, 0.2], or leave it out"));
        }
        for (key, span, value) in swept.entries() {
            if key == BUDGET {
                sweeps.add_budget((value, span), emulated, faults);
            } else if let Some(keys) = table(value).filter(|_| names.contains(&key)) {
                // `RMFR.fx = […]` without quotes is a table in a table.
                let Some(method) = place(key, names) else { continue };
                for (key, span, value) in keys.entries() {
                    sweeps.add((method, key), (value, span), (names, emulated), faults);
                }
            } else if let Some((method, rest)) = divided(key, names) {
                sweeps.add((method, rest), (value, span), (names, emulated), faults);
            } else {
                faults.push(no_method(key, span, names));
            }
        }
        for entries in sweeps.of_method.values_mut() {
            // The keys of a table are sorted; their positions give the order of the file.
            entries.sort_by_key(|entry| entry.span.start);
        }
        sweeps
    }

    /// The keys of a method; empty if it is not swept.
    pub(super) fn of(&self, method: usize) -> &[Entry<'a>] {
        self.of_method.get(&method).map(Vec::as_slice).unwrap_or_default()
    }

    /// The number of points of a method.
    pub(super) fn points(&self, method: usize) -> usize {
        let lengths = self.of(method).iter().map(|entry| entry.values.len().max(1));
        lengths.fold(1, usize::saturating_mul)
    }

    /// Adds a budget of all methods that can have one.
    fn add_budget(
        &mut self,
        (value, span): (&'a Spanned<DeValue<'a>>, Range<usize>),
        emulated: &[Option<Emulated>],
        faults: &mut Faults,
    ) {
        let Some(values) = values(BUDGET, value, faults) else { return };
        let takes = |emulated: &Option<Emulated>| {
            emulated.as_ref().is_some_and(Emulated::takes_common_budget)
        };
        let methods = emulated.iter().enumerate().filter(|(_, emulated)| takes(emulated));
        let methods: Vec<usize> = methods.map(|(index, _)| index).collect();
        if methods.is_empty() {
            let message = "budget is swept, but no method has a parameter that it could set";
            let help = "emulate a method such as rmfr, without a budget of its own";
            faults.push(Fault::new(span, message).help(help));
            return;
        }
        for (nth, method) in methods.into_iter().enumerate() {
            let entry = Entry { key: BUDGET, values: values.clone(), span: span.clone() };
            // The values of all are the same, so that one check finds what is wrong with them.
            if nth == 0 && !fits(&entry, emulated[method].as_ref(), faults) {
                return;
            }
            self.of_method.entry(method).or_default().push(entry);
        }
    }

    fn add(
        &mut self,
        (method, key): (usize, &'a str),
        (value, span): (&'a Spanned<DeValue<'a>>, Range<usize>),
        (names, emulated): (&[&str], &[Option<Emulated>]),
        faults: &mut Faults,
    ) {
        let Some(of_method) = &emulated[method] else {
            let message = format!(
                "method \"{}\" has frames that were rendered, so that it has no parameters to sweep",
                names[method]
            );
            let help = "sweep a method that is emulated, with emulate = { model = \"…\" }";
            faults.push(Fault::new(span, message).help(help));
            return;
        };
        let known = of_method.sweepable();
        if !known.iter().any(|known| known == key) {
            let message = format!("method \"{}\" has no `{key}` to sweep", names[method]);
            let near = nearest(key, known.iter().map(String::as_str));
            let label = near.map(|near| format!("did you mean {near}?")).unwrap_or_default();
            let help = format!("the keys are {}", known.join(", "));
            faults.push(Fault::new(span, message).label(label).help(help));
            return;
        }
        let Some(values) = values(key, value, faults) else { return };
        let entry = Entry { key, values, span };
        if self.of(method).iter().any(|other| other.key == key) {
            let message = format!("`{key}` of method \"{}\" is swept twice", names[method]);
            faults.push(Fault::new(entry.span, message).help("leave out one of them"));
        } else if fits(&entry, Some(of_method), faults) {
            self.of_method.entry(method).or_default().push(entry);
        }
    }
}

/// Checks each value of a key on its own.
fn fits(entry: &Entry<'_>, emulated: Option<&Emulated>, faults: &mut Faults) -> bool {
    let Some(emulated) = emulated else { return false };
    let wrong = entry.values.iter().find_map(|(value, span)| {
        let error = emulated.at(&[(entry.key, value)]).err()?;
        Some(Fault::new(span.clone(), error))
    });
    let fits = wrong.is_none();
    faults.extend(wrong);
    fits
}

/// The method whose name and a dot begin a key, and the rest of the key. Names may have dots, too.
fn divided<'a>(key: &'a str, names: &[&str]) -> Option<(usize, &'a str)> {
    let rest = |name: &str| key.strip_prefix(name)?.strip_prefix('.');
    let found = names.iter().enumerate();
    let found = found.filter_map(|(index, name)| Some((index, rest(name)?)));
    found.min_by_key(|(_, rest)| rest.len())
}

fn place(name: &str, names: &[&str]) -> Option<usize> {
    names.iter().position(|known| *known == name)
}

fn no_method(key: &str, span: Range<usize>, names: &[&str]) -> Fault {
    let name = key.rsplit_once('.').map_or(key, |(name, _)| name);
    let message = format!("there is no method \"{name}\" to sweep");
    let near = nearest(name, names.iter().copied());
    let label = near.map(|near| format!("did you mean \"{near}\"?")).unwrap_or_default();
    let help = format!(
        "write \"METHOD.KEY\" = […], or budget = […] for all; the methods are {}",
        first_quoted(names.iter().copied())
    );
    Fault::new(span, message).label(label).help(help)
}

/// The values of a key, as a list or a range.
fn values(
    key: &str,
    value: &Spanned<DeValue<'_>>,
    faults: &mut Faults,
) -> Option<Vec<(ParamValue, Range<usize>)>> {
    const HELP: &str =
        "write a list such as [0.1, 0.2], or a range { from = 0.1, to = 1, steps = 10 }";
    let found = match value.get_ref() {
        DeValue::Array(items) => {
            let found = items.iter().map(|item| Some((param_value(item)?, item.span())));
            found.collect::<Option<Vec<_>>>()
        }
        DeValue::Table(range) => {
            let before = faults.count();
            check(SWEEP_RANGE, range, &format!("sweep.{key}"), value.span(), faults);
            if faults.count() > before {
                return None;
            }
            return of_range(key, Node::new(range), value.span(), faults);
        }
        _ => None,
    };
    let Some(found) = found.filter(|found| !found.is_empty()) else {
        let message = format!("sweep.{key} must be a list of values");
        faults.push(Fault::new(value.span(), message).help(HELP));
        return None;
    };
    for (index, (value, span)) in found.iter().enumerate() {
        let written = shown_value(value);
        if found[..index].iter().any(|(other, _)| shown_value(other) == written) {
            let message = format!("sweep.{key} has the value {written} twice");
            faults.push(Fault::new(span.clone(), message).help("leave out one of them"));
            return None;
        }
    }
    Some(found)
}

/// The values of a range. Both ends belong to it.
fn of_range(
    key: &str,
    range: Node<'_>,
    span: Range<usize>,
    faults: &mut Faults,
) -> Option<Vec<(ParamValue, Range<usize>)>> {
    let (from, to) = (range.number("from")?, range.number("to")?);
    let steps = range.number("steps")? as usize;
    let is_log = range.text("scale") == Some("log");
    let wrong = if from.total_cmp(&to).is_eq() {
        Some("from and to are the same")
    } else if is_log && !(from > 0.0 && to > 0.0) {
        Some("a logarithmic scale needs from and to above 0")
    } else {
        None
    };
    if let Some(wrong) = wrong {
        faults.push(Fault::new(span, format!("sweep.{key}: {wrong}")));
        return None;
    }
    let value = |step: usize| {
        let value = spaced([from, to], step, steps, is_log);
        let is_end = step == 0 || step + 1 == steps;
        let short = || format!("{value:.*e}", RANGE_DIGITS - 1).parse().unwrap_or(value);
        let value = if is_end { value } else { short() };
        (ParamValue::Number(value), span.clone())
    };
    Some((0..steps.min(MOST_VALUES)).map(value).collect())
}

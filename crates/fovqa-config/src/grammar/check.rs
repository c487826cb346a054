//! Checks a parsed file against the grammar: unknown keys, wrong types, and values out of range.

use std::borrow::Cow;
use std::ops::Range;

use fovqa_emulate::EmulationSpec;
use fovqa_io::sequence::FrameRange;
use fovqa_metrics::Metric;
use fovqa_params::ParamInfo;
use fovqa_vision::displays;
use serde_spanned::Spanned;
use toml::de::{DeTable, DeValue};

use super::emulate::{self, OTHER_EYE};
use super::{Key, Kind, LONGEST_TEXT, parameter, quoted, resolution};
use crate::fault::{Fault, Faults};
use crate::nearest::nearest;

/// Checks a table. `place` is its name in messages, and `span` is its position.
pub(crate) fn check(
    keys: &[Key],
    table: &DeTable<'_>,
    place: &str,
    span: Range<usize>,
    faults: &mut Faults,
) {
    for (name, value) in table {
        let text = name.get_ref().as_ref();
        match keys.iter().find(|key| key.name == text) {
            Some(key) => check_value(&key.kind, value, &inside(place, text), faults),
            None => {
                faults.push(unknown("key", text, name.span(), place, keys.iter().map(|k| k.name)));
            }
        }
    }
    for key in keys.iter().filter(|key| key.required && !table.contains_key(key.name)) {
        let message = format!("{place} has no {}", key.name);
        let help = match key.kind {
            Kind::Tables(..) => format!("add [[{}]]: {}", key.name, key.about),
            _ => format!("add {} = …: {}", key.name, key.about),
        };
        faults.push(Fault::new(span.clone(), message).help(help));
    }
}

/// With what the name of a whole file begins: `the experiment`.
const WHOLE: &str = "the ";

fn inside(place: &str, key: &str) -> String {
    if place.starts_with(WHOLE) { key.to_owned() } else { format!("{place}.{key}") }
}

fn unknown<'a>(
    what: &str,
    name: &str,
    span: Range<usize>,
    place: &str,
    known: impl Iterator<Item = &'a str> + Clone,
) -> Fault {
    let fault = Fault::new(span, format!("{place} has no {what} `{name}`"));
    let guess = nearest(name, known.clone());
    let label =
        guess.map_or_else(|| format!("no such {what}"), |near| format!("did you mean {near}?"));
    fault.label(label).help(format!("the {what}s are {}", known.collect::<Vec<_>>().join(", ")))
}

/// Checks a table of metrics. Each key is a metric, and each value is a table of its parameters.
fn check_metrics(value: &Spanned<DeValue<'_>>, place: &str, faults: &mut Faults) {
    let DeValue::Table(table) = value.get_ref() else {
        return wrong_type(&Kind::Metrics, value, place, faults);
    };
    if table.is_empty() {
        let fault = Fault::new(value.span(), format!("[{place}] names no metric"));
        faults.push(
            fault.help("name at least one, such as psnr = {}, or leave out the table to use the default metrics"),
        );
    }
    for (name, params) in table {
        let text = name.get_ref().as_ref();
        let Some(metric) = Metric::ALL.into_iter().find(|m| m.key() == text) else {
            let known = Metric::ALL.into_iter().map(Metric::key);
            faults.push(unknown("metric", text, name.span(), &format!("[{place}]"), known));
            continue;
        };
        let DeValue::Table(params) = params.get_ref() else {
            let fault = Fault::new(params.span(), format!("{place}.{text} is {}", type_of(params)));
            faults.push(
                fault.help(format!("write {text} = {{}}, with its parameters between the braces")),
            );
            continue;
        };
        for (name, value) in params {
            check_param(metric.info().params, name, value, (place, text), faults);
        }
    }
}

/// Checks a parameter of a metric, model or method.
fn check_param(
    known: &'static [ParamInfo],
    name: &Spanned<Cow<'_, str>>,
    value: &Spanned<DeValue<'_>>,
    (place, owner): (&str, &str),
    faults: &mut Faults,
) {
    let param = name.get_ref().as_ref();
    if let Some(known) = known.iter().find(|known| known.name == param) {
        let place = format!("{place}.{owner}.{param}");
        return check_value(&parameter(known.values), value, &place, faults);
    }
    let names = known.iter().map(|param| param.name);
    let fault = unknown("parameter", param, name.span(), owner, names);
    let none = || format!("{owner} has no parameters");
    faults.push(if known.is_empty() { fault.help(none()) } else { fault });
}

/// Checks a table that names a model and contains its parameters.
fn check_model(kind: &Kind, value: &Spanned<DeValue<'_>>, place: &str, faults: &mut Faults) {
    let (Some((what, models)), DeValue::Table(table)) = (kind.models(), value.get_ref()) else {
        return wrong_type(kind, value, place, faults);
    };
    let keys = || models.iter().map(|model| model.0);
    let Some(model) = table.get("model") else {
        let fault = Fault::new(value.span(), format!("{place} has no model"));
        return faults.push(fault.help(format!("add model = …: {}", quoted(keys()))));
    };
    let DeValue::String(text) = model.get_ref() else {
        return wrong_type(&Kind::Text, model, &format!("{place}.model"), faults);
    };
    let name = text.replace('-', "_");
    let Some(&(owner, params)) = models.iter().find(|model| model.0 == name) else {
        let fault = Fault::new(model.span(), format!("there is no {what} \"{text}\""));
        let near = nearest(text, keys()).map(|near| format!("did you mean \"{near}\"?"));
        let help = format!("choose one of {}", quoted(keys()));
        return faults.push(fault.label(near.unwrap_or_default()).help(help));
    };
    for (name, value) in table.iter().filter(|(name, _)| name.get_ref() != "model") {
        check_param(params, name, value, (place, owner), faults);
    }
}

/// Checks the table of an emulated method.
fn check_emulation(value: &Spanned<DeValue<'_>>, place: &str, faults: &mut Faults) {
    let DeValue::Table(table) = value.get_ref() else {
        return wrong_type(&Kind::Emulation, value, place, faults);
    };
    let models = emulate::models();
    let names = || models.iter().map(EmulationSpec::key);
    let Some(model) = table.get("model") else {
        let fault = Fault::new(value.span(), format!("{place} has no model"));
        return faults.push(fault.help(format!("add model = …: {}", quoted(names()))));
    };
    let DeValue::String(text) = model.get_ref() else {
        return wrong_type(&Kind::Text, model, &format!("{place}.model"), faults);
    };
    let Some(spec) = models.iter().find(|spec| spec.key() == text.replace('-', "_")) else {
        let fault = Fault::new(model.span(), format!("there is no method \"{text}\" to emulate"));
        let near = nearest(text, names()).map(|near| format!("did you mean \"{near}\"?"));
        let help = format!("choose one of {}", quoted(names()));
        return faults.push(fault.label(near.unwrap_or_default()).help(help));
    };
    check_emulation_keys(spec, table, place, false, faults);
    match table.get(OTHER_EYE).map(|value| (value, value.get_ref())) {
        Some((_, DeValue::Table(other))) => {
            check_emulation_keys(spec, other, &inside(place, OTHER_EYE), true, faults);
        }
        Some((value, _)) => {
            wrong_type(&Kind::Table(&[]), value, &inside(place, OTHER_EYE), faults);
        }
        None => {}
    }
}

fn check_emulation_keys(
    spec: &EmulationSpec,
    table: &DeTable<'_>,
    place: &str,
    other_eye: bool,
    faults: &mut Faults,
) {
    let settable = spec.settable();
    for (name, value) in table {
        let text = name.get_ref().as_ref();
        let place = || inside(place, text);
        if !other_eye && (text == "model" || text == OTHER_EYE) {
            continue;
        }
        if let Some(key) = emulate::keys(other_eye).find(|key| key.name == text) {
            check_value(&key.kind, value, &place(), faults);
        } else if let Some((_, info)) = settable.iter().find(|(known, _)| known == text) {
            check_value(&parameter(info.values), value, &place(), faults);
        } else if text == "model" {
            let message =
                format!("{OTHER_EYE} cannot have a model: both eyes have that of the method");
            faults.push(Fault::new(name.span(), message).help("leave it out"));
        } else {
            let known = settable.iter().map(|(name, _)| name.as_str());
            let known: Vec<&str> = known.chain(emulate::keys(other_eye).map(|k| k.name)).collect();
            let known = known.iter().copied();
            faults.push(unknown("parameter", text, name.span(), spec.key(), known));
        }
    }
}

fn check_value(kind: &Kind, value: &Spanned<DeValue<'_>>, place: &str, faults: &mut Faults) {
    let span = value.span();
    let mut out_of_range = |found: &str| {
        faults.push(
            Fault::new(span.clone(), format!("{place} cannot be {found}"))
                .label(format!("write {}", kind.in_words())),
        );
    };
    match (kind, value.get_ref()) {
        // The keys of a sweep are names of methods, which are resolved later.
        (Kind::Bool, DeValue::Boolean(_)) | (Kind::Sweep, DeValue::Table(_)) => {}
        (Kind::Text, DeValue::String(text)) => {
            if text.is_empty() || text.chars().any(char::is_control) {
                out_of_range("empty, or have control characters");
            } else if text.chars().count() > LONGEST_TEXT {
                out_of_range(&format!("longer than {LONGEST_TEXT} characters"));
            }
        }
        (Kind::Name, DeValue::String(text)) => {
            if let Err(why) = name_fits(text) {
                faults.push(Fault::new(span, format!("{place} {why}")));
            }
        }
        (
            Kind::Number(min, max) | Kind::NumberOr(min, max, _),
            DeValue::Integer(_) | DeValue::Float(_),
        ) => match number(value.get_ref()) {
            Some(n) if n.is_finite() && *min <= n && n <= *max => {}
            _ => out_of_range(&written(value.get_ref())),
        },
        (Kind::Above(min, max), DeValue::Integer(_) | DeValue::Float(_)) => {
            match number(value.get_ref()) {
                Some(n) if *min < n && n <= *max => {}
                _ => out_of_range(&written(value.get_ref())),
            }
        }
        (
            Kind::Whole(min, max) | Kind::WholeOr(min, max, _),
            DeValue::Integer(_) | DeValue::Float(_),
        ) => match number(value.get_ref()) {
            Some(n) if n.fract() == 0.0 && (*min as f64..=*max as f64).contains(&n) => {}
            _ => out_of_range(&written(value.get_ref())),
        },
        (
            Kind::NumberOr(..) | Kind::WholeOr(..) | Kind::Word(_) | Kind::Words(_),
            DeValue::String(text),
        ) => one_of(&kind.words(), text, place, span, faults),
        (Kind::Frames, DeValue::String(text)) => {
            if let Err(error) = text.parse::<FrameRange>() {
                faults.push(Fault::new(span, format!("{place}: {error}")));
            }
        }
        (Kind::Display, DeValue::String(text)) => check_display(text, place, span, faults),
        (Kind::Metric, DeValue::String(text)) => {
            let known = Metric::ALL.into_iter().map(Metric::key);
            if !known.clone().any(|key| key == text) {
                faults.push(no_such(place, text, span, known));
            }
        }
        (Kind::Resolution(most), DeValue::String(text)) => {
            let fits = |size: [usize; 2]| size.iter().all(|side| side <= most);
            if !resolution(text).is_some_and(fits) {
                out_of_range(&format!("\"{text}\""));
            }
        }
        (Kind::List(kind, min, max), DeValue::Array(items)) => {
            if items.len() < *min || items.len() > *max {
                out_of_range(&format!("a list of {}", items.len()));
            }
            for item in items {
                check_value(kind, item, place, faults);
            }
        }
        (Kind::Table(keys), DeValue::Table(table)) => check(keys, table, place, span, faults),
        (Kind::Texts, DeValue::Table(table)) => check_texts(table, place, faults),
        (Kind::Tables(_, most), DeValue::Array(items)) if items.len() > *most => {
            out_of_range(&format!("an array of {}", items.len()));
        }
        (Kind::Tables(keys, _), DeValue::Array(items)) if items.iter().all(is_table) => {
            for item in items {
                if let DeValue::Table(table) = item.get_ref() {
                    check(keys, table, &named(place, table), item.span(), faults);
                }
            }
        }
        (Kind::Tables(..), DeValue::Array(items)) => {
            for item in items.iter().filter(|item| !is_table(item)) {
                wrong_type(kind, item, &format!("an entry of {place}"), faults);
            }
        }
        (Kind::Method | Kind::Acuity, _) => check_model(kind, value, place, faults),
        (Kind::Emulation, _) => check_emulation(value, place, faults),
        (Kind::Metrics, _) => check_metrics(value, place, faults),
        (Kind::Either(kinds), _) => match kinds.iter().find(|kind| is_of(kind, value)) {
            Some(kind) => check_value(kind, value, place, faults),
            None => wrong_type(kind, value, place, faults),
        },
        _ => wrong_type(kind, value, place, faults),
    }
}

/// Checks that all values of a table are texts.
fn check_texts(table: &DeTable<'_>, place: &str, faults: &mut Faults) {
    for (name, value) in table {
        if !matches!(value.get_ref(), DeValue::String(_)) {
            wrong_type(&Kind::Text, value, &inside(place, name.get_ref()), faults);
        }
    }
}

/// Checks the name of a display; `-` and `_` are alike.
fn check_display(text: &str, place: &str, span: Range<usize>, faults: &mut Faults) {
    let known = displays().iter().map(|display| display.name.as_str());
    let spelled = |name: &str| name == text || name.replace('_', "-") == *text;
    if !known.clone().any(spelled) {
        faults.push(no_such(place, text, span, known));
    }
}

fn one_of(words: &[&str], text: &str, place: &str, span: Range<usize>, faults: &mut Faults) {
    if !words.contains(&text) {
        // Of two spellings of a word, the help names one.
        let is_second =
            |word: &&&str| word.contains('-') && words.contains(&&*word.replace('-', "_"));
        let once = words.iter().filter(|word| !is_second(word)).copied();
        faults.push(no_such(place, text, span, once));
    }
}

/// An entry of an array of tables with its name, if it has one that is short enough to be repeated
/// in each of its mistakes.
fn named(place: &str, table: &DeTable<'_>) -> String {
    match table.get("name").map(Spanned::get_ref) {
        Some(DeValue::String(name)) if name_fits(name).is_ok() => format!("{place} \"{name}\""),
        _ => place.to_owned(),
    }
}

fn is_table(value: &Spanned<DeValue<'_>>) -> bool {
    matches!(value.get_ref(), DeValue::Table(_))
}

/// Whether a value has the type of a kind.
fn is_of(kind: &Kind, value: &Spanned<DeValue<'_>>) -> bool {
    match value.get_ref() {
        DeValue::Boolean(_) => matches!(kind, Kind::Bool),
        DeValue::String(_) => matches!(
            kind,
            Kind::Text
                | Kind::Name
                | Kind::NumberOr(..)
                | Kind::WholeOr(..)
                | Kind::Word(_)
                | Kind::Words(_)
                | Kind::Frames
                | Kind::Display
                | Kind::Metric
                | Kind::Resolution(_)
        ),
        DeValue::Integer(_) | DeValue::Float(_) => {
            matches!(
                kind,
                Kind::Number(..)
                    | Kind::Above(..)
                    | Kind::Whole(..)
                    | Kind::NumberOr(..)
                    | Kind::WholeOr(..)
            )
        }
        DeValue::Array(_) => matches!(kind, Kind::List(..) | Kind::Tables(..)),
        DeValue::Table(_) => {
            matches!(
                kind,
                Kind::Table(_)
                    | Kind::Texts
                    | Kind::Metrics
                    | Kind::Method
                    | Kind::Acuity
                    | Kind::Emulation
            )
        }
        DeValue::Datetime(_) => false,
    }
}

fn wrong_type(kind: &Kind, value: &Spanned<DeValue<'_>>, place: &str, faults: &mut Faults) {
    let fault = Fault::new(value.span(), format!("{place} cannot be {}", type_of(value)));
    faults.push(match kind {
        Kind::Tables(..) => {
            let name = place.trim_start_matches("an entry of ");
            fault.help(format!("write [[{name}]] above the keys of each entry"))
        }
        kind => fault.label(format!("write {}", kind.in_words())),
    });
}

fn no_such<'a>(
    place: &str,
    text: &str,
    span: Range<usize>,
    known: impl Iterator<Item = &'a str> + Clone,
) -> Fault {
    let fault = Fault::new(span, format!("{place} cannot be \"{text}\""));
    let fault = match nearest(text, known.clone()) {
        Some(near) => fault.label(format!("did you mean \"{near}\"?")),
        None => fault,
    };
    fault.help(format!("choose one of {}", quoted(known)))
}

fn type_of(value: &Spanned<DeValue<'_>>) -> &'static str {
    match value.get_ref() {
        DeValue::String(_) => "text",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a number with a fraction",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

/// The value of a number; `None` if it is not a number, or is too large.
pub(crate) fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(n) => i64::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
        DeValue::Float(n) => n.as_str().parse().ok(),
        _ => None,
    }
}

fn written(value: &DeValue<'_>) -> String {
    match value {
        DeValue::Integer(n) => n.to_string(),
        DeValue::Float(n) => n.to_string(),
        _ => String::new(),
    }
}

/// Whether a text can be a name. Names are used in the headings of tables and, with some characters
/// replaced, in file names.
fn name_fits(text: &str) -> Result<(), String> {
    const LONGEST: usize = 80;
    /// Maximum number of bytes. A file name has at most 255, and contains other text around the
    /// name.
    const LONGEST_BYTES: usize = 200;
    if text.trim().is_empty() || text.trim() != text {
        return Err("cannot be empty, or begin or end with a space".to_owned());
    }
    if text.chars().any(|c| c.is_control() || matches!(c, '/' | '\\')) || text.starts_with('.') {
        return Err(
            "cannot have / or \\ or control characters in it, or begin with a dot".to_owned()
        );
    }
    if text.starts_with("::") {
        return Err("cannot begin with ::, which is a command where CI shows it".to_owned());
    }
    if text.chars().count() > LONGEST || text.len() > LONGEST_BYTES {
        return Err(format!(
            "cannot be longer than {LONGEST} characters, or {LONGEST_BYTES} bytes"
        ));
    }
    Ok(())
}

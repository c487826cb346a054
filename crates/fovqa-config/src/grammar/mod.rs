//! The grammar of an experiment file: every key with its kind, range and description. This one
//! description is used to check files, to explain mistakes and to make the JSON Schema.

mod check;
mod curves;
mod emulate;
mod experiment;
mod figures;
mod gates;
mod keys;
mod schema;
mod study;
mod tables;

pub(crate) use check::{check, number};
pub(crate) use curves::{CURVES, MOST_CURVES};
pub(crate) use emulate::{BUDGET, OTHER_EYE, REPROJECT};
pub(crate) use experiment::{EXPERIMENT, SWEEP_RANGE};
pub use schema::{curves_schema, schema, study_schema};
pub(crate) use study::{ANALYSES, STUDY, about_option};

use fovqa_methods::Method;
use fovqa_params::{ParamInfo, ParamValues};
use fovqa_vision::acuity::AcuityModel;

/// A key of a table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Key {
    pub(crate) name: &'static str,
    pub(crate) required: bool,
    pub(crate) kind: Kind,
    /// One line of description, for editors.
    pub(crate) about: &'static str,
}

/// The kind of a value.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kind {
    Bool,
    /// A text that is not empty, has at most [`LONGEST_TEXT`] characters, and contains no control
    /// characters.
    Text,
    /// A name: a text that can be used in a file name and in the heading of a table.
    Name,
    /// A finite number. Both limits are allowed.
    Number(f64, f64),
    /// A finite number greater than the first limit and not greater than the second.
    Above(f64, f64),
    /// An integer. Both limits are allowed.
    Whole(i64, i64),
    /// A finite number with both limits allowed, or a word.
    NumberOr(f64, f64, &'static str),
    /// An integer with both limits allowed, or a word.
    WholeOr(i64, i64, &'static str),
    /// One of these words.
    Word(&'static [&'static str]),
    /// One of the words of a type.
    Words(fn() -> Vec<&'static str>),
    /// A range of frames, `A..B:STEP`.
    Frames,
    /// The name of a display preset.
    Display,
    /// The name of a metric.
    Metric,
    /// The size of a frame as text, `2560x1440`, with the largest side: 100,000, or 32,768 for frames
    /// that are drawn.
    Resolution(usize),
    /// A table with the name of a foveation method, `model`, and its parameters.
    Method,
    /// A table with the name of an acuity model, `model`, and its parameters.
    Acuity,
    /// A table with the name of a method that can be emulated, `model`, its parameters, and what
    /// surrounds them.
    Emulation,
    /// A list of values of one kind, with the minimum and maximum number of values.
    List(&'static Kind, usize, usize),
    /// A table.
    Table(&'static [Key]),
    /// A table with keys of its own, whose values are texts.
    Texts,
    /// An array of tables, with the maximum number of tables.
    Tables(&'static [Key], usize),
    /// A table whose keys are metrics and whose values are tables of parameters.
    Metrics,
    /// A table whose keys are those of emulated methods and whose values are lists or ranges.
    Sweep,
    /// One of several kinds with different types.
    Either(&'static [Kind]),
}

impl Kind {
    /// What the value has to be, in words for a message.
    pub(crate) fn in_words(&self) -> String {
        match self {
            Kind::Bool => "true or false".to_owned(),
            Kind::Text => "text in quotes".to_owned(),
            Kind::Name => "a name in quotes".to_owned(),
            Kind::Number(min, max) => match (min.is_finite(), max.is_finite()) {
                (true, true) => format!("a number from {min} to {max}"),
                _ => "a number".to_owned(),
            },
            Kind::Above(min, max) => format!("a number above {min} and at most {max}"),
            Kind::Whole(min, max) => format!("a whole number from {min} to {max}"),
            Kind::NumberOr(min, max, word) => {
                format!("{}; or \"{word}\"", Kind::Number(*min, *max).in_words())
            }
            Kind::WholeOr(min, max, word) => {
                format!("{}; or \"{word}\"", Kind::Whole(*min, *max).in_words())
            }
            Kind::Word(_) | Kind::Words(_) => format!("one of {}", quoted(self.words())),
            Kind::Frames => "a range of frames such as \"0..100\" or \"0..100:5\"".to_owned(),
            Kind::Display => "the name of a display (`fovqa list displays`)".to_owned(),
            Kind::Metric => "the name of a metric".to_owned(),
            Kind::Resolution(most) => {
                format!("a size such as \"2560x1440\", each side 1 to {most}")
            }
            Kind::Method | Kind::Emulation => {
                "a table such as { model = \"rmfr\", sigma = 2.6 }".to_owned()
            }
            Kind::Acuity => "a table such as { model = \"piecewise\", cap_cpd = 9 }".to_owned(),
            Kind::List(kind, min, max) => {
                let count = match (min, max) {
                    (min, max) if min == max => format!("a list of {min} values, each "),
                    (min, max) => format!("a list of {min} to {max} values, each "),
                };
                count + &kind.in_words()
            }
            Kind::Table(keys) => {
                let names = keys.iter().map(|key| format!("{} = …", key.name));
                format!("a table {{ {} }}", names.collect::<Vec<_>>().join(", "))
            }
            Kind::Texts => "a table such as { scene = \"hall\" }, with values in quotes".to_owned(),
            Kind::Tables(_, most) => format!("an array of at most {most} tables"),
            Kind::Metrics => "a table of metrics".to_owned(),
            Kind::Sweep => "a table such as { \"RMFR.fx\" = [0.1, 0.2] }".to_owned(),
            Kind::Either(kinds) => {
                kinds.iter().map(Kind::in_words).collect::<Vec<_>>().join("; or ")
            }
        }
    }
}

impl Kind {
    /// The words that a value of this kind may be.
    pub(crate) fn words(&self) -> Vec<&'static str> {
        match self {
            Kind::Word(words) => words.to_vec(),
            Kind::Words(words) => words(),
            Kind::NumberOr(_, _, word) | Kind::WholeOr(_, _, word) => vec![word],
            _ => Vec::new(),
        }
    }
}

/// Maximum number of characters in a text: a paragraph, or the longest path that operating systems
/// open.
pub(crate) const LONGEST_TEXT: usize = 4096;

/// A model that a table may name: the name and the parameters of the model.
pub(crate) type Model = (&'static str, &'static [ParamInfo]);

impl Kind {
    /// The models that a table of this kind may name, and the term for such a model.
    pub(crate) fn models(&self) -> Option<(&'static str, Vec<Model>)> {
        match self {
            Kind::Method => {
                let models = Method::all().map(|m| (m.key(), m.info().params));
                Some(("method", models.to_vec()))
            }
            Kind::Acuity => {
                let models = AcuityModel::all().map(|m| (m.info().key, m.info().params));
                Some(("acuity model", models.to_vec()))
            }
            _ => None,
        }
    }
}

/// Width and height from the text of a frame size. Each must be from 1 to 100000.
pub fn resolution(text: &str) -> Option<[usize; 2]> {
    const MOST: usize = 100_000;
    let (width, height) = text.split_once(['x', '×'])?;
    let side = |text: &str| {
        let side: usize = text.trim().parse().ok()?;
        (1..=MOST).contains(&side).then_some(side)
    };
    Some([side(width)?, side(height)?])
}

/// Words in quotes, with commas between them.
pub(crate) fn quoted<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    words.into_iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}

/// The first few names in quotes, with commas between them, for names from a file.
pub(crate) fn first_quoted<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    const SHOWN: usize = 50;
    let mut names = names.into_iter();
    let shown = quoted(names.by_ref().take(SHOWN));
    match names.count() {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// The kind of a metric's parameter.
pub(crate) const fn parameter(values: ParamValues) -> Kind {
    const FINITE: Kind = Kind::Number(f64::NEG_INFINITY, f64::INFINITY);
    const PAIR: Kind = Kind::List(&FINITE, 2, 2);
    /// `Either` needs static memory for its kinds. All parameters that are lists of pairs accept
    /// the same word.
    const PAIRS_OR_NONE: [Kind; 2] = [Kind::List(&PAIR, 1, 1000), Kind::Word(&["none"])];
    match values {
        ParamValues::Number(min, max) => Kind::Number(min, max),
        ParamValues::NumberOr(min, max, word) => Kind::NumberOr(min, max, word),
        ParamValues::Whole(min, max) => Kind::Whole(min as i64, max as i64),
        ParamValues::Flag => Kind::Bool,
        ParamValues::WholeOr(min, max, word) => Kind::WholeOr(min as i64, max as i64, word),
        ParamValues::Word(words) => Kind::Word(words),
        ParamValues::Numbers => Kind::List(&FINITE, 1, 1000),
        ParamValues::PairsOr(_) => Kind::Either(&PAIRS_OR_NONE),
    }
}

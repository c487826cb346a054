//! The options of each analysis.

use std::ops::Range;

use fovqa_study::input::Validation;
use fovqa_study::plan::{PairsOptions, PredictedOptions, StaircaseOptions};
use fovqa_study::psychometric::Model;
use fovqa_study::{Request, metrics, pairs, psychometric, ranks, ratings, staircase};

use super::options::names;
use crate::fault::{Fault, Faults};
use crate::grammar::about_option;
use crate::node::Node;

/// The analysis that a table asks for; `None` if something is wrong with its options.
pub(super) fn request(table: Node<'_>, span: Range<usize>, faults: &mut Faults) -> Option<Request> {
    let text = |key| table.text(key).map(str::to_owned);
    Some(match table.text("kind")? {
        "pairs" => Request::Pairs(pairs::Options {
            ties: table.word("ties").unwrap_or_default(),
            order: names(table, "order"),
            reference: text("reference"),
            pseudo_votes: table.number("pseudo_votes").unwrap_or(0.0),
        }),
        "ranks" => {
            let default = ranks::Options::default();
            let unit = names(table, "unit");
            Request::Ranks(ranks::Options {
                unit: if unit.is_empty() { default.unit } else { unit },
                pairwise: table.word("pairwise").unwrap_or_default(),
                ties: table.word("ties").unwrap_or_default(),
                order: names(table, "order"),
            })
        }
        "anova" => {
            needed(table, span, &["within"], faults)?;
            Request::Anova(names(table, "within"))
        }
        "psychometric" => Request::Psychometric(psychometric_options(table)),
        "staircase" => Request::Staircase(reversals(table)),
        "ratings" => Request::Ratings(ratings_options(table, faults)?),
        "metrics" => {
            needed(table, span, &["scores"], faults)?;
            Request::Metrics(metrics::Options {
                metrics: names(table, "metrics"),
                lower_is_better: names(table, "lower_is_better"),
            })
        }
        _ => plan(table, span, faults)?,
    })
}

/// Checks that a table has these keys.
fn needed(table: Node<'_>, span: Range<usize>, keys: &[&str], faults: &mut Faults) -> Option<()> {
    let missing: Vec<&str> = keys.iter().filter(|key| !table.has(key)).copied().collect();
    if missing.is_empty() {
        return Some(());
    }
    let kind = table.text("kind").unwrap_or_default();
    let missing = missing.join(", ");
    let fault = Fault::new(span, format!("the analysis {kind} lacks {missing}"));
    let first = keys.iter().find(|key| !table.has(key)).copied().unwrap_or_default();
    faults.push(fault.help(format!("add {first} = …: {}", about_option(first))));
    None
}

fn model(table: Node<'_>) -> Model {
    let default = Model::default();
    Model {
        sigmoid: table.word("sigmoid").unwrap_or_default(),
        direction: table.word("direction").unwrap_or_default(),
        guess: table.number("guess").unwrap_or(default.guess),
    }
}

/// One or several numbers.
fn numbers(table: Node<'_>, key: &str) -> Option<Vec<f64>> {
    table.numbers(key).or_else(|| Some(vec![table.number(key)?]))
}

fn psychometric_options(table: Node<'_>) -> psychometric::Options {
    let default = psychometric::Options::default();
    let word = table.text("overdispersion").map(|word| word == "on");
    psychometric::Options {
        model: model(table),
        lapse: table.number("lapse"),
        lapse_max: table.number("lapse_max").unwrap_or(default.lapse_max),
        performance: numbers(table, "performance").unwrap_or(default.performance),
        overdispersion: table.flag("overdispersion").or(word).unwrap_or(default.overdispersion),
    }
}

fn reversals(table: Node<'_>) -> staircase::Options {
    let default = staircase::Options::default();
    staircase::Options {
        drop_reversals: table
            .number("drop_reversals")
            .map_or(default.drop_reversals, |count| count as usize),
        mean: table.word("mean").unwrap_or_default(),
    }
}

fn ratings_options(table: Node<'_>, faults: &mut Faults) -> Option<ratings::Options> {
    let mut wrong = |key: &str, message: &str, help: &str| {
        faults.push(Fault::new(table.span(key), message).help(help));
        None
    };
    if table.has("grid") && table.has("threshold") {
        return wrong("threshold", "threshold has no effect with grid", "leave out one of them");
    }
    if table.has("smooth") && !table.has("grid") {
        return wrong("smooth", "smooth has no effect without grid", "add grid = [\"x\", \"y\"]");
    }
    let rule = (table.number("validation_expected"), table.number("max_errors"));
    let validation = match rule {
        (Some(expected), Some(most)) => Some(Validation { expected, max_errors: most as usize }),
        (None, None) => None,
        (Some(_), None) => {
            let help = "add max_errors: with so many wrong answers, a participant is left out";
            return wrong("validation_expected", "validation_expected needs max_errors", help);
        }
        (None, Some(_)) => {
            let help = "add validation_expected: the correct score of validation trials";
            return wrong("max_errors", "max_errors needs validation_expected", help);
        }
    };
    let grid = names(table, "grid");
    let grid: Option<[String; 2]> = match <[String; 2]>::try_from(grid) {
        Ok(columns) if columns[0] != columns[1] => Some(columns),
        Err(none) if none.is_empty() => None,
        _ => return wrong("grid", "grid needs two different columns", "write [\"x\", \"y\"]"),
    };
    Some(ratings::Options {
        threshold: table.number("threshold"),
        grid,
        smoothing: table.word("smooth").unwrap_or_default(),
        validation,
    })
}

fn plan(table: Node<'_>, span: Range<usize>, faults: &mut Faults) -> Option<Request> {
    needed(table, span.clone(), &["plan"], faults)?;
    let count = |key, default: usize| table.number(key).map_or(default, |count| count as usize);
    if table.text("plan") == Some("pairs") {
        return plan_pairs(table, span, faults);
    }
    let needs = ["participants", "trials", "threshold", "width", "start", "steps"];
    needed(table, span, &needs, faults)?;
    let number = |key| table.number(key).unwrap_or_default();
    Some(Request::PlanStaircase(StaircaseOptions {
        participants: count("participants", 1),
        trials: count("trials", 1),
        threshold: number("threshold"),
        width: number("width"),
        lapse: number("lapse"),
        between_sd: number("between_sd"),
        model: model(table),
        start: number("start"),
        steps: numbers(table, "steps").unwrap_or_default(),
        lowest: table.number("lowest"),
        highest: table.number("highest"),
        down: table.number("down").map_or(2, |down| down as u32),
        studies: count("studies", 1000),
        reversals: reversals(table),
    }))
}

fn plan_pairs(table: Node<'_>, span: Range<usize>, faults: &mut Faults) -> Option<Request> {
    let mut wrong = |key: &str, message: &str, help: &str| {
        let span = if table.has(key) { table.span(key) } else { span.clone() };
        faults.push(Fault::new(span, message).help(help));
        None
    };
    let is_predicted = table.has("results");
    match (table.has("share"), is_predicted) {
        (true, true) => {
            return wrong("results", "share and results both give the share", "leave out one");
        }
        (false, false) => {
            let help = "add share = 0.65, the true share of votes, or results = \"reports/NAME\", whose JODs predict it";
            return wrong("share", "the plan has no share", help);
        }
        _ => {}
    }
    for key in ["methods", "scene"] {
        if table.has(key) && !is_predicted {
            return wrong(key, &format!("{key} has no effect without results"), "leave it out");
        }
    }
    let width = table.number("width");
    if width.is_some_and(|width| width >= 1.0) {
        return wrong("width", "the width of an interval of a share is below 1", "write 0.2");
    }
    let options = PairsOptions {
        share: table.number("share").unwrap_or(0.5),
        alpha: table.number("alpha").unwrap_or(0.05),
        power: table.number("power").unwrap_or(0.8),
        alternative: table.word("alternative").unwrap_or_default(),
        trials: table.number("trials").map(|trials| trials as u64),
        width,
    };
    Some(if is_predicted {
        Request::PlanPredicted(PredictedOptions {
            pair: options,
            methods: names(table, "methods"),
            scene: table.text("scene").map(str::to_owned),
        })
    } else {
        Request::PlanPairs(options)
    })
}

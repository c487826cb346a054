//! How far methods can foveate: the smallest budget, or the last value of a parameter, at which a rule
//! still holds.

mod candidates;
mod kept_source;
mod options;
mod search;

use std::path::{Path, PathBuf};

use fovqa_engine::{Events, ResultsFolder, budget_range};
use fovqa_plan::{Experiment, GateRule, spaced};
use fovqa_report::DrawnLimits;
use fovqa_results::{
    ComparisonName, LIMITS_CSV, LIMITS_JSON, LIMITS_SCHEMA, LimitPoint, LimitRecord, LimitRule,
    LimitState, LimitsRecord, Number, SampleSummary, write_json_file, write_whole,
};

use crate::error::Error;
use crate::finish::in_folder;
use candidates::{Candidate, Scored, Scorer, Target, Varied};
pub use options::LimitOptions;
use search::{Measured, Place, Saves, Search};

/// What was found, and where it is.
#[derive(Debug)]
pub struct FoundLimits {
    /// The folder.
    pub folder: PathBuf,
    /// What was found.
    pub record: LimitsRecord,
    /// The table, and the number of figures.
    pub drawn: DrawnLimits,
}

/// What is known of a measured value beside it.
struct Sample {
    samples: Option<SampleSummary>,
    /// Whether it was measured to come closer to the limit.
    closer: bool,
}

/// The range of budgets that is searched by default, if methods can have all of it.
const BUDGETS: [f64; 2] = [0.01, 1.0];

/// One search: a rule for a method in a scene.
struct Wanted {
    rule: usize,
    target: usize,
    eye: String,
    search: Search<Sample>,
    /// Why there are no values.
    lacks: Option<String>,
}

/// Searches for the limits of an experiment's rules, and writes a table, figures and all values into a
/// folder.
///
/// # Errors
/// If the experiment has no rule with a fixed limit or no method that can be varied, a range cannot be
/// reached, no rule has a limit in its range, or the results cannot be written.
pub fn find_limits(
    experiment: &Experiment,
    options: &LimitOptions,
    events: &dyn Events,
) -> Result<FoundLimits, Error> {
    check(experiment, options)?;
    let name = format!("{}-limit", experiment.name);
    let folder = options.output.clone().unwrap_or_else(|| Path::new("reports").join(name));
    let varied = Varied::new(experiment, options)?;
    let scorer = Scorer::new(experiment, options, &varied)?;
    let targets = with_ranges(varied, &scorer, experiment, options)?;
    let folder =
        ResultsFolder::open_for_limits(&folder, options.locking).map_err(|e| in_folder(&e))?;
    let mut wanted = wanted(experiment, options, &targets);
    if wanted.is_empty() {
        let message = "no rule applies to a method that can be varied";
        return Err(Error::usage(message, "check scene and method of the [[gate]] rules"));
    }
    let scan = targets.iter().enumerate().flat_map(|(index, target)| {
        let (range, steps) = (target.range, options.steps);
        let at = (0..steps).map(move |step| spaced(range, step, steps, range[0] > 0.0));
        at.map(move |at| Candidate { target: index, at })
    });
    let mut candidates: Vec<Candidate> = scan.collect();
    let mut closer = false;
    while !candidates.is_empty() {
        let scored = scorer.score(&targets, &candidates, events)?;
        for of in &mut wanted {
            let target = of.target;
            let own = scored.iter().filter(|(candidate, _)| candidate.target == target);
            for (candidate, values) in own {
                take(of, &experiment.gates[of.rule], (*candidate, closer), values);
            }
        }
        candidates.clear();
        closer = true;
        for of in wanted.iter().filter(|of| of.lacks.is_none()) {
            let next = of.search.next(options.tolerance);
            let next = next.map(|at| Candidate { target: of.target, at });
            candidates.extend(next.filter(|next| !candidates.contains(next)));
        }
    }
    events.finish();
    let record = record(experiment, options, &targets, &wanted);
    folder.clear().map_err(|error| in_folder(&error))?;
    let drawn = write(folder.path(), &record, events)?;
    for warning in &drawn.warnings {
        events.warn(warning);
    }
    if record.limits.iter().all(|limit| limit.state != LimitState::Found) {
        let why: Vec<&str> = record.limits.iter().filter_map(|of| of.note.as_deref()).collect();
        let message = format!("no rule has a limit: {}", why.join("; "));
        return Err(Error::usage(message, "change the limits of the rules, or --from and --to"));
    }
    Ok(FoundLimits { folder: folder.path().to_owned(), record, drawn })
}

/// Checks what needs no files.
fn check(experiment: &Experiment, options: &LimitOptions) -> Result<(), Error> {
    let file = experiment.path.display();
    if experiment.gates.is_empty() {
        let message = format!("{file}: it has no [[gate]] rule whose limit could be searched");
        let help = "add one, such as [[gate]] with metric = \"fpsnr\" and at_least = 30";
        return Err(Error::usage(message, help));
    }
    if let Some(rule) = experiment.gates.iter().find(|rule| rule.needs_baseline()) {
        let message = format!(
            "{file}:{}: the rule for {} compares with a baseline; a search needs fixed limits",
            rule.line, rule.quantity
        );
        return Err(Error::usage(message, "give the rule at_least or at_most instead"));
    }
    if !experiment.plan.sweeps.is_empty() {
        let message = format!("{file}: it has a [sweep], but a search chooses the values itself");
        return Err(Error::usage(message, "leave [sweep] out"));
    }
    if options.steps < 2 {
        return Err(Error::usage("a search begins with at least 2 steps", "raise --steps"));
    }
    if !(options.tolerance > 0.0 && options.tolerance < 1.0) {
        let message = format!("a tolerance of {} is not above 0 and below 1", options.tolerance);
        return Err(Error::usage(message, "0.001 finds limits to within 0.1 %"));
    }
    if let (Some(from), Some(to)) = (options.from, options.to)
        && (from.is_nan() || to.is_nan() || from >= to)
    {
        let message = format!("--from {from} is not below --to {to}");
        return Err(Error::usage(message, "exchange them"));
    }
    Ok(())
}

/// The targets with the ranges that they are searched in.
fn with_ranges(
    varied: Varied,
    scorer: &Scorer,
    experiment: &Experiment,
    options: &LimitOptions,
) -> Result<Vec<Target>, Error> {
    let mut targets = varied.targets;
    for target in &mut targets {
        let scene = &experiment.plan.scenes[target.scene];
        if options.vary != LimitOptions::BUDGET {
            let (Some(from), Some(to)) = (options.from, options.to) else {
                let message = format!("the range of {} is not given", options.vary);
                return Err(Error::usage(message, "give it with --from and --to"));
            };
            target.range = [from, to];
            continue;
        }
        let mut reach = [0.0, f64::INFINITY];
        for (view, eye, spec) in scorer.views_of(experiment, target) {
            if let Some([least, most]) = budget_range(view, eye, spec)? {
                reach = [f64::max(reach[0], least), f64::min(reach[1], most)];
            }
        }
        let [from, to] = [options.from, options.to];
        let range =
            [from.unwrap_or(BUDGETS[0]).max(reach[0]), to.unwrap_or(BUDGETS[1]).min(reach[1])];
        if range[0].is_nan() || range[1].is_nan() || range[0] >= range[1] {
            let method = &experiment.plan.methods[target.method];
            let message = format!(
                "{}, {method}: budgets from {} to {} can be reached, but not from {} to {}",
                scene.name,
                short(reach[0]),
                short(reach[1]),
                from.unwrap_or(BUDGETS[0]),
                to.unwrap_or(BUDGETS[1])
            );
            return Err(Error::usage(message, "change --from and --to, or leave the method out"));
        }
        target.range = range;
    }
    Ok(targets)
}

/// The rules for each target that they apply to.
fn wanted(experiment: &Experiment, options: &LimitOptions, targets: &[Target]) -> Vec<Wanted> {
    let known = (options.vary == LimitOptions::BUDGET).then_some(Saves::Low);
    let mut wanted = Vec::new();
    for (rule, of) in experiment.gates.iter().enumerate() {
        for (target, Target { scene, method, .. }) in targets.iter().enumerate() {
            let scene = &experiment.plan.scenes[*scene];
            let method = &experiment.plan.methods[*method];
            let fits = |wanted: &Option<String>, name: &str| {
                wanted.as_ref().is_none_or(|wanted| wanted == name)
            };
            if !fits(&of.scene, &scene.name) || !fits(&of.method, method) {
                continue;
            }
            let two = scene.eyes.len() > 1;
            let eye = match &of.eye {
                Some(eye) if two => eye.clone(),
                Some(_) => continue,
                None if two => "both".to_owned(),
                None => String::new(),
            };
            wanted.push(Wanted { rule, target, eye, search: Search::new(known), lacks: None });
        }
    }
    wanted
}

/// Takes the value of a candidate.
fn take(of: &mut Wanted, rule: &GateRule, (candidate, closer): (Candidate, bool), scored: &Scored) {
    let place: ComparisonName = (scored.scene.clone(), scored.label.clone(), of.eye.clone());
    // A frame that could not be scored would leave the others with a value of their own.
    let found = match &scored.failure {
        Some(failure) => Err(failure.clone()),
        None => scored.values.of(&place, &rule.quantity).map_err(|lacking| lacking.to_string()),
    };
    match found {
        Ok(found) => {
            let value = found.value;
            let holds = rule.at_least.is_none_or(|least| value >= least)
                && rule.at_most.is_none_or(|most| value <= most);
            let samples = scored.values.samples_of(&place).cloned();
            let of_sample = Sample { samples, closer };
            of.search.add(Measured { at: candidate.at, value, holds, of: of_sample });
        }
        Err(why) => of.lacks = of.lacks.take().or(Some(why)),
    }
}

fn record(
    experiment: &Experiment,
    options: &LimitOptions,
    targets: &[Target],
    wanted: &[Wanted],
) -> LimitsRecord {
    let rule = |rule: &GateRule| LimitRule {
        name: rule.name.clone().unwrap_or_else(|| rule.quantity.to_string()),
        quantity: rule.quantity.clone(),
        at_least: rule.at_least,
        at_most: rule.at_most,
    };
    let is_budget = options.vary == LimitOptions::BUDGET;
    let of = targets.iter().find_map(|target| target.budget_of.clone());
    LimitsRecord {
        schema: LIMITS_SCHEMA.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        experiment: experiment.name.clone(),
        vary: options.vary.clone(),
        budget_of: of.filter(|_| is_budget),
        tolerance: options.tolerance,
        rules: experiment.gates.iter().map(rule).collect(),
        limits: wanted.iter().map(|of| limit(experiment, targets, of)).collect(),
        figures: experiment.figures.clone(),
    }
}

fn limit(experiment: &Experiment, targets: &[Target], of: &Wanted) -> LimitRecord {
    let target = &targets[of.target];
    let (scene, method) =
        (&experiment.plan.scenes[target.scene].name, &experiment.plan.methods[target.method]);
    let place = of.search.place();
    let [from, to] = target.range;
    let named = |why: &str| Some(format!("{scene}, {method}: {why}"));
    let in_range =
        |why: &str| named(&format!("the rule holds {why} from {} to {}", short(from), short(to)));
    let (state, note) = match (&of.lacks, place) {
        (Some(why), _) => (LimitState::NotScored, named(why)),
        (None, Place::Between(..)) => (LimitState::Found, None),
        (None, Place::Always) => (LimitState::Always, in_range("everywhere")),
        (None, Place::Never) => (LimitState::Never, in_range("nowhere")),
    };
    let ends = match place {
        Place::Between(holds, fails) if state == LimitState::Found => Some((holds, fails)),
        _ => None,
    };
    let holds = ends.map(|(holds, _)| &of.search.measured[holds]);
    let samples = holds.and_then(|holds| holds.of.samples.as_ref());
    let budget = samples.and_then(|samples| samples.budget.as_ref());
    LimitRecord {
        rule: of.rule,
        scene: scene.clone(),
        method: method.clone(),
        eye: of.eye.clone(),
        state,
        range: target.range,
        limit: holds.map(|holds| holds.at),
        fails_at: ends.map(|(_, fails)| of.search.measured[fails].at),
        value: holds.map(|holds| Number(holds.value)),
        samples_share: samples.map(|samples| samples.share),
        ideal_share: budget.map(|budget| budget.ideal_share),
        parameter: budget.and_then(|_| target.parameter.clone()),
        parameter_value: budget.map(|budget| budget.value.clone()).unwrap_or_default(),
        monotone: of.search.is_monotone(),
        note,
        points: of.search.measured.iter().map(point).collect(),
    }
}

/// A number with a few digits, for a message.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

fn point(of: &Measured<Sample>) -> LimitPoint {
    LimitPoint { at: of.at, value: Number(of.value), closer: of.of.closer }
}

/// Writes the record, the table and the figures.
fn write(folder: &Path, record: &LimitsRecord, events: &dyn Events) -> Result<DrawnLimits, Error> {
    const HELP: &str = "free some space, or give another folder with {output}";
    let failed = |error: &dyn std::fmt::Display| Error::input(error.to_string(), HELP);
    write_whole(&folder.join(LIMITS_CSV), record.csv().as_bytes()).map_err(|e| failed(&e))?;
    write_json_file(&folder.join(LIMITS_JSON), record).map_err(|error| failed(&error))?;
    let begin = |what: &str, items| events.step(what, items);
    fovqa_report::draw_limits(folder, record, &begin).map_err(|error| {
        if error.is_of_settings() {
            Error::usage(error.to_string(), "change [figures] in the experiment")
        } else {
            failed(&error)
        }
    })
}

//! Figures of plans: the power by number of trials, and a simulated staircase.

use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look};
use fovqa_study::plan::{PairsPlan, StaircasePlan};

use super::context::{Context, caption, percent, rounded};
use super::staircase::{Step, track};
use crate::sheet::NamedFigure;

pub(super) fn pairs(plan: &PairsPlan, context: &Context) -> Vec<NamedFigure> {
    let points: Vec<(f64, Option<f64>)> =
        plan.curve.iter().map(|&(trials, power)| (trials as f64, Some(power))).collect();
    let Some((first, last)) = points.first().zip(points.last()) else { return Vec::new() };
    let look = Look::new(0);
    let asked = plan.requested.zip(plan.power_at_trials);
    let rings: Vec<(f64, Option<f64>)> = [plan.trials.zip(plan.power), asked]
        .into_iter()
        .flatten()
        .map(|(trials, power)| (trials as f64, Some(power)))
        .collect();
    let required = LineSeries {
        name: format!("required power, {}", rounded(plan.required)),
        reference: true,
        points: vec![(first.0, Some(plan.required)), (last.0, Some(plan.required))],
        ..LineSeries::default()
    };
    let ringed = match (plan.trials, asked) {
        (Some(trials), None) => {
            format!("ring: {trials} trials, the least number with the required power")
        }
        (Some(trials), Some((asked, _))) => format!(
            "rings: {trials} trials, the least number with the required power, and {asked} trials"
        ),
        (None, Some((asked, _))) => {
            format!("ring: {asked} trials; no number of trials has the required power")
        }
        (None, None) => "no number of trials has the required power".to_owned(),
    };
    let line = LineSeries { name: "power".to_owned(), look, ..LineSeries::default() };
    let series = vec![
        required,
        LineSeries { rings: true, unlisted: true, points: rings, ..line.clone() },
        LineSeries { smooth: true, unmarked: true, points, ..line },
    ];
    let chart = LineChart {
        x: Axis::new("Trials of a pair"),
        y: Axis { min: Some(0.0), max: Some(1.0), ..Axis::new("Power") },
        series,
        ..LineChart::default()
    };
    let text = caption(&[
        "Exact power of the binomial test by number of trials; it falls where a larger number of \
         wins becomes necessary",
        &ringed,
    ]);
    vec![context.figure("power", "", (text, Figure::Line(chart)))]
}

pub(super) fn staircase(plan: &StaircasePlan, context: &Context) -> Vec<NamedFigure> {
    let trials = plan.first.levels.iter().zip(&plan.first.correct).enumerate();
    let step = |(index, (&level, &correct)): (usize, (&f64, &u8))| Step {
        trial: (index + 1) as f64,
        level,
        is_correct: correct == 1,
        is_used: false,
    };
    let steps: Vec<Step> = trials.map(step).collect();
    if steps.is_empty() {
        return Vec::new();
    }
    let name = format!("true level of {} correct", percent(plan.target_performance));
    let name = name.as_str();
    let chart = track(&steps, plan.target_level.map(|level| (name, level)), false);
    let dashed = match plan.target_level {
        Some(_) => "dashed: the level to which it converges at the mean threshold",
        None => "",
    };
    let text = caption(&["The first simulated staircase", dashed]);
    vec![context.figure("track", "", (text, Figure::Line(chart)))]
}

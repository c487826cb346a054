//! Tables of plans.

use fovqa_study::plan::{PairsPlan, PredictedPlan, StaircasePlan};

use super::cells::{half_open, number, whole, whole_or};
use super::parts::Parts;
use crate::plain_table::Cell;

const COLUMNS: [(&str, &str); 2] = [("quantity", "quantity"), ("value", "value")];

pub(super) fn pairs(plan: &PairsPlan, parts: &mut Parts) {
    let rows = vec![
        vec![Cell::text("trials per pair"), whole_or(plan.trials)],
        vec![Cell::text("power with these trials"), number(plan.power)],
        vec![Cell::text("power with --trials"), number(plan.power_at_trials)],
        vec![Cell::text("trials for --width"), whole_or(plan.trials_for_width)],
    ];
    let caption = "Trials that a binomial test of one pair needs";
    parts.table(("plan", caption), &COLUMNS, rows);
    parts.reasons([("plan".to_owned(), plan.reason.clone())]);
}

pub(super) fn predicted(plan: &PredictedPlan, parts: &mut Parts) {
    parts.remark(&plan.prediction);
    let scenes = if plan.scenes.len() == 1 { "scene" } else { "scenes" };
    parts.remark(format!("{scenes}: {}", plan.scenes.join(", ")));
    let rows = plan.pairs.iter().map(|pair| {
        vec![
            Cell::text(format!("{} – {}", pair.method, pair.opponent)),
            number(pair.jod),
            number(pair.opponent_jod),
            number(pair.share),
            whole_or(pair.plan.trials),
            number(pair.plan.power),
            number(pair.plan.power_at_trials),
            whole_or(pair.plan.trials_for_width),
        ]
    });
    let columns = [
        ("pair", "pair"),
        ("JOD", "jod"),
        ("JOD of the other", "opponent_jod"),
        ("share", "share"),
        ("trials", "trials"),
        ("power", "power"),
        ("power with --trials", "power_at_trials"),
        ("trials for --width", "trials_for_width"),
    ];
    let caption = "Trials that binomial tests of predicted shares need";
    parts.table(("plan", caption), &columns, rows.collect());
    parts.reasons(
        plan.pairs
            .iter()
            .map(|pair| (format!("{} – {}", pair.method, pair.opponent), pair.plan.reason.clone())),
    );
}

pub(super) fn staircase(plan: &StaircasePlan, parts: &mut Parts) {
    let rows = vec![
        vec![Cell::text("target performance"), number(plan.target_performance)],
        vec![Cell::text("target level"), number(plan.target_level)],
        vec![Cell::text("mean threshold of a study"), number(plan.mean)],
        vec![Cell::text("standard deviation"), number(plan.sd)],
        vec![Cell::text("interval"), half_open(plan.interval)],
        vec![Cell::text("mean half width of t intervals"), number(plan.mean_half_width)],
        vec![Cell::text("studies without a threshold"), whole(plan.failed)],
    ];
    parts.table(("plan", "Thresholds of simulated studies"), &COLUMNS, rows);
    parts.reasons([("plan".to_owned(), plan.reason.clone())]);
}

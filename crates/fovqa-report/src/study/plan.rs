//! Tables of plans.

use fovqa_study::plan::{PairsPlan, PredictedPair, PredictedPlan, StaircasePlan};

use super::cells::{half_open, number, shown, whole, whole_or};
use super::parts::Parts;
use crate::plain_table::Cell;

const COLUMNS: [(&str, &str); 2] = [("quantity", "quantity"), ("value", "value")];

pub(super) fn pairs(plan: &PairsPlan, parts: &mut Parts) {
    let mut rows = vec![
        vec![Cell::text("trials per pair"), whole_or(plan.trials)],
        vec![Cell::text("power with these trials"), number(plan.power)],
    ];
    if let Some(trials) = plan.requested {
        rows.push(vec![Cell::text(power_with(trials)), number(plan.power_at_trials)]);
    }
    if let Some(width) = plan.width {
        rows.push(vec![Cell::text(trials_for(width)), whole_or(plan.trials_for_width)]);
    }
    let caption = "Trials that a binomial test of one pair needs";
    parts.table(("plan", caption), &COLUMNS, rows);
    parts.reasons([("plan".to_owned(), reason(plan))]);
}

fn power_with(trials: u64) -> String {
    format!("power with {trials} trials")
}

fn trials_for(width: f64) -> String {
    format!("trials for an interval {} wide", shown(width))
}

/// Why a value that was asked for is undefined.
fn reason(plan: &PairsPlan) -> Option<String> {
    let asked = |reason: &&str| !reason.starts_with("without --");
    let reasons: Vec<&str> = plan.reason.as_deref()?.split("; ").filter(asked).collect();
    (!reasons.is_empty()).then(|| reasons.join("; "))
}

pub(super) fn predicted(plan: &PredictedPlan, parts: &mut Parts) {
    parts.remark(&plan.prediction);
    let scenes = if plan.scenes.len() == 1 { "scene" } else { "scenes" };
    parts.remark(format!("{scenes}: {}", plan.scenes.join(", ")));
    if !plan.left_out.is_empty() {
        let left_out = plan.left_out.join(", ");
        parts.remark(format!("left out, without a finite score in each scene: {left_out}"));
    }
    let first = plan.pairs.first().map(|pair| &pair.plan);
    let (requested, width) = (first.and_then(|p| p.requested), first.and_then(|p| p.width));
    let rows = plan.pairs.iter().map(|pair| {
        let mut row = vec![
            Cell::text(format!("{} – {}", pair.method, pair.opponent)),
            number(pair.jod),
            number(pair.opponent_jod),
            number(pair.share),
            whole_or(pair.plan.trials),
            number(pair.plan.power),
        ];
        row.extend(requested.map(|_| number(pair.plan.power_at_trials)));
        row.extend(width.map(|_| whole_or(pair.plan.trials_for_width)));
        row
    });
    let power_with = requested.map(power_with).unwrap_or_default();
    let trials_for = width.map(trials_for).unwrap_or_default();
    let mut columns = vec![
        ("pair", "pair"),
        ("JOD", "jod"),
        ("JOD of the other", "opponent_jod"),
        ("share", "share"),
        ("trials", "trials"),
        ("power", "power"),
    ];
    columns.extend(requested.map(|_| (power_with.as_str(), "power_at_trials")));
    columns.extend(width.map(|_| (trials_for.as_str(), "trials_for_width")));
    let caption = "Trials that binomial tests of predicted shares need";
    parts.table(("plan", caption), &columns, rows.collect());
    let name = |pair: &PredictedPair| format!("{} – {}", pair.method, pair.opponent);
    parts.reasons(plan.pairs.iter().map(|pair| (name(pair), reason(&pair.plan))));
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

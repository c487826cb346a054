//! Plans of studies as text.

use fovqa_study::plan::{PairsPlan, StaircasePlan};

use super::Report;
use super::numbers::{half_open, number};
use crate::text_table::plain_table;

pub(super) fn pairs(plan: &PairsPlan, report: &mut Report) {
    let count = |count: Option<u64>| count.map_or_else(|| number(None), |count| count.to_string());
    let mut table = plain_table(&["quantity", "value"]);
    table.add_row(["trials per pair".to_owned(), count(plan.trials)]);
    table.add_row(["power with these trials".to_owned(), number(plan.power)]);
    table.add_row(["power with --trials".to_owned(), number(plan.power_at_trials)]);
    table.add_row(["trials for --width".to_owned(), count(plan.trials_for_width)]);
    report.table("Trials that a binomial test of one pair needs", table);
    report.reasons([("plan".to_owned(), plan.reason.clone())]);
}

pub(super) fn staircase(plan: &StaircasePlan, report: &mut Report) {
    let mut table = plain_table(&["quantity", "value"]);
    table.add_row(["target performance".to_owned(), number(plan.target_performance)]);
    table.add_row(["target level".to_owned(), number(plan.target_level)]);
    table.add_row(["mean threshold of a study".to_owned(), number(plan.mean)]);
    table.add_row(["standard deviation".to_owned(), number(plan.sd)]);
    table.add_row(["interval".to_owned(), half_open(plan.interval)]);
    table.add_row(["mean half width of t intervals".to_owned(), number(plan.mean_half_width)]);
    table.add_row(["studies without a threshold".to_owned(), plan.failed.to_string()]);
    report.table("Thresholds of simulated studies", table);
    report.reasons([("plan".to_owned(), plan.reason.clone())]);
}

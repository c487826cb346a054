//! The gate checks the values of a finished run against rules, and proposes limits from repeated
//! runs.

mod aggregate;
mod calibrate;
mod calibration_toml;
mod files;
mod json;
mod loss;
mod noise;
#[cfg(test)]
mod random;
mod reading;
mod series;
mod spread_rule;
mod t_test;
mod values;
mod verdict;

pub use calibrate::{Calibration, FALSE_ALARMS, Proposal, ProposedLimit, calibrate};
pub use files::{GATE, keep_verdict, kept_verdict, verdict_file};
pub use json::{
    BandRecord, CheckRecord, FrameCheckRecord, GATE_SCHEMA, LossRecord, PictureRecord, PlaceRecord,
    RuleRecord, VerdictRecord, write_verdict_json,
};
pub(crate) use loss::own_difference;
pub use loss::{BandLoss, Compared, Loss, LossPicture, Place, statistic_name};
pub(crate) use series::Series;
pub(crate) use spread_rule::tested_quantities;
pub use values::{ComparisonName, FoundValue, Lacking, RunValues};
pub use verdict::{Check, FrameCheck, Limit, Outcome, RuleVerdict, State, Verdict};

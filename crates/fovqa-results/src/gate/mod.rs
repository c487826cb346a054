//! The gate checks the values of a finished run against rules, and proposes limits from repeated
//! runs.

mod adjust;
mod aggregate;
mod calibrate;
mod calibration_toml;
mod json;
mod noise;
#[cfg(test)]
mod random;
mod reading;
mod spread_rule;
mod student_t;
mod t_test;
mod values;
mod verdict;

pub use calibrate::{Calibration, FALSE_ALARMS, Proposal, ProposedLimit, calibrate};
pub use json::{GATE_SCHEMA, write_verdict_json};
pub(crate) use spread_rule::tested_quantities;
pub use values::{ComparisonName, FoundValue, Lacking, RunValues};
pub use verdict::{Check, Limit, Outcome, RuleVerdict, State, Verdict};

//! Planning of studies: the trials that pairwise comparisons need, and the precision of staircases.

mod document;
mod pairs;
mod predicted;
mod staircase;

pub use self::document::Plan;
pub use self::pairs::{PairsOptions, PairsPlan, plan_pairs};
pub use self::predicted::{PredictedOptions, PredictedPair, PredictedPlan, plan_predicted};
pub use self::staircase::{First, StaircaseOptions, StaircasePlan, plan_staircase};

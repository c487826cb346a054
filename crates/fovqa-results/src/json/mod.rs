//! JSON output of `score` and JSON files of a run. New keys may be added, but keys are never
//! renamed.

mod compared;
mod doubts;
mod foveate;
mod run;
mod score;
mod spectrum;
mod summary;
mod summary_file;
mod unique_keys;
mod values;

pub use compared::{HaarRecord, HaarSides, HaarValues, SideValues};
pub use doubts::DoubtRecord;
pub use foveate::{
    BudgetRecord, FOVEATE_SCHEMA, FoveateErrorRecord, FoveateRecord, FoveatedRecord,
};
pub use run::{ExperimentRecord, MOST_LISTED_INPUTS, RUN_SCHEMA, RunRecord};
pub use score::{SCORE_SCHEMA, write_json, write_stereo_json};
pub use spectrum::{SpectrumBin, SpectrumRecord, SpectrumValues, summary_spectra};
pub use summary::{BandStatistics, ComparisonSummary, ErrorRecord, SUMMARY_SCHEMA, ViewRecord};
pub use summary_file::{read_summary, write_summary};
pub(crate) use unique_keys::CheckedKeys;
pub use values::Number;

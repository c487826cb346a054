//! The data files of `fovqa curves`: all values as one tidy table, and a record of curves, settings
//! and counts.

mod record;
mod tidy;

pub use record::{CurveRecord, CurvesRecord, FieldRecord, ScreenRecord, ShadingRecord};
pub use tidy::curves_csv;

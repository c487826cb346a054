//! The results of a user study as text.

use fovqa_study::Analysis;

/// The tables of a study.
pub fn study_text(analysis: &Analysis) -> String {
    match *analysis {}
}

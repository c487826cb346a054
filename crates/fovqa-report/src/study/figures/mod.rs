use crate::sheet::NamedFigure;
use fovqa_study::{Analysis, Settings};
pub(crate) fn figures(_analysis: &Analysis, _name: &str, _settings: &Settings) -> Vec<NamedFigure> {
    Vec::new()
}

//! The files that are read, which no output may replace.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use fovqa_engine::FoundView;
use fovqa_frame::source::{Length, Origin, Source};
use fovqa_plan::{EyeView, Gaze, SourceSpec};

use crate::error::Error;

/// Refuses a video on standard input: the names and the number of the outputs depend on its length,
/// which is not known.
pub(super) fn refuse_stream(reference: &SourceSpec) -> Result<(), Error> {
    if reference == &SourceSpec::Files("-".into()) {
        let message = "a video on standard input cannot be emulated";
        return Err(Error::usage(message, "write it to a .y4m file first"));
    }
    Ok(())
}

/// All files of the inputs, as canonical paths.
pub(super) fn files(view: &FoundView, eye: &EyeView) -> BTreeSet<PathBuf> {
    let of_source = |source: &dyn Source| {
        let frames = match source.listing().length() {
            None => source.listing().entries().len(),
            // All frames of a video are in one file.
            Some(Length::Whole(_) | Length::Damaged(_) | Length::Open) => 1,
        };
        let origins = (0..frames).flat_map(|frame| source.origins(frame));
        let path = |(_, origin)| match origin {
            Origin::File(path) => Some(path),
            Origin::Made(_) => None,
        };
        origins.filter_map(path).collect::<Vec<PathBuf>>()
    };
    let trace = match &eye.settings.gaze {
        Gaze::Trace { path, .. } => Some(path.clone()),
        Gaze::Centre | Gaze::Point(_) | Gaze::Each(_) | Gaze::Builtin => None,
    };
    let files = view.sources.all().flat_map(of_source).chain(trace);
    files.filter_map(|path| fs::canonicalize(path).ok()).collect()
}

/// Whether a path leads to one of these files.
pub(super) fn contains(files: &BTreeSet<PathBuf>, path: &Path) -> bool {
    fs::canonicalize(path).is_ok_and(|path| files.contains(&path))
}

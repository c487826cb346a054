//! Makes the figures and tables of curves files.

use std::path::{Path, PathBuf};

use fovqa_engine::{Events, Locking, ResultsFolder};
use fovqa_methods::curves::trace_all;
use fovqa_plan::CurvesFile;
use fovqa_report::DrawnCurves;

use crate::error::Error;
use crate::finish::in_folder;
use crate::foreseen_figures::{CHANGE, warn_of_curves};

/// Computes the curves of a file, and writes its values, figures and tables into a folder. The
/// folder is `output`, or `reports/NAME` in the working directory, where NAME is the name in the
/// file.
///
/// # Errors
/// If a curve is not possible, or the folder cannot be written to.
pub fn curves(
    file: &CurvesFile,
    output: Option<&Path>,
    locking: Locking,
    events: &dyn Events,
) -> Result<(PathBuf, DrawnCurves), Error> {
    let folder = output.map_or_else(|| Path::new("reports").join(&file.name), Path::to_owned);
    let curves = trace_all(&file.plan.curves, file.plan.range, &file.plan.acuity)
        .map_err(|error| Error::usage(format!("{}: {error}", file.name), ""))?;
    let folder =
        ResultsFolder::open_for_curves(&folder, locking).map_err(|error| in_folder(&error))?;
    folder.clear().map_err(|error| in_folder(&error))?;
    let begin = |what: &str, items| events.step(what, items);
    let drawn =
        fovqa_report::draw_curves(folder.path(), file, &curves, &begin).map_err(|error| {
            if error.is_of_settings() {
                Error::usage(error.to_string(), CHANGE)
            } else {
                Error::input(
                    error.to_string(),
                    "free some space, or give another folder with {output}",
                )
            }
        })?;
    warn_of_curves(file, events);
    drawn.warnings.iter().for_each(|warning| events.warn(warning));
    let mut notes: Vec<&String> = Vec::new();
    let of_curves = curves.iter().flat_map(|curve| &curve.notes);
    for note in file.plan.left_out.iter().chain(of_curves) {
        if !notes.contains(&note) {
            notes.push(note);
            events.note(note);
        }
    }
    Ok((folder.path().to_owned(), drawn))
}

//! Makes the tables and figures of a finished run again.

use std::path::Path;

use fovqa_engine::{Events, Locking, ResultsFolder, shard_in};
use fovqa_report::{Drawn, DrawnLimits};
use fovqa_results::{
    CURVES_JSON, LIMITS_JSON, LIMITS_SCHEMA, LimitsRecord, RUN_JSON, STUDY_JSON, read_json_file,
};

use crate::error::Error;
use crate::finish::in_folder;

/// What was made for a folder.
#[derive(Debug)]
pub enum Report {
    /// The tables and figures of a run.
    Run(Drawn),
    /// The table and figures of a search for limits.
    Limits(DrawnLimits),
    /// A page about this number of results folders in it.
    Index(usize),
}

/// Makes the tables, figures and page of a run again, without scoring. For a folder that contains
/// several such folders, makes a page about all of them.
///
/// # Errors
/// If the folder contains no results, or cannot be written to.
pub fn report(folder: &Path, locking: Locking, events: &dyn Events) -> Result<Report, Error> {
    let begin = |what: &str, items| events.step(what, items);
    let shown = folder.display();
    if folder.join(CURVES_JSON).is_file() {
        let message = format!("{shown}: the folder contains curves");
        let help = "draw them again with `fovqa curves`, from their file";
        return Err(Error::input(message, help));
    }
    if folder.join(STUDY_JSON).is_file() && !folder.join(RUN_JSON).is_file() {
        let message = format!("{shown}: the folder contains a study");
        let help = "carry it out again with `fovqa study`, from its file";
        return Err(Error::input(message, help));
    }
    if folder.join(LIMITS_JSON).is_file() {
        let failed = |error: &dyn std::fmt::Display| {
            Error::input(error.to_string(), "search again with `fovqa limit`")
        };
        let record: LimitsRecord =
            read_json_file(&folder.join(LIMITS_JSON), LIMITS_SCHEMA, "the record of a search")
                .map_err(|error| failed(&error))?;
        let folder =
            ResultsFolder::open_for_limits(folder, locking).map_err(|error| in_folder(&error))?;
        let drawn = fovqa_report::draw_limits(folder.path(), &record, &begin);
        return Ok(Report::Limits(drawn.map_err(|error| failed(&error))?));
    }
    if !folder.join(RUN_JSON).is_file() && folder.is_dir() {
        let index = fovqa_report::draw_index(folder);
        let index =
            index.map_err(|error| Error::input(error.to_string(), "correct it or move it away"))?;
        if let Some(folders) = index {
            return Ok(Report::Index(folders));
        }
    }
    // This is checked before the folder is opened, because a folder that contains no run must not
    // be marked as a results folder.
    if !folder.join(RUN_JSON).is_file() {
        return Err(match shard_in(folder) {
            Some(shard) => Error::input(
                format!("{shown}: the folder contains shard {shard} of a run, but no results yet"),
                "`fovqa merge` joins shards",
            ),
            None => Error::input(
                format!("{shown}: the folder contains no finished run"),
                "give the folder that `fovqa run` wrote to, or a folder that contains such folders",
            ),
        });
    }
    let folder = ResultsFolder::open(folder, locking).map_err(|error| in_folder(&error))?;
    let drawn = fovqa_report::draw(folder.path(), &begin);
    let drawn = drawn.map_err(|error| {
        if error.is_of_settings() {
            let help = "change its `figure`, or [figures], in the experiment file, and run `fovqa run FILE --resume`";
            Error::usage(error.to_string(), help)
        } else {
            let help = "run the experiment again; `fovqa run FILE --resume` keeps what is scored";
            Error::input(error.to_string(), help)
        }
    });
    Ok(Report::Run(drawn?))
}

//! Steps after scoring: writes files, tables and figures.

use std::path::Path;

use fovqa_engine::{Events, FolderError, Named, ResultsFolder};
use fovqa_io::id_of;
use fovqa_plan::{Experiment, Eye};
use fovqa_report::Drawn;
use fovqa_results::{
    Batch, ExperimentRecord, Failure, FileError, INPUTS_CSV, Inputs, MOST_LISTED_INPUTS, RUN_JSON,
    RUN_SCHEMA, RunRecord, RunResults, SUMMARY_JSON, checksums, write_inputs, write_summary,
    write_tables,
};

use crate::error::Error;
use crate::gate::clear::clear_gate;
use crate::values::clear_values;

/// Removes the results of an earlier run, so that they cannot be mistaken for the results of this
/// one.
pub(crate) fn clear(folder: &ResultsFolder) -> Result<(), Error> {
    folder.clear().map_err(|error| in_folder(&error))?;
    fovqa_report::clear(folder.path());
    clear_gate(folder.path());
    clear_values(folder.path());
    Ok(())
}

/// Converts an error of a file of results.
pub(crate) fn no_space(error: &FileError) -> Error {
    Error::input(error.to_string(), NO_SPACE)
}

/// Converts an error of a results folder.
pub(crate) fn in_folder(error: &FolderError) -> Error {
    Error::input(error.to_string(), error.help())
}

/// What is done with a folder that has its results, before the report is made.
pub(crate) type Judge<'a> = dyn FnMut(&ResultsFolder) -> Result<(), Error> + 'a;

/// Writes the results and the report. Returns the number of errors and what the report contains.
/// Reports the items that could not be scored.
pub(crate) fn finish(
    experiment: &Experiment,
    results: RunResults,
    folder: &ResultsFolder,
    events: &dyn Events,
    judge: &mut Judge<'_>,
) -> Result<(usize, Drawn), Error> {
    let failures = results.comparisons.iter().flat_map(|comparison| {
        let eye = Some(comparison.eye).filter(|eye| !eye.is_empty());
        let place = [Some(comparison.scene.as_str()), Some(&comparison.method), eye];
        comparison.report.failures.iter().map(move |failure| (place, failure))
    });
    let errors = failures.clone().count();
    say_failures(failures, "summary.json", events);
    let writing = events.step("writing the results", 0);
    if let Err(error) = write(experiment, results, folder.path()) {
        return Err(no_space(&error));
    }
    drop(writing);
    judge(folder)?;
    let begin = |what: &str, items| events.step(what, items);
    let drawn = fovqa_report::draw(folder.path(), &begin).map_err(|error| {
        if error.is_of_settings() {
            Error::usage(error.to_string(), FIT)
        } else {
            Error::input(error.to_string(), DRAW_AGAIN)
        }
    })?;
    Ok((errors, drawn))
}

/// The SHA-256 of a text.
pub fn text_hash(text: &str) -> String {
    // Reading from memory does not fail.
    id_of(text.as_bytes()).map(|id| id.sha256).unwrap_or_default()
}

/// The help text for results that cannot be written.
const NO_SPACE: &str = "free some space, or give another folder with {output}; {resume} continues with the frames that are already scored";

/// The help text for figures that cannot be as the experiment says.
const FIT: &str =
    "all scores and the other figures are written; change the experiment, and run it with {resume}";

/// The help text for the case that only the tables and figures failed.
const DRAW_AGAIN: &str =
    "the results are written; correct this problem, and `fovqa report` draws them";

/// Reports the items of a shard that could not be scored. A shard has no results of its own.
pub(crate) fn say_failures_of_shard(failures: &[(Named<'_>, &Failure)], events: &dyn Events) {
    let place = |named: &Named<'_>| {
        let (scene, method) = (named.scene.to_owned(), named.method.to_owned());
        [Some(scene), Some(method), named.eye.map(|eye| Eye::name(eye).to_owned())]
    };
    let failures = failures.iter().map(|(named, failure)| (place(named), *failure));
    say_failures(failures, "the journal of the shard", events);
}

/// Reports the items that could not be scored. If there are very many, only the first ones are
/// reported.
fn say_failures<'a, T: AsRef<str>>(
    failures: impl Iterator<Item = ([Option<T>; 3], &'a Failure)>,
    all: &str,
    events: &dyn Events,
) {
    const SHOWN: usize = 20;
    let mut more = 0;
    for (nth, (place, failure)) in failures.enumerate() {
        if nth >= SHOWN {
            more += 1;
            continue;
        }
        let place = place.iter().flatten().map(|name| name.as_ref().to_owned());
        let frame = failure.frame.map(|frame| format!("frame {frame}"));
        let place: Vec<String> = place.chain(frame).collect();
        events.failure(&format!("{}: {}", place.join(", "), failure.message), &failure.help);
    }
    if more > 0 {
        events.note(&format!("{all} lists {more} more errors"));
    }
}

fn write(experiment: &Experiment, results: RunResults, folder: &Path) -> Result<(), FileError> {
    let batch = Batch::default();
    write_tables(folder, &results, &experiment.output, &batch)?;
    batch.write_with(&folder.join(SUMMARY_JSON), |out| {
        write_summary(&experiment.name, &results, out)
    })?;
    let file = experiment.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let (inputs, inputs_file) = if results.inputs.len() > MOST_LISTED_INPUTS {
        batch.write_with(&folder.join(INPUTS_CSV), |out| write_inputs(&results.inputs, out))?;
        (Inputs::default(), Some(INPUTS_CSV.to_owned()))
    } else {
        (results.inputs, None)
    };
    let record = RunRecord {
        schema: RUN_SCHEMA.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        experiment: ExperimentRecord {
            file,
            sha256: text_hash(&experiment.text),
            text: experiment.text.clone(),
        },
        resolved: experiment.resolved(),
        inputs,
        inputs_file,
        files: checksums(folder)?,
    };
    // The record vouches for the other files, so their names come first.
    batch.flush();
    batch.write_json(&folder.join(RUN_JSON), &record)
}

//! What is left to do once everything is scored: files, tables, figures, and saying so.

use std::path::Path;

use fovqa_engine::{FolderError, Named, ResultsFolder};
use fovqa_io::id_of;
use fovqa_plan::{Experiment, Eye};
use fovqa_report::Drawn;
use fovqa_results::{
    ExperimentRecord, Failure, FileError, RESULTS_CSV, RUN_JSON, RUN_SCHEMA, RunRecord, RunResults,
    SUMMARY_JSON, SummaryRecord, write_json_file, write_results_csv, write_whole_with,
};

use crate::diagnostic;
use crate::dialect::Dialect;
use crate::exit::Exit;
use crate::output;

/// Takes away what an earlier run has left, so that it cannot be taken for this one's.
pub(crate) fn clear(folder: &ResultsFolder) -> Result<(), FolderError> {
    folder.clear()?;
    fovqa_report::clear(folder.path());
    Ok(())
}

/// What of a run goes to stdout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shown {
    /// The comparison.
    Table,
    /// Nothing: something else will.
    Nothing,
}

/// Writes the results, draws them, and says where they are. An error: they could not be written or drawn.
pub(crate) fn finish(
    experiment: &Experiment,
    results: &RunResults,
    folder: &ResultsFolder,
    shown: Shown,
) -> Result<Exit, Exit> {
    let summary = SummaryRecord::of(&experiment.name, results);
    let failures = results.comparisons.iter().flat_map(|comparison| {
        let eye = Some(comparison.eye).filter(|eye| !eye.is_empty());
        let place = [Some(comparison.scene.as_str()), Some(&comparison.method), eye];
        comparison.report.failures.iter().map(move |failure| (place, failure))
    });
    say_failures(failures, "summary.json");
    if let Err(error) = write(experiment, results, &summary, folder.path()) {
        let help = "free some space, or give another folder with --output; --resume goes on with what is scored";
        return Err(failed(&error, help));
    }
    let drawn = fovqa_report::draw(folder.path()).map_err(|error| failed(&error, DRAW_AGAIN))?;
    let drawn = match shown {
        Shown::Table => drawn,
        Shown::Nothing => Drawn { table: None, ..drawn },
    };
    let printed = say(&drawn, folder.path());
    let own = results.comparisons.iter().filter(|comparison| comparison.eye != "both");
    let scored: usize = own.map(|comparison| comparison.report.frames.len()).sum();
    if summary.errors.is_empty() {
        return Ok(printed);
    }
    say_rest(summary.errors.len(), scored);
    Ok(Exit::Input)
}

/// The SHA-256 of a text.
pub(crate) fn text_hash(text: &str) -> String {
    // Reading from memory does not fail.
    id_of(text.as_bytes()).map(|id| id.sha256).unwrap_or_default()
}

/// What is left to do when only the drawing failed.
const DRAW_AGAIN: &str = "the results are written: mend this, and `fovqa report` draws them";

/// The same of a shard, which has no results of its own: whether anything of it could not be scored.
pub(crate) fn say_failures_of_shard(failures: &[(Named<'_>, &Failure)], scored: usize) -> bool {
    let place = |named: &Named<'_>| {
        let (scene, method) = (named.scene.to_owned(), named.method.to_owned());
        [Some(scene), Some(method), named.eye.map(|eye| Eye::name(eye).to_owned())]
    };
    say_failures(failures.iter().map(|(named, failure)| (place(named), *failure)), "its journal");
    if !failures.is_empty() {
        say_rest(failures.len(), scored);
    }
    !failures.is_empty()
}

fn say_rest(errors: usize, scored: usize) {
    let lines = if errors == 1 { "1 error" } else { &format!("{errors} errors") };
    let rest = match scored {
        0 => "nothing was scored".to_owned(),
        scored => format!("{scored} frames scored all the same"),
    };
    diagnostic::error(&format!("{lines}, {rest}"), "");
}

/// Says what could not be scored; of a great many, the first.
fn say_failures<'a, T: AsRef<str>>(
    failures: impl Iterator<Item = ([Option<T>; 3], &'a Failure)>,
    all: &str,
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
        let help = Dialect::Experiment.spell(&failure.help);
        diagnostic::error(&format!("{}: {}", place.join(", "), failure.message), &help);
    }
    if more > 0 {
        diagnostic::note(&format!("{more} more errors stand in {all}"));
    }
}

fn write(
    experiment: &Experiment,
    results: &RunResults,
    summary: &SummaryRecord,
    folder: &Path,
) -> Result<(), FileError> {
    write_whole_with(&folder.join(RESULTS_CSV), |out| write_results_csv(results, out))?;
    write_json_file(&folder.join(SUMMARY_JSON), summary)?;
    let file = experiment.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let record = RunRecord {
        schema: RUN_SCHEMA.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        experiment: ExperimentRecord {
            file,
            sha256: text_hash(&experiment.text),
            text: experiment.text.clone(),
        },
        resolved: experiment.resolved(),
        inputs: results.inputs.clone(),
    };
    write_json_file(&folder.join(RUN_JSON), &record)
}

/// The comparison on stdout, and where the files are on stderr.
pub(crate) fn say(drawn: &Drawn, folder: &Path) -> Exit {
    let printed = match &drawn.table {
        Some(table) => output::write(|out| out.write_all(table.terminal().as_bytes())),
        None => Exit::Done,
    };
    let figures = match drawn.figures {
        0 => String::new(),
        1 => ", 1 figure".to_owned(),
        n => format!(", {n} figures"),
    };
    let folder = folder.display();
    diagnostic::note(&format!(
        "{folder}: results.csv, summary.json{figures}; look at {folder}/index.html"
    ));
    printed
}

/// An error of an input or of the output.
pub(crate) fn failed(error: &dyn std::error::Error, help: &str) -> Exit {
    diagnostic::error(&error.to_string(), &Dialect::Experiment.spell(help));
    Exit::Input
}

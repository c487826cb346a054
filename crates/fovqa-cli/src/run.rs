//! `fovqa run`: experiment, frames, scores, files, tables and figures.

use std::path::{Path, PathBuf};

use fovqa_config::{Experiment, Eye};
use fovqa_engine::{Found, Journal, ResultsFolder};
use fovqa_io::FileId;
use fovqa_metrics::Metric;
use fovqa_report::Drawn;
use fovqa_results::{
    ExperimentRecord, FileError, RESULTS_CSV, RUN_JSON, RUN_SCHEMA, RunRecord, RunResults,
    SUMMARY_JSON, SummaryRecord, write_json_file, write_results_csv, write_whole_with,
};

use crate::args::RunArgs;
use crate::diagnostic;
use crate::dialect::Dialect;
use crate::exit::Exit;
use crate::heat_maps::HeatMaps;
use crate::progress::Terminal;
use crate::{experiment, output, threads};

pub(crate) fn run(args: &RunArgs) -> Exit {
    scored(args, Shown::Table).1
}

/// What of a run goes to stdout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shown {
    /// The comparison.
    Table,
    /// Nothing: something else will.
    Nothing,
}

/// Scores an experiment; the folder with its results, where they could be written, and how that ended.
pub(crate) fn scored(args: &RunArgs, shown: Shown) -> (Option<PathBuf>, Exit) {
    match into_folder(args, shown) {
        Ok((folder, exit)) => (Some(folder), exit),
        Err(exit) => (None, exit),
    }
}

fn into_folder(args: &RunArgs, shown: Shown) -> Result<(PathBuf, Exit), Exit> {
    if let Err(message) = threads::start(args.threads) {
        diagnostic::error(&message, "ask for fewer");
        return Err(Exit::Usage);
    }
    let mut experiment = experiment::read(&args.experiment)?;
    experiment.plan.frames = args.frames;
    experiment.plan.maps = args.maps.is_some();
    if args.maps.is_some() && !experiment.plan.metrics.metrics().contains(&Metric::Fvvdp) {
        let message = "--maps are of FovVideoVDP, and the experiment does not score it";
        diagnostic::error(message, "add fvvdp = {} to [metrics]");
        return Err(Exit::Usage);
    }
    let maps = args.maps.clone().map(|folder| HeatMaps::new(folder, true));
    let folder = args.output.clone().unwrap_or_else(|| default_folder(&experiment));
    // Before anything is read or scored: a folder that cannot be written to is found now.
    let folder = ResultsFolder::open(&folder).map_err(|error| failed(&error, error.help()))?;
    let found = fovqa_engine::find(&experiment.plan);
    if found.problems.iter().any(|problem| problem.error.is_usage()) {
        say_problems(&experiment, &found);
        return Err(Exit::Usage);
    }
    let results = score(&experiment, &found, &folder, maps.as_ref())?;
    let exit = finish(&experiment, &results, &folder, shown)?;
    Ok((folder.path().to_owned(), exit))
}

fn default_folder(experiment: &Experiment) -> PathBuf {
    Path::new("reports").join(&experiment.name)
}

/// Says what is wrong with the inputs as a whole.
pub(crate) fn say_problems(experiment: &Experiment, found: &Found) {
    for problem in &found.problems {
        let scene = &experiment.plan.scenes[problem.scene];
        let eye = scene.eyes[problem.eye].eye.map(Eye::name);
        let method = problem.method.map(|method| experiment.plan.methods[method].as_str());
        let place: Vec<&str> =
            [Some(scene.name.as_str()), method, eye].into_iter().flatten().collect();
        let help = Dialect::Experiment.spell(&problem.error.help());
        diagnostic::error(&format!("{}: {}", place.join(", "), problem.error), &help);
    }
}

fn score(
    experiment: &Experiment,
    found: &Found,
    folder: &ResultsFolder,
    maps: Option<&HeatMaps>,
) -> Result<RunResults, Exit> {
    folder.clear().map_err(|error| failed(&error, error.help()))?;
    fovqa_report::clear(folder.path());
    let hash = file_hash(&experiment.text);
    let terminal = Terminal::speaking(Dialect::Experiment);
    let scored = Journal::create(folder.path(), &hash).and_then(|mut journal| {
        fovqa_engine::run(&experiment.plan, found, &terminal, &mut |frame| {
            maps.map_or(Ok(()), |maps| maps.write(&frame))?;
            journal.write(&frame)
        })
    });
    terminal.finish();
    scored.map_err(|error| {
        diagnostic::error(&error.to_string(), &Dialect::Experiment.spell(&error.help()));
        if error.is_usage() { Exit::Usage } else { Exit::Input }
    })
}

/// Writes the results, draws them, and says where they are.
fn finish(
    experiment: &Experiment,
    results: &RunResults,
    folder: &ResultsFolder,
    shown: Shown,
) -> Result<Exit, Exit> {
    let summary = SummaryRecord::of(&experiment.name, results);
    say_failures(results);
    if let Err(error) = write(experiment, results, &summary, folder.path()) {
        return Err(failed(&error, "free some space, or give another folder with --output"));
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
    let errors = summary.errors.len();
    let lines = if errors == 1 { "1 error" } else { &format!("{errors} errors") };
    let rest = match scored {
        0 => "nothing was scored".to_owned(),
        scored => format!("{scored} frames scored all the same"),
    };
    diagnostic::error(&format!("{lines}, {rest}"), "");
    Ok(Exit::Input)
}

/// What is left to do when only the drawing failed.
const DRAW_AGAIN: &str = "the results are written: mend this, and `fovqa report` draws them";

/// Says what could not be scored; of a great many, the first.
fn say_failures(results: &RunResults) {
    const SHOWN: usize = 20;
    let failures = || {
        let comparisons = results.comparisons.iter();
        comparisons.flat_map(|comparison| {
            comparison.report.failures.iter().map(move |failure| (comparison, failure))
        })
    };
    for (comparison, failure) in failures().take(SHOWN) {
        let frame = failure.frame.map(|frame| format!("frame {frame}"));
        let eye = Some(comparison.eye).filter(|eye| !eye.is_empty()).map(str::to_owned);
        let place = [Some(comparison.scene.clone()), Some(comparison.method.clone()), eye, frame];
        let place: Vec<String> = place.into_iter().flatten().collect();
        let help = Dialect::Experiment.spell(&failure.help);
        diagnostic::error(&format!("{}: {}", place.join(", "), failure.message), &help);
    }
    let more = failures().count().saturating_sub(SHOWN);
    if more > 0 {
        diagnostic::note(&format!("{more} more errors stand in summary.json"));
    }
}

pub(crate) fn file_hash(text: &str) -> String {
    // Reading from memory does not fail.
    FileId::of(text.as_bytes()).map(|id| id.sha256).unwrap_or_default()
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
            sha256: file_hash(&experiment.text),
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

fn failed(error: &dyn std::error::Error, help: &str) -> Exit {
    diagnostic::error(&error.to_string(), &Dialect::Experiment.spell(help));
    Exit::Input
}

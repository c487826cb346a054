//! `fovqa baseline save|show|accept`.

use std::path::Path;

use fovqa_report::{baseline_table, difference_table};
use fovqa_results::{Baseline, write_json_file};

use crate::args::BaselineCommand;
use crate::diagnostic;
use crate::exit::Exit;
use crate::finished_run::FinishedRun;
use crate::output;
use crate::results::text_hash;

pub(crate) fn run(command: &BaselineCommand) -> Exit {
    let done = match command {
        BaselineCommand::Save(args) => save(&args.results, &args.baseline),
        BaselineCommand::Show(args) => read(&args.baseline).map(|baseline| {
            output::write(|out| out.write_all(baseline_table(&baseline).as_bytes()))
        }),
        BaselineCommand::Accept(args) => {
            accept(&args.results, &args.baseline, &args.scenes, args.dry_run)
        }
    };
    done.unwrap_or_else(|exit| exit)
}

fn read(path: &Path) -> Result<Baseline, Exit> {
    Baseline::read(path).map_err(|error| {
        diagnostic::error(&error.to_string(), "`fovqa baseline save` makes one of a run");
        Exit::Input
    })
}

/// The baseline of a run in which everything was scored.
fn of_run(results: &Path) -> Result<Baseline, Exit> {
    let finished = FinishedRun::read(results)?;
    if let Some(error) = finished.values.errors.first() {
        let message = format!("{}: not everything was scored: {error}", results.display());
        diagnostic::error(&message, "a baseline is of a whole run: mend the inputs and run again");
        return Err(Exit::Input);
    }
    let rules = &finished.record.resolved.gates;
    Ok(Baseline::of(&finished.record, &finished.values, rules, &text_hash))
}

fn write(baseline: &Baseline, path: &Path) -> Result<(), Exit> {
    write_json_file(path, baseline).map_err(|error| {
        diagnostic::error(&error.to_string(), "give another file");
        Exit::Input
    })
}

fn save(results: &Path, path: &Path) -> Result<Exit, Exit> {
    if path.exists() {
        let message = format!("{}: it is there already", path.display());
        diagnostic::error(&message, "`fovqa baseline accept` shows what differs and renews it");
        return Err(Exit::Input);
    }
    let baseline = of_run(results)?;
    write(&baseline, path)?;
    let values: usize = baseline.comparisons.iter().map(|c| c.values().count()).sum();
    diagnostic::note(&format!(
        "{}: {} comparisons, {values} values",
        path.display(),
        baseline.comparisons.len()
    ));
    Ok(Exit::Done)
}

fn accept(results: &Path, path: &Path, scenes: &[String], dry: bool) -> Result<Exit, Exit> {
    let before = read(path)?;
    let new = of_run(results)?;
    let accepted = before.accepting(&new, scenes).map_err(|why| {
        let message = format!("{}: {why}", path.display());
        diagnostic::error(&message, "accept all of the run, without --scene");
        Exit::Input
    })?;
    if let Some(why) = before.refuses(&new.resolved) {
        diagnostic::warning(&format!("the values were taken otherwise: {why}"));
    }
    let differences = before.differences(&new, scenes);
    let table = difference_table(&differences);
    let printed = output::write(|out| out.write_all(table.as_bytes()));
    if dry {
        diagnostic::note(&format!("{} values differ; nothing is written", differences.len()));
        return Ok(printed);
    }
    if printed != Exit::Done {
        // What could not be shown is not taken over.
        return Ok(printed);
    }
    write(&accepted, path)?;
    diagnostic::note(&format!("{}: {} values have changed", path.display(), differences.len()));
    Ok(printed)
}

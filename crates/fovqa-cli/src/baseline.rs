//! `fovqa baseline save|show|accept`.

use std::path::Path;

use fovqa_report::{baseline_table, difference_table};

use crate::args::BaselineCommand;
use crate::exit::Exit;
use crate::{diagnostic, experiment, output};

pub(crate) fn run(command: &BaselineCommand) -> Exit {
    let done = match command {
        BaselineCommand::Save(args) => save(&args.results, &args.baseline),
        BaselineCommand::Show(args) => fovqa::read_baseline(&args.baseline).map(|baseline| {
            output::write(|out| out.write_all(baseline_table(&baseline).as_bytes()))
        }),
        BaselineCommand::Accept(args) => {
            accept(&args.results, &args.baseline, &args.scenes, args.dry_run)
        }
    };
    done.unwrap_or_else(|error| experiment::failed(&error))
}

fn save(results: &Path, path: &Path) -> Result<Exit, fovqa::Error> {
    let baseline = fovqa::save_baseline(results, path)?;
    let values: usize = baseline.comparisons.iter().map(|c| c.values().count()).sum();
    diagnostic::note(&format!(
        "{}: {} comparisons, {values} values",
        path.display(),
        baseline.comparisons.len()
    ));
    Ok(Exit::Done)
}

fn accept(results: &Path, path: &Path, scenes: &[String], dry: bool) -> Result<Exit, fovqa::Error> {
    let accepted = fovqa::accept_baseline(results, path, scenes)?;
    if let Some(why) = &accepted.taken_otherwise {
        diagnostic::warning(&format!("the values were measured differently: {why}"));
    }
    let count = accepted.differences.len();
    let table = difference_table(&accepted.differences);
    let printed = output::write(|out| out.write_all(table.as_bytes()));
    if dry {
        diagnostic::note(&format!("{count} values differ; nothing was written"));
        return Ok(printed);
    }
    if printed != Exit::Done {
        // If the differences could not be shown, the new baseline is not written.
        return Ok(printed);
    }
    accepted.write(path)?;
    diagnostic::note(&format!("{}: {count} values have changed", path.display()));
    Ok(printed)
}

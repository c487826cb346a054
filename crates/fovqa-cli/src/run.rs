//! `fovqa run`: scores an experiment and writes files, tables and figures; or scores one shard of
//! it.

use fovqa::{Finished, Given, Run, RunOptions, Shard};

use crate::args::RunArgs;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{diagnostic, experiment, output, threads};
use fovqa::Dialect;

pub(crate) fn run(args: &RunArgs) -> Exit {
    scored(args).unwrap_or_else(|exit| exit)
}

fn scored(args: &RunArgs) -> Result<Exit, Exit> {
    threads::started(args.threads)?;
    let experiment = experiment::read(&args.experiment)?;
    let name = experiment.name.clone();
    let options = RunOptions {
        output: args.output.clone(),
        resume: args.resume,
        shard: args.shard,
        frames: args.frames,
        maps: args.maps.clone(),
        locking: args.lock.locking(),
    };
    let terminal = Terminal::speaking(Dialect::Experiment);
    let finished = Run::new(experiment, options, &Given::default())
        .and_then(|run| run.start(&terminal))
        .map_err(|error| experiment::failed(&error))?;
    let printed = match args.shard {
        None => say(&finished),
        Some(shard) => say_shard(&name, shard, &finished),
    };
    Ok(printed)
}

/// Prints the comparison table on stdout, and the location of the files on stderr.
pub(crate) fn say(finished: &Finished) -> Exit {
    let table = finished.drawn.as_ref().and_then(|drawn| drawn.table.as_ref());
    let printed = match table {
        Some(table) => output::text(&table.terminal()),
        None => Exit::Done,
    };
    for warning in finished.drawn.iter().flat_map(|drawn| &drawn.warnings) {
        diagnostic::warning(warning);
    }
    diagnostic::note(&finished.in_words());
    match finished.errors_in_words() {
        None => printed,
        Some(errors) => {
            diagnostic::error(&errors, "");
            Exit::Input
        }
    }
}

/// Prints where a shard is. A shard has no results of its own.
fn say_shard(name: &str, shard: Shard, finished: &Finished) -> Exit {
    let errors = finished.errors_in_words();
    if let Some(errors) = &errors {
        diagnostic::error(errors, "");
    }
    let scored = finished.scored;
    let frames = if scored == 1 { "1 frame" } else { &format!("{scored} frames") };
    diagnostic::note(&format!(
        "{}: shard {shard} of {name}, {frames}; `fovqa merge` joins shards",
        finished.folder.display()
    ));
    if errors.is_some() { Exit::Input } else { Exit::Done }
}

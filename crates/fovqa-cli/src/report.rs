//! `fovqa report`: tables and figures of a finished run, drawn again.

use fovqa_engine::{ResultsFolder, shard_in};
use fovqa_results::{CURVES_JSON, RUN_JSON};

use crate::args::ReportArgs;
use crate::diagnostic;
use crate::dialect::Dialect;
use crate::exit::Exit;

pub(crate) fn run(args: &ReportArgs) -> Exit {
    if args.results.join(CURVES_JSON).is_file() {
        let message = format!("{}: these are curves", args.results.display());
        diagnostic::error(&message, "draw them again with `fovqa curves`, from their file");
        return Exit::Input;
    }
    if !args.results.join(RUN_JSON).is_file() && args.results.is_dir() {
        match fovqa_report::draw_index(&args.results) {
            Ok(Some(count)) => {
                let shown = args.results.display();
                let folders = if count == 1 { "1 folder" } else { &format!("{count} folders") };
                diagnostic::note(&format!("{folders} of results; look at {shown}/index.html"));
                return Exit::Done;
            }
            // Not a folder of folders either.
            Ok(None) => {}
            Err(error) => {
                diagnostic::error(&error.to_string(), "mend it or move it away");
                return Exit::Input;
            }
        }
    }
    if !args.results.join(RUN_JSON).is_file()
        && let Some(shard) = shard_in(&args.results)
    {
        let shown = args.results.display();
        let message = format!("{shown}: it has shard {shard} of a run, and no results yet");
        diagnostic::error(&message, "`fovqa merge` puts shards together");
        return Exit::Input;
    }
    // Looked at first: a folder that is none of ours must not become one.
    if !args.results.join(RUN_JSON).is_file() {
        let message = format!("{}: there is no finished run in it", args.results.display());
        diagnostic::error(
            &message,
            "give the folder that `fovqa run` wrote to, or one with such folders in it",
        );
        return Exit::Input;
    }
    let folder = match ResultsFolder::open(&args.results, args.lock.locking()) {
        Ok(folder) => folder,
        Err(error) => {
            diagnostic::error(&error.to_string(), &Dialect::Options.spell(error.help()));
            return Exit::Input;
        }
    };
    match fovqa_report::draw(folder.path()) {
        Ok(drawn) => crate::results::say(&drawn, folder.path()),
        Err(error) => {
            diagnostic::error(&error.to_string(), "run the experiment again");
            Exit::Input
        }
    }
}

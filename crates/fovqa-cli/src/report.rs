//! `fovqa report`: tables and figures of a finished run, drawn again.

use fovqa_engine::ResultsFolder;
use fovqa_results::RUN_JSON;

use crate::args::ReportArgs;
use crate::diagnostic;
use crate::dialect::Dialect;
use crate::exit::Exit;

pub(crate) fn run(args: &ReportArgs) -> Exit {
    // Looked at first: a folder that is none of ours must not become one.
    if !args.results.join(RUN_JSON).is_file() {
        let message = format!("{}: there is no finished run in it", args.results.display());
        diagnostic::error(&message, "give the folder that `fovqa run` wrote to");
        return Exit::Input;
    }
    let folder = match ResultsFolder::open(&args.results) {
        Ok(folder) => folder,
        Err(error) => {
            diagnostic::error(&error.to_string(), &Dialect::Options.spell(error.help()));
            return Exit::Input;
        }
    };
    match fovqa_report::draw(folder.path()) {
        Ok(drawn) => crate::run::say(&drawn, folder.path()),
        Err(error) => {
            diagnostic::error(&error.to_string(), "run the experiment again");
            Exit::Input
        }
    }
}

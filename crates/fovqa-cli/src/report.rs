//! `fovqa report`: makes the tables and figures of a finished run again.

use fovqa::{Finished, Report};

use crate::args::ReportArgs;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{diagnostic, experiment, output, run};
use fovqa::Dialect;

pub(crate) fn run(args: &ReportArgs) -> Exit {
    let folder = &args.results;
    let terminal = Terminal::speaking(Dialect::Experiment);
    match fovqa::report(folder, args.lock.locking(), &terminal) {
        Ok(Report::Run(drawn)) => run::say(&Finished {
            folder: folder.clone(),
            scored: 0,
            known: 0,
            errors: 0,
            drawn: Some(drawn),
        }),
        Ok(Report::Limits(drawn)) => output::text(&drawn.table),
        Ok(Report::Index(count)) => {
            let folders = if count == 1 { "1 folder" } else { &format!("{count} folders") };
            let shown = folder.display();
            diagnostic::note(&format!("{folders} of results; look at {shown}/index.html"));
            Exit::Done
        }
        Err(error) => experiment::failed(&error),
    }
}

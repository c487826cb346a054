//! `fovqa report`: makes the tables and figures of a finished run again.

use fovqa::{Finished, Report};

use crate::args::ReportArgs;
use crate::exit::Exit;
use crate::{diagnostic, experiment, output, run};

pub(crate) fn run(args: &ReportArgs) -> Exit {
    let folder = &args.results;
    match fovqa::report(folder, args.lock.locking()) {
        Ok(Report::Run(drawn)) => {
            run::say(&Finished { folder: folder.clone(), scored: 0, errors: 0, drawn: Some(drawn) })
        }
        Ok(Report::Limits(drawn)) => {
            let table = format!("{}\n", drawn.table);
            output::write(|out| out.write_all(table.as_bytes()))
        }
        Ok(Report::Index(count)) => {
            let folders = if count == 1 { "1 folder" } else { &format!("{count} folders") };
            let shown = folder.display();
            diagnostic::note(&format!("{folders} of results; look at {shown}/index.html"));
            Exit::Done
        }
        Err(error) => experiment::failed(&error),
    }
}

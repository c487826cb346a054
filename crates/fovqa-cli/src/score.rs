//! `fovqa score`: scores one comparison and prints the results.

use fovqa::{Given, write_csv, write_json};

use crate::args::{Format, ScoreArgs};
use crate::diagnostic;
use crate::dialect::Dialect;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{experiment, failures, output, threads};

pub(crate) fn run(args: ScoreArgs) -> Exit {
    let (format, maps) = (args.format, args.maps.clone());
    if let Err(exit) = threads::started(args.threads) {
        return exit;
    }
    let plan = match args.plan() {
        Ok(plan) => plan,
        Err(message) => {
            diagnostic::error(&message, "`fovqa score --help` shows every option");
            return Exit::Usage;
        }
    };
    let terminal = Terminal::default();
    let report = match fovqa::score_files(&plan, &Given::default(), maps.as_deref(), &terminal) {
        Ok(report) => report,
        Err(error) => return experiment::said(&error, Dialect::Options),
    };
    failures::show(&report.failures, report.frames.len(), "scored");
    // If nothing was scored, print nothing that looks like a result.
    let written = if report.frames.is_empty() {
        Exit::Done
    } else {
        match format {
            Format::Table => output::text(&fovqa_report::score_table(&report)),
            Format::Json => output::write(|out| write_json(&report, out)),
            Format::Csv => output::write(|out| write_csv(&report, out)),
        }
    };
    if report.failures.is_empty() { written } else { Exit::Input }
}

//! `fovqa score`: request, run, results.

use fovqa_results::{write_csv, write_json};

use crate::args::{Format, ScoreArgs};
use crate::diagnostic;
use crate::exit::Exit;
use crate::output;
use crate::progress::Terminal;
use crate::threads;

pub(crate) fn run(args: ScoreArgs) -> Exit {
    let format = args.format;
    if let Err(message) = threads::start(args.threads) {
        diagnostic::error(&message, "ask for fewer");
        return Exit::Usage;
    }
    let request = match args.request() {
        Ok(request) => request,
        Err(message) => {
            diagnostic::error(&message, "`fovqa score --help` shows every option");
            return Exit::Usage;
        }
    };
    let terminal = Terminal::default();
    let report = fovqa_engine::score(&request, &terminal);
    terminal.finish();
    let report = match report {
        Ok(report) => report,
        Err(error) => {
            diagnostic::error(&error.to_string(), &error.help());
            return if error.is_usage() { Exit::Usage } else { Exit::Input };
        }
    };
    for failure in &report.failures {
        let frame = if report.failures.len() + report.frames.len() > 1 {
            format!("frame {}: ", failure.frame)
        } else {
            String::new()
        };
        diagnostic::error(&format!("{frame}{}", failure.message), &failure.help);
    }
    // Nothing that looks like a result where nothing was scored.
    let written = if report.frames.is_empty() {
        Exit::Done
    } else {
        output::write(|out| match format {
            Format::Table => out.write_all(fovqa_report::score_table(&report).as_bytes()),
            Format::Json => write_json(&report, out),
            Format::Csv => write_csv(&report, out),
        })
    };
    if report.failures.is_empty() { written } else { Exit::Input }
}

//! `fovqa score`: scores one comparison and prints the results.

use std::path::Path;

use fovqa::{Failure, Given, write_csv, write_json};
use fovqa_plan::Plan;
use fovqa_report::{score_table, stereo_table};
use fovqa_results::{write_stereo_csv, write_stereo_json};

use crate::args::{Format, ScoreArgs};
use crate::diagnostic;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{experiment, failures, output, threads};
use fovqa::Dialect;

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
    if plan.scenes.iter().any(|scene| scene.eyes.len() > 1) {
        return of_two_eyes(&plan, format, maps.as_deref());
    }
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
            Format::Table => output::text(&score_table(&report)),
            Format::Json => output::write(|out| write_json(&report, out)),
            Format::Csv => output::write(|out| write_csv(&report, out)),
        }
    };
    if report.failures.is_empty() { written } else { Exit::Input }
}

/// Scores the left and the right eye, and prints the results of each and of both.
fn of_two_eyes(plan: &Plan, format: Format, maps: Option<&Path>) -> Exit {
    let terminal = Terminal::default();
    let report = match fovqa::score_two_eyes(plan, &Given::default(), maps, &terminal) {
        Ok(report) => report,
        Err(error) => return experiment::said(&error, Dialect::Options),
    };
    let named = |(eye, failure): (&str, &Failure)| Failure {
        message: format!("{eye} eye: {}", failure.message),
        ..failure.clone()
    };
    let failures: Vec<Failure> = report.failures().map(named).collect();
    let scored = report.left.frames.len() + report.right.frames.len();
    failures::show(&failures, scored, "scored");
    let written = if scored == 0 {
        Exit::Done
    } else {
        match format {
            Format::Table => output::text(&stereo_table(&report)),
            Format::Json => output::write(|out| write_stereo_json(&report, out)),
            Format::Csv => output::write(|out| write_stereo_csv(&report, out)),
        }
    };
    if failures.is_empty() { written } else { Exit::Input }
}

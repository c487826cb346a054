//! `fovqa score`: plan, run, results.

use fovqa_engine::EngineError;
use fovqa_plan::Plan;
use fovqa_results::{ScoreReport, write_csv, write_json};

use crate::args::{Format, ScoreArgs};
use crate::diagnostic;
use crate::dialect::Dialect;
use crate::exit::Exit;
use crate::heat_maps::HeatMaps;
use crate::output;
use crate::progress::Terminal;
use crate::threads;

/// Of a great many failures, as many as a terminal holds.
const FAILURES_SHOWN: usize = 20;

pub(crate) fn run(args: ScoreArgs) -> Exit {
    let format = args.format;
    let maps = args.maps.clone().map(|folder| HeatMaps::new(folder, false));
    if let Err(message) = threads::start(args.threads) {
        diagnostic::error(&message, "ask for fewer");
        return Exit::Usage;
    }
    let plan = match args.plan() {
        Ok(plan) => plan,
        Err(message) => {
            diagnostic::error(&message, "`fovqa score --help` shows every option");
            return Exit::Usage;
        }
    };
    let report = match score(&plan, maps.as_ref()) {
        Ok(report) => report,
        Err(error) => {
            diagnostic::error(&error.to_string(), &Dialect::Options.spell(&error.help()));
            return if error.is_usage() { Exit::Usage } else { Exit::Input };
        }
    };
    for failure in report.failures.iter().take(FAILURES_SHOWN) {
        let frame = match failure.frame {
            Some(frame) if report.failures.len() + report.frames.len() > 1 => {
                format!("frame {frame}: ")
            }
            _ => String::new(),
        };
        let help = Dialect::Options.spell(&failure.help);
        diagnostic::error(&format!("{frame}{}", failure.message), &help);
    }
    let more = report.failures.len().saturating_sub(FAILURES_SHOWN);
    if more > 0 {
        diagnostic::note(&format!(
            "{more} more frames could not be scored; --format json lists them"
        ));
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

/// One reference against one test: whatever is wrong with the whole of it ends the run.
fn score(plan: &Plan, maps: Option<&HeatMaps>) -> Result<ScoreReport, EngineError> {
    fovqa_engine::check(plan)?;
    let mut found = fovqa_engine::find(plan, &fovqa_engine::Given::default());
    if let Some(problem) = found.problems.pop() {
        return Err(problem.error);
    }
    let terminal = Terminal::default();
    let results = fovqa_engine::run(plan, &found, &terminal, &mut |entry| {
        maps.map_or(Ok(()), |maps| maps.write(&entry))
    });
    terminal.finish();
    Ok(results?.comparisons.pop().map(|comparison| comparison.report).unwrap_or_default())
}

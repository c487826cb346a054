//! An experiment from a TOML file, run, and its gate: `cargo run --example experiment -- configs/ci/nightly.toml`.

use std::path::{Path, PathBuf};

use fovqa::{
    Against, Events, Finished, Given, Locking, Run, RunOptions, gate_folder, read_experiment,
};

/// Says what a run says on the way.
struct Printed;

#[allow(clippy::print_stderr, reason = "an example prints messages")]
impl Events for Printed {
    fn warn(&self, message: &str) {
        eprintln!("warning: {message}");
    }

    fn progress(&self, done: usize, total: usize) {
        eprintln!("{done} of {total} frames");
    }

    fn failure(&self, message: &str, help: &str) {
        eprintln!("error: {message}\n  help: {help}");
    }
}

/// Runs an experiment into a folder.
pub(crate) fn run(experiment: &Path, output: PathBuf) -> Result<Finished, fovqa::Error> {
    let experiment = read_experiment(experiment)?;
    let options = RunOptions { output: Some(output), ..RunOptions::default() };
    Run::new(experiment, options, &Given::default())?.start(&Printed)
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), fovqa::Error> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let file = arguments.next().unwrap_or_else(|| "configs/renders.toml".into());
    let output = arguments.next().unwrap_or_else(|| "reports/example".into());
    let finished = run(&file, output)?;
    if let Some(table) = finished.drawn.as_ref().and_then(|drawn| drawn.table.as_ref()) {
        print!("{}", table.terminal());
    }
    println!("{} frames; look at {}/report.html", finished.scored, finished.folder.display());
    let rules = &read_experiment(&file)?.gates;
    if !rules.is_empty() && rules.iter().all(|rule| !rule.needs_baseline()) {
        let verdict =
            gate_folder(&finished.folder, &Against::default(), Locking::Locked, &Printed)?;
        println!("its gate: {:?}", verdict.state());
    }
    Ok(())
}

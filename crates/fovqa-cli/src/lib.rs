//! The command: arguments, progress and exit codes. Everything else is in the library crates.

mod args;
mod baseline;
mod check;
mod curves;
mod diagnostic;
mod exit;
mod experiment;
mod failures;
mod foveate;
mod gallery;
mod gate;
mod limit;
mod list;
mod merge;
mod output;
mod progress;
mod report;
mod run;
mod schema;
mod score;
mod study;
mod threads;
mod usage;
mod width;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::CommandFactory;

use args::{Cli, Command};
use exit::Exit;

/// Runs the command with the arguments of this process.
pub fn main() -> ExitCode {
    ExitCode::from(run_command(std::env::args_os()))
}

/// Runs the command with arguments, of which the first is the name of the program. Returns the exit code.
/// This is for programs that are the command: it handles panics and Ctrl-C for the whole process.
pub fn run_command(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    exit::watch_panics();
    exit::watch_interrupts();
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let outcome = std::panic::catch_unwind(|| {
        let cli = match usage::parse(arguments) {
            Ok(cli) => cli,
            Err(error) => return usage::show(&error),
        };
        dispatch(cli)
    });
    let exit = outcome.unwrap_or_else(|payload| exit::of_panic(&*payload)).code();
    // Not every process that runs this does so at its end.
    let _ = std::io::stdout().flush();
    exit
}

fn dispatch(cli: Cli) -> Exit {
    match cli.command {
        Command::Score(args) => score::run(*args),
        Command::Gallery(args) => gallery::run(&args),
        Command::Run(args) => run::run(&args),
        Command::Gate(args) => gate::run(&args),
        Command::Limit(args) => limit::run(&args),
        Command::Baseline(command) => baseline::run(&command),
        Command::Merge(args) => merge::run(&args),
        Command::Report(args) => report::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Curves(args) => curves::run(&args),
        Command::Foveate(args) => foveate::run(*args),
        Command::Study(args) => study::run(&args),
        Command::Schema { what } => schema::run(what),
        Command::List { what } => list::run(what),
        Command::Completions { shell } => output::write(|out| {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "fovqa", &mut script);
            out.write_all(&script)
        }),
    }
}

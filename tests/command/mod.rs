//! The command line itself: exit codes, output, and files that are named for it.

mod completions;
mod exit_codes;
mod help;
mod output;
mod outputs;
#[cfg(unix)]
mod pseudo_terminal;
#[cfg(unix)]
mod terminal;
mod two_eyes;

//! The command line itself: exit codes, output.

mod exit_codes;
mod output;

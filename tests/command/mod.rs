//! The command line itself: exit codes, output, and files that are named for it.

mod exit_codes;
mod output;
mod outputs;

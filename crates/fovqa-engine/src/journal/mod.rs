//! The journal lists, line by line, what is finished. A run that is killed therefore loses none of
//! it, and the shards of a run can be merged.
//!
//! Each line is one JSON object, written in one operation: a killed run leaves whole lines and at
//! most one partial line. Numbers are written so that reading them gives exactly the same bits.

mod header;
mod number;
mod order;
mod read;
mod records;
mod seal;
mod write;

pub use header::{Header, shard_in};
pub(crate) use header::{ViewFiles, view_files};
pub(crate) use read::{Content, LineStep, Said, Shared, Text, findings_of, read};
pub use write::Journal;
pub(crate) use write::lines_of;

/// Name of the journal in the results folder.
pub const JOURNAL: &str = "journal.jsonl";

#[cfg(test)]
mod tests;

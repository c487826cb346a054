//! The journal: what is finished, line by line, so that a run that is killed loses nothing of it, and
//! shards of a run can be put together.
//!
//! Each line is one JSON object, written in one go: a kill leaves whole lines and at most one piece
//! of a line. Numbers are written so that they are read again to the last bit.

mod header;
mod number;
mod read;
mod records;
mod seal;
mod write;

pub use header::{Header, shard_in};
pub(crate) use header::{ViewFiles, view_files};
pub(crate) use read::{Content, Text, findings_of, place, read};
pub use write::Journal;
pub(crate) use write::lines_of;

/// Its name in the folder of results.
pub const JOURNAL: &str = "journal.jsonl";

#[cfg(test)]
mod tests;

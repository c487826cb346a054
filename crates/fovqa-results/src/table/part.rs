//! Which rows of the table of a run a file has.

use super::row::TableRow;

/// A part of the rows of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// All rows.
    All,
    /// The rows of single frames, as each eye sees them: they are known as soon as a frame is scored.
    Frames,
    /// All other rows: of whole sequences, and of both eyes together.
    Sequences,
}

impl Part {
    /// Whether a row belongs to this part.
    pub(super) fn has(self, row: &TableRow<'_>) -> bool {
        let is_of_frame = row.frame.is_some() && row.eye != "both";
        match self {
            Self::All => true,
            Self::Frames => is_of_frame,
            Self::Sequences => !is_of_frame,
        }
    }
}

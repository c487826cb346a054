//! The memory that a view needs, part by part.

use std::fmt;

/// The parts of the memory that is in use at the same time: the name and the bytes of each.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Needed(pub(crate) Vec<(&'static str, u64)>);

impl Needed {
    /// The sum in bytes.
    pub(crate) fn bytes(&self) -> u64 {
        self.0.iter().fold(0, |sum, (_, bytes)| sum.saturating_add(*bytes))
    }

    /// Whether FovVideoVDP uses most of it.
    pub(crate) fn is_of_fvvdp(&self) -> bool {
        self.0.iter().max_by_key(|(_, bytes)| *bytes).is_some_and(|(who, _)| *who == FVVDP)
    }
}

impl fmt::Display for Needed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = self.0.iter().filter(|(_, bytes)| *bytes > 0);
        let parts: Vec<String> =
            parts.map(|(who, bytes)| format!("{who} {}", gigabytes(*bytes))).collect();
        f.write_str(&parts.join(", "))
    }
}

/// The name of the part that FovVideoVDP needs.
pub(crate) const FVVDP: &str = "FovVideoVDP";

/// Formats a number of bytes for a message.
pub(crate) fn gigabytes(bytes: u64) -> String {
    format!("{:.1} GB", bytes as f64 / 1e9)
}

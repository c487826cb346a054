//! The names and numbers of a source's frames, known before any frame is read.

use std::ffi::OsString;
use std::sync::Arc;

/// The frames of a source, in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Listing {
    /// The user's argument as results show it: a path or a pattern.
    pub argument: String,
    /// Whether the argument names a single frame. Two such frames make a pair whatever their names
    /// are.
    pub is_single: bool,
    /// The frames.
    pub frames: Frames,
    /// How they are numbered.
    pub numbering: Numbering,
}

/// The frames that a source has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Frames {
    /// Each frame has a name of its own.
    Named(Vec<Entry>),
    /// Frames without names, such as those of a video, counted from 0.
    Counted(Length),
}

/// How many frames a source without names has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Length {
    /// The number of frames is known.
    Whole(usize),
    /// This many frames, of which the last cannot be read. Whether more frames follow it is
    /// unknown.
    Damaged(usize),
    /// A stream, whose length is unknown.
    Open,
}

/// A frame that has a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// The name, as results show it. It is shared, because the results of a long sequence contain the name of
    /// every frame.
    pub name: Arc<str>,
    /// The name by which another source may have the same frame: a file's name without its
    /// extension.
    pub stem: OsString,
    /// The frame's number; `None` if the names do not identify the frames by number.
    pub number: Option<i64>,
}

impl Listing {
    /// A listing of frames without names.
    pub fn counted(argument: String, length: Length) -> Self {
        let frames = Frames::Counted(length);
        Self { argument, is_single: false, frames, numbering: Numbering::ByPosition }
    }

    /// The length of a source whose frames have no names.
    pub fn length(&self) -> Option<Length> {
        match self.frames {
            Frames::Named(_) => None,
            Frames::Counted(length) => Some(length),
        }
    }

    /// The frames with names; empty if the frames have none.
    pub fn entries(&self) -> &[Entry] {
        match &self.frames {
            Frames::Named(entries) => entries,
            Frames::Counted(_) => &[],
        }
    }

    /// The name of a frame in results: its own name, or that of the whole source.
    pub fn name(&self, frame: usize) -> &str {
        self.entries().get(frame).map_or(&self.argument, |entry| &entry.name)
    }

    /// The name of a frame in results, to be kept.
    pub fn shared_name(&self, frame: usize) -> Arc<str> {
        let entry = self.entries().get(frame);
        entry.map_or_else(|| self.argument.as_str().into(), |entry| Arc::clone(&entry.name))
    }

    /// The name of a frame in messages, which is unique.
    pub fn label(&self, frame: usize) -> String {
        match &self.frames {
            Frames::Named(_) => self.name(frame).to_owned(),
            Frames::Counted(_) => format!("{}, frame {frame}", self.argument),
        }
    }
}

/// How the frames of a listing are numbered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Numbering {
    /// Each name has a number of its own.
    ByName,
    /// There is only one name and it has several numbers; the last one counts.
    LastOfSeveral(String),
    /// No name has a number; the position of a frame is its number.
    ByPosition,
    /// The names have numbers that do not identify the frames; the position of a frame is its
    /// number.
    Doubtful(Doubt),
}

/// Why the numbers in names do not identify the frames.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Doubt {
    /// This name has no number while others have one.
    Without(String),
    /// Two names have this same number.
    Twice(i64, String, String),
    /// The number in this name does not fit into 64 bits.
    TooLarge(String),
    /// Two names differ in their wording, and each has several numbers.
    Wording(String, String),
    /// The names have the same wording, but several numbers in them change.
    Several {
        /// Two of the names.
        names: [String; 2],
        /// One pattern per number that changes: `%d` in its place and `*` for the other numbers.
        patterns: Vec<String>,
    },
}

impl Doubt {
    /// The doubt in words, after "the numbers in the names do not tell the frames apart: ".
    pub fn in_words(&self) -> String {
        match self {
            Self::Without(name) => format!("{name} has none"),
            Self::Twice(number, a, b) => format!("{a} and {b} both have {number}"),
            Self::TooLarge(name) => format!("that of {name} does not fit into 64 bits"),
            Self::Wording(a, b) => {
                format!("{a} and {b} have several each, and differ in more than numbers")
            }
            Self::Several { names: [a, b], .. } => {
                format!("several change from name to name, as in {a} and {b}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_without_names_have_unique_labels() {
        let video = Listing::counted("a.y4m".to_owned(), Length::Whole(3));
        assert_eq!((video.name(2), video.label(2)), ("a.y4m", "a.y4m, frame 2".to_owned()));
        let entry = Entry { name: "a/1.png".into(), stem: "1".into(), number: Some(1) };
        let frames = Frames::Named(vec![entry]);
        let named = Listing { frames, ..video };
        assert_eq!((named.name(0), named.label(0)), ("a/1.png", "a/1.png".to_owned()));
    }
}

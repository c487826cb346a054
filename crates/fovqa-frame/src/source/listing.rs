//! The frames of a source before any of them is read: names and numbers.

use std::ffi::OsString;

/// The frames of a source, in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Listing {
    /// What the user called it, as results show it: a path, a pattern.
    pub argument: String,
    /// Whether that names one frame outright. Two such frames are a pair whatever their names.
    pub is_single: bool,
    /// The frames.
    pub frames: Frames,
    /// How they are numbered.
    pub numbering: Numbering,
}

/// The frames that a source has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Frames {
    /// Each with a name of its own.
    Named(Vec<Entry>),
    /// Frames without names, such as those of a video, counted from 0.
    Counted(Length),
}

/// How many frames a source without names has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Length {
    /// So many.
    Whole(usize),
    /// So many, of which the last cannot be read. Whether there were more behind it, nobody knows.
    Damaged(usize),
    /// As many as will come: a stream.
    Open,
}

/// A frame with a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// The name, as results show it.
    pub name: String,
    /// What another source may call the same frame: a file's name without its ending.
    pub stem: OsString,
    /// Its number; `None` where the names do not tell the frames apart.
    pub number: Option<i64>,
}

impl Listing {
    /// Frames without names.
    pub fn counted(argument: String, length: Length) -> Self {
        let frames = Frames::Counted(length);
        Self { argument, is_single: false, frames, numbering: Numbering::ByPosition }
    }

    /// How long it is, where its frames have no names.
    pub fn length(&self) -> Option<Length> {
        match self.frames {
            Frames::Named(_) => None,
            Frames::Counted(length) => Some(length),
        }
    }

    /// The frames with names; none, where they have none.
    pub fn entries(&self) -> &[Entry] {
        match &self.frames {
            Frames::Named(entries) => entries,
            Frames::Counted(_) => &[],
        }
    }

    /// What results call a frame: its name, or that of the whole source.
    pub fn name(&self, frame: usize) -> &str {
        self.entries().get(frame).map_or(&self.argument, |entry| &entry.name)
    }

    /// What messages call a frame: no other one is called so.
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
    /// One name alone, with several numbers in it: the last one counts.
    LastOfSeveral(String),
    /// No name has a number: frames count by their position.
    ByPosition,
    /// The names have numbers that do not tell the frames apart; frames count by their position.
    Doubtful(Doubt),
}

/// Why the numbers in names do not tell the frames apart.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Doubt {
    /// A name without a number among others that have one.
    Without(String),
    /// Two names of one number.
    Twice(i64, String, String),
    /// A number that does not fit into 64 bits.
    TooLarge(String),
    /// Names of different wording, each with several numbers.
    Wording(String, String),
    /// Names of one wording in which several numbers change.
    Several {
        /// Two of the names.
        names: [String; 2],
        /// Patterns, one for each number that changes, `%d` in its place and `*` in those of the others.
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
    fn frames_without_names_are_told_apart_in_messages() {
        let video = Listing::counted("a.y4m".to_owned(), Length::Whole(3));
        assert_eq!((video.name(2), video.label(2)), ("a.y4m", "a.y4m, frame 2".to_owned()));
        let entry = Entry { name: "a/1.png".to_owned(), stem: "1".into(), number: Some(1) };
        let frames = Frames::Named(vec![entry]);
        let named = Listing { frames, ..video };
        assert_eq!((named.name(0), named.label(0)), ("a/1.png", "a/1.png".to_owned()));
    }
}

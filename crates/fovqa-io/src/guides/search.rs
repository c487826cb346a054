//! What was looked for, and what there is.

use super::choice::{DepthChoice, GuideFile, MotionChoice};
use super::options::GuideOptions;
use crate::error::{ReadErrorKind, listed};

/// What was looked for beside the colour, and where it was found: material for a caller that
/// needs guides, or says which channels it used.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct GuideSearch {
    /// The motion; `None` when it was not asked for.
    pub motion: Option<Sought>,
    /// The depth; `None` when it was not asked for.
    pub depth: Option<Sought>,
    /// The channels of the file, with part and layer in front. Empty when nothing was asked for,
    /// and for files that are not OpenEXR.
    pub channels: Vec<String>,
}

/// One thing that was looked for.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sought {
    /// The names, the first choice first; those of a pair with ` + ` between them.
    pub wanted: Vec<String>,
    /// The channels found, written likewise, with part and layer in front.
    pub found: Option<String>,
    /// Channels of these names that belong to another view or layer than the colour, where nothing else
    /// was found.
    pub elsewhere: Option<String>,
}

impl Sought {
    pub(crate) fn motion(choices: &[MotionChoice]) -> Option<Self> {
        Self::of(choices.iter().map(|choice| in_one(&choice.channels)))
    }

    pub(crate) fn depth(choices: &[DepthChoice]) -> Option<Self> {
        Self::of(choices.iter().map(|choice| match choice {
            DepthChoice::Channel(name, _) => name.clone(),
            DepthChoice::Only => "the only channel".to_owned(),
        }))
    }

    fn of(names: impl Iterator<Item = String>) -> Option<Self> {
        let wanted: Vec<String> = names.collect();
        (!wanted.is_empty()).then_some(Self { wanted, found: None, elsewhere: None })
    }
}

/// The names of channels that belong together.
pub(crate) fn in_one(channels: &[String]) -> String {
    channels.join(" + ")
}

impl GuideSearch {
    /// In a file that cannot hold what was asked for.
    pub(crate) fn in_vain(options: &GuideOptions) -> Self {
        let motion = Sought::motion(&options.motion.choices(GuideFile::Colour));
        let depth = Sought::depth(&options.depth.choices(GuideFile::Colour));
        Self { motion, depth, channels: Vec::new() }
    }

    /// Why there is no motion, though it was asked for.
    pub fn missing_motion(&self) -> Option<ReadErrorKind> {
        self.missing("motion", self.motion.as_ref())
    }

    /// Why there is no depth, though it was asked for.
    pub fn missing_depth(&self) -> Option<ReadErrorKind> {
        self.missing("depth", self.depth.as_ref())
    }

    fn missing(&self, what: &'static str, sought: Option<&Sought>) -> Option<ReadErrorKind> {
        let sought = sought.filter(|sought| sought.found.is_none())?;
        if let Some(channels) = sought.elsewhere.clone() {
            return Some(ReadErrorKind::GuidesElsewhere { what, channels });
        }
        let wanted = listed(sought.wanted.iter().cloned());
        let channels = match self.channels.as_slice() {
            [] => "those of its colour".to_owned(),
            channels => listed(channels.iter().cloned()),
        };
        Some(ReadErrorKind::NoGuide { what, wanted, channels })
    }
}

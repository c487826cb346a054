//! The channels that were looked for, and the channels that exist.

use super::choice::{DepthChoice, GuideFile, MotionChoice};
use super::options::GuideOptions;
use crate::error::{ReadErrorKind, listed};

/// The motion and depth channels that were looked for beside the colour, and those that were found.
/// Callers use it to report missing channels or to show which channels were read.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct GuideSearch {
    /// The search for motion; `None` if it was not asked for.
    pub motion: Option<ChannelSearch>,
    /// The search for depth; `None` if it was not asked for.
    pub depth: Option<ChannelSearch>,
    /// The channels of the file, with part and layer in front. Empty if nothing was asked for, and
    /// for files that are not OpenEXR.
    pub channels: Vec<String>,
}

/// The search for the motion or for the depth.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ChannelSearch {
    /// The names that were looked for, the first choice first. The two names of a pair are joined
    /// by ` + `.
    pub wanted: Vec<String>,
    /// The channels that were found, joined in the same way, with part and layer in front.
    pub found: Option<String>,
    /// Channels of these names that belong to another view or layer than the colour, if no others
    /// were found.
    pub elsewhere: Option<String>,
}

impl ChannelSearch {
    pub(crate) fn motion(choices: &[MotionChoice]) -> Option<Self> {
        Self::of(choices.iter().map(|choice| joined_names(&choice.channels)))
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

/// Joins the names of channels that belong together.
pub(crate) fn joined_names(channels: &[String]) -> String {
    channels.join(" + ")
}

impl GuideSearch {
    /// The search in a file that cannot hold motion or depth.
    pub(crate) fn without_channels(options: &GuideOptions) -> Self {
        let motion = ChannelSearch::motion(&options.motion.choices(GuideFile::Colour));
        let depth = ChannelSearch::depth(&options.depth.choices(GuideFile::Colour));
        Self { motion, depth, channels: Vec::new() }
    }

    /// The error for motion that was asked for but is missing.
    pub fn missing_motion(&self) -> Option<ReadErrorKind> {
        self.missing("motion", self.motion.as_ref())
    }

    /// The error for depth that was asked for but is missing.
    pub fn missing_depth(&self) -> Option<ReadErrorKind> {
        self.missing("depth", self.depth.as_ref())
    }

    fn missing(&self, what: &'static str, sought: Option<&ChannelSearch>) -> Option<ReadErrorKind> {
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

//! One name to look for, and where.

use super::encoding::Encoding;
use super::options::NamedMotion;
use super::preset::GuidePreset;

/// Where guides are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GuideFile {
    /// In the file of the colour.
    Colour,
    /// In a file of their own, where a bare `X` or `R` can be nothing else.
    Separate,
}

/// In which layers a name is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reach {
    /// In all; a channel of exactly this name goes before those of a layer.
    Named,
    /// In all.
    Any,
    /// In the colour's layer and those it lies in; in a file without colour, where channels stand
    /// in no layer of their part.
    Own,
    /// The same, unless this channel is beside it: then it is one of a vector.
    OwnWithout(&'static str),
}

/// Motion channels to look for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MotionChoice {
    /// Channels of one layer, all of which have to be there; the motion is in the first two.
    pub(crate) channels: Vec<String>,
    pub(crate) reach: Reach,
    pub(crate) encoding: Encoding,
    /// The renderer that writes them so.
    pub(crate) preset: Option<GuidePreset>,
}

impl MotionChoice {
    /// Channels in pixels, x to the right and y down.
    pub(crate) fn pixels(channels: &[&str], reach: Reach) -> Self {
        let channels = channels.iter().map(|&name| name.to_owned()).collect();
        Self { channels, reach, encoding: Encoding::PIXELS, preset: None }
    }

    /// Channels as a renderer encodes them.
    pub(crate) fn of(preset: GuidePreset, channels: &[&str], reach: Reach) -> Self {
        let encoding = preset.encoding();
        Self { encoding, preset: Some(preset), ..Self::pixels(channels, reach) }
    }
}

impl From<&NamedMotion> for MotionChoice {
    fn from(named: &NamedMotion) -> Self {
        let &NamedMotion { ref channels, sign, scale, unit } = named;
        let encoding = Encoding { sign, scale, unit, offset: 0.0 };
        Self { channels: channels.to_vec(), reach: Reach::Named, encoding, preset: None }
    }
}

/// A depth channel to look for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum DepthChoice {
    Channel(String, Reach),
    /// The only one of the file.
    Only,
}

impl DepthChoice {
    pub(crate) fn new(channel: &str, reach: Reach) -> Self {
        Self::Channel(channel.to_owned(), reach)
    }
}

//! One set of channel names to look for, and the layers in which to look.

use super::encoding::Encoding;
use super::options::NamedMotion;
use super::preset::GuidePreset;

/// The file in which motion and depth are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GuideFile {
    /// The file of the colour.
    Colour,
    /// A separate file, in which a bare `X` or `R` can only be motion or depth.
    Separate,
}

/// The layers in which a name is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LayerScope {
    /// All layers. A channel of exactly this name takes precedence over those of a layer.
    Named,
    /// All layers.
    Any,
    /// The colour's layer and the layers that contain it. In a file without colour: channels that
    /// belong to no layer of their part.
    Own,
    /// The same layers, unless this other channel is beside it: then it is a component of a vector.
    OwnWithout(&'static str),
}

/// Motion channels that are looked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MotionChoice {
    /// Channels of one layer, all of which must exist. The motion is in the first two.
    pub(crate) channels: Vec<String>,
    pub(crate) scope: LayerScope,
    pub(crate) encoding: Encoding,
    /// The renderer that writes these names.
    pub(crate) preset: Option<GuidePreset>,
}

impl MotionChoice {
    /// Channels whose values are in pixels, x to the right and y down.
    pub(crate) fn pixels(channels: &[&str], scope: LayerScope) -> Self {
        let channels = channels.iter().map(|&name| name.to_owned()).collect();
        Self { channels, scope, encoding: Encoding::PIXELS, preset: None }
    }

    /// Channels whose values are encoded as the renderer writes them.
    pub(crate) fn of(preset: GuidePreset, channels: &[&str], scope: LayerScope) -> Self {
        let encoding = preset.encoding();
        Self { encoding, preset: Some(preset), ..Self::pixels(channels, scope) }
    }
}

impl From<&NamedMotion> for MotionChoice {
    fn from(named: &NamedMotion) -> Self {
        let &NamedMotion { ref channels, sign, scale, unit } = named;
        let encoding = Encoding { sign, scale, unit, offset: 0.0 };
        Self { channels: channels.to_vec(), scope: LayerScope::Named, encoding, preset: None }
    }
}

/// A depth channel that is looked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum DepthChoice {
    Channel(String, LayerScope),
    /// The only channel of the file.
    Only,
}

impl DepthChoice {
    pub(crate) fn new(channel: &str, scope: LayerScope) -> Self {
        Self::Channel(channel.to_owned(), scope)
    }
}

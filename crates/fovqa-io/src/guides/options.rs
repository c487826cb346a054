//! Options for the motion and depth that are read beside the colour.

use fovqa_params::words;
use serde::{Deserialize, Serialize};

use super::preset::GuidePreset;

/// The channels that hold the motion and the depth of a frame. By default neither is read.
///
/// Names are compared without regard to case, from the start or from a dot on: `Vector.X` also
/// matches `ViewLayer.Vector.X`, and the name of a part counts like a layer in front. If several
/// channels match, those of the colour's view are preferred (see the parts and views of Blender's
/// Multi-View) and, among those, the one whose layer has most leading components in common with the
/// colour's.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GuideOptions {
    /// The motion channels.
    pub motion: MotionChannels,
    /// The depth channel.
    pub depth: DepthChannels,
}

impl GuideOptions {
    /// Whether neither motion nor depth is read.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

/// The channels of backward motion: the position in the previous frame is the position in this
/// frame plus the motion.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MotionChannels {
    /// Motion is not read.
    #[default]
    None,
    /// `motion.X` and `motion.Y` in pixels, or else the names of the presets in the order of
    /// [`GuidePreset::ALL`]. In a separate file also `X`, `Y`, `Z` and `W` together as Blender
    /// writes them, `X` and `Y` in pixels, and `R` and `G` as Falcor writes them.
    Auto,
    /// The channels of a renderer.
    Preset(GuidePreset),
    /// The channels of these names.
    Named(NamedMotion),
    /// The channels of these names, across and down, encoded as the renderer writes them.
    NamedAs(GuidePreset, [String; 2]),
}

/// Motion channels and the meaning of their values: the motion in pixels is
/// `sample * sign * scale`, multiplied by the size of the unit in pixels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NamedMotion {
    /// The channels across and down.
    pub channels: [String; 2],
    /// 1, or -1 if the axis points to the left or up, or if the motion is forward, from the
    /// previous frame to this one.
    pub sign: [f64; 2],
    /// Units of motion per unit of a sample.
    pub scale: [f64; 2],
    /// The unit of motion.
    pub unit: MotionUnit,
}

words! {
    /// The unit of motion.
    #[derive(Default)]
    pub enum MotionUnit {
        /// Pixels.
        #[default]
        Pixels "pixels" "Pixels";
        /// The width and the height of the display window.
        Frame "frame" "Widths and heights of the frame";
        /// Half the width and half the height: coordinates run from -1 to 1 across the display
        /// window.
        Ndc "ndc" "Halves of the width and height: coordinates from -1 to 1";
    }
}

/// The channel of depth.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DepthChannels {
    /// Depth is not read.
    #[default]
    None,
    /// `Z` of the colour's own layer, or else the names of the presets in the order of
    /// [`GuidePreset::ALL`]. In a separate file also `Y`, `R` or the only channel.
    Auto,
    /// The channel of a renderer.
    Preset(GuidePreset),
    /// The channel of this name.
    Named(String),
}

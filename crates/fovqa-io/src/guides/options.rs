//! What to look for beside the colour.

use fovqa_params::words;
use serde::{Deserialize, Serialize};

use super::preset::GuidePreset;

/// Which channels hold the motion and the depth of a frame. By default neither is looked for.
///
/// Names are matched without regard to case, from a dot on: `Vector.X` is also
/// `ViewLayer.Vector.X`, and the name of a part counts like a layer in front. Of several such
/// channels the one of the colour's view is meant (see the parts and views of Blender's Multi-View)
/// and, among those, the one whose layer has most of its first names in common with the colour's.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GuideOptions {
    /// The motion.
    pub motion: MotionChannels,
    /// The depth.
    pub depth: DepthChannels,
}

impl GuideOptions {
    /// Whether nothing is looked for.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

/// The channels of backward motion: the position in the previous frame is the position in this
/// one plus the motion.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MotionChannels {
    /// Not read.
    #[default]
    None,
    /// `motion.X` and `motion.Y` in pixels, else the names of the presets in the order of
    /// [`GuidePreset::ALL`]. In a file of its own also `X`, `Y`, `Z` and `W` together as Blender
    /// writes them, `X` and `Y` in pixels, and `R` and `G` as Falcor writes them.
    Auto,
    /// Those of a renderer.
    Preset(GuidePreset),
    /// Those of these names.
    Named(NamedMotion),
    /// Those of these names, across and down, encoded as a renderer does.
    NamedAs(GuidePreset, [String; 2]),
}

/// Channels of motion and what their values mean: the motion in pixels is
/// `sample * sign * scale`, times the size of the unit in pixels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NamedMotion {
    /// The channels across and down.
    pub channels: [String; 2],
    /// 1, or -1 where the axis points to the left or up, or where the motion is that from the
    /// previous frame to this one.
    pub sign: [f64; 2],
    /// Units for one unit of a sample.
    pub scale: [f64; 2],
    /// The unit.
    pub unit: MotionUnit,
}

words! {
    /// What motion is counted in.
    #[derive(Default)]
    pub enum MotionUnit {
        /// Pixels.
        #[default]
        Pixels "pixels" "Pixels";
        /// Widths and heights of the display window.
        Frame "frame" "Widths and heights of the frame";
        /// Halves of them: coordinates that go from -1 to 1 across the display window.
        Ndc "ndc" "Halves of them: coordinates from -1 to 1";
    }
}

/// The channel of depth.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DepthChannels {
    /// Not read.
    #[default]
    None,
    /// `Z` of the colour's own layer, else the names of the presets in the order of
    /// [`GuidePreset::ALL`]. In a file of its own also `Y`, `R` or the only channel.
    Auto,
    /// That of a renderer.
    Preset(GuidePreset),
    /// That of this name.
    Named(String),
}

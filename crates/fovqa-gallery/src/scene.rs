//! The built-in scenes, and what every one of them can tell of a position in a frame.

use fovqa_params::words;
use fovqa_vision::View;

use crate::chart::CsfChart;
use crate::patterns::{Pattern, Turning};
use crate::walk::Walk;

words! {
    /// A built-in scene.
    pub enum SceneName {
        /// A hall with railings, pictures, plants and windows.
        Gallery "gallery" "A walk through a hall with railings, texts, plants, spheres and windows";
        /// Concentric rings and spokes, turned by 10° in each frame.
        PatternA "pattern_a" "Rings and spokes, turned by 10° in each frame";
        /// A checkerboard that becomes finer outwards, turned by 10° in each frame.
        PatternB "pattern_b" "A checkerboard of several sizes, turned by 10° in each frame";
        /// Text and fine lines, turned by 10° in each frame.
        PatternC "pattern_c" "Lines in several directions, turned by 10° in each frame";
        /// Vertical and horizontal stripes.
        Stripes "stripes" "Stripes of equal width, which show how a mapping bends them";
        /// A contrast-sensitivity chart.
        CsfChart "csf_chart" "Gratings: frequency rises to the right, contrast falls downwards";
    }
}

/// What is at a position of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Distance along the viewing axis in metres.
    pub depth_m: f64,
    /// From this position to that of the same point in the frame before, in pixels; `None` where the
    /// point was behind the eye.
    pub motion_px: Option<[f64; 2]>,
}

/// A frame of a built-in scene, as a function of position. Positions are in pixels from the top-left
/// corner; those off the frame have values as well.
pub trait FrameScene: Send + Sync {
    /// Linear light, Rec. 709; 1 is white paper.
    fn light(&self, x: f64, y: f64) -> [f32; 3];

    /// Depth and motion.
    fn surface(&self, x: f64, y: f64) -> Surface;
}

/// A built-in scene, prepared once for all frames.
#[derive(Debug)]
pub(crate) enum Prepared {
    Walk(Walk),
    Turning(Turning),
    Chart(CsfChart),
}

impl Prepared {
    pub(crate) fn new(name: SceneName, view: View, fps: f64, eye_m: f64, seed: u64) -> Self {
        let turning = |pattern| Self::Turning(Turning::new(pattern, view));
        match name {
            SceneName::Gallery => Self::Walk(Walk::new(view, fps, eye_m, seed)),
            SceneName::PatternA => turning(Pattern::A),
            SceneName::PatternB => turning(Pattern::B),
            SceneName::PatternC => turning(Pattern::C),
            SceneName::Stripes => turning(Pattern::Stripes),
            SceneName::CsfChart => Self::Chart(CsfChart::new(view)),
        }
    }

    pub(crate) fn frame(&self, frame: usize) -> Box<dyn FrameScene + '_> {
        match self {
            Self::Walk(walk) => Box::new(walk.frame(frame)),
            Self::Turning(turning) => Box::new(turning.frame(frame)),
            Self::Chart(chart) => Box::new(chart.frame()),
        }
    }
}

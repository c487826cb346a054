//! The built-in scenes by their names.

use fovqa_params::words;
use fovqa_vision::View;

use crate::chart::CsfChart;
use crate::frame_scene::FrameScene;
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

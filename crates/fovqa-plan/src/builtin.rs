//! A built-in sequence as the reference of a scene.

use fovqa_gallery::BuiltinSpec;
use serde::{Deserialize, Serialize};

/// A built-in sequence as one eye sees it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BuiltinFrames {
    /// What it is made of.
    pub spec: BuiltinSpec,
    /// Width and height of its frames in pixels.
    pub size: [usize; 2],
    /// From the middle between both eyes to this one, to the right, in metres.
    pub eye_m: f64,
}

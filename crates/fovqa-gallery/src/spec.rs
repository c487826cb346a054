//! What a built-in sequence is made of, as plain data.

use fovqa_vision::View;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::scene::SceneName;

/// A built-in sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BuiltinSpec {
    /// The scene.
    pub scene: SceneName,
    /// Number of frames.
    pub frames: usize,
    /// Frames per second.
    pub fps: f64,
    /// Samples for each pixel of the ground truth.
    pub samples: usize,
    /// The seed of everything that looks random.
    pub seed: u64,
}

/// Distance between the pupils of both eyes in metres, by default.
pub const IPD_M: f64 = 0.063;

impl BuiltinSpec {
    /// The most frames.
    pub const MOST_FRAMES: usize = 100_000;
    /// The longest side of a frame in pixels.
    pub const MOST_SIDE: usize = 32_768;
    /// The most samples for each pixel.
    pub const MOST_SAMPLES: usize = 4096;

    /// A scene with the defaults: one frame, 90 frames per second, 16 samples for each pixel.
    pub fn new(scene: SceneName) -> Self {
        Self { scene, frames: 1, fps: 90.0, samples: 16, seed: 1 }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// If one of them is out of range.
    pub fn check(&self) -> Result<(), GalleryError> {
        let whole = |what, found: usize, most: usize| {
            if (1..=most).contains(&found) {
                return Ok(());
            }
            Err(GalleryError::OutOfRange {
                what,
                found: found.to_string(),
                range: format!("1 to {most}"),
            })
        };
        whole("frames", self.frames, Self::MOST_FRAMES)?;
        whole("samples", self.samples, Self::MOST_SAMPLES)?;
        if (1.0..=1e4).contains(&self.fps) {
            return Ok(());
        }
        let range = "1 to 10000".to_owned();
        Err(GalleryError::OutOfRange { what: "fps", found: self.fps.to_string(), range })
    }
}

/// A built-in sequence that cannot be.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum GalleryError {
    /// A number out of range.
    #[error("{what} of a built-in scene cannot be {found}: it must be {range}")]
    OutOfRange {
        /// Which number.
        what: &'static str,
        /// What it is.
        found: String,
        /// What it may be.
        range: String,
    },
    /// A frame size that cannot be.
    #[error(
        "a built-in scene cannot have frames of {width}x{height}: each side must be 1 to 32768 pixels"
    )]
    Size {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
}

/// Checks the size of a view.
pub(crate) fn check_size(view: &View) -> Result<(), GalleryError> {
    let View { width, height, .. } = *view;
    let fits = |side: usize| (1..=BuiltinSpec::MOST_SIDE).contains(&side);
    if fits(width) && fits(height) { Ok(()) } else { Err(GalleryError::Size { width, height }) }
}

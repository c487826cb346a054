//! Where the regions of frames are that figures show side by side, and what is recorded of them.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// The folder of regions in a results folder.
pub const CROPS: &str = "crops";

/// The folder of a region of a scene's frames.
pub fn crop_folder(results: &Path, scene: &str, eye: Option<&str>, region: &str) -> PathBuf {
    let mut folder = results.join(CROPS).join(scene);
    folder.extend(eye);
    folder.join(region)
}

/// Where a region lies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CropRecord {
    /// The number of its frame.
    pub frame: i64,
    /// Width and height of the frame in pixels.
    pub frame_px: [usize; 2],
    /// Its left and upper edge in the frame, in pixels.
    pub corner_px: [usize; 2],
    /// Position of the gaze in the frame, in pixels.
    pub gaze_px: Option<[f64; 2]>,
    /// Eccentricity of its centre in degrees.
    pub eccentricity_deg: Option<f64>,
}

impl CropRecord {
    /// The file of the record in the folder of a region.
    pub fn file(folder: &Path) -> PathBuf {
        folder.join("region.json")
    }

    /// The picture of the reference in the folder of a region.
    pub fn reference_file(folder: &Path) -> PathBuf {
        folder.join("reference.png")
    }

    /// The picture of a method's test in the folder of a region.
    pub fn test_file(folder: &Path, method: &str) -> PathBuf {
        folder.join("methods").join(format!("{method}.png"))
    }
}

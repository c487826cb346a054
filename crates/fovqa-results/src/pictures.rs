//! Pictures of frames in a results folder, which the report shows: where they are, and what is
//! recorded of them.
//!
//! ```text
//! images/images.json                               the frames of each scene, and the gaze
//! images/SCENE[/EYE]/0012/frame.json               how the frame is seen
//!                         reference.png            the reference, in full
//!                         page.webp                the same, as the page shows it
//!                         methods/METHOD/test.png  the test
//!                                        page.webp
//!                                        ssim.png  a map
//!                                        test.json borders and maps for the page
//! ```

use std::io::BufReader;
use std::path::{Path, PathBuf};

use fovqa_plan::{Eye, FrameChoice};
use fovqa_vision::EccentricityKind;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::files::open_result_file;

/// The folder of pictures in a results folder.
pub const IMAGES: &str = "images";
/// The file that lists the frames with pictures.
pub const IMAGES_JSON: &str = "images/images.json";
/// Name and version of the format of [`IMAGES_JSON`].
pub const IMAGES_SCHEMA: &str = "fovqa.images/1";

/// The frames of a run that have pictures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImagesRecord {
    /// [`IMAGES_SCHEMA`].
    pub schema: String,
    /// The views, in the order of the experiment.
    pub views: Vec<ViewImages>,
}

/// The frames of a scene, as one eye sees it, that have pictures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ViewImages {
    /// The name of the scene.
    pub scene: String,
    /// The eye; `None` if the scene has one image per frame.
    pub eye: Option<Eye>,
    /// The key of the metric that ranks the frames.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ranked_by: Option<String>,
    /// The frames with pictures, each with what it was chosen for, in ascending order.
    pub frames: Vec<ChosenFrame>,
    /// The methods with pictures, in the order of the experiment.
    pub methods: Vec<String>,
    /// The gaze of each frame, in pixels, if it moves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gaze: Vec<(i64, [f64; 2])>,
}

/// A frame with pictures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChosenFrame {
    /// Its number.
    pub frame: i64,
    /// What it was chosen for.
    pub why: Vec<FrameChoice>,
}

/// How a frame with pictures is seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FrameRecord {
    /// The longer side of the page's pictures that was asked for, in pixels.
    pub size: usize,
    /// Width and height of the frame in pixels.
    pub frame_px: [usize; 2],
    /// How the eye sees it; `None` without a view.
    pub view: Option<FrameView>,
}

/// The view of a frame with pictures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FrameView {
    /// Focal lengths along x and y in pixels.
    pub focal_px: [f64; 2],
    /// The principal point in pixels.
    pub principal_px: [f64; 2],
    /// The gaze in pixels.
    pub gaze_px: [f64; 2],
    /// The definition of eccentricity.
    pub eccentricity: EccentricityKind,
    /// The edges of the eccentricity bands in degrees.
    pub bands_deg: Vec<f64>,
}

/// What the page shows of a test besides its picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TestRecord {
    /// The borders between layers or rates: lines of points in pixels.
    pub borders: Vec<Vec<[f64; 2]>>,
    /// The maps.
    pub maps: Vec<MapBlocks>,
}

/// The means of a map over blocks of pixels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MapBlocks {
    /// The name of the map.
    pub map: String,
    /// Side of a block in pixels of the frame.
    pub block: usize,
    /// Number of blocks in a row.
    pub columns: usize,
    /// Number of rows of blocks.
    pub rows: usize,
    /// The means row by row, NaN where there is no value: half floats, little-endian, as a raw deflate
    /// stream in base64.
    pub values: String,
}

/// The folder of a frame's pictures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameImages(PathBuf);

impl FrameImages {
    /// The folder of a frame of a scene, as one eye sees it, below a results folder or relative to it.
    pub fn new(results: &Path, scene: &str, eye: Option<Eye>, frame: i64) -> Self {
        let mut folder = results.join(IMAGES).join(scene);
        folder.extend(eye.map(Eye::name));
        Self(folder.join(padded(frame)))
    }

    /// The folder itself.
    pub fn folder(&self) -> &Path {
        &self.0
    }

    /// The file of its [`FrameRecord`].
    pub fn record(&self) -> PathBuf {
        self.0.join("frame.json")
    }

    /// The picture of the reference.
    pub fn reference(&self) -> PathBuf {
        self.0.join("reference.png")
    }

    /// The picture of the reference for the page.
    pub fn reference_on_page(&self) -> PathBuf {
        self.0.join("page.webp")
    }

    /// The folder of a method's test.
    pub fn method(&self, method: &str) -> PathBuf {
        self.0.join("methods").join(method)
    }

    /// The picture of a method's test.
    pub fn test(&self, method: &str) -> PathBuf {
        self.method(method).join("test.png")
    }

    /// The picture of a method's test for the page.
    pub fn test_on_page(&self, method: &str) -> PathBuf {
        self.method(method).join("page.webp")
    }

    /// The file of the [`TestRecord`] of a method's test.
    pub fn test_record(&self, method: &str) -> PathBuf {
        self.method(method).join("test.json")
    }

    /// The picture of a map of a method's test.
    pub fn map(&self, method: &str, map: &str) -> PathBuf {
        self.method(method).join(format!("{map}.png"))
    }
}

/// Reads a record of pictures; `None` if there is none, or it is damaged.
pub fn read_record<T: DeserializeOwned>(path: &Path) -> Option<T> {
    serde_json::from_reader(BufReader::new(open_result_file(path).ok()?)).ok()
}

/// The number of a frame with at least four digits, after the minus sign if it is negative.
pub fn padded(frame: i64) -> String {
    let sign = if frame < 0 { "-" } else { "" };
    format!("{sign}{:04}", frame.unsigned_abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_a_frame_are_in_its_folder() {
        let images = FrameImages::new(Path::new(""), "room", Some(Eye::Left), 12);
        let shown = |path: PathBuf| path.to_string_lossy().replace('\\', "/");
        assert_eq!(shown(images.record()), "images/room/left/0012/frame.json");
        assert_eq!(shown(images.test("A")), "images/room/left/0012/methods/A/test.png");
        let images = FrameImages::new(Path::new("r"), "room", None, -3);
        assert_eq!(shown(images.map("A", "ssim")), "r/images/room/-0003/methods/A/ssim.png");
        assert_eq!(padded(123_456), "123456");
    }
}

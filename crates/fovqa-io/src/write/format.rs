//! The formats in which frames are written.

use std::path::Path;

use fovqa_params::{Words, words};

use super::error::EncodeError;

words! {
    /// A format in which frames are written.
    pub enum FrameFormat {
        /// PNG with codes of 8 or 16 bits.
        Png "png" "PNG with codes of 8 or 16 bits";
        /// OpenEXR with linear light in half floats or floats.
        Exr "exr" "OpenEXR with linear light in half floats or floats";
        /// JPEG with codes of 8 bits, at quality 100 and without chroma subsampling.
        Jpeg "jpg" "JPEG with codes of 8 bits, quality 100";
    }
}

impl FrameFormat {
    /// The format of a file, by the ending of its name.
    ///
    /// # Errors
    /// If the ending is that of a video, or of no format that can be written.
    pub fn of_path(path: &Path) -> Result<Self, EncodeError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let format = Self::all().into_iter().find(|format| format.endings().contains(&&*ending));
        format.ok_or_else(|| {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
            if ending == VIDEO_ENDING {
                EncodeError::Video { name }
            } else {
                EncodeError::UnknownEnding { name }
            }
        })
    }

    /// The endings of its files in lower case, without the dot; the usual one first.
    pub fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Png => &["png"],
            Self::Exr => &["exr"],
            Self::Jpeg => &["jpg", "jpeg"],
        }
    }

    /// The name of the format in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Exr => "OpenEXR",
            Self::Jpeg => "JPEG",
        }
    }
}

/// The ending of y4m video.
const VIDEO_ENDING: &str = "y4m";

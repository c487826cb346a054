//! The format of a file, by its name.

use std::path::Path;

use fovqa_params::Words;

use super::error::EncodeError;
use super::format::FrameFormat;

/// The ending of y4m video.
const VIDEO_ENDING: &str = "y4m";

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
}

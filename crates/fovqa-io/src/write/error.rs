//! Why a frame cannot be encoded.

use fovqa_params::Words;
use thiserror::Error;

use super::format::FrameFormat;

/// A frame that cannot be encoded as a file.
#[derive(Debug, Error)]
pub enum EncodeError {
    /// A file name whose ending names no format that can be written.
    #[error("{name:?} does not end like a picture that can be written")]
    UnknownEnding {
        /// The file name.
        name: String,
    },
    /// A file name with the ending of a video.
    #[error("{name:?} is the name of a y4m video, and videos cannot be written")]
    Video {
        /// The file name.
        name: String,
    },
    /// The format cannot hold the samples of the frame.
    #[error("{} files cannot hold {samples}", format.name())]
    Samples {
        /// The format.
        format: FrameFormat,
        /// What the frame holds.
        samples: &'static str,
    },
    /// The format cannot hold so many pixels.
    #[error("{} files cannot hold a frame of {width}x{height}", format.name())]
    Size {
        /// The format.
        format: FrameFormat,
        /// Width of the frame in pixels.
        width: usize,
        /// Height of the frame in pixels.
        height: usize,
    },
    /// The encoder failed.
    #[error("it cannot be encoded as {}: {detail}", format.name())]
    Encoder {
        /// The format.
        format: FrameFormat,
        /// The message of the encoder.
        detail: String,
    },
}

impl EncodeError {
    /// How to correct it.
    pub fn help(&self) -> String {
        match self {
            Self::UnknownEnding { .. } => {
                let endings: Vec<String> = FrameFormat::all()
                    .into_iter()
                    .flat_map(FrameFormat::endings)
                    .map(|ending| format!(".{ending}"))
                    .collect();
                format!("give a name that ends in one of {}", endings.join(", "))
            }
            Self::Video { .. } => "give a folder, or the name of a PNG file".to_owned(),
            Self::Samples { format: FrameFormat::Exr, .. } => {
                "write a PNG file, or convert the codes to linear light first".to_owned()
            }
            Self::Samples { format: FrameFormat::Jpeg, .. } => {
                "write a PNG or OpenEXR file".to_owned()
            }
            Self::Samples { format: FrameFormat::Png, .. } => "write an OpenEXR file".to_owned(),
            Self::Size { .. } => "write another format".to_owned(),
            Self::Encoder { .. } => String::new(),
        }
    }
}

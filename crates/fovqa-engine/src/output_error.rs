//! Why an emulated frame cannot be written.

use std::io::ErrorKind;
use std::path::PathBuf;

use fovqa_emulate::WriteFrameError;
use fovqa_io::EncodeError;
use thiserror::Error;

/// An emulated frame that cannot be written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The format of the file cannot hold the frame.
    #[error("{}: {error}", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: EncodeError,
    },
    /// The picture cannot be converted to what the format holds.
    #[error("{}: {error}", path.display())]
    Convert {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: WriteFrameError,
    },
    /// Linear light is asked for, but the transfer function of the input is not known to emulation.
    #[error(
        "{}: OpenEXR files hold linear light, which is decoded as sRGB, but the transfer function of the input is {transfer}",
        path.display()
    )]
    Transfer {
        /// The file.
        path: PathBuf,
        /// The transfer function of the input.
        transfer: &'static str,
    },
    /// The reduced buffer is asked for, but the method has none.
    #[error("{method} has no reduced buffer")]
    NoBuffer {
        /// The method.
        method: String,
    },
    /// The operating system refuses.
    #[error("{}: it cannot be written: {error}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
}

impl OutputError {
    /// Whether the error is in the request rather than in an output.
    pub fn is_usage(&self) -> bool {
        !matches!(self, Self::Write { .. })
    }

    /// How to correct it.
    pub fn help(&self) -> String {
        match self {
            Self::Encode { error, .. } => error.help(),
            Self::Convert { .. } => "write a PNG file, or use another tone map".to_owned(),
            Self::Transfer { .. } => "write a PNG file".to_owned(),
            Self::NoBuffer { .. } => {
                "leave {buffer} out, or choose a method that fills a smaller buffer".to_owned()
            }
            Self::Write { path, error } => match error.kind() {
                ErrorKind::NotFound => {
                    let folder = path.parent().unwrap_or(path);
                    format!("make the folder {} first", folder.display())
                }
                ErrorKind::PermissionDenied => "give a folder that can be written to".to_owned(),
                ErrorKind::IsADirectory => "give the name of a file".to_owned(),
                ErrorKind::InvalidFilename => "give a shorter name".to_owned(),
                _ => "give another path, or free some space".to_owned(),
            },
        }
    }
}

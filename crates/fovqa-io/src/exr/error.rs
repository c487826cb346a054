//! Errors of the OpenEXR decoder.

use std::io::ErrorKind;

use crate::error::ReadErrorKind;

pub(super) fn no_parts() -> ReadErrorKind {
    ReadErrorKind::Damaged { format: "OpenEXR", detail: "it has no parts".to_owned() }
}

pub(super) fn damaged(error: ::exr::error::Error) -> ReadErrorKind {
    use ::exr::error::Error;
    match error {
        Error::Io(error) => match error.kind() {
            ErrorKind::UnexpectedEof => {
                let detail = "the file ends too early".to_owned();
                ReadErrorKind::Damaged { format: "OpenEXR", detail }
            }
            // The file points to a position that does not exist in it.
            ErrorKind::InvalidInput | ErrorKind::InvalidData => {
                let detail = format!("it points to a place without data: {error}");
                ReadErrorKind::Damaged { format: "OpenEXR", detail }
            }
            _ => ReadErrorKind::Io(error),
        },
        Error::NotSupported(what) if what.contains("deep") => ReadErrorKind::Deep,
        Error::NotSupported(what) => ReadErrorKind::Unsupported { detail: what.into_owned() },
        Error::Invalid(what) if what.contains("compression attribute") => {
            let detail = "a compression newer than the decoder".to_owned();
            ReadErrorKind::Unsupported { detail }
        }
        error => ReadErrorKind::Damaged { format: "OpenEXR", detail: error.to_string() },
    }
}

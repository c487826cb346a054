//! The content of the application segments: JFIF, Exif, ICC profile, Adobe.

use super::segments::{Segment, marker};
use crate::exif::is_turned;

/// The information from application segments.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Application {
    /// Whether there is a JFIF segment: three components are then YCbCr.
    pub(super) jfif: bool,
    /// The colour transform in Adobe's segment.
    pub(super) adobe_transform: Option<u8>,
    /// Whether the Exif orientation is not "upright".
    pub(super) turned: bool,
    /// Whether there is a colour profile.
    pub(super) profile: bool,
}

impl Application {
    /// Stores the information of a segment. Segments of other applications are ignored.
    pub(super) fn take(&mut self, segment: Segment<'_>) {
        const EXIF: &[u8] = b"Exif\0\0";
        /// The length of JFIF's and of Adobe's segment in bytes; a shorter segment is something
        /// else.
        const JFIF_LENGTH: usize = 14;
        const ADOBE_LENGTH: usize = 12;
        let Segment { marker, data } = segment;
        match marker {
            marker::APP0 if data.len() >= JFIF_LENGTH && data.starts_with(b"JFIF\0") => {
                self.jfif = true;
            }
            marker::APP1 => {
                if let Some(exif) = data.strip_prefix(EXIF) {
                    self.turned |= is_turned(exif);
                }
            }
            marker::APP2 => self.profile |= data.starts_with(b"ICC_PROFILE\0"),
            marker::APP14 if data.starts_with(b"Adobe") && data.len() >= ADOBE_LENGTH => {
                self.adobe_transform = Some(data[ADOBE_LENGTH - 1]);
            }
            _ => {}
        }
    }
}

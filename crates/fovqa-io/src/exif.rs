//! Exif data in PNG and JPEG files.

use image::metadata::Orientation;

/// Whether Exif data has an orientation other than "upright".
pub(crate) fn is_turned(exif: &[u8]) -> bool {
    Orientation::from_exif_chunk(exif).is_some_and(|found| found != Orientation::NoTransforms)
}

//! Exif data, as PNG and JPEG carry it.

use image::metadata::Orientation;

/// Whether Exif data has an orientation that is not "upright".
pub(crate) fn is_turned(exif: &[u8]) -> bool {
    Orientation::from_exif_chunk(exif).is_some_and(|found| found != Orientation::NoTransforms)
}

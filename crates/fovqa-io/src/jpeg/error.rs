//! Errors of the JPEG decoder.

use super::kind::JpegKind;
use crate::error::ReadErrorKind;

pub(super) type Result<T> = std::result::Result<T, ReadErrorKind>;

pub(super) fn damaged(detail: impl Into<String>) -> ReadErrorKind {
    ReadErrorKind::Damaged { format: "JPEG", detail: detail.into() }
}

pub(super) fn not_read(kind: JpegKind) -> ReadErrorKind {
    ReadErrorKind::UnsupportedJpeg(kind)
}

//! What a format of files does to values.

use std::fmt;

/// A kind of files whose scores are comparable among each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FileKind {
    /// Values of light that are neither limited nor rounded much: OpenEXR.
    Linear,
    /// Codes without loss: PNG, y4m video, and everything else.
    Codes,
    /// Codes with the loss of JPEG.
    Jpeg,
}

impl FileKind {
    /// The kind of a file, by the ending of its name.
    pub fn of(name: &str) -> Self {
        let ending = name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
        match ending.as_str() {
            "exr" => Self::Linear,
            "jpg" | "jpeg" => Self::Jpeg,
            _ => Self::Codes,
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Linear => "OpenEXR",
            Self::Codes => "PNG or video",
            Self::Jpeg => "JPEG",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_tell_the_kind() {
        for (name, kind) in [
            ("a/b.EXR", FileKind::Linear),
            ("b.jpeg", FileKind::Jpeg),
            ("b.JPG", FileKind::Jpeg),
            ("b.exr.png", FileKind::Codes),
            ("exr", FileKind::Linear),
            ("video.y4m", FileKind::Codes),
            ("", FileKind::Codes),
        ] {
            assert_eq!(FileKind::of(name), kind, "{name}");
        }
    }
}

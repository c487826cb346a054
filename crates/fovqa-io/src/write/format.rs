//! The formats in which frames are written.

use fovqa_params::words;

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

//! Options for reading files.

use serde::{Deserialize, Serialize};

use crate::alpha::AlphaPolicy;
use crate::error::ReadErrorKind;
use crate::guides::options::GuideOptions;
use crate::y4m::options::Y4mOptions;

/// Options for reading files.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReadOptions {
    /// The colour layer to read from OpenEXR files that have several.
    pub layer: Option<String>,
    /// How to treat alpha.
    pub alpha: AlphaPolicy,
    /// The largest number of pixels that a file may declare, in millions.
    pub max_megapixels: u64,
    /// The motion and depth to read with the colour.
    pub guides: GuideOptions,
    /// Options for single formats.
    #[serde(default)]
    pub formats: FormatOptions,
}

impl Default for ReadOptions {
    /// No layer; alpha is an error; no motion or depth; at most 256 megapixels, which is three
    /// times the retinal resolution of the papers (11520x6480), or 768 MB of 8-bit RGB.
    fn default() -> Self {
        Self {
            layer: None,
            alpha: AlphaPolicy::Error,
            max_megapixels: 256,
            guides: GuideOptions::default(),
            formats: FormatOptions::default(),
        }
    }
}

impl ReadOptions {
    /// Refuses a declared size that is too large, before anything is allocated for it.
    pub(crate) fn check_size(&self, width: u64, height: u64) -> Result<(), ReadErrorKind> {
        let limit = self.max_megapixels.saturating_mul(1_000_000);
        if width.saturating_mul(height) > limit {
            let limit_megapixels = self.max_megapixels;
            return Err(ReadErrorKind::TooLarge { width, height, limit_megapixels });
        }
        Ok(())
    }

    /// Refuses a block that, decoded, is larger than any block of an allowed frame, because decoders
    /// allocate a whole block at once.
    pub(crate) fn check_block(&self, bytes: u64) -> Result<(), ReadErrorKind> {
        /// Three floats for each pixel of the largest frame, and some reserve.
        const BYTES_A_PIXEL: u64 = 16;
        let limit = self.max_megapixels.saturating_mul(1_000_000 * BYTES_A_PIXEL);
        if bytes > limit { Err(ReadErrorKind::BlockTooLarge { bytes }) } else { Ok(()) }
    }
}

/// Options that concern a single format, one field per format.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct FormatOptions {
    /// Options for YUV4MPEG2 video.
    #[serde(flatten)]
    pub y4m: Y4mOptions,
}

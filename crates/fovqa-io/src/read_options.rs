//! How files are read.

use serde::{Deserialize, Serialize};

use crate::alpha::AlphaPolicy;
use crate::error::ReadErrorKind;
use crate::guides::options::GuideOptions;
use crate::y4m::options::Y4mOptions;

/// How files are read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReadOptions {
    /// The colour layer of OpenEXR files that have several.
    pub layer: Option<String>,
    /// What to do with alpha.
    pub alpha: AlphaPolicy,
    /// Most pixels a file may declare, in millions.
    pub max_megapixels: u64,
    /// Motion and depth to read beside the colour.
    pub guides: GuideOptions,
    /// What is of one format alone.
    #[serde(default)]
    pub formats: FormatOptions,
}

impl Default for ReadOptions {
    /// No layer, alpha an error, no guides, 256 megapixels: three times the retinal resolution of
    /// the papers (11520x6480), 768 MB of 8-bit RGB.
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
    /// Refuses a declared size before anything is allocated for it.
    pub(crate) fn check_size(&self, width: u64, height: u64) -> Result<(), ReadErrorKind> {
        let limit = self.max_megapixels.saturating_mul(1_000_000);
        if width.saturating_mul(height) > limit {
            let limit_megapixels = self.max_megapixels;
            return Err(ReadErrorKind::TooLarge { width, height, limit_megapixels });
        }
        Ok(())
    }

    /// Refuses a block that no frame within the limit could have: decoders allocate it whole.
    pub(crate) fn check_block(&self, bytes: u64) -> Result<(), ReadErrorKind> {
        /// Three floats and something to spare for each pixel of the largest frame.
        const BYTES_A_PIXEL: u64 = 16;
        let limit = self.max_megapixels.saturating_mul(1_000_000 * BYTES_A_PIXEL);
        if bytes > limit { Err(ReadErrorKind::BlockTooLarge { bytes }) } else { Ok(()) }
    }
}

/// Settings that belong to a single format, one field per format.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct FormatOptions {
    /// Video as YUV4MPEG2.
    #[serde(flatten)]
    pub y4m: Y4mOptions,
}

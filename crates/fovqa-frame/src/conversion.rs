//! The samples of a frame with their conversion to the signal or to luminance.

use half::f16;

use crate::codes::{CODES_8, CODES_16};
use crate::display_range::{Curve, DisplayRange};
use crate::signal_params::SignalParams;
use crate::tonemap::ToneMap;
use crate::transfer::srgb;

/// The samples of a frame with their conversion to the signal or to luminance.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Conversion<'a> {
    /// 8-bit codes, multiplied by a whole number.
    Codes8(&'a [u8], f32),
    /// 16-bit codes, multiplied by a whole number.
    Codes16(&'a [u16], f32),
    /// 8-bit codes, looked up in a table of the signal or of luminance.
    Table8(&'a [u8], &'a [f32; CODES_8]),
    /// 16-bit codes, looked up in a table of the signal or of luminance.
    Table16(&'a [u16], &'a [f32; CODES_16]),
    /// Half floats, looked up by their bits in a table of the signal or of luminance.
    Half(&'a [f16], &'a [f32; CODES_16]),
    /// Linear scene values to the signal.
    Linear(&'a [f32], FloatToSignal),
    /// Encoded values, limited to [0, 1].
    Encoded(&'a [f32]),
    /// Encoded values to displayed luminance.
    Curve(&'a [f32], Curve<'a>),
    /// Linear scene values to displayed luminance.
    ToneMapped(&'a [f32], FloatToSignal, Curve<'a>),
    /// Absolute luminance, limited to the display.
    Absolute(&'a [f32], DisplayRange),
}

/// Exposure, tone map and sRGB encoding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FloatToSignal {
    gain: f32,
    tonemap: ToneMap,
    encoder: srgb::Encoder,
}

impl FloatToSignal {
    pub(crate) fn new(params: &SignalParams) -> Self {
        Self {
            gain: libm::exp2(params.exposure_stops) as f32,
            tonemap: params.tonemap,
            encoder: srgb::Encoder::new(),
        }
    }

    #[inline]
    pub(crate) fn map(self, linear: f32) -> f32 {
        // NaN becomes 0, since the tone map takes `NaN.max(0.0)`, which is 0.
        self.encoder.encode(self.tonemap.map(linear * self.gain))
    }
}

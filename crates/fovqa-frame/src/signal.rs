//! From samples to the signal metrics see: display-encoded, per channel.
//!
//! Encoded input (PNG and JPEG, unless told otherwise) is used as it is. Linear input
//! (OpenEXR, unless told otherwise) gets exposure, then the tone map per channel, then the sRGB
//! encoding. NaN becomes 0 and an infinity the end of the range, so that a masked pixel cannot
//! leak into its neighbours.

use std::sync::OnceLock;

use fovqa_params::{OrAuto, words};
use half::f16;
use serde::{Deserialize, Serialize};

use crate::frame::{Frame, Samples};
use crate::light::{Curve, ShownLight};
use crate::tonemap::ToneMap;
use crate::transfer::srgb;

words! {
    /// How the values of a file are encoded.
    pub enum Transfer {
        /// sRGB: used as they are.
        Srgb "srgb" "sRGB-encoded";
        /// Linear light: exposure, tone map and sRGB encoding follow.
        Linear "linear" "Linear light: exposure, tone map and sRGB encoding follow";
        /// SMPTE ST 2084 codes: used as they are.
        Pq "pq" "SMPTE ST 2084 codes, used as they are";
        /// A power of 2.2: used as they are.
        Gamma22 "gamma2.2" "A power of 2.2, used as it is";
    }
}

impl OrAuto for Transfer {
    const AUTO: &'static str = "sRGB for PNG, JPEG and y4m video, linear for OpenEXR";
}

words! {
    /// What metrics see of a picture.
    #[derive(Default)]
    pub enum SignalChannels {
        /// Three channels; a gray picture stands for three equal ones.
        #[default]
        Rgb "rgb" "Red, green and blue";
        /// One: [`Luma`].
        Luma "luma" "0.2126 R + 0.7152 G + 0.0722 B of the encoded signal";
    }
}

/// Weights of luma, `Y = 0.2126 R + 0.7152 G + 0.0722 B` of the encoded signal (Rec. ITU-R BT.709).
#[derive(Debug, Clone, Copy)]
pub struct Luma;

impl Luma {
    /// Red, green, blue.
    pub const WEIGHTS: [f32; 3] = [0.2126, 0.7152, 0.0722];
}

/// How samples become the signal.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SignalParams {
    /// `None`: sRGB for encoded frames, linear for others.
    pub transfer: Option<Transfer>,
    /// Exposure of linear input, in stops.
    pub exposure_stops: f64,
    /// Tone map of linear input.
    pub tonemap: ToneMap,
    /// RGB or luma.
    pub channels: SignalChannels,
}

impl SignalParams {
    /// The transfer function of a frame: the one asked for, or that of its kind of file.
    pub fn transfer_of(&self, frame: &Frame) -> Transfer {
        self.transfer.unwrap_or(if frame.is_encoded() { Transfer::Srgb } else { Transfer::Linear })
    }
}

/// The way from a sample to the signal, tabulated once where the sample has few values.
#[derive(Debug)]
pub struct SignalTables {
    params: SignalParams,
    codes8: OnceLock<Box<[f32; CODES_8]>>,
    codes16: OnceLock<Box<[f32; CODES_16]>>,
    half: OnceLock<Box<[f32; CODES_16]>>,
}

/// How many values 8 bits have. A table of this length needs no check of an 8-bit index.
pub(crate) const CODES_8: usize = 1 << 8;
/// How many values 16 bits have.
pub(crate) const CODES_16: usize = 1 << 16;

/// The values of all codes from 0 on.
#[allow(clippy::unnecessary_box_returns, reason = "a quarter of a megabyte is no stack frame")]
pub(crate) fn table<const N: usize>(value: impl Fn(usize) -> f32) -> Box<[f32; N]> {
    let values: Box<[f32]> = (0..N).map(value).collect();
    values.try_into().unwrap_or_else(|_| unreachable!("N values make a table of N"))
}

/// One frame's samples with the way to the signal.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Source<'a> {
    /// Codes times a whole number.
    Codes8(&'a [u8], f32),
    Codes16(&'a [u16], f32),
    Table8(&'a [u8], &'a [f32; CODES_8]),
    Table16(&'a [u16], &'a [f32; CODES_16]),
    Half(&'a [f16], &'a [f32; CODES_16]),
    Linear(&'a [f32], FloatToSignal),
    Encoded(&'a [f32]),
    /// To light: encoded values, those of a scene, and absolute light.
    Curve(&'a [f32], Curve<'a>),
    ToneMapped(&'a [f32], FloatToSignal, Curve<'a>),
    Absolute(&'a [f32], ShownLight),
}

/// Exposure, tone map, encoding.
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
        // `NaN.max(0.0)` in the tone map is 0.
        self.encoder.encode(self.tonemap.map(linear * self.gain))
    }
}

impl SignalTables {
    /// Prepares the conversion; tables are built when a frame first needs them.
    pub fn new(params: SignalParams) -> Self {
        Self { params, codes8: OnceLock::new(), codes16: OnceLock::new(), half: OnceLock::new() }
    }

    /// The parameters these tables stand for.
    pub fn params(&self) -> &SignalParams {
        &self.params
    }

    /// Whether a frame's codes are the signal: then two such frames are compared in exact
    /// integers.
    pub(crate) fn codes_are_signal(&self, frame: &Frame) -> bool {
        frame.samples().is_integer() && self.params.transfer_of(frame) != Transfer::Linear
    }

    /// The source of a frame whose codes are the signal, in units in which both frames of a pair
    /// have the peak `peak`: 255 or 65535.
    pub(crate) fn codes(frame: &Frame, peak: f32) -> Option<Source<'_>> {
        match frame.samples() {
            Samples::U8(s) => Some(Source::Codes8(s, peak / 255.0)),
            Samples::U16(s) => Some(Source::Codes16(s, peak / 65535.0)),
            Samples::F16(_) | Samples::F32(_) => None,
        }
    }

    /// The source of any frame, with peak 1.
    pub(crate) fn unit<'a>(&'a self, frame: &'a Frame) -> Source<'a> {
        let linear = self.params.transfer_of(frame) == Transfer::Linear;
        let gain = libm::exp2(self.params.exposure_stops);
        let tonemap = self.params.tonemap;
        let to_signal = |v: f64| {
            if linear {
                srgb::encode(f64::from(tonemap.map((v * gain) as f32))) as f32
            } else {
                v.clamp(0.0, 1.0) as f32
            }
        };
        match frame.samples() {
            Samples::U8(s) => {
                let value = |code: usize| to_signal(code as f64 / 255.0);
                Source::Table8(s, self.codes8.get_or_init(|| table(value)))
            }
            Samples::U16(s) => {
                let value = |code: usize| to_signal(code as f64 / 65535.0);
                Source::Table16(s, self.codes16.get_or_init(|| table(value)))
            }
            Samples::F16(s) => {
                let value = |bits: usize| {
                    let v = f64::from(f16::from_bits(bits as u16).to_f32());
                    if v.is_nan() { 0.0 } else { to_signal(v) }
                };
                Source::Half(s, self.half.get_or_init(|| table(value)))
            }
            Samples::F32(s) if linear => Source::Linear(s, FloatToSignal::new(&self.params)),
            Samples::F32(s) => Source::Encoded(s),
        }
    }
}

//! Converts samples to the signal that metrics compare: display-encoded, per channel.
//!
//! Encoded input (PNG and JPEG, unless told otherwise) is used as it is. Linear input (OpenEXR,
//! unless told otherwise) gets exposure, then the tone map per channel, then the sRGB encoding. NaN
//! becomes 0 and infinity becomes the end of the range, so that a masked pixel cannot affect its
//! neighbours.

use std::sync::OnceLock;

use half::f16;

use crate::codes::{CODES_8, CODES_16, table};
use crate::conversion::{Conversion, FloatToSignal};
use crate::frame::{Frame, Samples};
use crate::light::{self, LightKind};
use crate::luminance::LuminanceTables;
use crate::signal_params::{SignalParams, Transfer};
use crate::transfer::srgb;

/// The conversion from samples to the signal, tabulated once where samples have few possible
/// values.
#[derive(Debug)]
pub struct SignalTables {
    params: SignalParams,
    codes8: OnceLock<Box<[f32; CODES_8]>>,
    codes16: OnceLock<Box<[f32; CODES_16]>>,
    half: OnceLock<Box<[f32; CODES_16]>>,
    displayed: OnceLock<LuminanceTables>,
    scene: OnceLock<LuminanceTables>,
}

impl SignalTables {
    /// Prepares the conversion. Tables are built when a frame first needs them.
    pub fn new(params: SignalParams) -> Self {
        Self {
            params,
            codes8: OnceLock::new(),
            codes16: OnceLock::new(),
            half: OnceLock::new(),
            displayed: OnceLock::new(),
            scene: OnceLock::new(),
        }
    }

    /// The parameters of these tables.
    pub fn params(&self) -> &SignalParams {
        &self.params
    }

    /// The conversion to light.
    pub(crate) fn light(&self, kind: LightKind) -> &LuminanceTables {
        let tables = match kind {
            LightKind::Displayed => &self.displayed,
            LightKind::Scene => &self.scene,
        };
        tables.get_or_init(|| light::tables(self.params, kind))
    }

    /// Whether a frame's codes are the signal already. Two such frames are compared in exact
    /// integers.
    pub(crate) fn codes_are_signal(&self, frame: &Frame) -> bool {
        frame.samples().is_integer() && self.params.transfer_of(frame) != Transfer::Linear
    }

    /// The conversion of a frame whose codes are the signal, in units in which both frames of a
    /// pair have the peak `peak`, 255 or 65535.
    pub(crate) fn codes(frame: &Frame, peak: f32) -> Option<Conversion<'_>> {
        match frame.samples() {
            Samples::U8(s) => Some(Conversion::Codes8(s, peak / 255.0)),
            Samples::U16(s) => Some(Conversion::Codes16(s, peak / 65535.0)),
            Samples::F16(_) | Samples::F32(_) => None,
        }
    }

    /// The conversion of any frame, with peak 1.
    pub(crate) fn unit<'a>(&'a self, frame: &'a Frame) -> Conversion<'a> {
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
                Conversion::Table8(s, self.codes8.get_or_init(|| table(value)))
            }
            Samples::U16(s) => {
                let value = |code: usize| to_signal(code as f64 / 65535.0);
                Conversion::Table16(s, self.codes16.get_or_init(|| table(value)))
            }
            Samples::F16(s) => {
                let value = |bits: usize| {
                    let v = f64::from(f16::from_bits(bits as u16).to_f32());
                    if v.is_nan() { 0.0 } else { to_signal(v) }
                };
                Conversion::Half(s, self.half.get_or_init(|| table(value)))
            }
            Samples::F32(s) if linear => Conversion::Linear(s, FloatToSignal::new(&self.params)),
            Samples::F32(s) => Conversion::Encoded(s),
        }
    }
}

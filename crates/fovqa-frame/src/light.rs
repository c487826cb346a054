//! Red, green and blue light of a frame, for metrics that compare colours.
//!
//! Displayed light is what a display emits for the signal, from 0 to 1. Scene light is the samples of a
//! linear file as they are, before exposure and tone map.

use std::ops::Range;

use crate::display_range::DisplayRange;
use crate::frame::{Channels, Frame};
use crate::luminance::{LinearInput, LuminanceSignal, LuminanceTables};
use crate::signal::SignalTables;
use crate::signal_params::{Luma, SignalParams, Transfer};
use crate::transfer::srgb;

/// The light of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightKind {
    /// The decoded signal, from 0 to 1.
    Displayed,
    /// The samples of linear input, from 0 on. Negative samples and NaN are 0.
    Scene,
}

/// The conversions to both kinds of light.
pub(crate) fn tables(signal: SignalParams, kind: LightKind) -> LuminanceTables {
    let weights = Luma::WEIGHTS.map(f64::from);
    let linear = match kind {
        LightKind::Displayed => LinearInput::ToneMapped,
        LightKind::Scene => LinearInput::Absolute(DisplayRange {
            cd_m2_per_unit: 1.0,
            floor_cd_m2: 0.0,
            peak_cd_m2: f64::from(f32::MAX),
            black_cd_m2: 0.0,
        }),
    };
    let decode = match signal.transfer {
        Some(Transfer::Gamma22) => |encoded: f64| libm::pow(encoded, 2.2),
        _ => srgb::decode,
    };
    LuminanceTables::new(signal, decode, linear, weights)
}

/// A frame that is read row by row as light.
#[derive(Debug)]
pub struct LightSignal<'a> {
    frame: &'a Frame,
    signal: LuminanceSignal<'a>,
}

impl<'a> LightSignal<'a> {
    /// Prepares a frame. PQ codes have no displayed light from 0 to 1, and encoded samples no scene light:
    /// callers must check this first. Otherwise, both are decoded as sRGB.
    pub fn new(frame: &'a Frame, tables: &'a SignalTables, kind: LightKind) -> Self {
        Self { frame, signal: tables.light(kind).luminance(frame) }
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.frame.width()
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.frame.height()
    }

    /// Whether red, green and blue are equal everywhere.
    pub fn is_gray(&self) -> bool {
        self.frame.channels() == Channels::Gray
    }

    /// Reads the columns `xs` of row `y` as red, green and blue.
    ///
    /// # Panics
    /// When there are no such pixels, or a plane does not have a value for each.
    pub fn fill(&self, y: usize, xs: Range<usize>, planes: [&mut [f32]; 3]) {
        self.signal.fill_channels(y, xs, planes);
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use half::f16;

    use super::*;
    use crate::frame::Samples;
    use crate::tonemap::ToneMap;

    fn read(frame: &Frame, params: SignalParams, kind: LightKind) -> [Vec<f32>; 3] {
        let tables = SignalTables::new(params);
        let mut planes: [Vec<f32>; 3] = std::array::from_fn(|_| vec![0.0; frame.width()]);
        let [r, g, b] = &mut planes;
        LightSignal::new(frame, &tables, kind).fill(0, 0..frame.width(), [r, g, b]);
        planes
    }

    #[test]
    fn displayed_light_is_the_decoded_signal() {
        let frame = |samples| Frame::new(2, 1, Channels::Rgb, samples).unwrap();
        let codes = frame(Samples::U8(vec![0, 10, 255, 51, 188, 128].into()));
        let srgb = SignalParams::default();
        let [r, g, b] = read(&codes, srgb, LightKind::Displayed);
        let of = |code: f64| srgb::decode(code / 255.0) as f32;
        assert_eq!([r, g, b], [[of(0.0), of(51.0)], [of(10.0), of(188.0)], [1.0, of(128.0)]]);
        let gamma = SignalParams { transfer: Some(Transfer::Gamma22), ..srgb };
        let [r, ..] = read(&codes, gamma, LightKind::Displayed);
        assert_eq!(r, [0.0, libm::pow(0.2, 2.2) as f32]);
        // Linear input is exposed and tone-mapped; the encoding and its inverse cancel out.
        let scene = Samples::F32(vec![0.5, -1.0, 2.0, f32::NAN, 1.0, 7.0].into());
        let mapped = SignalParams { exposure_stops: 1.0, tonemap: ToneMap::Reinhard, ..srgb };
        let [r, g, b] = read(&frame(scene), mapped, LightKind::Displayed);
        for (found, wanted) in
            [r, g, b].concat().iter().zip([0.5, 0.0, 0.8, 0.0, 2.0 / 3.0, 14.0 / 15.0])
        {
            assert!((found - wanted).abs() < 2e-7, "{found} for {wanted}");
        }
    }

    #[test]
    fn scene_light_is_the_samples() {
        let values = [0.25, -3.0, 1e30, f32::NAN];
        let signal = SignalParams { exposure_stops: 3.0, ..SignalParams::default() };
        let gray = Frame::new(4, 1, Channels::Gray, Samples::F32(values.to_vec().into())).unwrap();
        let planes = read(&gray, signal, LightKind::Scene);
        assert_eq!(planes, [(); 3].map(|()| vec![0.25, 0.0, 1e30, 0.0]));
        let halves: Vec<f16> = values.iter().map(|v| f16::from_f32(v.min(6e4))).collect();
        let gray = Frame::new(4, 1, Channels::Gray, Samples::F16(halves.into())).unwrap();
        assert_eq!(read(&gray, signal, LightKind::Scene)[2][..2], [0.25, 0.0]);
        let linear = SignalParams { transfer: Some(Transfer::Linear), ..signal };
        let codes = Frame::new(1, 1, Channels::Gray, Samples::U8(vec![51].into())).unwrap();
        assert_eq!(read(&codes, linear, LightKind::Scene)[1], [0.2]);
    }
}

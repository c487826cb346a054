//! Display photometry: from values to emitted luminance, for each colour channel separately.
//!
//! The black level is the panel's own plus the reflected light, E / π · k. White is the peak: it
//! includes the reflected light, which is not added on top. All values are in cd/m².

use fovqa_frame::transfer::{pq, srgb};
use fovqa_frame::{DisplayRange, LinearInput, LuminanceTables, SignalParams};
use fovqa_vision::{Eotf, Luminance};

use super::calibration::LOWEST_LIGHT_CD_M2;
use super::params::Params;

/// The conversion of a display from values to luminance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Photometry {
    luminance: Luminance,
    black_cd_m2: f64,
}

impl Photometry {
    /// The photometry of a display.
    pub fn new(luminance: Luminance) -> Self {
        Self { luminance, black_cd_m2: luminance.black_cd_m2() }
    }

    /// Luminance of white in cd/m².
    pub fn peak_cd_m2(&self) -> f64 {
        self.luminance.peak_cd_m2
    }

    /// Luminance of black in cd/m².
    pub fn black_cd_m2(&self) -> f64 {
        self.black_cd_m2
    }

    /// The encoding of the display's input.
    pub fn eotf(&self) -> Eotf {
        self.luminance.eotf
    }

    /// The emitted luminance of a value in cd/m². The value is either encoded, and clamped to [0,
    /// 1], or a luminance.
    pub fn emitted_cd_m2(&self, value: f64) -> f64 {
        let code = value.clamp(0.0, 1.0);
        let relative =
            |share: f64| (self.peak_cd_m2() - self.black_cd_m2) * share + self.black_cd_m2;
        let shown = self.shown(1.0);
        let light =
            |light: f64| light.clamp(shown.floor_cd_m2, shown.peak_cd_m2) + shown.black_cd_m2;
        match self.luminance.eotf {
            Eotf::Srgb => relative(srgb::decode(code)),
            Eotf::Gamma => relative(libm::pow(code, self.luminance.gamma)),
            Eotf::Pq => light(pq::decode(code)),
            Eotf::Linear | Eotf::Absolute => light(value),
        }
    }

    /// How the display shows absolute luminance.
    fn shown(&self, cd_m2_per_unit: f64) -> DisplayRange {
        let floor_cd_m2 = match self.luminance.eotf {
            Eotf::Absolute => self.luminance.min_cd_m2.unwrap_or(LOWEST_LIGHT_CD_M2),
            _ => LOWEST_LIGHT_CD_M2,
        };
        DisplayRange {
            cd_m2_per_unit,
            floor_cd_m2,
            peak_cd_m2: self.peak_cd_m2(),
            black_cd_m2: self.black_cd_m2,
        }
    }

    /// The conversion from the samples of frames to luminance on this display. Linear samples are
    /// absolute luminance if the input of the display is luminance, or if `params` say how many
    /// cd/m² a unit is. Otherwise they are tone-mapped and encoded as `signal` says.
    pub fn tables(&self, signal: SignalParams, params: &Params) -> LuminanceTables {
        let absolute = |unit: f64| LinearInput::Absolute(self.shown(unit));
        let linear = match params.cd_m2_per_unit {
            Some(unit) => absolute(unit),
            None if self.eotf().is_relative() => LinearInput::ToneMapped,
            None => absolute(1.0),
        };
        let this = *self;
        let emitted = move |value| this.emitted_cd_m2(value);
        LuminanceTables::new(signal, emitted, linear, params.color_space.luminance_weights())
    }
}

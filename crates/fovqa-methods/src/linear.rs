//! Linear fall-off of the sampling probability (Weier et al. 2016, as RMFR compares with it).
//!
//! The probability that a pixel is sampled is 1 inside `inner_deg`, falls linearly in degrees to
//! `p_min` at `outer_deg`, and is constant beyond. It is a density per area: the rate per axis is
//! its square root.

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::error::MethodError;
use crate::foveation::{Counts, Foveation, Rates};
use crate::info::MethodInfo;
use crate::setting::{Place, Setting};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// The eccentricity in degrees where the fall begins. Default 10.
    pub inner_deg: f64,
    /// The eccentricity in degrees where it ends. Default 20.
    pub outer_deg: f64,
    /// The smallest probability. Default 0.047.
    pub p_min: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self { inner_deg: 10.0, outer_deg: 20.0, p_min: 0.047 }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "inner_deg" => self.inner_deg = value.number()?,
            "outer_deg" => self.outer_deg = value.number()?,
            "p_min" => self.p_min = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "linear",
    label: "Linear",
    about: "sampling probability that falls linearly with eccentricity",
    source: "Weier et al. 2016; values of RMFR (Ye et al. 2022)",
    params: &[
        ParamInfo {
            name: "inner_deg",
            default: "10",
            values: ParamValues::Number(0.0, 89.0),
            about: "eccentricity at which the probability begins to fall, °",
        },
        ParamInfo {
            name: "outer_deg",
            default: "20",
            values: ParamValues::Number(0.001, 89.9),
            about: "eccentricity at which the probability reaches p_min, °; above inner_deg",
        },
        ParamInfo {
            name: "p_min",
            default: "0.047",
            values: ParamValues::Number(1e-6, 1.0),
            about: "lowest share of pixels that are sampled",
        },
    ],
};

/// Linear fall-off, applied to a frame.
#[derive(Debug, Clone, Copy)]
pub struct Linear {
    setting: Setting,
    params: Params,
}

impl Linear {
    /// Applies the method to a frame and a gaze.
    ///
    /// # Errors
    /// When the fall ends before it begins.
    pub fn new(params: &Params, setting: &Setting) -> Result<Self, MethodError> {
        if params.outer_deg <= params.inner_deg {
            let message = format!(
                "outer_deg {} must be above inner_deg {}",
                params.outer_deg, params.inner_deg
            );
            return Err(MethodError::Params { method: INFO.key, message });
        }
        Ok(Self { setting: *setting, params: *params })
    }

    fn probability(&self, radius_px: f64) -> f64 {
        let Params { inner_deg, outer_deg, p_min } = self.params;
        let e = self.setting.eccentricity_deg(radius_px);
        let fall = ((e - inner_deg) / (outer_deg - inner_deg)).clamp(0.0, 1.0);
        1.0 - (1.0 - p_min) * fall
    }
}

impl Foveation for Linear {
    fn rates(&self, place: Place) -> Option<Rates> {
        Some(Rates::both(self.probability(place.radius_px).sqrt()))
    }

    fn density(&self, place: Place) -> f64 {
        self.probability(place.radius_px)
    }

    fn counts(&self) -> Counts {
        let bounds = [self.params.inner_deg, self.params.outer_deg];
        let [inner, outer] = bounds.map(|e| self.setting.radius_px(e));
        let samples = self.setting.integrate(&[0.0, inner, outer], |r| self.probability(r));
        Counts::of_pixels(samples)
    }
}

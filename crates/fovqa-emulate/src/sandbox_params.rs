//! Parameters of the sandbox and of enhancement.

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::peripheral::Growth;

const RATE: ParamInfo = ParamInfo {
    name: "rate_arcmin",
    default: "2",
    values: ParamValues::Number(0.0, 600.0),
    about: "growth of the blur, minutes of arc a degree",
};

const FOVEAL: ParamInfo = ParamInfo {
    name: "foveal_deg",
    default: "15",
    values: ParamValues::Number(0.0, 89.0),
    about: "where the blur begins, ° (7.5 on a desktop)",
};

const TRANSITION: ParamInfo = ParamInfo {
    name: "transition_deg",
    default: "20",
    values: ParamValues::Number(0.001, 1000.0),
    about: "over which enhancement rises to its full strength, °",
};

/// The largest strength of an enhancement.
pub(crate) const MOST_F_MAX: f64 = 100.0;

const F_MAX: ParamInfo = ParamInfo {
    name: "f_max",
    default: "1",
    values: ParamValues::Number(0.0, MOST_F_MAX),
    about: "strength of the enhancement (3 and 5 ring)",
};

/// Parameters of `stable` and `aliased`.
pub(crate) const BLUR: &[ParamInfo] = &[RATE, FOVEAL];
/// Parameters of `perceptual-target`.
pub(crate) const TARGET: &[ParamInfo] = &[RATE, FOVEAL, F_MAX, TRANSITION];
/// Parameters of `--enhance`, beside its strength.
pub(crate) const ENHANCE: &[ParamInfo] = &[RATE, FOVEAL, TRANSITION];

/// Parameters of a blur that grows with eccentricity, and of the enhancement behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SandboxParams {
    pub(crate) growth: Growth,
    pub(crate) f_max: f64,
    pub(crate) transition_deg: f64,
}

impl Default for SandboxParams {
    fn default() -> Self {
        let growth = Growth { rate_arcmin: 2.0, foveal_deg: 15.0 };
        Self { growth, f_max: 1.0, transition_deg: 20.0 }
    }
}

impl SandboxParams {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "rate_arcmin" => self.growth.rate_arcmin = value.number()?,
            "foveal_deg" => self.growth.foveal_deg = value.number()?,
            "f_max" => self.f_max = value.number()?,
            "transition_deg" => self.transition_deg = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

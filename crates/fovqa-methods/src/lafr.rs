//! Log-polar foveated rendering with two kernels (Shi et al. 2023, "LaFR"), as VaFR quotes it.
//!
//! VaFR's Eq. 15 has no real value as printed; this file uses the consistent form. With Z = z(e_f):
//! F = 1 - log_Z(α Z^(1-a) / (1-a)), U_f = (Z (1-F))^(1/F). Inside e_f: U = ((1-F) z)^(1/F).
//! Outside: U = g^(β/0.7) (1 - U_f) + U_f, g = (2 acos Q - π) / π, Q = (1/z - 1/Z) / (1/Z - 1). u =
//! w U, v = θ/360 h. Rates are dU/de. The outer branch has the factor (β/0.7) g^(β/0.7 - 1), and
//! Eq. 17 as printed is twice too large there. a = 1/4 is inferred from LMFR's α = 4. The rate
//! jumps at e_f, which is the discontinuity that VaFR shows. For β > 0.7 the outer rate begins at
//! 0, for β < 0.7 at infinity.

use std::f64::consts::PI;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::error::MethodError;
use crate::foveation::{Counts, Foveation, Mapping, Rates, Reach};
use crate::info::MethodInfo;
use crate::log_polar::LogPolar;
use crate::setting::{Place, Setting, up_to};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// δ: the buffer's sides are the frame's divided by it. 1.8 for quality (default), 2.2
    /// for speed.
    pub sigma: f64,
    /// a in the formula for F. Default 1/4.
    pub a: f64,
    /// α in the formula for F. Default 0.85.
    pub alpha: f64,
    /// β in the exponent of the outer kernel. Default 0.7.
    pub beta: f64,
    /// e_f, the eccentricity in degrees where the inner kernel ends. Default 4.89.
    pub foveal_deg: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self { sigma: 1.8, a: 0.25, alpha: 0.85, beta: 0.7, foveal_deg: 4.89 }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "sigma" => self.sigma = value.number()?,
            "a" => self.a = value.number()?,
            "alpha" => self.alpha = value.number()?,
            "beta" => self.beta = value.number()?,
            "foveal_deg" => self.foveal_deg = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "lafr",
    label: "LaFR",
    about: "log-polar foveated rendering with an inner and an outer kernel",
    source: "Shi et al. 2023; VaFR (Zhang, Gai, Li), Eq. 15 and 17, repaired",
    params: &[
        ParamInfo {
            name: "sigma",
            default: "1.8",
            values: ParamValues::Number(0.1, 1000.0),
            about: "δ, ratio of the frame's sides to the buffer's (2.2: speed)",
        },
        ParamInfo {
            name: "a",
            default: "0.25",
            values: ParamValues::Number(0.01, 0.99),
            about: "exponent of the inner kernel (inferred from LMFR's alpha = 4)",
        },
        ParamInfo {
            name: "alpha",
            default: "0.85",
            values: ParamValues::Number(0.01, 100.0),
            about: "weight of the inner kernel",
        },
        ParamInfo {
            name: "beta",
            default: "0.7",
            values: ParamValues::Number(0.01, 100.0),
            about: "the outer kernel's exponent is beta / 0.7",
        },
        ParamInfo {
            name: "foveal_deg",
            default: "4.89",
            values: ParamValues::Number(0.01, 89.0),
            about: "e_f, where the inner kernel ends, °",
        },
    ],
};

/// Log-polar foveated rendering with two kernels, applied to a frame.
#[derive(Debug, Clone, Copy)]
pub struct Lafr {
    polar: LogPolar,
    /// The distance of e_f in pixels, and Z there.
    foveal_px: f64,
    foveal_z: f64,
    /// F and U_f.
    f: f64,
    foveal_u: f64,
    /// β / 0.7.
    power: f64,
}

impl Lafr {
    /// Applies the method to a frame and a gaze.
    ///
    /// # Errors
    /// When e_f lies within a pixel of the gaze or outside the frame, or the kernels do not meet.
    pub fn new(params: &Params, setting: &Setting) -> Result<Self, MethodError> {
        let refused = |message: String| MethodError::Params { method: INFO.key, message };
        let polar = LogPolar::new(setting, params.sigma, INFO.key)?;
        let foveal_px = setting.radius_px(params.foveal_deg);
        let corner_px = setting.corner_px();
        if foveal_px <= 1.0 || foveal_px >= corner_px {
            return Err(refused(format!(
                "foveal_deg {} is {foveal_px:.1} px from the gaze: it must be between {:.3}° (1 px) and \
                 {:.3}° (the farthest corner)",
                params.foveal_deg,
                setting.eccentricity_deg(1.0),
                setting.eccentricity_deg(corner_px),
            )));
        }
        let z = polar.z(foveal_px);
        let joined = params.alpha * libm::pow(z, 1.0 - params.a) / (1.0 - params.a);
        let f = 1.0 - libm::log(joined) / libm::log(z);
        let foveal_u = libm::pow(z * (1.0 - f), 1.0 / f);
        if !(f > 0.0 && f < 1.0 && foveal_u > 0.0 && foveal_u < 1.0) {
            return Err(refused(format!(
                "with a = {} and alpha = {} the kernels do not meet at {}°: F = {f:.4} is not \
                 between 0 and 1. alpha must be between {:.4} and {:.4} here",
                params.a,
                params.alpha,
                params.foveal_deg,
                z * (1.0 - params.a) / libm::pow(z, 1.0 - params.a),
                (1.0 - params.a) / libm::pow(z, 1.0 - params.a),
            )));
        }
        Ok(Self { polar, foveal_px, foveal_z: z, f, foveal_u, power: params.beta / 0.7 })
    }

    /// Q of Eq. 15.
    fn q(&self, z: f64) -> f64 {
        ((1.0 / z - 1.0 / self.foveal_z) / (1.0 / self.foveal_z - 1.0)).clamp(-1.0, 0.0)
    }

    /// U as a function of z.
    fn kernel(&self, z: f64) -> f64 {
        if z <= self.foveal_z {
            return libm::pow((1.0 - self.f) * z, 1.0 / self.f);
        }
        let g = (2.0 * libm::acos(self.q(z)) - PI) / PI;
        libm::pow(g, self.power) * (1.0 - self.foveal_u) + self.foveal_u
    }

    /// z as a function of U.
    fn inverse(&self, u: f64) -> f64 {
        if u <= self.foveal_u {
            return libm::pow(u, self.f) / (1.0 - self.f);
        }
        let g = libm::pow((u - self.foveal_u) / (1.0 - self.foveal_u), 1.0 / self.power);
        let q = libm::cos((g + 1.0) * PI / 2.0);
        1.0 / (q * (1.0 / self.foveal_z - 1.0) + 1.0 / self.foveal_z)
    }

    /// dU/dz.
    fn slope(&self, z: f64) -> f64 {
        if up_to(z, self.foveal_z) {
            return self.kernel(z) / (self.f * z);
        }
        let q = self.q(z);
        let g = (2.0 * libm::acos(q) - PI) / PI;
        let g_slope = 2.0 / PI / (1.0 - q * q).sqrt() / (z * z) / (1.0 / self.foveal_z - 1.0);
        self.power * libm::pow(g, self.power - 1.0) * (1.0 - self.foveal_u) * g_slope
    }
}

impl Mapping for Lafr {
    fn buffer(&self, _layer: usize) -> [f64; 2] {
        self.polar.size
    }

    fn to_buffer(&self, _layer: usize, place: Place) -> [f64; 2] {
        let u = self.kernel(self.polar.z(place.radius_px));
        [self.polar.size[0] * u, self.polar.row(place)]
    }

    fn to_screen(&self, _layer: usize, [u, v]: [f64; 2]) -> Place {
        self.polar.place(self.inverse(u / self.polar.size[0]), v)
    }

    fn is_polar(&self) -> bool {
        true
    }
}

impl Foveation for Lafr {
    fn rates(&self, place: Place) -> Option<Rates> {
        let r = place.radius_px;
        let radial = self.polar.size[0] * self.slope(self.polar.z(r)) * self.polar.z_slope(r);
        (r > 1.0 && radial.is_finite())
            .then(|| Rates { radial, tangential: self.polar.tangential(r) })
    }

    fn counts(&self) -> Counts {
        self.polar.counts(&[self.foveal_px], |z| self.kernel(z))
    }

    fn reach(&self) -> Reach {
        Reach::Corner
    }

    fn mapping(&self) -> Option<&dyn Mapping> {
        Some(self)
    }
}

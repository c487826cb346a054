//! Kernel foveated rendering (Meng et al. 2018): the log-polar mapping with a kernel. With σ = 1.8
//! it is what VaFR calls LMFR.
//!
//! Mapping (VaFR, Eq. 14): z = ln r / ln L, u = w z^α, v = θ/360 h, w = W/σ, h = H/σ. Some public
//! code raises z to 1/α on the way into the buffer, which puts half of it inside r < 1.6 px. Rates
//! (VaFR, Eq. 16 and 20): radial ½ α z^(α-1) w π / (180 ln L sin e cos e), tangential h / (720 sin
//! e cos e) cycles per degree. In Eq. 20 the right-hand side is correct, but the middle term is
//! twice too large.

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::error::MethodError;
use crate::foveation::{Counts, Foveation, Mapping, Rates, Reach};
use crate::info::MethodInfo;
use crate::log_polar::LogPolar;
use crate::setting::{Place, Setting};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// σ: the buffer's sides are the frame's divided by it. Default 2.6 (as in RMFR's comparison;
    /// 1.8 in VaFR's).
    pub sigma: f64,
    /// Exponent of the kernel. Default 4.
    pub alpha: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self { sigma: 2.6, alpha: 4.0 }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "sigma" => self.sigma = value.number()?,
            "alpha" => self.alpha = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "kfr",
    label: "KFR",
    about: "kernel foveated rendering: a log-polar buffer, stretched by a kernel (LMFR: sigma 1.8)",
    source: "Meng et al. 2018; VaFR (Zhang, Gai, Li), Eq. 14, 16, 20",
    params: &[
        ParamInfo {
            name: "sigma",
            default: "2.6",
            values: ParamValues::Number(0.1, 1000.0),
            about: "ratio of the frame's sides to the buffer's",
        },
        ParamInfo {
            name: "alpha",
            default: "4",
            values: ParamValues::Number(0.1, 100.0),
            about: "exponent of the kernel",
        },
    ],
};

/// Kernel foveated rendering, applied to a frame.
#[derive(Debug, Clone, Copy)]
pub struct Kfr {
    polar: LogPolar,
    alpha: f64,
}

impl Kfr {
    /// Applies the method to a frame and a gaze.
    ///
    /// # Errors
    /// When no corner of the frame is farther than a pixel from the gaze.
    pub fn new(params: &Params, setting: &Setting) -> Result<Self, MethodError> {
        let polar = LogPolar::new(setting, params.sigma, INFO.key)?;
        Ok(Self { polar, alpha: params.alpha })
    }
}

impl Mapping for Kfr {
    fn buffer(&self, _layer: usize) -> [f64; 2] {
        self.polar.size
    }

    fn to_buffer(&self, _layer: usize, place: Place) -> [f64; 2] {
        let z = self.polar.z(place.radius_px);
        [self.polar.size[0] * libm::pow(z, self.alpha), self.polar.row(place)]
    }

    fn to_screen(&self, _layer: usize, [u, v]: [f64; 2]) -> Place {
        self.polar.place(libm::pow(u / self.polar.size[0], 1.0 / self.alpha), v)
    }

    fn is_polar(&self) -> bool {
        true
    }
}

impl Foveation for Kfr {
    fn rates(&self, place: Place) -> Option<Rates> {
        let r = place.radius_px;
        (r > 1.0).then(|| {
            let slope = self.alpha * libm::pow(self.polar.z(r), self.alpha - 1.0);
            Rates {
                radial: self.polar.size[0] * slope * self.polar.z_slope(r),
                tangential: self.polar.tangential(r),
            }
        })
    }

    fn counts(&self) -> Counts {
        self.polar.counts(&[], |z| libm::pow(z, self.alpha))
    }

    fn reach(&self) -> Reach {
        Reach::Corner
    }

    fn mapping(&self) -> Option<&dyn Mapping> {
        Some(self)
    }
}

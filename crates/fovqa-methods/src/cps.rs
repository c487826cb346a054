//! Coarse pixel shading (Patney et al. 2016, section 4.3).
//!
//! The rates are 1, ½ and ¼ per axis. The requested rate is 1 up to e_f and falls linearly to ¼
//! over T degrees: clamp(1 - 0.75 (e - e_f) / T, ¼, 1). It is rounded up to the next rate (`ceil`),
//! rounded to the `nearest` one, or used unrounded (`continuous`). The normalised rate S = (1 -
//! request) / 0.75 is the input of the temporal filter. A quad covers 2x2, 4x4 or 8x8 pixels, so
//! the number of quads is a quarter of the number of samples. The same holds for the display's
//! pixels, so shares are the same.

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::foveation::{Counts, Foveation, Rates};
use crate::info::MethodInfo;
use crate::setting::{Place, Setting, up_to};

/// How a requested rate is rounded to a rate of the hardware.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Quantise {
    /// The smallest rate that is not below the request.
    #[default]
    Ceil,
    /// The nearest rate; the larger one of two that are equally near.
    Nearest,
    /// No rounding.
    Continuous,
}

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// e_f, the eccentricity in degrees up to which every pixel is shaded. Default 15
    /// (head-mounted; 7.5 on a desktop).
    pub foveal_deg: f64,
    /// T, the range in degrees over which the rate falls. Default 20.
    pub transition_deg: f64,
    /// How a requested rate is rounded to a rate of the hardware.
    pub quantise: Quantise,
}

impl Default for Params {
    fn default() -> Self {
        Self { foveal_deg: 15.0, transition_deg: 20.0, quantise: Quantise::Ceil }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "foveal_deg" => self.foveal_deg = value.number()?,
            "transition_deg" => self.transition_deg = value.number()?,
            "quantise" => {
                self.quantise = match value.text()? {
                    "ceil" => Quantise::Ceil,
                    "nearest" => Quantise::Nearest,
                    "continuous" => Quantise::Continuous,
                    _ => return None,
                }
            }
            _ => return None,
        }
        Some(())
    }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "cps",
    label: "CPS",
    about: "coarse pixel shading: one sample for 1, 2x2 or 4x4 pixels",
    source: "Patney et al. 2016, section 4.3",
    params: &[
        ParamInfo {
            name: "foveal_deg",
            default: "15",
            values: ParamValues::Number(0.0, 89.0),
            about: "e_f, up to which every pixel is shaded, ° (7.5 on a desktop)",
        },
        ParamInfo {
            name: "transition_deg",
            default: "20",
            values: ParamValues::Number(0.001, 1000.0),
            about: "T, over which the rate falls to a quarter, °",
        },
        ParamInfo {
            name: "quantise",
            default: "\"ceil\"",
            values: ParamValues::Word(&["ceil", "nearest", "continuous"]),
            about: "how the rate is rounded to 1, 1/2 or 1/4",
        },
    ],
};

/// The smallest rate per axis.
const LEAST: f64 = 0.25;

/// Coarse pixel shading, applied to a frame.
#[derive(Debug, Clone, Copy)]
pub struct Cps {
    setting: Setting,
    params: Params,
}

impl Cps {
    /// Applies the method to a frame and a gaze.
    pub fn new(params: &Params, setting: &Setting) -> Self {
        Self { setting: *setting, params: *params }
    }

    /// The requested rate per axis at an eccentricity in degrees.
    pub fn request(&self, eccentricity_deg: f64) -> f64 {
        let Params { foveal_deg, transition_deg, .. } = self.params;
        let beyond = (eccentricity_deg - foveal_deg) / transition_deg;
        (1.0 - (1.0 - LEAST) * beyond).clamp(LEAST, 1.0)
    }

    /// The normalised rate S of the temporal filter: 0 where every pixel is shaded, 1 at the
    /// coarsest rate.
    pub fn normalised(&self, eccentricity_deg: f64) -> f64 {
        (1.0 - self.request(eccentricity_deg)) / (1.0 - LEAST)
    }

    fn rate(&self, radius_px: f64) -> f64 {
        let request = self.request(self.setting.eccentricity_deg(radius_px));
        let stepped = |full: bool, half: bool| match (full, half) {
            (true, _) => 1.0,
            (false, true) => 0.5,
            (false, false) => LEAST,
        };
        match self.params.quantise {
            Quantise::Ceil => stepped(!up_to(request, 0.5), !up_to(request, LEAST)),
            Quantise::Nearest => stepped(up_to(0.75, request), up_to(0.375, request)),
            Quantise::Continuous => request,
        }
    }
}

impl Foveation for Cps {
    fn rates(&self, place: Place) -> Option<Rates> {
        Some(Rates::both(self.rate(place.radius_px)))
    }

    fn counts(&self) -> Counts {
        let Params { foveal_deg, transition_deg, .. } = self.params;
        // The request is 1, 3/4, 1/2, 3/8 and 1/4 there: the rate has a step at each for one of the
        // rounding modes.
        let breaks: Vec<f64> = [0.0, 1.0 / 3.0, 2.0 / 3.0, 5.0 / 6.0, 1.0]
            .into_iter()
            .map(|share| foveal_deg + share * transition_deg)
            .filter(|e| *e < 89.9)
            .map(|e| self.setting.radius_px(e))
            .collect();
        let breaks: Vec<f64> = std::iter::once(0.0).chain(breaks).collect();
        let samples = self.setting.integrate(&breaks, |r| {
            let rate = self.rate(r);
            rate * rate
        });
        Counts::of_pixels(samples)
    }
}

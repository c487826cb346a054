//! Three nested layers (Guenter et al. 2012, "hyperbolic" in RMFR's comparison).
//!
//! Layers end at e_1 and e_2 and have the linear scales s_1, s_2, s_3. They are discs that are
//! blended over the last `transition_deg` before each bound by t² (3 - 2t); curves show the
//! unblended rate. `fixed` uses bounds and scales as they are given. `optimised` minimises the
//! number of samples with s_2 = ω(e_1)/ω*, s_3 = ω(e_2)/ω*, ω(e) = m e + ω₀ and ω* = atan(2 c_r) in
//! degrees. Scales are at least 1 (our choice: a display that shows less than acuity is not
//! supersampled), both angles are on a grid of 0.25°, and ties are decided for the smaller e_1.
//! There are two counts: the rendered samples (squares of side 2 r_k clipped to the frame, with the
//! fovea repeated), and the visible ones among them.

use std::f64::consts::PI;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::error::MethodError;
use crate::foveation::{Counts, Foveation, Mapping, Rates};
use crate::info::MethodInfo;
use crate::setting::{Place, Setting, up_to};

/// How bounds and scales are determined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fit {
    /// They are used as given.
    #[default]
    Fixed,
    /// They are optimised for the fewest samples at a given acuity.
    Optimised,
}

/// Parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// Radii of the two inner layers in degrees. Default 10, 20.
    pub bounds_deg: Vec<f64>,
    /// Pixels per sample along an axis, of each layer. Default 1, 2, 12.35.
    pub scales: Vec<f64>,
    /// Width of the blend before a bound, in degrees. Default 2.
    pub transition_deg: f64,
    /// How bounds and scales are determined.
    pub fit: Fit,
    /// Slope of the minimum angle of resolution, for `optimised`. Default 0.0275.
    pub m: f64,
    /// The minimum angle of resolution at the gaze in degrees. Default 1/48.
    pub omega0_deg: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            bounds_deg: vec![10.0, 20.0],
            scales: vec![1.0, 2.0, 12.35],
            transition_deg: 2.0,
            fit: Fit::Fixed,
            m: 0.0275,
            omega0_deg: 1.0 / 48.0,
        }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "bounds_deg" => self.bounds_deg = value.list()?,
            "scales" => self.scales = value.list()?,
            "transition_deg" => self.transition_deg = value.number()?,
            "fit" => {
                self.fit = match value.text()? {
                    "fixed" => Fit::Fixed,
                    "optimised" => Fit::Optimised,
                    _ => return None,
                }
            }
            "m" => self.m = value.number()?,
            "omega0_deg" => self.omega0_deg = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "guenter",
    label: "Guenter",
    about: "three nested layers, each coarser than the one inside (\"hyperbolic\" in RMFR)",
    source: "Guenter et al. 2012; the fixed values are RMFR's (Ye et al. 2022)",
    params: &[
        ParamInfo {
            name: "bounds_deg",
            default: "[10, 20]",
            values: ParamValues::Numbers,
            about: "radii of the two inner layers, °, increasing, between 0 and 90",
        },
        ParamInfo {
            name: "scales",
            default: "[1, 2, 12.35]",
            values: ParamValues::Numbers,
            about: "pixels per sample along an axis, of each layer, 0.1 to 1000",
        },
        ParamInfo {
            name: "transition_deg",
            default: "2",
            values: ParamValues::Number(0.0, 45.0),
            about: "width of the blend before a bound, ° (emulation; curves are unblended)",
        },
        ParamInfo {
            name: "fit",
            default: "\"fixed\"",
            values: ParamValues::Word(&["fixed", "optimised"]),
            about: "use the given bounds and scales, or those that need the fewest samples (scales are at least 1: our choice)",
        },
        ParamInfo {
            name: "m",
            default: "0.0275",
            values: ParamValues::Number(0.0, 1.0),
            about: "for optimised: slope of the minimum angle of resolution, ° per °",
        },
        ParamInfo {
            name: "omega0_deg",
            default: "0.020833333333333332",
            values: ParamValues::Number(1e-3, 10.0),
            about: "for optimised: angle of one cycle at the gaze, ° (1/48)",
        },
    ],
};

const GRID_DEG: f64 = 0.25;
/// The last angle of the grid inside 90°.
const LAST_STEP: f64 = 359.0;
const MOST_SCALE: f64 = 1000.0;

/// Three nested layers, applied to a frame.
#[derive(Debug, Clone, Copy)]
pub struct Guenter {
    setting: Setting,
    bounds_deg: [f64; 2],
    radii_px: [f64; 2],
    scales: [f64; 3],
    optimised: bool,
}

impl Guenter {
    /// Applies the method to a frame and a gaze.
    ///
    /// # Errors
    /// When there are not two bounds that rise inside (0°, 90°) and three scales.
    pub fn new(params: &Params, setting: &Setting) -> Result<Self, MethodError> {
        if params.fit == Fit::Optimised {
            return Ok(Self::optimised(params, setting));
        }
        let refused = |message: String| Err(MethodError::Params { method: INFO.key, message });
        let Ok(bounds_deg) = <[f64; 2]>::try_from(params.bounds_deg.clone()) else {
            return refused(format!("bounds_deg has {} values, not 2", params.bounds_deg.len()));
        };
        let Ok(scales) = <[f64; 3]>::try_from(params.scales.clone()) else {
            return refused(format!("scales has {} values, not 3", params.scales.len()));
        };
        if !(bounds_deg[0] > 0.0 && bounds_deg[0] < bounds_deg[1] && bounds_deg[1] < 90.0) {
            return refused(format!(
                "bounds_deg {bounds_deg:?} must increase between 0° and 90°, both excluded"
            ));
        }
        if let Some(scale) = scales.iter().find(|s| !(0.1..=MOST_SCALE).contains(*s)) {
            return refused(format!("a scale of {scale} is not between 0.1 and 1000"));
        }
        Ok(Self::with(setting, bounds_deg, scales, false))
    }

    fn with(setting: &Setting, bounds_deg: [f64; 2], scales: [f64; 3], optimised: bool) -> Self {
        let radii_px = bounds_deg.map(|e| setting.radius_px(e));
        Self { setting: *setting, bounds_deg, radii_px, scales, optimised }
    }

    fn optimised(params: &Params, setting: &Setting) -> Self {
        let shown_deg = libm::atan(2.0 / setting.focal_px()) * (180.0 / PI);
        let scale =
            |e: f64| ((params.m * e + params.omega0_deg) / shown_deg).clamp(1.0, MOST_SCALE);
        let last =
            (setting.eccentricity_deg(setting.corner_px()) / GRID_DEG).ceil().clamp(2.0, LAST_STEP);
        let steps = 1..=(last as u32);
        let at = |step: u32| f64::from(step) * GRID_DEG;
        // The cost of a layer depends only on its own bound and the one inside it.
        let squares: Vec<f64> =
            steps.clone().map(|i| square(setting, setting.radius_px(at(i)))).collect();
        let mut best = (f64::INFINITY, [at(1), at(2)]);
        for i in steps.clone() {
            for j in i + 1..=*steps.end() {
                let (s2, s3) = (scale(at(i)), scale(at(j)));
                let samples = squares[i as usize - 1]
                    + squares[j as usize - 1] / (s2 * s2)
                    + setting.pixels() / (s3 * s3);
                if samples < best.0 {
                    best = (samples, [at(i), at(j)]);
                }
            }
        }
        let bounds_deg = best.1;
        Self::with(setting, bounds_deg, [1.0, scale(bounds_deg[0]), scale(bounds_deg[1])], true)
    }

    /// Parameters that describe these layers with `fixed`.
    pub fn fixed(&self, params: &Params) -> Params {
        Params {
            bounds_deg: self.bounds_deg.to_vec(),
            scales: self.scales.to_vec(),
            fit: Fit::Fixed,
            ..params.clone()
        }
    }

    /// Radii of the inner layers in degrees.
    pub fn bounds_deg(&self) -> [f64; 2] {
        self.bounds_deg
    }

    /// Pixels per sample along an axis, of each layer.
    pub fn scales(&self) -> [f64; 3] {
        self.scales
    }

    /// The number of samples with discs instead of squares and with the fovea repeated, which is
    /// RMFR's other count.
    pub fn samples_in_discs(&self) -> f64 {
        let disc = |r: f64| self.setting.integrate(&[0.0, r], |at| f64::from(at <= r));
        disc(self.radii_px[0]) / (self.scales[0] * self.scales[0])
            + disc(self.radii_px[1]) / (self.scales[1] * self.scales[1])
            + self.setting.pixels() / (self.scales[2] * self.scales[2])
    }

    /// The extent of a layer's box on each side of the gaze, clipped to the frame: negative and
    /// positive side.
    fn sides_px(&self, layer: usize, axis: usize) -> [f64; 2] {
        let radius = self.radii_px.get(layer).copied().unwrap_or(f64::INFINITY);
        [-1.0, 1.0].map(|sign| self.setting.side_px(axis, sign).min(radius))
    }
}

/// The number of pixels in a square around the gaze, given by half its side and clipped to the
/// frame.
fn square(setting: &Setting, half_px: f64) -> f64 {
    let extent = |axis: usize| {
        setting.side_px(axis, -1.0).min(half_px) + setting.side_px(axis, 1.0).min(half_px)
    };
    extent(0) * extent(1)
}

impl Mapping for Guenter {
    fn layers(&self) -> usize {
        3
    }

    fn layer_at(&self, place: Place) -> usize {
        self.radii_px.iter().position(|r| up_to(place.radius_px, *r)).unwrap_or(2)
    }

    fn buffer(&self, layer: usize) -> [f64; 2] {
        [0, 1].map(|axis| {
            let [before, behind] = self.sides_px(layer, axis);
            (before + behind) / self.scales[layer]
        })
    }

    fn to_buffer(&self, layer: usize, place: Place) -> [f64; 2] {
        let offset = place.offset_px();
        [0, 1].map(|i| (offset[i] + self.sides_px(layer, i)[0]) / self.scales[layer])
    }

    fn to_screen(&self, layer: usize, buffer: [f64; 2]) -> Place {
        Place::at([0, 1].map(|i| buffer[i] * self.scales[layer] - self.sides_px(layer, i)[0]))
    }

    fn is_polar(&self) -> bool {
        false
    }
}

impl Foveation for Guenter {
    fn rates(&self, place: Place) -> Option<Rates> {
        Some(Rates::both(1.0 / self.scales[self.layer_at(place)]))
    }

    fn counts(&self) -> Counts {
        let buffers: Vec<[f64; 2]> = (0..3).map(|layer| self.buffer(layer)).collect();
        let samples = buffers.iter().map(|[w, h]| w * h).sum();
        let density = |r| self.density(Place { radius_px: r, direction: [1.0, 0.0] });
        let breaks = [0.0, self.radii_px[0], self.radii_px[1]];
        let samples_seen = self.setting.integrate(&breaks, density);
        Counts { buffers, samples, samples_on_screen: samples, samples_beyond: 0.0, samples_seen }
    }

    fn mapping(&self) -> Option<&dyn Mapping> {
        Some(self)
    }

    fn note(&self) -> Option<String> {
        self.optimised.then(|| {
            let ([e1, e2], [_, s2, s3]) = (self.bounds_deg, self.scales);
            let [width, height] = self.setting.size_px();
            format!(
                "Guenter's layers, optimised for {width}x{height}: {e1}° and {e2}°, scales 1, \
                 {s2:.4}, {s3:.4}"
            )
        })
    }
}

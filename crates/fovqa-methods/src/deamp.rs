//! DEAMP: dominant-eye-aware foveated rendering with nested rectangular mappings (Wang, Gu, Lu
//! 2024).
//!
//! The layers have half-angles e_1 < … < e_n. Each is an RMFR (Eq. 3-4) with its own σ_k; the last
//! one is always the whole frame. Half-sizes are tan e_k / tan e_n · W/2 and H/2 (`tan`, as in the
//! text and the published code) or e_k / e_n · W/2 (`linear`, the reading that gives the paper's
//! "75 %"). Counts (Eq. 5-9): l_k = 2 r_k (f + W/2) / (σ_k (r_k + f)), V_k = l_xk l_yk -
//! (σ_(k-1)/σ_k)² l_x(k-1) l_y(k-1), and the total is Σ V_k. Layers are centred on the gaze and
//! clipped to the frame. With the gaze off centre, A is defined per side as in RMFR, and counts are
//! the integral of the density. Angles are those of the paper's 90° frame; in another frame they
//! are scaled with it, which [`Foveation::note`] reports. The σ of the dominant eye's middle layer
//! is not printed; the other eye has its own values. Variants: 2L (one layer), 4L (22.5°, 45°), 6L
//! (the default).

use std::f64::consts::PI;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::error::MethodError;
use crate::foveation::{Counts, Foveation, Mapping, Rates, Reach};
use crate::info::MethodInfo;
use crate::rmfr::AxisMapping;
use crate::setting::{Place, Setting, up_to};

/// How the angles of layers are converted to sizes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Projection {
    /// Sizes are proportional to the tangents.
    #[default]
    Tan,
    /// Sizes are proportional to the angles.
    Linear,
}

/// Parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// σ of each layer, the innermost first. Default 2.51, 3.6, 4.8 (those of the dominant eye).
    pub sigmas: Vec<f64>,
    /// Half-angles of the layers in degrees. Default 10, 22.5, 45.
    pub bounds_deg: Vec<f64>,
    /// f along x as a share of the width. Default 0.38.
    pub fx: f64,
    /// f along y as a share of the height. Default 0.38.
    pub fy: f64,
    /// How angles are converted to sizes.
    pub projection: Projection,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            sigmas: vec![2.51, 3.6, 4.8],
            bounds_deg: vec![10.0, 22.5, 45.0],
            fx: 0.38,
            fy: 0.38,
            projection: Projection::Tan,
        }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "sigmas" => self.sigmas = value.list()?,
            "bounds_deg" => self.bounds_deg = value.list()?,
            "fx" => self.fx = value.number()?,
            "fy" => self.fy = value.number()?,
            "projection" => {
                self.projection = match value.text()? {
                    "tan" => Projection::Tan,
                    "linear" => Projection::Linear,
                    _ => return None,
                }
            }
            _ => return None,
        }
        Some(())
    }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "deamp",
    label: "DEAMP",
    about: "nested rectangular mappings, coarser towards the periphery",
    source: "Wang, Gu, Lu 2024, Eq. 3-9",
    params: &[
        ParamInfo {
            name: "sigmas",
            default: "[2.51, 3.6, 4.8]",
            values: ParamValues::Numbers,
            about: "σ of each layer from the gaze outwards, 0.1 to 1000 (the dominant eye's; the paper does not print the middle one)",
        },
        ParamInfo {
            name: "bounds_deg",
            default: "[10, 22.5, 45]",
            values: ParamValues::Numbers,
            about: "half-angles of the layers, °, increasing; the last is the whole frame",
        },
        ParamInfo {
            name: "fx",
            default: "0.38",
            values: ParamValues::Number(1e-3, 1000.0),
            about: "f along x, as a share of the width",
        },
        ParamInfo {
            name: "fy",
            default: "0.38",
            values: ParamValues::Number(1e-3, 1000.0),
            about: "f along y, as a share of the height",
        },
        ParamInfo {
            name: "projection",
            default: "\"tan\"",
            values: ParamValues::Word(&["tan", "linear"]),
            about: "how the angles of layers are converted to sizes",
        },
    ],
};

#[derive(Debug, Clone, Copy)]
struct Layer {
    sigma: f64,
    /// Half width and height in pixels.
    half_px: [f64; 2],
}

/// DEAMP, applied to a frame.
#[derive(Debug, Clone)]
pub struct Deamp {
    setting: Setting,
    axes: [AxisMapping; 2],
    layers: Vec<Layer>,
    bounds_deg: Vec<f64>,
    projection: Projection,
}

impl Deamp {
    /// Applies the method to a frame and a gaze.
    ///
    /// # Errors
    /// When there is not one σ for each bound, or the bounds do not rise inside (0°, 90°).
    pub fn new(params: &Params, setting: &Setting) -> Result<Self, MethodError> {
        let refused = |message: String| Err(MethodError::Params { method: INFO.key, message });
        let Params { sigmas, bounds_deg, .. } = params;
        if sigmas.is_empty() || sigmas.len() != bounds_deg.len() {
            return refused(format!(
                "sigmas has {} values, but bounds_deg has {}: give one of each per layer",
                sigmas.len(),
                bounds_deg.len()
            ));
        }
        if let Some(sigma) = sigmas.iter().find(|s| !(0.1..=1000.0).contains(*s)) {
            return refused(format!("a sigma of {sigma} is not between 0.1 and 1000"));
        }
        let rising = bounds_deg.windows(2).all(|pair| pair[0] < pair[1]);
        if !rising || !bounds_deg.iter().all(|e| *e > 0.0 && *e < 90.0) {
            return refused(format!(
                "bounds_deg {bounds_deg:?} must increase between 0° and 90°, both excluded"
            ));
        }
        let axes =
            [AxisMapping::new(setting, 0, params.fx), AxisMapping::new(setting, 1, params.fy)];
        let mut deamp = Self {
            setting: *setting,
            axes,
            layers: Vec::new(),
            bounds_deg: bounds_deg.clone(),
            projection: params.projection,
        };
        deamp.layers = bounds_deg
            .iter()
            .zip(sigmas)
            .map(|(&e, &sigma)| Layer { sigma, half_px: deamp.half_px(e) })
            .collect();
        Ok(deamp)
    }

    /// Half width and half height, in pixels, of the box with this half-angle in degrees.
    fn half_px(&self, half_angle_deg: f64) -> [f64; 2] {
        let whole = self.bounds_deg[self.bounds_deg.len() - 1];
        let tan = |deg: f64| libm::tan(deg * (PI / 180.0));
        let share = match self.projection {
            Projection::Tan => tan(half_angle_deg) / tan(whole),
            Projection::Linear => half_angle_deg / whole,
        };
        self.setting.size_px().map(|side| side / 2.0 * share)
    }

    /// The part of a box around the gaze that a layer fills: up to its border, or to that of the
    /// frame for the last layer.
    fn clipped(&self, layer: usize, half_px: [f64; 2]) -> [f64; 2] {
        let whole = layer + 1 == self.layers.len();
        let limit = if whole { [f64::INFINITY; 2] } else { self.layers[layer].half_px };
        [0, 1].map(|i| half_px[i].min(limit[i]))
    }

    /// Width and height, in samples of a layer, of a box around the gaze that is clipped to the
    /// frame.
    fn extent(&self, layer: usize, half_px: [f64; 2]) -> [f64; 2] {
        let sigma = self.layers[layer].sigma;
        [0, 1].map(|i| {
            let to =
                |sign: f64| self.axes[i].forward(sign * half_px[i].min(self.axes[i].side_px(sign)));
            (to(1.0) - to(-1.0)) / sigma
        })
    }

    /// The number of samples within a box around the gaze, given by its half-sizes. Samples that a
    /// finer layer covers are left out.
    fn within(&self, half_px: [f64; 2]) -> f64 {
        let area = |layer: usize, half: [f64; 2]| {
            let [x, y] = self.extent(layer, half);
            x * y
        };
        (0..self.layers.len())
            .map(|k| {
                let outer = area(k, self.clipped(k, half_px));
                let inner = k.checked_sub(1).map_or(0.0, |finer| {
                    area(k, [0, 1].map(|i| half_px[i].min(self.layers[finer].half_px[i])))
                });
                outer - inner
            })
            .sum()
    }

    /// The share of the frame's pixels that is shaded within a half-angle in degrees, up to the
    /// last bound (Fig. 5b).
    pub fn share_within(&self, half_angle_deg: f64) -> f64 {
        self.within(self.half_px(half_angle_deg)) / self.setting.pixels()
    }

    /// The largest half-angle of the method's own scale in degrees, which is the last bound.
    pub fn whole_deg(&self) -> f64 {
        self.bounds_deg[self.bounds_deg.len() - 1]
    }

    /// The share of the frame's area that belongs to the outermost layer, for a gaze in the centre.
    pub fn outer_share(&self) -> f64 {
        let inner = self.layers.len().checked_sub(2).map(|k| self.layers[k].half_px);
        1.0 - inner.map_or(0.0, |[x, y]| 4.0 * x * y / self.setting.pixels())
    }

    fn slopes(&self, place: Place) -> [f64; 2] {
        let (offset, sigma) = (place.offset_px(), self.layers[self.layer_at(place)].sigma);
        [0, 1].map(|i| self.axes[i].slope(offset[i], place.direction[i]) / sigma)
    }

    /// The start of a layer's buffer, in the units of the axis mapping.
    fn origin(&self, layer: usize) -> [f64; 2] {
        let half = self.clipped(layer, [f64::INFINITY; 2]);
        [0, 1].map(|i| self.axes[i].forward(-half[i].min(self.axes[i].side_px(-1.0))))
    }
}

impl Mapping for Deamp {
    fn layers(&self) -> usize {
        self.layers.len()
    }

    fn layer_at(&self, place: Place) -> usize {
        let [x, y] = place.offset_px().map(f64::abs);
        let inside = |layer: &Layer| up_to(x, layer.half_px[0]) && up_to(y, layer.half_px[1]);
        self.layers.iter().position(inside).unwrap_or(self.layers.len() - 1)
    }

    fn buffer(&self, layer: usize) -> [f64; 2] {
        self.extent(layer, self.clipped(layer, [f64::INFINITY; 2]))
    }

    fn to_buffer(&self, layer: usize, place: Place) -> [f64; 2] {
        let (offset, origin) = (place.offset_px(), self.origin(layer));
        let sigma = self.layers[layer].sigma;
        [0, 1].map(|i| (self.axes[i].forward(offset[i]) - origin[i]) / sigma)
    }

    fn to_screen(&self, layer: usize, buffer: [f64; 2]) -> Place {
        let (origin, sigma) = (self.origin(layer), self.layers[layer].sigma);
        Place::at([0, 1].map(|i| self.axes[i].inverse(sigma * buffer[i] + origin[i])))
    }

    fn is_polar(&self) -> bool {
        false
    }
}

impl Foveation for Deamp {
    fn rates(&self, place: Place) -> Option<Rates> {
        Some(Rates::separable(self.slopes(place), place.direction))
    }

    fn density(&self, place: Place) -> f64 {
        let [x, y] = self.slopes(place);
        x * y
    }

    fn counts(&self) -> Counts {
        let samples = self.within([f64::INFINITY; 2]);
        Counts {
            buffers: (0..self.layers.len()).map(|k| self.buffer(k)).collect(),
            samples,
            samples_on_screen: samples,
            samples_beyond: 0.0,
            samples_seen: samples,
        }
    }

    fn reach(&self) -> Reach {
        Reach::Border
    }

    fn mapping(&self) -> Option<&dyn Mapping> {
        Some(self)
    }

    fn note(&self) -> Option<String> {
        let deg = |px: f64| self.setting.eccentricity_deg(px);
        let true_deg: Vec<[f64; 2]> =
            self.layers.iter().map(|layer| layer.half_px.map(deg)).collect();
        let differs = |(found, &said): (&[f64; 2], &f64)| {
            found.iter().any(|found| (found - said).abs() > 0.005)
        };
        true_deg.iter().zip(&self.bounds_deg).any(differs).then(|| {
            let layers: Vec<String> = true_deg
                .iter()
                .zip(&self.bounds_deg)
                .map(|([x, y], said)| format!("{said}° is {x:.2}° x {y:.2}°"))
                .collect();
            let [width, height] = self.setting.size_px();
            format!(
                "the angles of DEAMP's layers scale with the frame; in {width}x{height} {} (half \
                 angles, gaze in the centre)",
                layers.join(", ")
            )
        })
    }
}

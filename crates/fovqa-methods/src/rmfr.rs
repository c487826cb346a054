//! Rectangular mapping-based foveated rendering (Ye et al. 2022).
//!
//! Mapping (Eq. 4-7, and Eq. 3-4 of DEAMP), per axis: with t = screen - gaze, A the distance from
//! the gaze to the border on that side, and f in pixels, u = (gaze + t (f + A) / (|t| + f)) / σ.
//! Inverse: q = σu - gaze, t = f q / (f + A - |q|). The density per axis is
//! f (f + A) / ((|t| + f)² σ), and the number of samples is W H / σ².
//!
//! Misprints: in Eq. 4, read the gaze for x in (1 - x/W) and x/W. Eq. 6, and Eq. 4 of DEAMP, give t,
//! the offset from the gaze; add the gaze to get the screen position.

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::foveation::{Counts, Foveation, Mapping, Rates, Reach};
use crate::info::MethodInfo;
use crate::setting::{Place, Setting};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// σ: the buffer's sides are the frame's divided by it. Default 2.6.
    pub sigma: f64,
    /// f along x as a share of the width. Default 0.38.
    pub fx: f64,
    /// f along y as a share of the height. Default 0.38.
    pub fy: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self { sigma: 2.6, fx: 0.38, fy: 0.38 }
    }
}

impl Params {
    pub(crate) fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "sigma" => self.sigma = value.number()?,
            "fx" => self.fx = value.number()?,
            "fy" => self.fy = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

pub(crate) const INFO: MethodInfo = MethodInfo {
    key: "rmfr",
    label: "RMFR",
    about: "rectangular mapping-based foveated rendering: each axis is compressed separately",
    source: "Ye et al. 2022, Eq. 4-7",
    params: &[
        ParamInfo {
            name: "sigma",
            default: "2.6",
            values: ParamValues::Number(0.1, 1000.0),
            about: "ratio of the frame's sides to the buffer's",
        },
        ParamInfo {
            name: "fx",
            default: "0.38",
            values: ParamValues::Number(1e-3, 1000.0),
            about: "f along x, as a share of the width; small: a sharper peak at the gaze",
        },
        ParamInfo {
            name: "fy",
            default: "0.38",
            values: ParamValues::Number(1e-3, 1000.0),
            about: "f along y, as a share of the height",
        },
    ],
};

/// RMFR, Fig. 3: the mapping of a half axis, d_i = f d / (f - |d|), for `d` in [-1, 1] and f > 1.
/// To compare shapes, divide by the value at 1, f / (f - 1).
pub fn half_axis(f: f64, d: f64) -> f64 {
    f * d / (f - d.abs())
}

/// The mapping of one axis, before it is scaled by 1/σ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AxisMapping {
    f_px: f64,
    /// A on the negative and the positive side.
    sides_px: [f64; 2],
}

impl AxisMapping {
    pub(crate) fn new(setting: &Setting, axis: usize, share: f64) -> Self {
        let sides_px = [setting.side_px(axis, -1.0), setting.side_px(axis, 1.0)];
        Self { f_px: share * setting.size_px()[axis], sides_px }
    }

    /// A on the side of `sign`; 0 counts as positive.
    pub(crate) fn side_px(&self, sign: f64) -> f64 {
        self.sides_px[usize::from(sign >= 0.0)]
    }

    /// t (f + A) / (|t| + f).
    pub(crate) fn forward(&self, t: f64) -> f64 {
        t * (self.f_px + self.side_px(t)) / (t.abs() + self.f_px)
    }

    /// f q / (f + A - |q|).
    pub(crate) fn inverse(&self, q: f64) -> f64 {
        self.f_px * q / (self.f_px + self.side_px(q) - q.abs())
    }

    /// f (f + A) / (|t| + f)². If t is 0, `sign` decides the side.
    pub(crate) fn slope(&self, t: f64, sign: f64) -> f64 {
        let a = self.side_px(if t == 0.0 { sign } else { t });
        let from = t.abs() + self.f_px;
        self.f_px * (self.f_px + a) / (from * from)
    }
}

/// Rectangular mapping-based foveated rendering, applied to a frame.
#[derive(Debug, Clone, Copy)]
pub struct Rmfr {
    setting: Setting,
    sigma: f64,
    axes: [AxisMapping; 2],
}

impl Rmfr {
    /// Applies the method to a frame and a gaze.
    pub fn new(params: &Params, setting: &Setting) -> Self {
        let axes =
            [AxisMapping::new(setting, 0, params.fx), AxisMapping::new(setting, 1, params.fy)];
        Self { setting: *setting, sigma: params.sigma, axes }
    }

    fn slopes(&self, place: Place) -> [f64; 2] {
        let offset = place.offset_px();
        [0, 1].map(|i| self.axes[i].slope(offset[i], place.direction[i]) / self.sigma)
    }
}

impl Mapping for Rmfr {
    fn buffer(&self, _layer: usize) -> [f64; 2] {
        self.setting.size_px().map(|side| side / self.sigma)
    }

    fn to_buffer(&self, _layer: usize, place: Place) -> [f64; 2] {
        let (offset, gaze) = (place.offset_px(), self.setting.gaze_px());
        [0, 1].map(|i| (gaze[i] + self.axes[i].forward(offset[i])) / self.sigma)
    }

    fn to_screen(&self, _layer: usize, buffer: [f64; 2]) -> Place {
        let gaze = self.setting.gaze_px();
        Place::at([0, 1].map(|i| self.axes[i].inverse(self.sigma * buffer[i] - gaze[i])))
    }

    fn is_polar(&self) -> bool {
        false
    }
}

impl Foveation for Rmfr {
    fn rates(&self, place: Place) -> Option<Rates> {
        Some(Rates::separable(self.slopes(place), place.direction))
    }

    fn density(&self, place: Place) -> f64 {
        let [x, y] = self.slopes(place);
        x * y
    }

    fn counts(&self) -> Counts {
        let [w, h] = self.buffer(0);
        Counts::of([w, h], w * h)
    }

    fn reach(&self) -> Reach {
        Reach::Border
    }

    fn mapping(&self) -> Option<&dyn Mapping> {
        Some(self)
    }
}

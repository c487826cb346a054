//! The parameters and the description of FovVideoVDP.

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use super::color_space::ColorSpace;
use super::heat_map::MAP;
use super::pyramid::SMALLEST_SIDE;
use crate::info::{MetricInfo, Needs};
use crate::kinds::{Better, LeadIn};
use crate::metric_params::MetricParams;
use crate::pooling::{Pooling, Statistic};

/// The statistics of a frame: its JOD, its Q, the Q of each spatial-frequency band (as level) and
/// channel, and the share of each eccentricity band in Q.
const STATISTICS: [Statistic; 6] = [
    Statistic::named("frame_jod"),
    Statistic::named("q").pointing(Better::Lower),
    Statistic::named("q_sustained").pointing(Better::Lower),
    Statistic::named("q_transient").pointing(Better::Lower),
    // A share of the Q of both eyes together, or of all frames together.
    Statistic::named("share")
        .over_bands(Pooling::Sum)
        .over_eyes(Pooling::WeightedMean)
        .over_frames(Pooling::WeightedMean)
        .pointing(Better::Neither),
    Statistic::named("share_outside_bands")
        .over_eyes(Pooling::WeightedMean)
        .over_frames(Pooling::WeightedMean)
        .of_bands()
        .without_row(),
];

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "fvvdp",
    label: "FovVideoVDP",
    unit: "JOD",
    per_band: true,
    needs: Needs {
        view: true,
        luminance: true,
        lead_in: LeadIn::Filters,
        every_pixel: true,
        ..Needs::NOTHING
    },
    statistics: &STATISTICS,
    map: Some(&MAP),
    about: "visible difference that depends on eccentricity and time: 10 means none, 1 less means that 75 % prefer the reference; per band, the band's share of the difference Q",
    source: "Mantiuk et al. 2021, version 1.2",
    params: &[
        ParamInfo {
            name: "foveated",
            default: "true",
            values: ParamValues::Flag,
            about: "true: sensitivity falls off from the gaze; false: every pixel is viewed directly",
        },
        ParamInfo {
            name: "temp_padding",
            default: "\"replicate\"",
            values: ParamValues::Word(&["replicate", "circular", "pingpong"]),
            about: "what precedes the first frame of a sequence",
        },
        ParamInfo {
            name: "cd_m2_per_unit",
            default: "\"auto\"",
            values: ParamValues::NumberOr(1e-9, 1e9, "auto"),
            about: "cd/m² of a linear sample of 1 (also for PU-PSNR); auto is 1 on linear and PQ displays, and the tone-mapped signal on others",
        },
        ParamInfo {
            name: "color_space",
            default: "\"srgb\"",
            values: ParamValues::Word(&ColorSpace::NAMES),
            about: "primaries of the files (also for PU-PSNR)",
        },
        ParamInfo {
            name: "exact_edges",
            default: "false",
            values: ParamValues::Flag,
            about: "weight the right edge of coarser levels by the parity of their columns; FovVideoVDP uses their rows",
        },
        ParamInfo {
            name: "map_context",
            default: "\"test\"",
            values: ParamValues::Word(&["test", "reference"]),
            about: "the picture under the coloured heat maps",
        },
    ],
    ..MetricInfo::FIDELITY
};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// Whether sensitivity falls with eccentricity. If not, vision is foveal at every pixel.
    pub foveated: bool,
    /// The frames that are assumed before the first frame.
    pub temp_padding: Padding,
    /// Luminance in cd/m² of a linear sample of 1. `None` means 1 on displays whose input is
    /// luminance, while other displays show the result of exposure, tone map and encoding.
    pub cd_m2_per_unit: Option<f64>,
    /// The colour space of the files.
    pub color_space: ColorSpace,
    /// Whether the right edge of coarser levels has correct weights, unlike in FovVideoVDP.
    pub exact_edges: bool,
    /// The picture below heat maps.
    pub map_context: MapContext,
}

/// The frames that are assumed before the first frame of a sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Padding {
    /// The first frame, repeated.
    #[default]
    Replicate,
    /// The sequence itself, as in a loop.
    Circular,
    /// The sequence in reverse order.
    Pingpong,
}

/// The picture below a heat map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MapContext {
    /// The test.
    #[default]
    Test,
    /// The reference.
    Reference,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            foveated: true,
            temp_padding: Padding::default(),
            cd_m2_per_unit: None,
            color_space: ColorSpace::default(),
            exact_edges: false,
            map_context: MapContext::default(),
        }
    }
}

impl MetricParams for Params {
    fn smallest_side(&self, _ssim_window: usize) -> usize {
        SMALLEST_SIDE
    }

    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "foveated" => self.foveated = value.flag()?,
            "temp_padding" => {
                self.temp_padding = match value.text()? {
                    "replicate" => Padding::Replicate,
                    "circular" => Padding::Circular,
                    "pingpong" => Padding::Pingpong,
                    _ => return None,
                }
            }
            "cd_m2_per_unit" => self.cd_m2_per_unit = value.number(),
            "color_space" => self.color_space = ColorSpace::find(value.text()?)?,
            "exact_edges" => self.exact_edges = value.flag()?,
            "map_context" => {
                self.map_context = match value.text()? {
                    "test" => MapContext::Test,
                    "reference" => MapContext::Reference,
                    _ => return None,
                }
            }
            _ => return None,
        }
        Some(())
    }
}

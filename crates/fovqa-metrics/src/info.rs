//! The description that each metric has in its own file: names, direction, needs, statistics, parameters.

use fovqa_params::ParamInfo;

use crate::kinds::{Better, LeadIn, MetricKind};
use crate::map::MapInfo;
use crate::metric::Metric;
use crate::pooling::Statistic;
use crate::row::Rows;

/// The description of a metric.
#[derive(Debug, Clone, Copy)]
pub struct MetricInfo {
    /// The name in results and on the command line, where `-` may replace `_`.
    pub key: &'static str,
    /// The name in tables.
    pub label: &'static str,
    /// Its name in sentences; empty where the label is one.
    pub long_name: &'static str,
    /// Version of the metric's values. It changes with every change of the values.
    pub version: u32,
    /// The unit; empty for a number without unit.
    pub unit: &'static str,
    /// The kind of metric.
    pub kind: MetricKind,
    /// The direction in which values are better.
    pub better: Better,
    /// Whether it has a value for each eccentricity band.
    pub per_band: bool,
    /// The inputs that it needs besides the frames.
    pub needs: Needs,
    /// Its statistics, with the way in which each is pooled.
    pub statistics: &'static [Statistic],
    /// Computes values of the pair that follow from the values of both pictures, of a frame or of means.
    pub derive: Option<fn(&Rows) -> Rows>,
    /// The map of a pair, if the metric has one.
    pub map: Option<&'static MapInfo>,
    /// Other maps that are made with it.
    pub more_maps: &'static [&'static MapInfo],
    /// A description in one line.
    pub about: &'static str,
    /// The publication that defines it.
    pub source: &'static str,
    /// The parameters it accepts.
    pub params: &'static [ParamInfo],
}

impl MetricInfo {
    /// Defaults for the description of a fidelity metric.
    pub(crate) const FIDELITY: Self = Self {
        key: "",
        label: "",
        long_name: "",
        version: 1,
        unit: "",
        kind: MetricKind::Fidelity,
        better: Better::Higher,
        per_band: false,
        needs: Needs::NOTHING,
        statistics: &[Statistic::VALUE],
        derive: None,
        map: None,
        more_maps: &[],
        about: "",
        source: "",
        params: &[],
    };

    /// All of its maps.
    pub fn maps(&self) -> impl Iterator<Item = &'static MapInfo> {
        self.map.into_iter().chain(self.more_maps.iter().copied())
    }

    /// Defaults for the description of a profile. Profiles describe bands and therefore need a
    /// view.
    pub(crate) const PROFILE: Self = Self {
        kind: MetricKind::Profile,
        better: Better::Neither,
        per_band: true,
        needs: Needs { view: true, ..Needs::NOTHING },
        ..Self::FIDELITY
    };

    /// Defaults for the description of a temporal metric.
    pub(crate) const TEMPORAL: Self = Self {
        kind: MetricKind::Temporal,
        better: Better::Lower,
        per_band: true,
        needs: Needs { guides: true, lead_in: LeadIn::Frames, ..Needs::NOTHING },
        ..Self::FIDELITY
    };
}

/// The inputs that a metric needs besides the two frames of a pair.
#[derive(Debug, Clone, Copy)]
#[allow(clippy::struct_excessive_bools, reason = "each is a need of its own")]
pub struct Needs {
    /// A view, even if there are no bands.
    pub view: bool,
    /// Luminance, which requires the display's photometry.
    pub luminance: bool,
    /// The foveal weight of every pixel.
    pub foveal_weight: Demand,
    /// Motion vectors and depth, if the renderer has written them.
    pub guides: bool,
    /// Frames before the present one.
    pub lead_in: LeadIn,
    /// Every pixel: the metric is not defined where pixels are left out.
    pub every_pixel: bool,
}

/// How much a metric needs an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Demand {
    /// Not at all.
    None,
    /// It has further values where the input is there.
    Takes,
    /// It has no value without the input.
    Needs,
}

impl Needs {
    /// Nothing but the frames.
    pub const NOTHING: Self = Self {
        view: false,
        luminance: false,
        foveal_weight: Demand::None,
        guides: false,
        lead_in: LeadIn::None,
        every_pixel: false,
    };

    /// The inputs that at least one of these metrics needs.
    pub fn of(metrics: &[Metric]) -> Self {
        let needs = || metrics.iter().map(|metric| metric.info().needs);
        Self {
            view: needs().any(|needs| needs.view),
            luminance: needs().any(|needs| needs.luminance),
            foveal_weight: needs().map(|needs| needs.foveal_weight).max().unwrap_or(Demand::None),
            guides: needs().any(|needs| needs.guides),
            lead_in: needs().map(|needs| needs.lead_in).max().unwrap_or(LeadIn::None),
            every_pixel: needs().any(|needs| needs.every_pixel),
        }
    }
}

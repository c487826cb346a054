//! The description that each metric has in its own file: names, direction, needs, statistics, parameters.

use fovqa_params::ParamInfo;

use crate::kinds::{Better, LeadIn, MetricKind};
use crate::map::MapInfo;
use crate::metric::Metric;
use crate::pooling::Statistic;

/// The description of a metric.
#[derive(Debug, Clone, Copy)]
pub struct MetricInfo {
    /// Its name in results and, with `-` for `_` if one likes, on the command line.
    pub key: &'static str,
    /// Its name in tables.
    pub label: &'static str,
    /// Version of its values: another one for whatever changes them.
    pub version: u32,
    /// Its unit; empty for a plain number.
    pub unit: &'static str,
    /// What it is of.
    pub kind: MetricKind,
    /// Its direction.
    pub better: Better,
    /// Whether it has a value per eccentricity band.
    pub per_band: bool,
    /// What it needs beside the frames.
    pub needs: Needs,
    /// Its statistics, and how each is pooled.
    pub statistics: &'static [Statistic],
    /// The map it has of a pair.
    pub map: Option<&'static MapInfo>,
    /// One line on what it is.
    pub about: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Its parameters.
    pub params: &'static [ParamInfo],
}

impl MetricInfo {
    /// What most metrics of fidelity say, for theirs to begin with.
    pub(crate) const FIDELITY: Self = Self {
        key: "",
        label: "",
        version: 1,
        unit: "",
        kind: MetricKind::Fidelity,
        better: Better::Higher,
        per_band: false,
        needs: Needs::NOTHING,
        statistics: &[Statistic::VALUE],
        map: None,
        about: "",
        source: "",
        params: &[],
    };

    /// What profiles say: they are of bands, and so need a view.
    pub(crate) const PROFILE: Self = Self {
        kind: MetricKind::Profile,
        better: Better::Neither,
        per_band: true,
        needs: Needs { view: true, ..Needs::NOTHING },
        ..Self::FIDELITY
    };
}

/// What a metric needs beside the two frames of a pair.
#[derive(Debug, Clone, Copy)]
#[allow(clippy::struct_excessive_bools, reason = "each is a need of its own")]
pub struct Needs {
    /// A view, even without bands.
    pub view: bool,
    /// Luminance: the display's photometry.
    pub luminance: bool,
    /// The foveal weight of every pixel.
    pub foveal_weight: bool,
    /// Motion vectors and depth, where the renderer has left some.
    pub guides: bool,
    /// Frames before the present one.
    pub lead_in: LeadIn,
    /// Every pixel: it is not defined where some are left out.
    pub every_pixel: bool,
}

impl Needs {
    /// Nothing but the frames.
    pub const NOTHING: Self = Self {
        view: false,
        luminance: false,
        foveal_weight: false,
        guides: false,
        lead_in: LeadIn::None,
        every_pixel: false,
    };

    /// What at least one of some metrics needs.
    pub fn of(metrics: &[Metric]) -> Self {
        let needs = || metrics.iter().map(|metric| metric.info().needs);
        Self {
            view: needs().any(|needs| needs.view),
            luminance: needs().any(|needs| needs.luminance),
            foveal_weight: needs().any(|needs| needs.foveal_weight),
            guides: needs().any(|needs| needs.guides),
            lead_in: needs().map(|needs| needs.lead_in).max().unwrap_or(LeadIn::None),
            every_pixel: needs().any(|needs| needs.every_pixel),
        }
    }
}

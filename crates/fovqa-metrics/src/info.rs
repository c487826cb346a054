//! The description that each metric has in its own file: names, direction, needs, statistics, parameters.

use fovqa_params::{ParamError, ParamInfo, ParamValue};

use crate::map::MapInfo;
use crate::pair_pass::PairPass;
use crate::pooling::Statistic;
use crate::registry::{Metric, Params};

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
    /// How a pair is measured, where the metric has a pass of its own.
    pub pass: Option<PairPass>,
    /// The map it has of a pair.
    pub map: Option<&'static MapInfo>,
    /// The smallest side that a frame may have, pixels.
    pub smallest_side: fn(&Params) -> usize,
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
        pass: None,
        map: None,
        smallest_side: |_| 1,
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

/// What a metric is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MetricKind {
    /// A test against its reference: one number.
    Fidelity,
    /// One picture by eccentricity: of reference and test alike, and their ratio.
    Profile,
    /// One sequence over time: of reference and test alike, and their ratio.
    Temporal,
}

/// Which way a metric points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// Larger is better.
    Higher,
    /// Smaller is better.
    Lower,
    /// Neither: it is held against the reference's.
    Neither,
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
    /// Bands of blocks of 2x2 pixels and, level by level, of 2x2 of those: so many levels; 0: none.
    pub block_levels: fn(&Params) -> usize,
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
        block_levels: |_| 0,
        every_pixel: false,
    };

    /// What any of some metrics needs; the blocks of each are its own.
    pub fn of(metrics: &[Metric]) -> Self {
        let needs = || metrics.iter().map(|metric| metric.info().needs);
        Self {
            view: needs().any(|needs| needs.view),
            luminance: needs().any(|needs| needs.luminance),
            foveal_weight: needs().any(|needs| needs.foveal_weight),
            guides: needs().any(|needs| needs.guides),
            lead_in: needs().map(|needs| needs.lead_in).max().unwrap_or(LeadIn::None),
            block_levels: Self::NOTHING.block_levels,
            every_pixel: needs().any(|needs| needs.every_pixel),
        }
    }
}

/// How many frames of its sequence a metric has to have seen before the one it measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LeadIn {
    /// None: each frame stands by itself.
    None,
    /// The one before.
    Frame,
    /// As many as its filters reach over.
    Filters,
}

/// The parameters of a metric: defaults, and how they are set by name.
pub(crate) trait MetricParams: Default + Clone + PartialEq {
    /// Sets what the metric's table of parameters has found to be one of its values; `None` where it
    /// cannot be.
    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()>;

    /// Checks what only all of them together can tell.
    fn check(&self) -> Result<(), ParamError> {
        Ok(())
    }
}

/// The parameters of a metric that has none of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoParams;

impl MetricParams for NoParams {
    fn set(&mut self, _: &str, _: &ParamValue) -> Option<()> {
        None
    }
}

//! What a metric says about itself, in its own file: names, direction, what it needs, parameters.

use fovqa_params::{ParamError, ParamInfo, ParamValue};

use crate::map::MapInfo;
use crate::pooling::Statistic;
use crate::registry::{Metric, Params};

/// What there is to say about a metric.
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

    /// What either of two metrics needs.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            view: self.view || other.view,
            luminance: self.luminance || other.luminance,
            foveal_weight: self.foveal_weight || other.foveal_weight,
            guides: self.guides || other.guides,
            lead_in: self.lead_in.max(other.lead_in),
            every_pixel: self.every_pixel || other.every_pixel,
        }
    }

    /// What any of some metrics needs.
    pub fn of(metrics: &[Metric]) -> Self {
        metrics.iter().map(|metric| metric.info().needs).fold(Self::NOTHING, Self::and)
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

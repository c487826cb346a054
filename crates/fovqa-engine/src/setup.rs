//! What the size of the first frame settles for all: metrics that fit, view, bands, weights, mask.

use std::borrow::Cow;

use fovqa_config::{Gaze, MetricChoice, Plan, Settings};
use fovqa_frame::Mask;
use fovqa_metrics::{Metric, Regions, Scorer};
use fovqa_results::ViewResult;
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, GazeAt, View, ViewSpec};

use crate::events::Warnings;
use crate::load::Fault;
use crate::retina::{Retina, RetinaMaker};

/// Settled once, used for every frame.
pub(crate) struct Setup<'a> {
    pub(crate) size: (usize, usize),
    /// The file whose size it is.
    pub(crate) first_file: String,
    pub(crate) scorer: Scorer,
    pub(crate) view: Option<ViewResult>,
    mask: Option<Mask>,
    maker: Option<RetinaMaker<'a>>,
    retina: Option<Retina>,
    no_bands: BandMap,
    /// What the mask leaves of the present gaze's bands.
    masked: Option<Regions<'static>>,
}

/// What a setup is made from.
pub(crate) struct Inputs<'a, 'b> {
    pub(crate) plan: &'a Plan,
    pub(crate) settings: &'a Settings,
    /// Bands of the whole scene, where both eyes' views decide them.
    pub(crate) scene_bands: Option<&'a BandEdges>,
    pub(crate) metrics: &'b [Metric],
    pub(crate) mask: Option<&'b Mask>,
    pub(crate) trace: Option<&'a [GazeAt]>,
    pub(crate) frames: usize,
    /// Size of the files, before any crop.
    pub(crate) file_size: (usize, usize),
}

impl<'a> Setup<'a> {
    pub(crate) fn new(
        inputs: &Inputs<'a, '_>,
        size: (usize, usize),
        first_file: String,
        warnings: &mut Warnings<'_>,
    ) -> Result<Self, Fault> {
        let plan = inputs.plan;
        let mask = inputs.mask.map(|mask| fit_mask(inputs, mask, size)).transpose()?;
        let mut metrics = inputs.metrics.to_vec();
        if plan.metrics == MetricChoice::Default {
            let scorer = Scorer::new(metrics.clone(), plan.params.clone());
            for (metric, error) in scorer.unfit(size.0, size.1) {
                let message = format!("{} is left out: {error}", metric.info().label);
                warnings.once_a_view(metric.key(), &message);
                metrics.retain(|m| *m != metric);
            }
        }
        let foveal = metrics.iter().any(|m| m.info().needs_view);
        let mut scorer = Scorer::new(metrics, plan.params.clone());
        if plan.metrics == MetricChoice::Default {
            scorer = scorer.lenient();
        }
        let mut setup = Self {
            size,
            first_file,
            scorer,
            view: None,
            mask,
            maker: None,
            retina: None,
            no_bands: BandMap::without_bands(size.0, size.1),
            masked: None,
        };
        if let Some(spec) = &inputs.settings.view {
            setup.look(inputs, spec, foveal, warnings)?;
        }
        Ok(setup)
    }

    /// Settles view, bands and weights.
    fn look(
        &mut self,
        inputs: &Inputs<'a, '_>,
        spec: &ViewSpec,
        foveal: bool,
        warnings: &mut Warnings<'_>,
    ) -> Result<(), Fault> {
        let (w, h) = self.size;
        let resolved = spec.resolve(w, h).map_err(|error| Fault {
            message: error.to_string(),
            help: "give a view that fits frames of this size".to_owned(),
        })?;
        if let Some([dw, dh]) = resolved.stretched_from {
            let message = format!(
                "frames of {w}x{h} are stretched over the display's {dw}x{dh}: they fill its whole field"
            );
            warnings.once_a_view("stretched", &message);
        }
        let (view, kind) = (resolved.view, inputs.settings.eccentricity);
        let gaze_px = first_gaze(inputs.settings, inputs.trace, &view);
        let bands = inputs.scene_bands.or(inputs.settings.bands.as_ref());
        let edges = bands.cloned().unwrap_or_else(|| {
            BandEdges::default_up_to(farthest_deg(inputs.settings, inputs.trace, &view))
        });
        self.view = Some(ViewResult {
            size: [w, h],
            focal_px: view.focal_px,
            gaze_px,
            eccentricity: match kind {
                EccentricityKind::Angular => "angular",
                EccentricityKind::Planar => "planar",
            },
            bands_deg: edges.iter().collect(),
        });
        let maker = RetinaMaker {
            view,
            kind,
            edges,
            params: &inputs.plan.params,
            foveal,
            keep: inputs.frames > 1 && inputs.trace.is_none(),
        };
        let retina = maker.at(gaze_px, None);
        if retina.weight.as_ref().is_some_and(fovqa_metrics::WeightField::is_flat) {
            let message = format!(
                "the view shows {:.2} cycles per degree at most, less than the eye sees anywhere in the \
                 frame: the foveal weight is flat, and foveal metrics equal their plain forms",
                view.nyquist_cpd()
            );
            warnings.once_a_view("flat weight", &message);
        }
        (self.maker, self.retina) = (Some(maker), Some(retina));
        Ok(())
    }

    /// Moves the gaze, where there is a view.
    pub(crate) fn look_at(&mut self, gaze_px: [f64; 2]) {
        if let Some(maker) = &self.maker {
            if !self.retina.as_ref().is_some_and(|retina| retina.is_at(gaze_px)) {
                self.masked = None;
            }
            self.retina = Some(maker.at(gaze_px, self.retina.take()));
        }
    }

    /// Makes ready what the mask alone decides, if it has not been since the gaze moved.
    pub(crate) fn apply_mask(&mut self) {
        if let (Some(mask), None) = (&self.mask, &self.masked) {
            let regions = Regions::masked(self.bands(), mask, self.scorer.window_radius());
            self.masked = Some(regions);
        }
    }

    /// The regions of a frame: bands, less what the mask and the frame's own bad pixels leave out.
    pub(crate) fn regions(&self, finite: Option<&Mask>) -> Cow<'_, Regions<'_>> {
        match (finite, &self.masked) {
            (None, Some(masked)) => Cow::Borrowed(masked),
            (None, None) => Cow::Owned(Regions::unmasked(self.bands())),
            (Some(finite), _) => {
                let mut both = finite.clone();
                if let Some(mask) = &self.mask {
                    both.intersect(mask);
                }
                let radius = self.scorer.window_radius();
                Cow::Owned(Regions::masked(self.bands(), &both, radius))
            }
        }
    }

    /// The bands of the present gaze; none without a view.
    fn bands(&self) -> &BandMap {
        self.retina.as_ref().map_or(&self.no_bands, |retina| &retina.bands)
    }

    /// The foveal weight of the present gaze.
    pub(crate) fn weight(&self) -> Option<&fovqa_metrics::WeightField> {
        self.retina.as_ref()?.weight.as_ref()
    }
}

/// The gaze of the first frame.
fn first_gaze(settings: &Settings, trace: Option<&[GazeAt]>, view: &View) -> [f64; 2] {
    match (&settings.gaze, trace) {
        (_, Some(trace)) => trace[0].px,
        (Gaze::Point(px), None) => *px,
        (_, None) => view.principal_px,
    }
}

/// The largest eccentricity of any pixel in any frame: where the default bands end.
pub(crate) fn farthest_deg(settings: &Settings, trace: Option<&[GazeAt]>, view: &View) -> f64 {
    let gazes = trace.map_or_else(
        || vec![first_gaze(settings, None, view)],
        |trace| trace.iter().map(|gaze| gaze.px).collect(),
    );
    let farthest = |gaze| Eccentricity::new(*view, gaze, settings.eccentricity).max_deg();
    gazes.into_iter().map(farthest).fold(0.0, f64::max)
}

/// A mask has the size of the frames, or of the files they are cropped from.
fn fit_mask(
    inputs: &Inputs<'_, '_>,
    mask: &Mask,
    (width, height): (usize, usize),
) -> Result<Mask, Fault> {
    if (mask.width(), mask.height()) == (width, height) {
        return Ok(mask.clone());
    }
    if let Some(crop) = inputs.settings.crop
        && (mask.width(), mask.height()) == inputs.file_size
    {
        return Ok(mask.cropped(crop.x, crop.y, crop.width, crop.height));
    }
    Err(Fault {
        message: format!(
            "the mask has {}x{} pixels and the frames have {width}x{height}",
            mask.width(),
            mask.height()
        ),
        help: "a mask has the size of the frames".to_owned(),
    })
}

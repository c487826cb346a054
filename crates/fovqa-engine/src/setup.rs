//! What the size of the first frame settles for all: metrics that fit, view, bands, weights, mask.

use std::borrow::Cow;

use fovqa_frame::Mask;
use fovqa_metrics::{Metric, Regions, Scorer};
use fovqa_results::ViewResult;
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, GazeAt, ViewSpec};

use crate::events::Warnings;
use crate::load::Fault;
use crate::request::{Gaze, MetricChoice, ScoreRequest};
use crate::retina::{Retina, RetinaMaker};

/// Settled once, used for every frame.
pub(crate) struct Setup<'a> {
    pub(crate) size: (usize, usize),
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
    pub(crate) request: &'a ScoreRequest,
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
        let request = inputs.request;
        let mask = inputs.mask.map(|mask| fit_mask(inputs, mask, size)).transpose()?;
        let mut metrics = inputs.metrics.to_vec();
        if request.metrics == MetricChoice::Default {
            let scorer = Scorer::new(metrics.clone(), request.params.clone());
            for (metric, error) in scorer.unfit(size.0, size.1) {
                let message = format!("{} is left out: {error}", metric.info().label);
                warnings.once(metric.key(), &message);
                metrics.retain(|m| *m != metric);
            }
        }
        let foveal = metrics.iter().any(|m| m.info().needs_view);
        let mut scorer = Scorer::new(metrics, request.params.clone());
        if request.metrics == MetricChoice::Default {
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
        if let Some(spec) = &request.view {
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
            warnings.once("stretched", &message);
        }
        let (view, kind) = (resolved.view, inputs.request.eccentricity);
        let gaze_px = match (&inputs.request.gaze, inputs.trace) {
            (_, Some(trace)) => trace[0].px,
            (Gaze::Point(px), None) => *px,
            (_, None) => view.principal_px,
        };
        let edges = inputs.request.bands.clone().unwrap_or_else(|| {
            let gazes =
                inputs.trace.map_or_else(|| vec![gaze_px], |t| t.iter().map(|g| g.px).collect());
            let farthest = |gaze| Eccentricity::new(view, gaze, kind).max_deg();
            BandEdges::default_up_to(gazes.into_iter().map(farthest).fold(0.0, f64::max))
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
            params: &inputs.request.params,
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
            warnings.once("flat weight", &message);
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

/// A mask has the size of the frames, or of the files they are cropped from.
fn fit_mask(
    inputs: &Inputs<'_, '_>,
    mask: &Mask,
    (width, height): (usize, usize),
) -> Result<Mask, Fault> {
    if (mask.width(), mask.height()) == (width, height) {
        return Ok(mask.clone());
    }
    if let Some(crop) = inputs.request.crop
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

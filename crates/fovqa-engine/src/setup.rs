//! Data that the size of the first frame determines for all frames: metrics that fit, view, bands,
//! weights and mask.

use std::collections::BTreeMap;
use std::sync::Arc;

use fovqa_frame::Mask;
use fovqa_metrics::fvvdp::{Fvvdp, Geometry, SMALLEST_SIDE};
use fovqa_metrics::{Demand, Metric, Needs, WeightField};
use fovqa_plan::{Gaze, MetricChoice, Plan, Settings};
use fovqa_results::ViewResult;
use fovqa_vision::{BandEdges, Eccentricity, EccentricityKind, GazeAt, Seen, View, ViewSpec};

use crate::events::Warnings;
use crate::load::Fault;
use crate::retina::{Key, Retina, RetinaMaker, Retinas, Viewing, key};

/// The data are computed once and used for every frame.
pub(crate) struct Setup<'a> {
    pub(crate) size: (usize, usize),
    /// The file that determines the size.
    pub(crate) first_file: String,
    /// The metrics that fit the frames.
    pub(crate) metrics: Vec<Metric>,
    pub(crate) view: Option<ViewResult>,
    retinas: Retinas<'a>,
    /// The retina of the present gaze.
    retina: Arc<Retina>,
}

/// The inputs that a setup is made from.
pub(crate) struct Inputs<'a, 'b> {
    pub(crate) plan: &'a Plan,
    pub(crate) settings: &'a Settings,
    /// Bands of the whole scene, if they depend on the views of both eyes.
    pub(crate) scene_bands: Option<&'a BandEdges>,
    pub(crate) metrics: &'b [Metric],
    pub(crate) mask: Option<&'b Mask>,
    pub(crate) trace: Option<&'a [GazeAt]>,
    /// Number of pairs of each frame.
    pub(crate) pairs: &'b [usize],
    /// Width and height of the files in pixels, before any crop.
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
            for (metric, error) in plan.params.unfit(&metrics, size) {
                let message = format!("{} is left out: {error}", metric.info().label);
                warnings.once_a_view(metric.key(), &message);
                metrics.retain(|m| *m != metric);
            }
        }
        let wants_fvvdp = metrics.contains(&Metric::Fvvdp);
        let foveal = Needs::of(&metrics).foveal_weight > Demand::None;
        let levels = |metric: &Metric| plan.params.block_levels(*metric);
        let block_levels = metrics.iter().map(levels).filter(|levels| *levels > 0).collect();
        let seen = inputs.settings.view.as_ref().map(|spec| look(inputs, spec, size, warnings));
        let (viewing, view) = seen.transpose()?.unzip();
        let fvvdp = viewing.as_ref().filter(|_| wants_fvvdp && fits_fvvdp(size)).map(|viewing| {
            let display = match &inputs.settings.view {
                Some(ViewSpec::Display(display)) => Some(display.central_pixels_per_degree()),
                _ => None,
            };
            Fvvdp::new(Geometry::new(viewing.view, display), &plan.params.fvvdp)
        });
        if plan.params.fvvdp.foveated
            && let Some(fvvdp) = &fvvdp
            && fvvdp.geometry().passes_90_deg()
        {
            let message = format!(
                "the field is too wide for its {:.2} pixels per degree: beyond 90°, FovVideoVDP uses a negative \
                 frequency as its lowest, as the original does, so differences at the edges count too much and \
                 the JOD does not measure quality; use frames with more pixels, a narrower field, or \
                 fvvdp.foveated = false",
                fvvdp.geometry().pixels_per_degree
            );
            warnings.once_a_view("field beyond 90 degrees", &message);
        }
        let gaze_px = view.as_ref().map_or([0.0; 2], |view: &ViewResult| view.gaze_px);
        let mut retinas = Retinas::new(RetinaMaker {
            viewing,
            size,
            params: &plan.params,
            foveal,
            block_levels,
            fvvdp,
            mask,
            window_radius: plan.params.ssim.window_radius(),
            uses: uses(inputs, gaze_px),
        });
        let retina = retinas.at(gaze_px);
        if retina.weight.as_ref().is_some_and(WeightField::is_flat)
            && let Some(viewing) = &retinas.maker.viewing
        {
            let message = format!(
                "the view shows at most {:.2} cycles per degree, less than the eye can see anywhere in the \
                 frame: the foveal weight is constant, and foveal metrics equal their unweighted forms",
                viewing.view.nyquist_cpd()
            );
            warnings.once_a_view("flat weight", &message);
        }
        Ok(Self { size, first_file, metrics, view, retinas, retina })
    }

    /// Checks the pixel aspect ratio of a file. If the file declares pixels that are not square,
    /// the view has to agree within one percent, which is more than the rounding of either value.
    pub(crate) fn check_pixels(&self, file: &str, pixel_aspect: f32) -> Result<(), Fault> {
        const TOLERANCE: f64 = 0.01;
        let Some(viewing) = &self.retinas.maker.viewing else { return Ok(()) };
        let [x, y] = viewing.view.focal_px;
        let (declared, seen) = (f64::from(pixel_aspect), y / x);
        let is = |aspect: f64| (declared / aspect - 1.0).abs() <= TOLERANCE;
        // A file without square pixels declares that. If the file declares nothing, or 1, the view
        // decides.
        if is(1.0) || is(seen) {
            return Ok(());
        }
        Err(Fault {
            message: format!(
                "{file} declares pixels that are {pixel_aspect} times as wide as high, but in the view they are \
                 {seen:.4} times as wide as high"
            ),
            help: "give the horizontal and the vertical field of view, or the frustum, that was used for rendering; if the \
                   pixels are square, write that into the file (pixelAspectRatio 1 of OpenEXR, A1:1 of y4m)"
                .to_owned(),
        })
    }

    /// Moves the gaze, if there is a view.
    pub(crate) fn look_at(&mut self, gaze_px: [f64; 2]) {
        if self.view.is_some() {
            self.retina = self.retinas.at(gaze_px);
        }
    }

    /// The data for the present gaze.
    pub(crate) fn retina(&self) -> Arc<Retina> {
        Arc::clone(&self.retina)
    }

    /// Radius in pixels of the windows in which every pixel has to count.
    pub(crate) fn window_radius(&self) -> usize {
        self.retinas.maker.window_radius
    }

    /// The number of bands.
    pub(crate) fn bands(&self) -> usize {
        self.view.as_ref().map_or(0, |view| view.bands_deg.len())
    }

    /// FovVideoVDP for these frames, if it is requested.
    pub(crate) fn fvvdp(&self) -> Option<&Fvvdp> {
        self.retinas.maker.fvvdp.as_ref()
    }

    /// The lens mask.
    pub(crate) fn mask(&self) -> Option<&Mask> {
        self.retinas.maker.mask.as_ref()
    }

    /// Where pixels are finite, without those that the lens mask leaves out.
    pub(crate) fn within_mask(&self, finite: &Mask) -> Mask {
        let mut both = finite.clone();
        if let Some(mask) = self.mask() {
            both.intersect(mask);
        }
        both
    }

    /// The eccentricity of the pixels with this gaze; `None` without a view.
    pub(crate) fn eccentricity(&self, gaze_px: [f64; 2]) -> Option<Eccentricity> {
        let Viewing { view, kind, .. } = self.retinas.maker.viewing.as_ref()?;
        Some(Eccentricity::new(*view, gaze_px, *kind))
    }

    /// The edges of the bands; `None` without a view.
    pub(crate) fn edges(&self) -> Option<&BandEdges> {
        Some(&self.retinas.maker.viewing.as_ref()?.edges)
    }

    /// How the eye sees a frame with this gaze; `None` without a view.
    pub(crate) fn seen(&self, gaze_px: [f64; 2]) -> Option<Seen> {
        let eccentricity = self.eccentricity(gaze_px)?;
        Some(Seen { eccentricity, bands: self.retinas.maker.viewing.as_ref()?.edges.clone() })
    }

    /// The distance between two gaze positions in degrees; `None` without a view.
    pub(crate) fn gaze_step_deg(&self, from_px: [f64; 2], to_px: [f64; 2]) -> Option<f64> {
        let viewing = self.retinas.maker.viewing.as_ref()?;
        let from = Eccentricity::new(viewing.view, from_px, EccentricityKind::Angular);
        Some(from.at_deg(to_px[0], to_px[1]))
    }
}

/// Whether FovVideoVDP is defined for frames of this size. If not, the scorer returns the error.
fn fits_fvvdp((width, height): (usize, usize)) -> bool {
    width.min(height) >= SMALLEST_SIDE
}

/// The number of pairs for each gaze.
fn uses(inputs: &Inputs<'_, '_>, gaze_px: [f64; 2]) -> BTreeMap<Key, usize> {
    let mut uses = BTreeMap::new();
    for (frame, pairs) in inputs.pairs.iter().enumerate() {
        let gaze = inputs.trace.map_or(gaze_px, |trace| trace[frame].px);
        *uses.entry(key(gaze)).or_default() += pairs;
    }
    uses
}

/// Determines the viewing conditions of the frames.
fn look(
    inputs: &Inputs<'_, '_>,
    spec: &ViewSpec,
    (w, h): (usize, usize),
    warnings: &mut Warnings<'_>,
) -> Result<(Viewing, ViewResult), Fault> {
    let resolved = spec.resolve(w, h).map_err(|error| Fault {
        message: error.to_string(),
        help: "give a view that fits frames of this size".to_owned(),
    })?;
    if let Some([dw, dh]) = resolved.stretched_from {
        let fvvdp = if inputs.metrics.contains(&Metric::Fvvdp) {
            "; FovVideoVDP treats each of their pixels as one pixel of the display"
        } else {
            ""
        };
        let message = format!(
            "frames of {w}x{h} are stretched over the display's {dw}x{dh}: they fill its whole field{fvvdp}"
        );
        warnings.once_a_view("stretched", &message);
    }
    for doubt in spec.doubts(&resolved.view) {
        warnings.once_a_view(&doubt, &doubt);
    }
    let (view, kind) = (resolved.view, inputs.settings.eccentricity);
    let bands = inputs.scene_bands.or(inputs.settings.bands.as_ref());
    let edges = bands.cloned().unwrap_or_else(|| {
        BandEdges::default_up_to(farthest_deg(inputs.settings, inputs.trace, &view))
    });
    let result = ViewResult {
        size: [w, h],
        focal_px: view.focal_px,
        gaze_px: first_gaze(inputs.settings, inputs.trace, &view),
        eccentricity: kind,
        bands_deg: edges.iter().collect(),
    };
    Ok((Viewing { view, kind, edges }, result))
}

/// The gaze of the first frame.
fn first_gaze(settings: &Settings, trace: Option<&[GazeAt]>, view: &View) -> [f64; 2] {
    match (&settings.gaze, trace) {
        (_, Some(trace)) => trace[0].px,
        (Gaze::Point(px), None) => *px,
        (_, None) => view.principal_px,
    }
}

/// The largest eccentricity in degrees of any pixel in any frame. The default bands end there.
pub(crate) fn farthest_deg(settings: &Settings, trace: Option<&[GazeAt]>, view: &View) -> f64 {
    let gazes = trace.map_or_else(
        || vec![first_gaze(settings, None, view)],
        |trace| trace.iter().map(|gaze| gaze.px).collect(),
    );
    let farthest = |gaze| Eccentricity::new(*view, gaze, settings.eccentricity).max_deg();
    gazes.into_iter().map(farthest).fold(0.0, f64::max)
}

/// Fits a mask to the frames. The mask must have the size of the frames, or of the files they are
/// cropped from.
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
            "the mask has {}x{} pixels, but the frames have {width}x{height}",
            mask.width(),
            mask.height()
        ),
        help: "the mask must have the size of the frames".to_owned(),
    })
}

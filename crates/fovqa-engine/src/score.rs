//! `score`: one reference against one test, frame by frame.

use std::collections::BTreeSet;
use std::fs::File;
use std::path::{Component, Path};

use fovqa_frame::{Mask, PairSignal, SignalTables};
use fovqa_io::read_mask;
use fovqa_io::sequence::{FramePair, list, pair};
use fovqa_metrics::{Metric, Regions, Scorer};
use fovqa_results::{Failure, FrameResult, ScoreReport, ViewResult};
use fovqa_vision::{
    BandEdges, BandMap, Eccentricity, EccentricityKind, GazeAt, GazeTrace, ViewSpec,
};

use crate::error::{EngineError, no_view};
use crate::events::Events;
use crate::load::{LoadError, Loaded, Loader};
use crate::read_ahead::read_ahead;
use crate::request::{Gaze, MetricChoice, ScoreRequest};
use crate::retina::{Retina, RetinaMaker};

/// Scores every frame of a request. Frames that cannot be scored are in the report's failures.
///
/// # Errors
/// When nothing can be scored at all: no frames, frames that do not pair, a view, gaze or mask
/// that cannot be.
pub fn score(request: &ScoreRequest, events: &dyn Events) -> Result<ScoreReport, EngineError> {
    let metrics = check(request, events)?;
    let (pairs, first_frame) = find_pairs(request)?;
    let trace = gaze_trace(request, &pairs, first_frame)?;
    let mask = request.mask.as_deref().map(|path| read_mask(path, &request.read)).transpose()?;
    let loader = Loader {
        read: &request.read,
        crop: request.crop,
        nonfinite: request.nonfinite,
        signal: &request.signal,
    };
    let mut run = Run {
        request,
        events,
        tables: SignalTables::new(request.signal),
        trace: trace.as_deref(),
        mask,
        frames: pairs.len(),
        setup: None,
        said: BTreeSet::new(),
        report: ScoreReport {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            view: None,
            metrics,
            frames: Vec::with_capacity(pairs.len()),
            failures: Vec::new(),
            gaze_held: trace.as_ref().map(|t| t.iter().filter(|g| g.held).count()),
        },
    };
    events.progress(0, pairs.len());
    read_ahead(
        &pairs,
        |pair| loader.load(pair),
        |index, loaded| {
            run.frame(index, &pairs[index], loaded);
            events.progress(index + 1, pairs.len());
        },
    );
    Ok(run.report)
}

/// Checks what needs no file, and settles the metrics.
fn check(request: &ScoreRequest, events: &dyn Events) -> Result<Vec<Metric>, EngineError> {
    request.params.check()?;
    let needs_view = |metrics: &[Metric]| -> Vec<Metric> {
        metrics.iter().copied().filter(|m| m.info().needs_view).collect()
    };
    if let Some(view) = &request.view {
        view.check()?;
    } else {
        let what = match request.gaze {
            _ if request.bands.is_some() => Some("eccentricity bands"),
            Gaze::Point(_) | Gaze::Trace { .. } => Some("a gaze"),
            Gaze::Centre => None,
        };
        if let Some(what) = what {
            return Err(EngineError::NoView { what: what.to_owned() });
        }
    }
    let mut metrics = match &request.metrics {
        MetricChoice::Named(named) => {
            let foveal = needs_view(named);
            if request.view.is_none() && !foveal.is_empty() {
                return Err(no_view(&foveal));
            }
            named.clone()
        }
        MetricChoice::Default => {
            let mut metrics = Metric::DEFAULT.to_vec();
            if request.view.is_none() {
                for metric in needs_view(&metrics) {
                    events.warn(&format!(
                        "{} is left out: it needs a view (such as --fov-vertical or --display)",
                        metric.info().label
                    ));
                }
                metrics.retain(|m| !m.info().needs_view);
            }
            metrics
        }
    };
    metrics.sort_unstable();
    metrics.dedup();
    Ok(metrics)
}

/// The pairs to score, and the number of the sequence's first frame.
fn find_pairs(request: &ScoreRequest) -> Result<(Vec<FramePair>, u64), EngineError> {
    let (reference, test) = (list(&request.reference)?, list(&request.test)?);
    let mut pairs = pair(&reference, &test, request.allow_missing)?;
    let numbers = || pairs.iter().map(|p| p.number);
    let (first, last) = (numbers().min().unwrap_or(0), numbers().max().unwrap_or(0));
    if let Some(range) = request.frames {
        pairs.retain(|pair| range.contains(pair.number));
    }
    if pairs.is_empty() {
        return Err(EngineError::NoFrames { first, last });
    }
    Ok((pairs, first))
}

fn gaze_trace(
    request: &ScoreRequest,
    pairs: &[FramePair],
    first_frame: u64,
) -> Result<Option<Vec<GazeAt>>, EngineError> {
    let Gaze::Trace { path, hold } = &request.gaze else { return Ok(None) };
    let file = File::open(path)
        .and_then(|file| {
            let folder = file.metadata()?.is_dir();
            if folder { Err(std::io::ErrorKind::IsADirectory.into()) } else { Ok(file) }
        })
        .map_err(|error| EngineError::GazeFile { path: path.clone(), error })?;
    let frames: Vec<u64> = pairs.iter().map(|p| p.number).collect();
    GazeTrace::read(std::io::BufReader::new(file))
        .and_then(|trace| trace.at_frames(&frames, first_frame, request.fps, *hold))
        .map(Some)
        .map_err(|error| EngineError::GazeTrace { path: path.clone(), error })
}

struct Run<'a> {
    request: &'a ScoreRequest,
    events: &'a dyn Events,
    tables: SignalTables,
    trace: Option<&'a [GazeAt]>,
    mask: Option<Mask>,
    frames: usize,
    setup: Option<Setup<'a>>,
    said: BTreeSet<String>,
    report: ScoreReport,
}

/// What the first frame's size settles for all.
struct Setup<'a> {
    size: (usize, usize),
    scorer: Scorer,
    maker: Option<RetinaMaker<'a>>,
    retina: Option<Retina>,
    no_bands: BandMap,
    mask: Option<Mask>,
    first_file: String,
}

/// A message and how to mend it.
struct Fault {
    message: String,
    help: String,
}

impl From<LoadError> for Fault {
    fn from(error: LoadError) -> Self {
        Self { message: error.to_string(), help: error.help().to_owned() }
    }
}

impl<'a> Run<'a> {
    fn frame(&mut self, index: usize, pair: &FramePair, loaded: Result<Loaded, LoadError>) {
        let result = loaded.map_err(Fault::from).and_then(|l| self.score(index, pair, &l));
        let (reference, test) = (shown(&pair.reference), shown(&pair.test));
        match result {
            Ok(frame) => self.report.frames.push(frame),
            Err(Fault { message, help }) => {
                let frame = pair.number;
                self.report.failures.push(Failure { frame, reference, test, message, help });
            }
        }
    }

    /// Says something once, whatever number of frames it is true of.
    fn warn_once(&mut self, key: &str, message: &str) {
        if self.said.insert(key.to_owned()) {
            let once = if self.frames > 1 { " (said once for all frames)" } else { "" };
            self.events.warn(&format!("{message}{once}"));
        }
    }

    fn score(
        &mut self,
        index: usize,
        pair: &FramePair,
        loaded: &Loaded,
    ) -> Result<FrameResult, Fault> {
        for (file, note) in &loaded.notes {
            self.warn_once(note, &format!("{file}: {note}"));
        }
        let size = (loaded.reference.width(), loaded.reference.height());
        if self.setup.is_none() {
            let setup = self.set_up(size, pair)?;
            self.setup = Some(setup);
        }
        let gaze_px = self.trace.map(|trace| trace[index].px);
        let Some(setup) = &mut self.setup else { unreachable!("set up above") };
        if size != setup.size {
            return Err(Fault {
                message: format!(
                    "{} has {}x{} pixels and {}, the first of the sequence, has {}x{}",
                    pair.reference.display(),
                    size.0,
                    size.1,
                    setup.first_file,
                    setup.size.0,
                    setup.size.1
                ),
                help: "a sequence has one size".to_owned(),
            });
        }
        if let (Some(maker), Some(gaze_px)) = (&setup.maker, gaze_px) {
            setup.retina = Some(maker.at(gaze_px, setup.retina.take()));
        }
        let bands = setup.retina.as_ref().map_or(&setup.no_bands, |retina| &retina.bands);
        let mask = match (&setup.mask, &loaded.finite) {
            (Some(mask), Some(finite)) => {
                let mut both = mask.clone();
                both.intersect(finite);
                Some(both)
            }
            (mask, finite) => mask.clone().or_else(|| finite.clone()),
        };
        let regions = match &mask {
            Some(mask) => Regions::masked(bands, mask, setup.scorer.window_radius()),
            None => Regions::unmasked(bands),
        };
        let signal = PairSignal::new(&loaded.reference, &loaded.test, &self.tables);
        let weight = setup.retina.as_ref().and_then(|retina| retina.weight.as_ref());
        let scores = setup.scorer.score(&signal, &regions, weight).map_err(|error| Fault {
            message: format!("{}: {error}", pair.test.display()),
            help: format!("leave it out of --metrics, or {}", score_help(&error)),
        })?;
        if let Some(view) = &self.report.view {
            let gaze = gaze_px.unwrap_or(view.gaze_px);
            let inside = |at: f64, side: usize| (0.0..=side as f64).contains(&at);
            if !(inside(gaze[0], size.0) && inside(gaze[1], size.1)) {
                let message = format!(
                    "the gaze ({}, {}) lies outside the frame of {}x{}; eccentricities are measured from it all the same",
                    gaze[0], gaze[1], size.0, size.1
                );
                self.warn_once("gaze outside", &message);
            }
        }
        Ok(FrameResult {
            frame: pair.number,
            reference: shown(&pair.reference),
            test: shown(&pair.test),
            gaze_px,
            scores,
        })
    }

    fn set_up(&mut self, size: (usize, usize), pair: &FramePair) -> Result<Setup<'a>, Fault> {
        let mask = self.mask.clone().map(|mask| self.fit_mask(mask, size)).transpose()?;
        let mut scorer = Scorer::new(self.report.metrics.clone(), self.request.params.clone());
        if self.request.metrics == MetricChoice::Default {
            for (metric, error) in scorer.unfit(size.0, size.1) {
                self.warn_once(
                    metric.key(),
                    &format!("{} is left out: {error}", metric.info().label),
                );
                self.report.metrics.retain(|m| *m != metric);
            }
            scorer = Scorer::new(self.report.metrics.clone(), self.request.params.clone());
        }
        let maker = match &self.request.view {
            Some(spec) => Some(self.retina_maker(spec, size)?),
            None => None,
        };
        let retina = match (&maker, &self.report.view) {
            (Some(maker), Some(view)) => Some(maker.at(view.gaze_px, None)),
            _ => None,
        };
        if let (Some(maker), Some(field)) =
            (&maker, retina.as_ref().and_then(|retina| retina.weight.as_ref()))
            && field.is_flat()
        {
            let message = format!(
                "the view shows {:.2} cycles per degree at most, less than the eye sees anywhere in the \
                 frame: the foveal weight is flat, and foveal metrics equal their plain forms",
                maker.view.nyquist_cpd()
            );
            self.warn_once("flat weight", &message);
        }
        Ok(Setup {
            size,
            scorer,
            maker,
            retina,
            no_bands: BandMap::without_bands(size.0, size.1),
            mask,
            first_file: pair.reference.display().to_string(),
        })
    }

    fn retina_maker(
        &mut self,
        spec: &ViewSpec,
        size: (usize, usize),
    ) -> Result<RetinaMaker<'a>, Fault> {
        let resolved = spec
            .resolve(size.0, size.1)
            .map_err(|error| Fault { message: error.to_string(), help: String::new() })?;
        if let Some([w, h]) = resolved.stretched_from {
            let message = format!(
                "frames of {}x{} are stretched over the display's {w}x{h}: they fill its whole field",
                size.0, size.1
            );
            self.warn_once("stretched", &message);
        }
        let view = resolved.view;
        let kind = self.request.eccentricity;
        let gaze_px = match (&self.request.gaze, self.trace) {
            (_, Some(trace)) => trace[0].px,
            (Gaze::Point(px), None) => *px,
            (_, None) => view.principal_px,
        };
        let edges = self.request.bands.clone().unwrap_or_else(|| {
            let gazes =
                self.trace.map_or_else(|| vec![gaze_px], |t| t.iter().map(|g| g.px).collect());
            let farthest = |gaze| Eccentricity::new(view, gaze, kind).max_deg();
            BandEdges::default_up_to(gazes.into_iter().map(farthest).fold(0.0, f64::max))
        });
        self.report.view = Some(ViewResult {
            size: [size.0, size.1],
            focal_px: view.focal_px,
            gaze_px,
            eccentricity: match kind {
                EccentricityKind::Angular => "angular",
                EccentricityKind::Planar => "planar",
            },
            bands_deg: edges.iter().collect(),
        });
        let foveal = self.report.metrics.iter().any(|m| m.info().needs_view);
        Ok(RetinaMaker {
            view,
            kind,
            edges,
            params: &self.request.params,
            foveal,
            keep: self.frames > 1 && self.trace.is_none(),
        })
    }

    /// A mask has the size of the frames, or of the files they are cropped from.
    fn fit_mask(&self, mask: Mask, (width, height): (usize, usize)) -> Result<Mask, Fault> {
        if (mask.width(), mask.height()) == (width, height) {
            return Ok(mask);
        }
        if let Some(crop) = self.request.crop {
            let fits = |from: usize, length: usize, side: usize| {
                from.checked_add(length).is_some_and(|end| end <= side)
            };
            if fits(crop.x, crop.width, mask.width()) && fits(crop.y, crop.height, mask.height()) {
                return Ok(mask.cropped(crop.x, crop.y, crop.width, crop.height));
            }
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
}

fn score_help(error: &fovqa_metrics::ScoreError) -> &'static str {
    use fovqa_metrics::ScoreError;
    match error {
        ScoreError::TooSmall { .. } => "render larger frames",
        ScoreError::Masked { .. } => "score without a mask",
        ScoreError::NothingLeft | ScoreError::NoWindow { .. } => "check the mask: white is visible",
        ScoreError::NoView { .. } => "give a view",
    }
}

/// A path as results show it: relative to the working directory where it lies below it, with `/`.
fn shown(path: &Path) -> String {
    let below = std::env::current_dir()
        .ok()
        .and_then(|here| path.strip_prefix(here).ok().map(Path::to_owned));
    let path = below.unwrap_or_else(|| path.to_owned());
    let mut parts: Vec<String> = Vec::new();
    for part in path.components() {
        match part {
            Component::RootDir => parts.push(String::new()),
            Component::CurDir => {}
            part => parts.push(part.as_os_str().to_string_lossy().into_owned()),
        }
    }
    parts.join("/")
}

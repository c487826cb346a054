//! `fovqa foveate`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use fovqa::{BuiltinSpec, SceneName};
use fovqa_emulate::{Budget, EmulateError, EmulationSpec, FilterChoice, Jitter, Sampling, Space};
use fovqa_frame::{Crop, SignalChannels};
use fovqa_io::sequence::FrameRange;
use fovqa_io::{AlphaPolicy, DepthChannels, GuideOptions, ReadOptions};
use fovqa_methods::BudgetSamples;
use fovqa_params::{ParamValue, Words};
use fovqa_plan::{
    BuiltinFrames, Emulation, EyeView, Gaze, MetricChoice, Plan, Scene, Settings, SourceSpec,
};
use fovqa_vision::ViewSpec;

use super::curves::resolution;
use super::guides::MotionArgs;
use super::no_such::no_such;
use super::offered::{self, offering};
use super::signal::{EncodingArgs, VideoArgs};
use super::values::{crop, finite, literal, positive, words};
use super::view::{GazeArgs, ViewSpecArgs};

pub(crate) const EXAMPLES: &str = "\
INPUT is a file, a folder, a glob ('renders/*.exr'), a pattern (gt.%04d.exr) or a y4m video. OUTPUT
is a file for a single frame, otherwise a folder, which is made if needed. A file is written as PNG,
OpenEXR or JPEG, by its ending. Files in a folder have the names and types of the inputs; frames of
a video are written as PNG. Existing files are replaced.

From a finished frame, emulation understates aliasing and flicker: the pixels of the frame are
filtered already. docs/emulation.md describes every method, option and output.

Examples:
  fovqa foveate gt.png rmfr.png --method rmfr --gaze 720,800
  fovqa foveate gt.png kfr.png --method kfr --budget 0.15 --filter own --buffer kfr-buffer.png
  fovqa foveate gt/ deamp/ --method deamp --set 'sigmas=[2.51,3.6,4.8]' --gaze gaze.csv --fps 72
  fovqa foveate gt.%04d.exr vafr/ --method vafr --fov-vertical 100 --temporal --set taa.alpha=0.2
  fovqa foveate builtin:gallery rmfr.png --method rmfr --display vive-pro-eye

Exit codes: 0 done; 2 the command line is wrong; 3 an input is missing, unreadable or does not fit,
or an output cannot be written (the other frames are still written); 70 a bug in fovqa; 130
interrupted.";

/// How the record of an emulation is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FoveateFormat {
    /// Text to read.
    Text,
    /// All values, as JSON.
    Json,
}

#[derive(Debug, Args)]
pub(crate) struct FoveateArgs {
    /// Finished frames: a file, a folder, a glob, a pattern or a y4m video; or builtin:NAME, a scene that
    /// is sampled itself (`fovqa gallery --help` shows the names)
    input: PathBuf,
    /// File for a single frame, otherwise folder
    pub(crate) output: PathBuf,
    /// How sample counts are printed
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub(crate) format: FoveateFormat,
    #[command(flatten)]
    emulation: EmulationArgs,
    /// Also write the reduced buffer as a picture: FILE for a single frame, otherwise a folder. Of
    /// several layers, each has a file: FILE with -1, -2, … before the ending, the innermost first
    #[arg(long, value_name = "FILE")]
    pub(crate) buffer: Option<PathBuf>,
    #[command(flatten)]
    view: ViewSpecArgs,
    #[command(flatten)]
    gaze: GazeArgs,
    #[command(flatten)]
    input_signal: InputSignalArgs,
    #[command(flatten)]
    motion: MotionArgs,
    /// Emulate only these frame numbers, from A up to, but not including, B
    #[arg(long, allow_hyphen_values = true, value_name = "A..B:STEP", help_heading = "Sequence")]
    frames: Option<FrameRange>,
    /// Number of frames of a built-in scene
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = "Sequence")]
    builtin_frames: usize,
    /// Size of the frames of a built-in scene [default: that of --display]
    #[arg(long, value_name = "WxH", value_parser = resolution, help_heading = "View")]
    resolution: Option<[usize; 2]>,
    /// Frames per second, needed for gaze traces in seconds [default: the frame rate of a y4m video]
    #[arg(long, value_name = "N", value_parser = positive, help_heading = "Sequence")]
    fps: Option<f64>,
    /// Threads to work with [default: all cores, or `RAYON_NUM_THREADS`]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
}

/// The method and everything around it.
#[derive(Debug, Args)]
#[command(next_help_heading = "Emulation")]
struct EmulationArgs {
    /// The method; `fovqa list methods` shows them
    #[arg(long, value_name = "NAME", value_parser = offering(method, offered::emulated_methods), hide_possible_values = true)]
    method: EmulationSpec,
    /// A parameter: of the method, such as sigma=1.8, of its filters (filter.X), of the temporal filter
    /// (taa.X) or of the enhancement (enhance.X)
    #[arg(long = "set", value_name = "PARAM=VALUE", value_parser = assignment)]
    set: Vec<(String, ParamValue)>,
    /// How a sample reads the frame
    #[arg(long, value_name = "HOW", default_value = Sampling::default().word(), value_parser = words::<Sampling>())]
    sampling: Sampling,
    /// How samples move within their cells from frame to frame
    #[arg(long, value_name = "HOW", default_value = Jitter::default().word(), value_parser = words::<Jitter>())]
    jitter: Jitter,
    /// Which of the method's own filters are applied
    #[arg(long, value_name = "WHICH", default_value = FilterChoice::default().word(), value_parser = words::<FilterChoice>())]
    filter: FilterChoice,
    /// The values on which the method works
    #[arg(long, value_name = "SPACE", default_value = Space::default().word(), value_parser = words::<Space>())]
    space: Space,
    /// Apply the temporal filter after the method, along the motion vectors
    #[arg(long)]
    temporal: bool,
    /// Enhance the contrast of the periphery, up to this strength
    #[arg(long, value_name = "F_MAX", value_parser = finite, allow_negative_numbers = true)]
    enhance: Option<f64>,
    /// Set the method's free parameter so that the samples are this share of the frame's pixels,
    /// such as 0.15
    #[arg(long, value_name = "SHARE", value_parser = finite, allow_negative_numbers = true)]
    budget: Option<f64>,
    /// Which samples the budget counts
    #[arg(long, value_name = "WHICH", default_value = BudgetSamples::default().word(), value_parser = words::<BudgetSamples>(), requires = "budget")]
    budget_of: BudgetSamples,
}

/// How the input is read.
#[derive(Debug, Args)]
#[command(next_help_heading = "Signal")]
struct InputSignalArgs {
    #[command(flatten)]
    encoding: EncodingArgs,
    /// Colour layer of OpenEXR files that have several; "root" for R, G, B without a prefix
    #[arg(long, value_name = "NAME")]
    layer: Option<String>,
    /// Treatment of alpha that is not 1 everywhere
    #[arg(long, value_name = "POLICY", default_value = AlphaPolicy::default().word(), value_parser = words::<AlphaPolicy>())]
    alpha: AlphaPolicy,
    #[command(flatten)]
    video: VideoArgs,
    /// Rectangle to emulate, such as one eye of a side-by-side picture; only this rectangle is written,
    /// and the view options describe it
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    crop: Option<Crop>,
    /// Largest number of pixels that a file may declare, in millions
    #[arg(long, value_name = "N", default_value_t = ReadOptions::default().max_megapixels)]
    max_megapixels: u64,
}

fn method(name: &str) -> Result<EmulationSpec, String> {
    EmulationSpec::new(name).map_err(|_| {
        let known = EmulationSpec::methods().into_iter().map(|info| info.key.replace('_', "-"));
        no_such("method", name, &known.collect::<Vec<_>>())
    })
}

fn assignment(text: &str) -> Result<(String, ParamValue), String> {
    let (name, value) = text.split_once('=').ok_or_else(|| "write PARAM=VALUE".to_owned())?;
    Ok((name.trim().to_owned(), literal(value.trim())?))
}

/// A command line that cannot be carried out.
pub(crate) struct Refused {
    pub(crate) message: String,
    pub(crate) help: String,
}

impl From<EmulateError> for Refused {
    fn from(error: EmulateError) -> Self {
        Self { message: error.to_string(), help: error.help().to_owned() }
    }
}

impl From<String> for Refused {
    fn from(message: String) -> Self {
        Self { message, help: "`fovqa foveate --help` shows every option".to_owned() }
    }
}

impl EmulationArgs {
    fn spec(&self) -> Result<EmulationSpec, EmulateError> {
        let mut spec = self.method.clone();
        for (name, value) in &self.set {
            spec.set(name, value)?;
        }
        spec.set_sampling(self.sampling);
        spec.set_jitter(self.jitter);
        spec.set_filters(self.filter)?;
        spec.set_space(self.space);
        spec.set_temporal(self.temporal);
        if let Some(f_max) = self.enhance {
            spec.set_enhance(f_max)?;
        }
        if let Some(share) = self.budget {
            spec.set_budget(Budget { share, of: self.budget_of })?;
        }
        Ok(spec)
    }
}

impl FoveateArgs {
    /// The emulation, and a warning for each parameter that has no effect.
    pub(crate) fn spec(&self) -> Result<(EmulationSpec, Vec<String>), Refused> {
        let spec = self.emulation.spec()?;
        let applied = spec.parameters();
        let is_applied = |name: &&String| applied.iter().any(|(known, _)| known == *name);
        let unused = spec.set_by_name().keys().filter(|name| !is_applied(name)).map(|name| {
            let option = match name.split_once('.') {
                Some(("filter", _)) => "--filter",
                Some(("taa", _)) => "--temporal",
                _ => "--enhance",
            };
            format!("--set {name} has no effect without {option}")
        });
        let unused = unused.collect();
        Ok((spec, unused))
    }

    /// The built-in scene that the input names, if it does. Each pixel of its ground truth, which is not
    /// written, gets a single sample.
    fn builtin(&self) -> Result<Option<BuiltinFrames>, Refused> {
        let name = self.input.to_str().and_then(|input| input.strip_prefix("builtin:"));
        let Some(name) = name else { return Ok(None) };
        let known = || SceneName::all().into_iter().map(|scene| scene.word().replace('_', "-"));
        let scene = SceneName::find(&name.replace('-', "_"))
            .ok_or_else(|| no_such("built-in scene", name, &known().collect::<Vec<_>>()))?;
        let view = self.view.spec()?;
        if view.is_none() && scene == SceneName::Gallery {
            return Err("the gallery needs {view}".to_owned().into());
        }
        let of_display = match view {
            Some(ViewSpec::Display(display)) => Some(display.resolution),
            _ => None,
        };
        let size = self.resolution.or(of_display);
        let size =
            size.ok_or_else(|| "give the size of the frames with --resolution".to_owned())?;
        let default = BuiltinSpec::new(scene);
        let fps = self.fps.unwrap_or(default.fps);
        let spec = BuiltinSpec { frames: self.builtin_frames, samples: 1, fps, ..default };
        Ok(Some(BuiltinFrames { spec, size, eye_m: 0.0 }))
    }

    /// The plan that emulates `spec`.
    pub(crate) fn plan(self, spec: EmulationSpec) -> Result<Plan, Refused> {
        let builtin = self.builtin()?;
        let Self { view, gaze, input_signal, motion, .. } = self;
        let walks = builtin.as_ref().is_some_and(|of| of.spec.scene == SceneName::Gallery);
        let settings = Settings {
            guides: GuideOptions { motion: motion.channels(), depth: DepthChannels::None },
            motion_files: motion.files(),
            view: view.spec()?,
            gaze: if walks && !gaze.is_given() { Gaze::Builtin } else { gaze.gaze() },
            read: ReadOptions {
                layer: input_signal.layer,
                alpha: input_signal.alpha,
                max_megapixels: input_signal.max_megapixels,
                formats: input_signal.video.formats(),
                ..ReadOptions::default()
            },
            signal: input_signal.encoding.signal(SignalChannels::default()),
            crop: input_signal.crop,
            ..Settings::default()
        };
        let fps = self.fps.or(builtin.as_ref().map(|of| of.spec.fps));
        let eye = EyeView {
            reference: builtin.map_or_else(|| self.input.into(), SourceSpec::Builtin),
            tests: vec![(0, Emulation::from(spec).into())],
            settings,
            ..EyeView::default()
        };
        let scene = Scene { frames: self.frames, fps, eyes: vec![eye], ..Scene::default() };
        Ok(Plan {
            // Absolute paths inside the working directory are shown relative to it.
            base: std::env::current_dir().unwrap_or_default(),
            scenes: vec![scene],
            methods: vec![String::new()],
            metrics: MetricChoice::Named(Vec::new()),
            ..Plan::default()
        })
    }
}

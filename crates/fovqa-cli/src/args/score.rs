//! `fovqa score`.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use fovqa_io::sequence::FrameRange;
use fovqa_plan::{EyeView, Plan, Scene, Settings, WantedPictures};

use super::guides::GuideArgs;
use super::metrics::MetricArgs;
use super::right_eye::RightEyeArgs;
use super::signal::SignalArgs;
use super::values::positive;
use super::view::ViewArgs;

pub(crate) const EXAMPLES: &str = "\
Paths are files, folders, globs ('renders/*.exr'), patterns (gt.%04d.exr, 'gt.####.exr') or y4m
videos; - is a y4m video on standard input.
Frames are paired by name, then by the number that changes from name to name (docs/files.md).

Examples:
  fovqa score gt.png rmfr.png --fov-vertical 100
  fovqa score gt/ rmfr/ --display vive-pro-eye --gaze gaze.csv --fps 72 --format csv
  fovqa score gt/ rmfr/ --metrics fvvdp --display htc-vive-pro --fps 90 --maps maps
  fovqa score gt.%04d.exr rmfr.%04d.exr --tonemap reinhard --exposure 0.5 --metrics psnr,ssim
  fovqa score left/gt.exr left/rmfr.exr --right-reference right/gt.exr --right-test right/rmfr.exr
  ffmpeg -i rmfr.mkv -f yuv4mpegpipe -strict -1 - | fovqa score gt.y4m -

Exit codes: 0 done; 2 the command line is wrong; 3 an input is missing, unreadable or does not fit,
or the output cannot be written (frames that fit are still scored); 70 a bug in fovqa; 130
interrupted.";

/// How results are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// A table to read.
    Table,
    /// All values, as nested JSON.
    Json,
    /// One long table with one value per row.
    Csv,
}

#[derive(Debug, Args)]
pub(crate) struct ScoreArgs {
    /// Reference frames (ground truth): a file, a folder, a glob, a pattern, a y4m video, or - for one on
    /// standard input
    reference: PathBuf,
    /// Test frames (foveated renders), in the same forms
    test: PathBuf,
    /// How results are printed
    #[arg(long, value_name = "FORMAT", default_value = "table")]
    pub(crate) format: Format,
    #[command(flatten)]
    metrics: MetricArgs,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    signal: SignalArgs,
    #[command(flatten)]
    right_eye: RightEyeArgs,
    #[command(flatten)]
    guides: GuideArgs,
    /// Score only these frame numbers, from A up to, but not including, B
    #[arg(long, allow_hyphen_values = true, value_name = "A..B:STEP", help_heading = "Sequence")]
    frames: Option<FrameRange>,
    /// Frames per second, needed for FovVideoVDP of a sequence and for gaze traces in seconds
    /// [default: the frame rate of a y4m video]
    #[arg(long, value_name = "N", value_parser = positive, help_heading = "Sequence")]
    fps: Option<f64>,
    /// Skip frames without a partner
    #[arg(long, help_heading = "Sequence")]
    allow_missing: bool,
    /// Write maps of each frame to DIR, as values (OpenEXR) and as a heat map with a colour bar, bands
    /// and gaze (PNG); `fovqa list metrics` shows which metrics have a map
    #[arg(long, value_name = "DIR")]
    pub(crate) maps: Option<PathBuf>,
    /// Threads to score with [default: all cores, or `RAYON_NUM_THREADS`]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
}

impl ScoreArgs {
    /// The plan; the error is a wrong command line.
    pub(crate) fn plan(self) -> Result<Plan, String> {
        let stdin = Path::new("-");
        if self.reference == stdin && self.test == stdin {
            return Err(
                "reference and test are both standard input (-), which can only be read once"
                    .to_owned(),
            );
        }
        let (motion_files, depth_files) = self.guides.files();
        let settings = Settings {
            guides: self.guides.options(),
            motion_files,
            depth_files,
            view: self.view.spec()?,
            luminance: self.view.luminance(),
            gaze: self.view.gaze(),
            eccentricity: self.view.eccentricity(),
            bands: self.view.bands(),
            read: self.signal.read(),
            signal: self.signal.signal(),
            nonfinite: self.signal.nonfinite(),
            plausibility: self.signal.plausibility(),
            mask: self.signal.mask(),
            given_mask: None,
            crop: self.signal.crop(),
        };
        let eye = EyeView {
            eye: None,
            reference: self.reference.into(),
            tests: vec![(0, self.test.into())],
            test_layers: self.signal.test_layer().map(|layer| (0, layer)).into_iter().collect(),
            settings,
        };
        let eyes = self.right_eye.with_left(eye, self.view.gaze_hold())?;
        let scene = Scene {
            name: String::new(),
            frames: self.frames,
            allow_missing: self.allow_missing,
            fps: self.fps,
            eyes,
        };
        Ok(Plan {
            // Absolute paths inside the working directory are shown relative to it.
            base: std::env::current_dir().unwrap_or_default(),
            scenes: vec![scene],
            methods: vec![String::new()],
            sweeps: Vec::new(),
            metrics: self.metrics.choice(),
            params: self.metrics.params()?,
            frames: None,
            hash_inputs: false,
            maps: self.maps.is_some(),
            crops: Vec::new(),
            pictures: WantedPictures::default(),
        })
    }
}

//! `fovqa gallery`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use fovqa::{BuiltinSpec, GalleryRequest, SceneName};
use fovqa_params::Words;
use fovqa_plan::Eye;
use fovqa_vision::ViewSpec;

use super::curves::resolution;
use super::values::{finite, positive, words};
use super::view::ViewSpecArgs;

pub(crate) const EXAMPLES: &str = "\
The built-in scenes need no file. The gallery is a hall with railings, texts, plants, spheres and
windows, through which a viewer walks; the others are flat patterns. DIR gets exr/0000.exr (linear
light, with motion.X, motion.Y and Z), png/0000.png, gaze.csv and camera.json, and for two eyes a
folder each, left and right. In an experiment, builtin = \"gallery\" takes the place of reference.

Examples:
  fovqa gallery --output hall --display vive-pro-eye
  fovqa gallery --output walk --resolution 960x1080 --fov-vertical 100 --frames 300 --samples 16
  fovqa gallery --output eyes --display vive-pro-eye --eye both
  fovqa gallery --output chart --scene csf-chart --resolution 1920x1080 --fov-vertical 60

Exit codes: 0 done; 2 the command line is wrong; 3 a file cannot be written; 70 a bug in fovqa; 130
interrupted.";

/// Which eye sees the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum EyeChoice {
    /// The left eye.
    Left,
    /// The right eye.
    Right,
    /// Both eyes.
    Both,
}

#[derive(Debug, Args)]
pub(crate) struct GalleryArgs {
    /// The folder for the files
    #[arg(long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// The scene
    #[arg(long, value_name = "NAME", default_value = "gallery", value_parser = words::<SceneName>())]
    scene: SceneName,
    /// Number of frames
    #[arg(long, value_name = "N", default_value_t = 1)]
    frames: usize,
    /// Frames per second
    #[arg(long, value_name = "N", default_value = "90", value_parser = positive)]
    fps: f64,
    /// Samples for each pixel
    #[arg(long, value_name = "N", default_value_t = 16)]
    samples: usize,
    /// Seed of everything that looks random
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// The eye that sees the scene [default: one in the middle between both]
    #[arg(long, value_name = "EYE")]
    eye: Option<EyeChoice>,
    /// Distance between the pupils, millimetres
    #[arg(long, value_name = "MM", default_value = "63", value_parser = finite)]
    ipd_mm: f64,
    /// Size of the frames [default: that of --display]
    #[arg(long, value_name = "WxH", value_parser = resolution)]
    resolution: Option<[usize; 2]>,
    /// Threads to work with [default: all cores, or `RAYON_NUM_THREADS`]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
    #[command(flatten)]
    view: ViewSpecArgs,
}

impl GalleryArgs {
    /// What is asked for; the error is a wrong command line.
    pub(crate) fn request(&self) -> Result<GalleryRequest, String> {
        let view = self.view.spec()?;
        let view = view.ok_or_else(|| "the scene needs {view}".to_owned())?;
        let of_display = match &view {
            ViewSpec::Display(display) => Some(display.resolution),
            _ => None,
        };
        let size = self.resolution.or(of_display);
        let size =
            size.ok_or_else(|| "give the size of the frames with --resolution".to_owned())?;
        if !(0.0..=200.0).contains(&self.ipd_mm) {
            return Err("--ipd-mm must be 0 to 200".to_owned());
        }
        let spec = BuiltinSpec {
            scene: self.scene,
            frames: self.frames,
            fps: self.fps,
            samples: self.samples,
            seed: self.seed,
        };
        let eyes = match self.eye {
            None => Vec::new(),
            Some(EyeChoice::Left) => vec![Eye::Left],
            Some(EyeChoice::Right) => vec![Eye::Right],
            Some(EyeChoice::Both) => Eye::all(),
        };
        let ipd_m = self.ipd_mm / 1000.0;
        Ok(GalleryRequest { eyes, ipd_m, ..GalleryRequest::new(spec, size, view) })
    }
}

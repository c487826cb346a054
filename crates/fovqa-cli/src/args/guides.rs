//! `--motion` and `--depth`: the motion and depth that temporal differences and the temporal filter use.

use std::path::PathBuf;

use clap::Args;
use fovqa_io::{DepthChannels, GuideOptions, GuidePreset, MotionChannels, MotionUnit, NamedMotion};
use fovqa_params::Words;

use super::offered::{self, offering};

#[derive(Debug, Args)]
#[command(next_help_heading = "Sequence")]
pub(crate) struct MotionArgs {
    /// Backward motion vectors: auto, none, blender, falcor, unreal, mitsuba, or two OpenEXR channels:
    /// X,Y in pixels to the right and down (X,-Y: y up), or blender:X,Y as a renderer encodes them
    /// (experiment files can also give units and scales)
    #[arg(long, value_name = "WHICH", default_value = "auto", allow_hyphen_values = true, value_parser = offering(motion, offered::guides), hide_possible_values = true)]
    motion: MotionChannels,
    /// Separate OpenEXR files with the motion; they pair with the reference (or input) frames
    #[arg(long, value_name = "PATH")]
    motion_files: Option<PathBuf>,
}

impl MotionArgs {
    pub(crate) fn channels(&self) -> MotionChannels {
        self.motion.clone()
    }

    pub(crate) fn files(&self) -> Option<PathBuf> {
        self.motion_files.clone()
    }
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Sequence")]
pub(crate) struct GuideArgs {
    #[command(flatten)]
    motion: MotionArgs,
    /// Depth: auto, none, blender, falcor, unreal, mitsuba, or the name of an OpenEXR channel
    #[arg(long, value_name = "WHICH", default_value = "auto", value_parser = offering(depth, offered::guides), hide_possible_values = true)]
    depth: DepthChannels,
    /// Separate OpenEXR files with the depth; they pair with the reference frames
    #[arg(long, value_name = "PATH")]
    depth_files: Option<PathBuf>,
}

fn preset(word: &str) -> Option<GuidePreset> {
    GuidePreset::find(&word.to_lowercase())
}

fn motion(text: &str) -> Result<MotionChannels, String> {
    match text.to_lowercase().as_str() {
        "auto" => return Ok(MotionChannels::Auto),
        "none" => return Ok(MotionChannels::None),
        _ => {}
    }
    if let Some(preset) = preset(text) {
        return Ok(MotionChannels::Preset(preset));
    }
    let of_preset = text.split_once(':').and_then(|(word, rest)| Some((preset(word)?, rest)));
    let names = of_preset.map_or(text, |(_, names)| names);
    let names: Vec<&str> = names.split(',').map(str::trim).collect();
    let &[x, y] = names.as_slice() else { return Err(MOTION_FORMS.to_owned()) };
    if let Some((preset, _)) = of_preset {
        let channels = [x, y].map(str::to_owned);
        return if channels.iter().any(String::is_empty) {
            Err(MOTION_FORMS.to_owned())
        } else {
            Ok(MotionChannels::NamedAs(preset, channels))
        };
    }
    let [x, y] = [x, y].map(signed);
    let channels = [x.1.to_owned(), y.1.to_owned()];
    if channels.iter().any(String::is_empty) {
        return Err(MOTION_FORMS.to_owned());
    }
    if x.0.is_none() && y.0.is_none() {
        check_plain(&channels)?;
    }
    Ok(MotionChannels::Named(NamedMotion {
        channels,
        sign: [x.0, y.0].map(|sign| sign.unwrap_or(1.0)),
        scale: [1.0; 2],
        unit: MotionUnit::Pixels,
    }))
}

/// The forms that `--motion` accepts.
const MOTION_FORMS: &str = "write auto, none, blender, falcor, unreal, mitsuba, two channels \
                            separated by a comma, or RENDERER:X,Y with the two channels of a renderer";

/// The sign before the name of a channel, if there is one, and the name.
fn signed(name: &str) -> (Option<f64>, &str) {
    match (name.strip_prefix('-'), name.strip_prefix('+')) {
        (Some(name), _) => (Some(-1.0), name),
        (_, Some(name)) => (Some(1.0), name),
        (None, None) => (None, name),
    }
}

/// Refuses channel names for which a renderer writes other values than pixels to the right and
/// down, unless the argument states the form of the values.
fn check_plain(channels: &[String; 2]) -> Result<(), String> {
    match GuidePreset::of_motion(channels).filter(|preset| !preset.is_plain()) {
        None => Ok(()),
        Some(preset) => {
            let ([x, y], renderer) = (channels, preset.word());
            Err(format!(
                "{renderer} writes these channels in another encoding than pixels to the right and down: \
                 write --motion {renderer}, or --motion {renderer}:{x},{y} for exactly these; \
                 if they do hold pixels to the right and down, --motion +{x},+{y}"
            ))
        }
    }
}

fn depth(text: &str) -> Result<DepthChannels, String> {
    let named = || DepthChannels::Named(text.trim().to_owned());
    match text.to_lowercase().as_str() {
        "auto" => Ok(DepthChannels::Auto),
        "none" | "off" => Ok(DepthChannels::None),
        "" => Err("write auto, none, a renderer, or the name of a channel".to_owned()),
        _ => Ok(preset(text).map_or_else(named, DepthChannels::Preset)),
    }
}

impl GuideArgs {
    pub(crate) fn options(&self) -> GuideOptions {
        GuideOptions { motion: self.motion.channels(), depth: self.depth.clone() }
    }

    pub(crate) fn files(&self) -> (Option<PathBuf>, Option<PathBuf>) {
        (self.motion.files(), self.depth_files.clone())
    }
}

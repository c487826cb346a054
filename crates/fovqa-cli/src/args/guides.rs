//! `--motion`, `--depth`: what differences over time are taken along.

use std::path::PathBuf;

use clap::Args;
use fovqa_io::{DepthChannels, GuideOptions, GuidePreset, MotionChannels, MotionUnit, NamedMotion};

#[derive(Debug, Args)]
#[command(next_help_heading = "Sequence")]
pub(crate) struct GuideArgs {
    /// Backward motion vectors: auto, none, blender, falcor, unreal, mitsuba, or the names of two
    /// OpenEXR channels, X,Y in pixels (experiments can give them signs and units)
    #[arg(long, verbatim_doc_comment, value_name = "WHICH", default_value = "auto", value_parser = motion)]
    motion: MotionChannels,
    /// OpenEXR files that hold the motion alone; they pair with the reference frames
    #[arg(long, value_name = "PATH")]
    motion_files: Option<PathBuf>,
    /// Depth: auto, none, blender, falcor, unreal, mitsuba, or the name of an OpenEXR channel
    #[arg(long, value_name = "WHICH", default_value = "auto", value_parser = depth)]
    depth: DepthChannels,
    /// OpenEXR files that hold the depth alone; they pair with the reference frames
    #[arg(long, value_name = "PATH")]
    depth_files: Option<PathBuf>,
}

fn preset(word: &str) -> Option<GuidePreset> {
    GuidePreset::ALL.into_iter().find(|preset| preset.name() == word.to_lowercase())
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
    match text.split(',').map(str::trim).collect::<Vec<_>>().as_slice() {
        [x, y] if !x.is_empty() && !y.is_empty() => Ok(MotionChannels::Named(NamedMotion {
            channels: [(*x).to_owned(), (*y).to_owned()],
            sign: [1.0; 2],
            scale: [1.0; 2],
            unit: MotionUnit::Pixels,
        })),
        _ => {
            Err("write auto, none, blender, falcor, unreal, mitsuba, or two channels with a comma \
                  between them"
                .to_owned())
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
        GuideOptions { motion: self.motion.clone(), depth: self.depth.clone() }
    }

    pub(crate) fn files(&self) -> (Option<PathBuf>, Option<PathBuf>) {
        (self.motion_files.clone(), self.depth_files.clone())
    }
}

//! `motion` and `depth`: the channels and files that contain them.

use std::path::{Path, PathBuf};

use fovqa_io::{DepthChannels, GuideOptions, GuidePreset, MotionChannels, NamedMotion};
use fovqa_params::Words;

use super::placeholders::{Placeholders, path};
use crate::fault::{Fault, Faults};
use crate::node::Node;

/// The channels of motion and depth, and the separate files that contain only these.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Guides {
    pub(super) options: GuideOptions,
    pub(super) motion_files: Option<PathBuf>,
    pub(super) depth_files: Option<PathBuf>,
}

/// Resolves the tables that contain `motion` and `depth`.
pub(super) fn guides(
    motion: Option<Node<'_>>,
    depth: Option<Node<'_>>,
    base: &Path,
    placeholders: Placeholders<'_>,
    faults: &mut Faults,
) -> Guides {
    let files = |table: Option<Node<'_>>, faults: &mut Faults| {
        let table = table?;
        path(placeholders, base, table.text("files")?, table.span("files"), faults)
    };
    let motion_table = motion.and_then(|at| at.table("motion"));
    let depth_table = depth.and_then(|at| at.table("depth"));
    Guides {
        motion_files: files(motion_table, faults),
        depth_files: files(depth_table, faults),
        options: GuideOptions {
            motion: match (motion_table, motion.and_then(|at| at.text("motion"))) {
                (Some(table), _) => named_motion(table, faults),
                (None, Some("none")) => MotionChannels::None,
                (None, Some(word)) => {
                    GuidePreset::find(word).map_or(MotionChannels::Auto, MotionChannels::Preset)
                }
                (None, None) => MotionChannels::Auto,
            },
            depth: match (depth_table, depth.and_then(|at| at.text("depth"))) {
                (Some(table), _) => named_depth(table, faults),
                (None, Some("none")) => DepthChannels::None,
                (None, Some(word)) => {
                    GuidePreset::find(word).map_or(DepthChannels::Auto, DepthChannels::Preset)
                }
                (None, None) => DepthChannels::Auto,
            },
        },
    }
}

fn named_motion(table: Node<'_>, faults: &mut Faults) -> MotionChannels {
    either(table, "channels", faults);
    let Some(names) = table.names("channels") else {
        for key in ["sign", "scale", "unit", "encoding"].into_iter().filter(|key| table.has(key)) {
            let message = format!("{key} describes channels, but none are named");
            let fault = Fault::new(table.span(key), message);
            faults.push(fault.help("add channels = [\"…\", \"…\"]: a preset has its own"));
        }
        let named = table.word("preset");
        return named.map_or(MotionChannels::Auto, MotionChannels::Preset);
    };
    let Ok([x, y]) = <[(&str, _); 2]>::try_from(names) else { return MotionChannels::Auto };
    let channels = [x.0.to_owned(), y.0.to_owned()];
    let own = ["sign", "scale", "unit"].into_iter().find(|key| table.has(key));
    if let Some(preset) = table.word("encoding") {
        if let Some(key) = own {
            let message = format!("both {key} and an encoding with its own {key} are given");
            let fault = Fault::new(table.span(key), message);
            faults.push(fault.label("given together with encoding").help("keep one of them"));
        }
        return MotionChannels::NamedAs(preset, channels);
    }
    let known = GuidePreset::of_motion(&channels).filter(|preset| !preset.is_plain());
    if let Some(preset) = known.filter(|_| own.is_none()) {
        // Without further keys, the values are in the form that the renderer writes.
        let renderer = preset.word();
        let message = format!(
            "{renderer} writes these channels in another encoding than pixels to the right and down"
        );
        let help = format!(
            "add encoding = \"{renderer}\", or sign = [1, 1] if they do hold pixels to the right and down"
        );
        faults.push(Fault::new(table.span("channels"), message).help(help));
    }
    let sign = table.array("sign").unwrap_or([1.0; 2]);
    if sign.iter().any(|sign| sign.abs() < 1.0) {
        let fault = Fault::new(table.span("sign"), "a sign must be 1 or -1");
        faults.push(fault.help("use scale for other factors"));
    }
    let scale = table.number("scale").map(|scale| [scale; 2]).or_else(|| table.array("scale"));
    let scale = scale.unwrap_or([1.0; 2]);
    if scale.contains(&0.0) {
        faults.push(Fault::new(table.span("scale"), "a scale of 0 removes all motion"));
    }
    MotionChannels::Named(NamedMotion {
        channels,
        sign,
        scale,
        unit: table.word("unit").unwrap_or_default(),
    })
}

fn named_depth(table: Node<'_>, faults: &mut Faults) -> DepthChannels {
    either(table, "channel", faults);
    match (table.text("channel"), table.word("preset")) {
        (Some(name), _) => DepthChannels::Named(name.to_owned()),
        (None, Some(preset)) => DepthChannels::Preset(preset),
        (None, None) => DepthChannels::Auto,
    }
}

/// Checks that a table has either channels or a preset.
fn either(table: Node<'_>, channels: &str, faults: &mut Faults) {
    if table.has(channels) && table.has("preset") {
        let message = format!("both {channels} and a preset are given");
        let fault = Fault::new(table.span("preset"), message);
        faults
            .push(fault.label(format!("given together with {channels}")).help("keep one of them"));
    }
}

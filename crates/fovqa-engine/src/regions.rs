//! The regions of frames that figures show: in which frames they are, and which of them do not
//! exist.

use fovqa_plan::{CropRegion, Eye, Plan};

use crate::events::Events;
use crate::found::{FoundInputs, FoundView};
use crate::found_frame::FoundFrame;

/// A region in a frame of one eye's view, which a run cuts out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundRegion<'a> {
    /// The region.
    pub region: &'a CropRegion,
    /// The name of the scene.
    pub scene: &'a str,
    /// The eye; `None` if the scene has one image per frame.
    pub eye: Option<Eye>,
    /// The number of the frame.
    pub frame: i64,
}

/// The regions of a plan in the frames that were found. A frame whose size is not known before it is
/// read has none of them.
pub fn found_regions<'a>(plan: &'a Plan, found: &FoundInputs) -> Vec<FoundRegion<'a>> {
    let mut regions = Vec::new();
    for view in &found.views {
        let scene = &plan.scenes[view.scene];
        for region in plan.crops.iter().filter(|region| region.is_in(&scene.name)) {
            let Some(frame) = frame_of(region, view) else { continue };
            let is_within = size(plan, view, frame).is_some_and(|s| region.corner(s).is_some());
            if is_within {
                let (eye, frame) = (scene.eyes[view.eye].eye, frame.number);
                regions.push(FoundRegion { region, scene: &scene.name, eye, frame });
            }
        }
    }
    regions
}

/// Warns of the regions that are left out because a frame does not exist or is too small. Each
/// region is named once.
pub fn warn_of_regions(plan: &Plan, found: &FoundInputs, events: &dyn Events) {
    for region in &plan.crops {
        let is_of = |view: &&FoundView| region.is_in(&plan.scenes[view.scene].name);
        let views: Vec<&FoundView> = found.views.iter().filter(is_of).collect();
        let message = without_frame(plan, region, &views).or_else(|| outside(plan, region, &views));
        if let Some(message) = message {
            events.warn(&format!("the region \"{}\" is left out{message}", region.name));
        }
    }
}

/// The frame of a region in a view.
fn frame_of<'a>(region: &CropRegion, view: &'a FoundView) -> Option<&'a FoundFrame> {
    match region.frame {
        None => view.frames.first(),
        Some(number) => view.frames.iter().find(|frame| frame.number == number),
    }
}

/// The size of the visible part of a frame, as far as it is known before the frame is read.
fn size(plan: &Plan, view: &FoundView, frame: &FoundFrame) -> Option<(usize, usize)> {
    let crop = plan.scenes[view.scene].eyes[view.eye].settings.crop;
    let of_file = view.sources.reference.size(frame.reference).ok()?;
    Some(crop.map_or(of_file, |crop| (crop.width, crop.height)))
}

/// What is wrong with a region whose frame none of the views has.
fn without_frame(plan: &Plan, region: &CropRegion, views: &[&FoundView]) -> Option<String> {
    const SHOWN: usize = 3;
    let number = region.frame?;
    if views.is_empty() || views.iter().any(|view| frame_of(region, view).is_some()) {
        return None;
    }
    let mut ranges: Vec<String> = Vec::new();
    for view in views {
        let [first, .., last] = view.frames.as_slice() else {
            let only = view.frames.first().map(|frame| format!("frame {}", frame.number));
            ranges.extend(only.map(|only| format!("{} has {only}", plan.scenes[view.scene].name)));
            continue;
        };
        let scene = &plan.scenes[view.scene].name;
        let range = format!("{scene} has frames {} to {}", first.number, last.number);
        if !ranges.contains(&range) {
            ranges.push(range);
        }
    }
    let more = ranges.len().saturating_sub(SHOWN);
    ranges.truncate(SHOWN);
    let more = if more > 0 { format!(", and {more} more") } else { String::new() };
    Some(format!(": there is no frame {number} ({}{more})", ranges.join(", ")))
}

/// What is wrong with a region that is not within all of its frames.
fn outside(plan: &Plan, region: &CropRegion, views: &[&FoundView]) -> Option<String> {
    let mut scenes: Vec<&str> = Vec::new();
    let mut first_size = None;
    let mut is_somewhere = false;
    for view in views {
        let Some(size) = frame_of(region, view).and_then(|frame| size(plan, view, frame)) else {
            continue;
        };
        let scene = plan.scenes[view.scene].name.as_str();
        if region.corner(size).is_some() {
            is_somewhere = true;
        } else if !scenes.contains(&scene) {
            scenes.push(scene);
            first_size.get_or_insert(size);
        }
    }
    let (width, height) = first_size?;
    let [at_x, at_y] = region.at;
    let [wide, high] = region.size;
    let place = match scenes.as_slice() {
        [first, more @ ..] if is_somewhere && !more.is_empty() => {
            format!(" of \"{first}\" and of {} more", more.len())
        }
        [first] if is_somewhere => format!(" of \"{first}\""),
        _ => String::new(),
    };
    let possible = if wide > width || high > height {
        format!("a region can have at most {width}x{height} px")
    } else {
        let far = |side: usize, of: usize| side as f64 - of as f64 / 2.0;
        format!(
            "the centre of a region of this size can be from [{}, {}] to [{}, {}]",
            wide as f64 / 2.0,
            high as f64 / 2.0,
            far(width, wide),
            far(height, high)
        )
    };
    Some(format!(
        "{place}: {wide}x{high} px around [{at_x}, {at_y}] are not within the frame of \
         {width}x{height}; {possible}"
    ))
}

/// Whether [`warn_of_regions`] knows the size of a frame.
pub(crate) fn is_foreseen(view: &FoundView, frame: &FoundFrame) -> bool {
    view.sources.reference.size(frame.reference).is_ok()
}

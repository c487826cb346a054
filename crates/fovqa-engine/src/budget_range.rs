//! The budgets that a method can have over all frames of a view.

use std::collections::BTreeSet;

use fovqa_emulate::EmulationSpec;
use fovqa_plan::EyeView;

use crate::error::EngineError;
use crate::found::FoundView;
use crate::foveator;
use crate::view_frame::fixed_gaze;

/// The smallest and the largest budget that a method can have at every gaze of a view, counted as its spec
/// says; `None` if the size of its frames cannot be found out.
///
/// # Errors
/// If the method cannot be applied, or has no parameter that a budget could set.
pub fn budget_range(
    view: &FoundView,
    eye: &EyeView,
    spec: &EmulationSpec,
) -> Result<Option<[f64; 2]>, EngineError> {
    let Some(size) = view.frame_size(eye) else { return Ok(None) };
    let traced = view.trace.iter().flatten().map(|gaze| Some(gaze.px.map(f64::to_bits)));
    let mut gazes: BTreeSet<Option<[u64; 2]>> = traced.collect();
    if gazes.is_empty() {
        gazes.insert(fixed_gaze(eye).map(|gaze| gaze.map(f64::to_bits)));
    }
    let mut range = [0.0, f64::INFINITY];
    for gaze in gazes {
        let gaze = gaze.map(|gaze| gaze.map(f64::from_bits));
        let [least, most] = foveator::budget_range(spec, eye.settings.view.as_ref(), size, gaze)?;
        range = [f64::max(range[0], least), f64::min(range[1], most)];
    }
    Ok(Some(range))
}

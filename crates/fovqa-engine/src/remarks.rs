//! Remarks for the user about the frames that were found, before any pixel is read.

use fovqa_frame::source::{Length, Numbering, Source};
use fovqa_io::sequence::Spacing;
use fovqa_plan::{EyeView, Gaze, Plan, Scene};

use crate::error::EngineError;
use crate::found::is_wanted;
use crate::view_sources::ViewSources;

/// Remarks for the user about the frames of a view.
///
/// # Errors
/// If frames are requested by number, but the names have no numbers.
pub(crate) fn remarks(
    plan: &Plan,
    scene: &Scene,
    view: &EyeView,
    sources: &ViewSources,
    (numbering, spacing): (&Numbering, &Spacing),
) -> Result<Vec<String>, EngineError> {
    let by_number = if matches!(view.settings.gaze, Gaze::Trace { .. }) {
        Some("a gaze trace")
    } else if scene.frames.or(plan.frames).is_some() {
        Some("a selection of frames")
    } else {
        None
    };
    let mut remarks = Vec::new();
    match (numbering, by_number) {
        (Numbering::Doubtful(doubt), Some(what)) => {
            let argument = sources.reference.listing().argument.clone();
            return Err(EngineError::NoNumbers { argument, what, doubt: doubt.clone() });
        }
        (Numbering::Doubtful(doubt), None) => {
            let doubt = doubt.in_words();
            remarks.push(format!(
                "{}: the numbers in the file names do not identify the frames: {doubt}; frames are numbered by \
                 their position from 0, and a pattern such as 'f_%04d.png' selects one sequence",
                sources.reference.listing().argument
            ));
        }
        (Numbering::LastOfSeveral(name), Some(what)) => remarks.push(format!(
            "{name} has several numbers, and {what} uses the last one: if this is not the frame number, give a \
             pattern such as 'f_%04d.png'"
        )),
        _ => {}
    }
    let missing = spacing.missing(|number| is_wanted(plan, scene, number));
    if !missing.is_empty() {
        let (are, them) = if missing.count() == 1 { ("is", "it") } else { ("are", "them") };
        remarks.push(format!(
            "{missing} {are} missing in reference and test; no difference over time is computed across {them}"
        ));
    }
    for listing in sources.all().map(Source::listing) {
        if let Some(Length::Damaged(frames)) = listing.length() {
            remarks.push(format!(
                "{}: its frame {} is damaged, and no frame after it can be found",
                listing.argument,
                frames.saturating_sub(1)
            ));
        }
    }
    let mut rates = sources.all().filter_map(|source| Some((source.fps()?, source)));
    if scene.fps.is_none()
        && let Some((rate, first)) = rates.next()
        && let Some((other, second)) = rates.find(|(other, _)| other.to_bits() != rate.to_bits())
    {
        let [first, second] = [first, second].map(|source| &source.listing().argument);
        remarks.push(format!(
            "{first} has {} frames per second, but {second} has {}; the first rate is used unless {{fps}} is given",
            shown(rate),
            shown(other)
        ));
    }
    Ok(remarks)
}

/// Rounds a frame rate to the decimals that a message shows.
fn shown(rate: f64) -> f64 {
    (rate * 1000.0).round() / 1000.0
}

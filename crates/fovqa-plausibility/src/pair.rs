//! A pair, and the order in which it is checked.

use fovqa_frame::{Frame, Mask, SignalTables};

use crate::sample::Sample;
use crate::suspicion::{Check, Suspicion};
use crate::{brightness, channels, constant, scene, sharpness, shift};

/// The smallest number of windows from which anything but a constant picture is concluded.
const FEWEST_WINDOWS: usize = 64;

/// A pair to be looked at. Both frames have the same size.
#[derive(Debug, Clone, Copy)]
pub struct Looked<'a> {
    /// The reference.
    pub reference: &'a Frame,
    /// The test.
    pub test: &'a Frame,
    /// How samples become the signal.
    pub tables: &'a SignalTables,
    /// The pixels that are scored; `None` means all.
    pub counts: Option<&'a Mask>,
    /// The gaze in pixels; `None` if eccentricity does not matter.
    pub gaze_px: Option<[f64; 2]>,
}

/// Looks only for pictures of one colour, which takes nearly no time.
pub fn glance(pair: &Looked<'_>) -> Vec<Suspicion> {
    constant::check(pair).into_iter().collect()
}

/// Looks for mistakes. Returns the likely ones, the gravest first: once the pictures do not show the same,
/// nothing else is concluded from them.
pub fn look(pair: &Looked<'_>) -> Vec<Suspicion> {
    if let Some(constant) = constant::check(pair) {
        return vec![constant];
    }
    let mut sample = Sample::new(pair.reference, pair.test, pair.tables, pair.counts);
    if sample.counted().count() < FEWEST_WINDOWS {
        return Vec::new();
    }
    let grave = brightness::of_clipped(pair, &sample)
        .or_else(|| constant::of_windows(&mut sample))
        .or_else(|| {
            // A shift changes as much as another scene.
            let other = scene::check(&sample)?;
            let shift = (other.check == Check::Scene).then(|| shift::search(pair)).flatten();
            Some(shift.unwrap_or(other))
        })
        .or_else(|| shift::check(pair, &sample));
    if let Some(grave) = grave {
        return vec![grave];
    }
    let mut suspicions = Vec::from_iter(brightness::check(pair, &sample));
    // Light that differs changes detail too.
    if suspicions.is_empty() && scene::is_alike(&sample) {
        suspicions.extend(sharpness::check(&sample, pair.gaze_px));
    }
    suspicions.extend(channels::check(pair, &sample));
    suspicions
}

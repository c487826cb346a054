//! Warnings about the view and the gaze, each reported once.

use fovqa_engine::Events;
use fovqa_vision::ViewSpec;

/// Reports warnings, each once for all frames.
pub(super) struct Warned<'a> {
    events: &'a dyn Events,
    frames: usize,
    gaze: bool,
}

impl<'a> Warned<'a> {
    pub(super) fn new(events: &'a dyn Events, frames: usize) -> Self {
        Self { events, frames, gaze: false }
    }

    /// Warns of a view that does not fit the frames or looks wrong.
    pub(super) fn of_view(&self, spec: Option<&ViewSpec>, [width, height]: [usize; 2]) {
        // A view that is not possible was an error before.
        let Some((spec, Ok(resolved))) = spec.map(|spec| (spec, spec.resolve(width, height)))
        else {
            return;
        };
        if let Some([across, down]) = resolved.stretched_from {
            self.say(&format!(
                "frames of {width}x{height} are stretched over the display's {across}x{down}: they fill its \
                 whole field"
            ));
        }
        for doubt in spec.doubts(&resolved.view) {
            self.say(&doubt);
        }
    }

    /// Warns of a gaze outside the frame.
    pub(super) fn of_gaze(&mut self, [x, y]: [f64; 2], [width, height]: [usize; 2]) {
        let inside = |at: f64, side: usize| (0.0..=side as f64).contains(&at);
        if self.gaze || (inside(x, width) && inside(y, height)) {
            return;
        }
        self.gaze = true;
        self.say(&format!(
            "the gaze ({x}, {y}) is outside the frame of {width}x{height}; the nearest point of the frame is used"
        ));
    }

    fn say(&self, message: &str) {
        let once = if self.frames > 1 { " (said once for all frames)" } else { "" };
        self.events.warn(&format!("{message}{once}"));
    }
}

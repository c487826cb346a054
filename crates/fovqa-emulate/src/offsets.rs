//! Pixels as they are seen from the gaze.

use std::ops::Range;

use fovqa_methods::Setting;

/// Offsets of pixel centres from the gaze along both axes, in pixels.
#[derive(Debug, Clone)]
pub(crate) struct Offsets {
    pub(crate) x: Vec<f32>,
    pub(crate) y: Vec<f32>,
    gaze_px: [f64; 2],
    size_px: [f64; 2],
}

impl Offsets {
    pub(crate) fn new(setting: &Setting) -> Self {
        let (size_px, gaze_px) = (setting.size_px(), setting.gaze_px());
        let along = |axis: usize| {
            let offset = |i: usize| (i as f64 + 0.5 - gaze_px[axis]) as f32;
            (0..size_px[axis] as usize).map(offset).collect()
        };
        Self { x: along(0), y: along(1), gaze_px, size_px }
    }

    /// The gaze in pixels.
    pub(crate) fn gaze_px(&self) -> [f64; 2] {
        self.gaze_px
    }

    /// Width of the frame in pixels.
    pub(crate) fn width(&self) -> usize {
        self.x.len()
    }

    /// Height of the frame in pixels.
    pub(crate) fn height(&self) -> usize {
        self.y.len()
    }

    /// The pixels of row `y` whose centres are within a distance of the gaze.
    pub(crate) fn within(&self, y: usize, radius_px: f64) -> Range<usize> {
        let dy = y as f64 + 0.5 - self.gaze_px[1];
        let square = radius_px * radius_px - dy * dy;
        if square.is_nan() || square < 0.0 {
            return 0..0;
        }
        let half = square.sqrt();
        let [gx, width] = [self.gaze_px[0], self.size_px[0]];
        let first = (gx - half - 0.5).ceil().clamp(0.0, width);
        let behind = ((gx + half - 0.5).floor() + 1.0).clamp(first, width);
        first as usize..behind as usize
    }

    /// Squared distances of the pixels `xs` of row `y` from the gaze.
    pub(crate) fn squares(&self, y: usize, xs: Range<usize>) -> impl Iterator<Item = f32> + '_ {
        let dy = self.y[y];
        self.x[xs].iter().map(move |dx| dx * dx + dy * dy)
    }
}

//! Pictures of 8-bit codes, and what can be done to them.

use std::path::Path;

use fovqa_frame::{Channels, Frame, FrameSignal, SignalParams, SignalTables};
use fovqa_io::{ReadOptions, read_frame};
use fovqa_plausibility::{Looked, Suspicion, look};
use fovqa_testkit::synthetic::{Xorshift, rgb8};

/// A colour picture with values from 0 to 1, the channels of a pixel side by side.
#[derive(Debug, Clone)]
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: Vec<f32>,
}

/// A pair with the gaze in pixels.
#[derive(Debug, Clone)]
pub(crate) struct Pair {
    pub(crate) name: String,
    pub(crate) reference: Picture,
    pub(crate) test: Picture,
    pub(crate) gaze: [f64; 2],
}

pub(crate) fn read(path: &Path, exposure_stops: f64) -> Picture {
    let frame =
        read_frame(path, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}")).frame;
    let tables = SignalTables::new(SignalParams { exposure_stops, ..SignalParams::default() });
    let signal = FrameSignal::new(&frame, &tables);
    assert_eq!(signal.channels(), Channels::Rgb);
    let (width, height) = (signal.width(), signal.height());
    let mut values = vec![0.0; width * height * 3];
    for (y, row) in values.chunks_exact_mut(width * 3).enumerate() {
        signal.fill_row(y, row);
    }
    Picture { width, height, values }
}

impl Pair {
    pub(crate) fn look(&self) -> Vec<Suspicion> {
        let tables = SignalTables::new(SignalParams::default());
        let [reference, test] = [&self.reference, &self.test].map(Picture::frame);
        look(&Looked {
            reference: &reference,
            test: &test,
            tables: &tables,
            counts: None,
            gaze_px: Some(self.gaze),
        })
    }
}

impl Picture {
    pub(crate) fn frame(&self) -> Frame {
        let codes = self.values.iter().map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u8).collect();
        rgb8(self.width, self.height, codes)
    }

    /// The pixel at a place; outside, that of the nearest edge.
    fn at(&self, x: isize, y: isize) -> [f32; 3] {
        let x = x.clamp(0, self.width as isize - 1) as usize;
        let y = y.clamp(0, self.height as isize - 1) as usize;
        let at = (y * self.width + x) * 3;
        [self.values[at], self.values[at + 1], self.values[at + 2]]
    }

    fn from(width: usize, height: usize, pixel: impl Fn(isize, isize) -> [f32; 3]) -> Self {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x as isize, y as isize)));
        let values = places.flat_map(|(x, y)| pixel(x, y)).collect();
        Self { width, height, values }
    }

    /// Each value is changed.
    pub(crate) fn map(&self, with: impl Fn(f32) -> f32) -> Self {
        Self { values: self.values.iter().map(|v| with(*v)).collect(), ..*self }
    }

    /// The content moves by whole pixels to the right and down.
    pub(crate) fn shifted(&self, [dx, dy]: [isize; 2]) -> Self {
        Self::from(self.width, self.height, |x, y| self.at(x - dx, y - dy))
    }

    pub(crate) fn flipped(&self, across: bool, down: bool) -> Self {
        let (w, h) = (self.width as isize, self.height as isize);
        Self::from(self.width, self.height, |x, y| {
            self.at(if across { w - 1 - x } else { x }, if down { h - 1 - y } else { y })
        })
    }

    /// Another picture, stretched to this size.
    pub(crate) fn filled_from(&self, other: &Picture) -> Self {
        let along = |at: isize, of: usize, to: usize| at * of as isize / to as isize;
        Self::from(self.width, self.height, |x, y| {
            other.at(along(x, other.width, self.width), along(y, other.height, self.height))
        })
    }

    /// Red and blue in the place of each other.
    pub(crate) fn blue_first(&self) -> Self {
        let swapped = |x, y| {
            let [r, g, b] = self.at(x, y);
            [b, g, r]
        };
        Self::from(self.width, self.height, swapped)
    }

    pub(crate) fn noisy(&self, deviation: f32, seed: u64) -> Self {
        let mut random = Xorshift::new(seed);
        let values = self.values.iter().map(|v| {
            // The sum of twelve uniform numbers is nearly normal.
            let sum: f64 = (0..12).map(|_| random.next_unit()).sum::<f64>() - 6.0;
            v + deviation * sum as f32
        });
        Self { values: values.collect(), ..*self }
    }

    /// Gaussian blur whose standard deviation in pixels depends on the distance to a place in
    /// diagonals, in steps of half a pixel.
    pub(crate) fn blurred(&self, place: [f64; 2], deviation: impl Fn(f64) -> f64) -> Self {
        let diagonal = (self.width as f64).hypot(self.height as f64);
        let step = |x: isize, y: isize| {
            let distance = (x as f64 + 0.5 - place[0]).hypot(y as f64 + 0.5 - place[1]) / diagonal;
            (2.0 * deviation(distance)).round() as usize
        };
        let most =
            (0..4).map(|c| step((c % 2) * self.width as isize, (c / 2) * self.height as isize));
        let most = most.max().unwrap_or(0).max(step(place[0] as isize, place[1] as isize));
        let levels: Vec<Picture> = (0..=most).map(|n| self.smoothed(n as f64 / 2.0)).collect();
        Self::from(self.width, self.height, |x, y| levels[step(x, y).min(most)].at(x, y))
    }

    fn smoothed(&self, deviation: f64) -> Self {
        if deviation <= 0.0 {
            return self.clone();
        }
        let radius = (3.0 * deviation).ceil() as isize;
        let kernel: Vec<f32> = (-radius..=radius)
            .map(|i| (-(i * i) as f64 / (2.0 * deviation * deviation)).exp() as f32)
            .collect();
        let total: f32 = kernel.iter().sum();
        let along = |picture: &Picture, dx: isize, dy: isize| {
            Self::from(self.width, self.height, |x, y| {
                let mut sum = [0.0; 3];
                for (k, i) in kernel.iter().zip(-radius..=radius) {
                    let pixel = picture.at(x + dx * i, y + dy * i);
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += k / total * value;
                    }
                }
                sum
            })
        };
        along(&along(self, 1, 0), 0, 1)
    }

    /// Blocks of equal pixels, larger away from a place: 1, 2, 4 pixels.
    pub(crate) fn in_blocks(&self, place: [f64; 2]) -> Self {
        let diagonal = (self.width as f64).hypot(self.height as f64);
        Self::from(self.width, self.height, |x, y| {
            let distance = (x as f64 - place[0]).hypot(y as f64 - place[1]) / diagonal;
            let side = if distance < 0.15 {
                1
            } else if distance < 0.3 {
                2
            } else {
                4
            };
            self.at(x / side * side + side / 2, y / side * side + side / 2)
        })
    }

    /// Black outside a circle that the frame encloses, as a lens shows it.
    pub(crate) fn in_circle(&self) -> Self {
        let (w, h) = (self.width as f64, self.height as f64);
        let radius = 0.5 * w.max(h);
        Self::from(self.width, self.height, |x, y| {
            let far = (x as f64 + 0.5 - w / 2.0).hypot(y as f64 + 0.5 - h / 2.0) > radius;
            if far { [0.0; 3] } else { self.at(x, y) }
        })
    }
}

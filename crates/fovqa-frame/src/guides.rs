//! Motion and depth of a frame: where its pixels were in the previous frame, and how far away they
//! are.

use std::ops::Range;

use half::f16;
use half::slice::HalfFloatSliceExt;

use crate::frame::{Crop, CropError, FrameError};

/// The samples of a plane, row by row, in the type of the file.
#[derive(Debug, Clone, PartialEq)]
pub enum PlaneSamples {
    /// Half floats.
    F16(Vec<f16>),
    /// Floats.
    F32(Vec<f32>),
}

impl PlaneSamples {
    fn len(&self) -> usize {
        match self {
            PlaneSamples::F16(s) => s.len(),
            PlaneSamples::F32(s) => s.len(),
        }
    }
}

/// One channel of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    width: usize,
    height: usize,
    samples: PlaneSamples,
    /// The visible part, within `width` x `height`.
    crop: Crop,
}

impl Plane {
    /// Makes a plane of samples and a size in pixels.
    ///
    /// # Errors
    /// When there are no pixels, or not `width * height` samples.
    pub fn new(width: usize, height: usize, samples: PlaneSamples) -> Result<Self, FrameError> {
        if width == 0 || height == 0 {
            return Err(FrameError::Empty { width, height });
        }
        let expected = width.checked_mul(height);
        if Some(samples.len()) != expected {
            let expected = expected.unwrap_or(usize::MAX);
            return Err(FrameError::SampleCount { found: samples.len(), expected });
        }
        let crop = Crop { x: 0, y: 0, width, height };
        Ok(Self { width, height, samples, crop })
    }

    /// The same plane with only a rectangle of it visible. No sample is copied.
    ///
    /// # Errors
    /// When the rectangle is empty or reaches beyond the plane.
    pub fn cropped(mut self, crop: Crop) -> Result<Self, CropError> {
        self.crop = crop.within(self.crop)?;
        Ok(self)
    }

    /// Width of the visible part in pixels.
    pub fn width(&self) -> usize {
        self.crop.width
    }

    /// Height of the visible part in pixels.
    pub fn height(&self) -> usize {
        self.crop.height
    }

    /// Width and height of the file's own frame, before any crop.
    pub fn file_size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// All samples, including those outside the visible part.
    pub fn samples(&self) -> &PlaneSamples {
        &self.samples
    }

    /// The memory of the samples, in bytes.
    pub fn bytes(&self) -> usize {
        match &self.samples {
            PlaneSamples::F16(s) => size_of_val(s.as_slice()),
            PlaneSamples::F32(s) => size_of_val(s.as_slice()),
        }
    }

    /// Index of the sample where the visible part of row `y` starts.
    fn row_start(&self, y: usize) -> usize {
        (self.crop.y + y) * self.width + self.crop.x
    }

    /// The sample at a visible pixel.
    ///
    /// # Panics
    /// When the pixel is not visible.
    pub fn at(&self, x: usize, y: usize) -> f32 {
        assert!(x < self.width() && y < self.height(), "a visible pixel");
        let at = self.row_start(y) + x;
        match &self.samples {
            PlaneSamples::F16(s) => s[at].to_f32(),
            PlaneSamples::F32(s) => s[at],
        }
    }

    /// Copies the visible columns `xs` of the visible row `y` to `out`, one sample per pixel.
    ///
    /// # Panics
    /// When these pixels are not all visible, or `out` is not as long as `xs`.
    pub fn fill_row(&self, y: usize, xs: Range<usize>, out: &mut [f32]) {
        assert!(xs.end <= self.width() && y < self.height(), "visible pixels");
        let start = self.row_start(y);
        let row = start + xs.start..start + xs.end;
        match &self.samples {
            PlaneSamples::F16(s) => s[row].convert_to_f32_slice(out),
            PlaneSamples::F32(s) => out.copy_from_slice(&s[row]),
        }
    }
}

/// Backward motion: the position of a pixel in the previous frame is its position in this frame
/// plus its motion. x points to the right and y down. Where the motion is unknown, the samples are
/// NaN.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    x: Plane,
    y: Plane,
    scale: [f64; 2],
    offset: [f32; 2],
}

impl Motion {
    /// Motion in pixels as `[x, y] * scale`. `None` unless both planes show the same part of frames
    /// of one size.
    pub fn new(x: Plane, y: Plane, scale: [f64; 2]) -> Option<Self> {
        let alike = x.file_size() == y.file_size() && x.crop == y.crop;
        alike.then_some(Self { x, y, scale, offset: [0.0; 2] })
    }

    /// The same motion for planes in which the sample `offset` stands for no motion: in pixels it
    /// is `([x, y] - offset) * scale`.
    #[must_use]
    pub fn with_offset(self, offset: [f32; 2]) -> Self {
        Self { offset, ..self }
    }

    /// The same motion with only a rectangle of it visible. No sample is copied.
    ///
    /// # Errors
    /// When the rectangle is empty or reaches beyond the frame.
    pub fn cropped(self, crop: Crop) -> Result<Self, CropError> {
        Ok(Self { x: self.x.cropped(crop)?, y: self.y.cropped(crop)?, ..self })
    }

    /// Width of the visible part in pixels.
    pub fn width(&self) -> usize {
        self.x.width()
    }

    /// Height of the visible part in pixels.
    pub fn height(&self) -> usize {
        self.x.height()
    }

    /// Width and height of the file's own frame, before any crop.
    pub fn file_size(&self) -> (usize, usize) {
        self.x.file_size()
    }

    /// The memory of the samples, in bytes.
    pub fn bytes(&self) -> usize {
        self.x.bytes() + self.y.bytes()
    }

    /// Pixels of motion per unit of the samples that [`Self::fill_row`] returns, across and down. A
    /// scale is negative where the axis of the file points the other way.
    pub fn scale(&self) -> [f64; 2] {
        self.scale
    }

    /// Copies the samples of the visible columns `xs` of the visible row `y`. The offset is
    /// subtracted, but the scale is not applied: the motion in pixels is `out_x * scale()[0]` and
    /// `out_y * scale()[1]`.
    ///
    /// # Panics
    /// When these pixels are not all visible, or the slices are not as long as `xs`.
    pub fn fill_row(&self, y: usize, xs: Range<usize>, out_x: &mut [f32], out_y: &mut [f32]) {
        self.x.fill_row(y, xs.clone(), out_x);
        self.y.fill_row(y, xs, out_y);
        for (out, offset) in [out_x, out_y].into_iter().zip(self.offset) {
            if offset != 0.0 {
                for sample in out {
                    *sample -= offset;
                }
            }
        }
    }

    /// The motion of a visible pixel, in pixels across and down.
    ///
    /// # Panics
    /// When the pixel is not visible.
    pub fn at(&self, x: usize, y: usize) -> [f64; 2] {
        let samples = [self.x.at(x, y), self.y.at(x, y)];
        std::array::from_fn(|i| f64::from(samples[i] - self.offset[i]) * self.scale[i])
    }
}

/// The motion and depth of a frame, as far as they exist.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Guides {
    /// The motion from the previous frame.
    pub motion: Option<Motion>,
    /// The distance of each pixel in the renderer's units; NaN where there is none.
    pub depth: Option<Plane>,
}

impl Guides {
    /// The same motion and depth with only a rectangle visible. No sample is copied.
    ///
    /// # Errors
    /// When the rectangle is empty or reaches beyond the frame.
    pub fn cropped(self, crop: Crop) -> Result<Self, CropError> {
        let motion = self.motion.map(|motion| motion.cropped(crop)).transpose()?;
        let depth = self.depth.map(|depth| depth.cropped(crop)).transpose()?;
        Ok(Self { motion, depth })
    }

    /// The memory of the samples, in bytes.
    pub fn bytes(&self) -> usize {
        self.motion.as_ref().map_or(0, Motion::bytes) + self.depth.as_ref().map_or(0, Plane::bytes)
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is only passed on comes back exactly")]
mod tests {
    use super::*;

    const W: usize = 40;
    const H: usize = 5;

    fn value(x: usize, y: usize) -> f32 {
        (100 * y + x) as f32
    }

    fn values() -> Vec<f32> {
        (0..W * H).map(|i| value(i % W, i / W)).collect()
    }

    fn plane() -> Plane {
        Plane::new(W, H, PlaneSamples::F32(values())).unwrap()
    }

    fn half_plane() -> Plane {
        let samples = values().into_iter().map(f16::from_f32).collect();
        Plane::new(W, H, PlaneSamples::F16(samples)).unwrap()
    }

    fn row(plane: &Plane, y: usize, xs: Range<usize>) -> Vec<f32> {
        let mut out = vec![-1.0; xs.len()];
        plane.fill_row(y, xs, &mut out);
        out
    }

    #[test]
    fn a_plane_needs_a_sample_for_every_pixel() {
        let new = |w, h, n| Plane::new(w, h, PlaneSamples::F32(vec![0.0; n])).map(|_| ());
        assert_eq!(new(3, 4, 12), Ok(()));
        assert_eq!(new(3, 4, 11), Err(FrameError::SampleCount { found: 11, expected: 12 }));
        assert_eq!(new(0, 4, 0), Err(FrameError::Empty { width: 0, height: 4 }));
        let expected = usize::MAX;
        assert_eq!(new(usize::MAX, 2, 0), Err(FrameError::SampleCount { found: 0, expected }));
    }

    #[test]
    fn rows_are_those_of_the_visible_part() {
        for plane in [plane(), half_plane()] {
            let plane = plane.cropped(Crop { x: 3, y: 1, width: 30, height: 4 }).unwrap();
            let plane = plane.cropped(Crop { x: 2, y: 1, width: 21, height: 2 }).unwrap();
            assert_eq!((plane.width(), plane.height(), plane.file_size()), (21, 2, (W, H)));
            for y in 0..2 {
                let want: Vec<f32> = (1..20).map(|x| value(x + 5, y + 2)).collect();
                assert_eq!(row(&plane, y, 1..20), want);
                assert_eq!(plane.at(4, y), value(9, y + 2));
            }
            assert!(plane.clone().cropped(Crop { x: 1, y: 0, width: 21, height: 2 }).is_err());
            assert!(plane.cropped(Crop { x: 0, y: 1, width: 21, height: 2 }).is_err());
        }
    }

    #[test]
    #[should_panic(expected = "visible")]
    fn a_row_does_not_run_into_the_next_one() {
        row(&plane().cropped(Crop { x: 0, y: 0, width: 9, height: 5 }).unwrap(), 0, 5..10);
    }

    #[test]
    fn bytes_are_those_of_the_type() {
        assert_eq!((plane().bytes(), half_plane().bytes()), (W * H * 4, W * H * 2));
        let motion = Motion::new(plane(), half_plane(), [1.0; 2]).unwrap();
        let guides = Guides { motion: Some(motion), depth: Some(plane()) };
        assert_eq!(guides.bytes(), W * H * 10);
        assert_eq!(Guides::default().bytes(), 0);
    }

    #[test]
    fn motion_is_of_one_size() {
        let other = Plane::new(H, W, PlaneSamples::F32(values())).unwrap();
        assert!(Motion::new(plane(), other, [1.0; 2]).is_none());
        let cut = |x| plane().cropped(Crop { x, y: 0, width: 9, height: 5 }).unwrap();
        assert!(Motion::new(cut(0), cut(1), [1.0; 2]).is_none());
        assert!(Motion::new(cut(1), cut(1), [1.0; 2]).is_some());
    }

    #[test]
    fn motion_leaves_the_scale_out_of_rows_and_the_offset_in() {
        let motion = Motion::new(plane(), half_plane(), [2.0, -0.5]).unwrap();
        let motion = motion.with_offset([10.0, 0.0]);
        let motion = motion.cropped(Crop { x: 7, y: 2, width: 9, height: 2 }).unwrap();
        assert_eq!((motion.width(), motion.height(), motion.file_size()), (9, 2, (W, H)));
        let (mut x, mut y) = ([0.0; 2], [0.0; 2]);
        motion.fill_row(1, 3..5, &mut x, &mut y);
        assert_eq!((x, y), ([300.0, 301.0], [310.0, 311.0]));
        assert_eq!(motion.scale(), [2.0, -0.5]);
        assert_eq!(motion.at(3, 1), [600.0, -155.0]);
    }

    #[test]
    fn guides_are_cropped_together() {
        let motion = Motion::new(plane(), plane(), [1.0; 2]).unwrap();
        let guides = Guides { motion: Some(motion), depth: Some(half_plane()) };
        let crop = Crop { x: 7, y: 2, width: 9, height: 3 };
        let cut = guides.clone().cropped(crop).unwrap();
        assert_eq!(cut.motion.unwrap().at(0, 0), [207.0, 207.0]);
        assert_eq!(cut.depth.unwrap().at(8, 2), 415.0);
        assert!(guides.cropped(Crop { x: 32, ..crop }).is_err());
        assert_eq!(Guides::default().cropped(crop).unwrap(), Guides::default());
    }
}

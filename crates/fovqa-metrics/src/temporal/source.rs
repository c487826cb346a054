//! Where the pixels of a frame were in the frame before it.

use fovqa_frame::{Mask, Motion, Plane};
use multiversion::multiversion;

use super::depth_plane::DepthPlane;
use super::luma_plane::LumaPlane;
use crate::regions::Regions;

/// How a frame hangs together with the one before it.
#[derive(Debug, Clone, Copy)]
pub struct Link<'a> {
    /// Backward motion; `None`: nothing moves.
    pub motion: Option<&'a Motion>,
    /// Depth of this frame and of the one before it; `None`: it is not looked at.
    pub depth: Option<(&'a Plane, &'a DepthPlane)>,
    /// Which pixels of this frame count, and into which band.
    pub regions: &'a Regions<'a>,
    /// Which pixels of the frame before it count; `None`: all.
    pub mask_before: Option<&'a Mask>,
}

/// Pixels whose sources are fetched from consecutive places where they have one motion.
const STRETCH: usize = 16;

/// Where the pixels of a stretch of a row come from.
#[derive(Debug)]
pub(crate) struct Sources {
    motion: [Vec<f32>; 2],
    depth: Vec<f32>,
    /// Column and row of the upper left of the four taps; -1 is beyond the border.
    tap: [Vec<i32>; 2],
    /// Column and row of the pixel that holds the source.
    holder: [Vec<i32>; 2],
    /// Weight of the taps to the right, and of those below.
    weight: [Vec<f32>; 2],
    /// 1 where the source can be compared, 0 elsewhere.
    valid: Vec<u32>,
}

impl Sources {
    /// Room for up to `columns` pixels.
    pub(crate) fn new(columns: usize) -> Self {
        Self {
            motion: std::array::from_fn(|_| vec![0.0; columns]),
            depth: vec![0.0; columns],
            tap: std::array::from_fn(|_| vec![0; columns]),
            holder: std::array::from_fn(|_| vec![0; columns]),
            weight: std::array::from_fn(|_| vec![0.0; columns]),
            valid: vec![1; columns],
        }
    }

    /// 1 where a pixel can be compared.
    pub(crate) fn valid(&self) -> &[u32] {
        &self.valid
    }

    /// Finds the sources of the columns from `x` on, `n` of them, of row `y`.
    pub(crate) fn find(
        &mut self,
        link: &Link<'_>,
        tolerance: Option<f64>,
        (width, height): (usize, usize),
        (x, y, n): (usize, usize, usize),
    ) {
        if let Some(motion) = link.motion {
            let [mx, my] = &mut self.motion;
            motion.fill_row(y, x..x + n, &mut mx[..n], &mut my[..n]);
            self.valid[..n].fill(1);
            let [across, down] = motion.scale();
            let axes = [
                Axis { from: x as f64, step: 1.0, scale: across, side: width as f64 },
                Axis { from: y as f64, step: 0.0, scale: down, side: height as f64 },
            ];
            for (i, axis) in axes.into_iter().enumerate() {
                let mut followed = Followed {
                    tap: &mut self.tap[i],
                    holder: &mut self.holder[i],
                    weight: &mut self.weight[i],
                    valid: &mut self.valid,
                };
                follow(&self.motion[i][..n], axis, &mut followed);
            }
        } else {
            self.valid[..n].fill(1);
            for i in 0..n {
                self.holder[0][i] = (x + i) as i32;
            }
            self.holder[1][..n].fill(y as i32);
            self.tap[0][..n].copy_from_slice(&self.holder[0][..n]);
            self.tap[1][..n].fill(y as i32);
            self.weight.iter_mut().for_each(|weight| weight[..n].fill(0.0));
        }
        if let (Some((now, before)), Some(tolerance)) = (link.depth, tolerance) {
            now.fill_row(y, x..x + n, &mut self.depth[..n]);
            self.compare_depth(before, tolerance, n);
        }
        if let Some(mask) = link.mask_before {
            self.keep_unmasked(mask, n);
        }
    }

    /// Leaves out pixels whose source lies at another depth: what has just come into sight.
    fn compare_depth(&mut self, before: &DepthPlane, tolerance: f64, n: usize) {
        let [columns, rows] = &self.holder;
        for i in 0..n {
            if self.valid[i] == 1 {
                let now = f64::from(self.depth[i]);
                let then = f64::from(before.row(rows[i] as usize)[columns[i] as usize]);
                // False for whatever is not finite: sky may be far, but not infinitely far.
                let alike = now.is_finite() && (then - now).abs() <= tolerance * now.abs();
                self.valid[i] = u32::from(alike);
            }
        }
    }

    /// Leaves out pixels with a tap that has weight and does not count.
    fn keep_unmasked(&mut self, mask: &Mask, n: usize) {
        let (width, height) = (mask.width(), mask.height());
        for i in 0..n {
            let taps = Taps::at(self.tap[0][i], self.tap[1][i], width, height);
            let [right, below] = [self.weight[0][i] > 0.0, self.weight[1][i] > 0.0];
            let counts = |x: usize, y: usize| mask.row(y)[x];
            let clean = || {
                counts(taps.left, taps.top)
                    && (!right || counts(taps.right, taps.top))
                    && (!below || counts(taps.left, taps.bottom))
                    && (!(right && below) || counts(taps.right, taps.bottom))
            };
            if self.valid[i] == 1 && !clean() {
                self.valid[i] = 0;
            }
        }
    }

    /// The luma at the sources of `out.len()` pixels; anything where they are not valid.
    pub(crate) fn fetch(&self, before: &LumaPlane, out: &mut [f32]) {
        let n = out.len();
        let mut i = 0;
        while i < n {
            let end = (i + STRETCH).min(n);
            match self.together(i..end, before) {
                Some((top, bottom)) => {
                    let [right, below] = self.weight.each_ref().map(|weight| &weight[i..end]);
                    between(top, bottom, right, below, &mut out[i..end]);
                }
                None => (i..end).for_each(|i| {
                    if self.valid[i] == 1 {
                        out[i] = self.fetch_one(before, i);
                    }
                }),
            }
            i = end;
        }
    }

    /// The rows of taps of a stretch whose pixels move together and stay inside of the frame.
    fn together<'a>(
        &self,
        stretch: std::ops::Range<usize>,
        before: &'a LumaPlane,
    ) -> Option<(&'a [f32], &'a [f32])> {
        let [columns, rows] = self.tap.each_ref().map(|tap| &tap[stretch.clone()]);
        let (&x, &y) = (columns.first()?, rows.first()?);
        let inside = x >= 0
            && y >= 0
            && x as usize + stretch.len() < before.width()
            && y as usize + 1 < before.height();
        if !inside || !consecutive(columns, x) || !equal(rows, y) {
            return None;
        }
        let (x, y) = (x as usize, y as usize);
        let taps = x..=x + stretch.len();
        Some((&before.row(y)[taps.clone()], &before.row(y + 1)[taps]))
    }

    fn fetch_one(&self, before: &LumaPlane, i: usize) -> f32 {
        let taps = Taps::at(self.tap[0][i], self.tap[1][i], before.width(), before.height());
        let (top, bottom) = (before.row(taps.top), before.row(taps.bottom));
        let [right, below] = [self.weight[0][i], self.weight[1][i]];
        let upper = top[taps.left] + (top[taps.right] - top[taps.left]) * right;
        let lower = bottom[taps.left] + (bottom[taps.right] - bottom[taps.left]) * right;
        upper + (lower - upper) * below
    }
}

/// Four pixels, kept within the frame.
struct Taps {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

impl Taps {
    fn at(x: i32, y: i32, width: usize, height: usize) -> Self {
        let within = |at: i32, side: usize| at.clamp(0, side as i32 - 1) as usize;
        Self {
            left: within(x, width),
            right: within(x.saturating_add(1), width),
            top: within(y, height),
            bottom: within(y.saturating_add(1), height),
        }
    }
}

/// One axis of a stretch of a row.
#[derive(Clone, Copy)]
struct Axis {
    /// Position of its first pixel.
    from: f64,
    /// From each pixel to the next: 1 along the row, 0 across it.
    step: f64,
    /// Pixels of motion for one unit of a sample.
    scale: f64,
    /// The frame's side, pixels.
    side: f64,
}

/// Where motion along one axis leads.
struct Followed<'a> {
    tap: &'a mut [i32],
    holder: &'a mut [i32],
    weight: &'a mut [f32],
    valid: &'a mut [u32],
}

/// Follows motion along one axis. In f64: a pixel that just leaves the frame, or its neighbour, has to be
/// told from one that does not.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn follow(motion: &[f32], axis: Axis, out: &mut Followed<'_>) {
    let n = motion.len();
    let (tap, holder) = (&mut out.tap[..n], &mut out.holder[..n]);
    let (weight, valid) = (&mut out.weight[..n], &mut out.valid[..n]);
    for i in 0..n {
        // Pixel centres are at +0.5; the taps around a source are half a pixel to each side of it.
        let between = axis.from + axis.step * i as f64 + f64::from(motion[i]) * axis.scale;
        let source = between + 0.5;
        let inside = source >= 0.0 && source < axis.side;
        let between = if inside { between } else { 0.0 };
        let first = between.floor();
        tap[i] = first as i32;
        holder[i] = (between + 0.5).floor() as i32;
        weight[i] = (between - first) as f32;
        valid[i] &= u32::from(inside);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn between(top: &[f32], bottom: &[f32], right: &[f32], below: &[f32], out: &mut [f32]) {
    let n = out.len();
    let (top, bottom) = (&top[..=n], &bottom[..=n]);
    let (right, below) = (&right[..n], &below[..n]);
    for i in 0..n {
        let upper = top[i] + (top[i + 1] - top[i]) * right[i];
        let lower = bottom[i] + (bottom[i + 1] - bottom[i]) * right[i];
        out[i] = upper + (lower - upper) * below[i];
    }
}

/// Whether numbers rise one by one from `first`. Folds, not `all`: without an early way out they
/// vectorise.
fn consecutive(numbers: &[i32], first: i32) -> bool {
    let steps = numbers.iter().zip(first..);
    steps.fold(0, |apart, (number, want)| apart | (number ^ want)) == 0
}

fn equal(numbers: &[i32], first: i32) -> bool {
    numbers.iter().fold(0, |apart, number| apart | (number ^ first)) == 0
}

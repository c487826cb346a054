//! The sources of pixels: their positions in the previous frame.

use fovqa_frame::{Mask, Motion, Plane};
use multiversion::multiversion;

use super::kept_plane::KeptPlane;
use crate::regions::Regions;

/// The relation of a frame to the previous one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link<'a> {
    /// Backward motion; `None` if nothing moves.
    pub motion: Option<&'a Motion>,
    /// Depth of this frame and of the previous one; `None` if depth is ignored.
    pub depth: Option<(&'a Plane, &'a KeptPlane)>,
    /// The pixels of this frame that count, with the band of each.
    pub regions: &'a Regions<'a>,
    /// The pixels of the previous frame that count; `None` means all.
    pub mask_before: Option<&'a Mask>,
}

/// The number of pixels in a stretch, a vector of the widest kind. If its pixels have the same
/// motion, their sources are fetched from consecutive positions.
const STRETCH: usize = 16;

/// A stretch of a row, and the size of its frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    pub(crate) x: usize,
    pub(crate) y: usize,
    pub(crate) pixels: usize,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

/// The sources of the pixels of a stretch. A source lies between four pixels (taps): the upper left
/// one is `whole` pixels away, across and down, and `weight` is the weight of the taps to its right
/// and below it.
#[derive(Debug)]
pub(crate) struct Sources {
    motion: [Vec<f32>; 2],
    depth: Vec<f32>,
    whole: [Vec<i32>; 2],
    weight: [Vec<f32>; 2],
    /// 1 where the source can be compared, 0 elsewhere.
    valid: Vec<u32>,
    /// The position of the taps of each [`STRETCH`].
    layouts: Vec<TapLayout>,
}

/// The position of the taps of a stretch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TapLayout {
    /// All within the frame and consecutive: the pixels are a whole stretch with the same motion.
    Together,
    /// All within the frame.
    Inside,
    /// Some of them outside the frame.
    Beyond,
}

impl Sources {
    /// A buffer for up to `columns` pixels.
    pub(crate) fn new(columns: usize) -> Self {
        Self {
            motion: std::array::from_fn(|_| vec![0.0; columns]),
            depth: vec![0.0; columns],
            whole: std::array::from_fn(|_| vec![0; columns]),
            weight: std::array::from_fn(|_| vec![0.0; columns]),
            valid: vec![1; columns],
            layouts: vec![TapLayout::Beyond; columns.div_ceil(STRETCH)],
        }
    }

    /// 1 where a pixel can be compared.
    pub(crate) fn valid(&self) -> &[u32] {
        &self.valid
    }

    /// Finds the sources of a stretch.
    pub(crate) fn find(&mut self, link: &Link<'_>, tolerance: Option<f64>, at: Stretch) {
        let n = at.pixels;
        self.valid[..n].fill(1);
        match link.motion {
            Some(motion) => self.follow(motion, at),
            None => {
                for axis in 0..2 {
                    self.whole[axis][..n].fill(0);
                    self.weight[axis][..n].fill(0.0);
                }
            }
        }
        let [across, down] = self.whole.each_ref().map(|whole| &whole[..n]);
        find_tap_layout(across, down, at, &mut self.layouts);
        if let (Some((now, before)), Some(tolerance)) = (link.depth, tolerance) {
            now.fill_row(at.y, at.x..at.x + n, &mut self.depth[..n]);
            compare_depth(self, before, tolerance, at);
        }
        if let Some(mask) = link.mask_before {
            self.keep_unmasked(mask, at);
        }
    }

    fn follow(&mut self, motion: &Motion, at: Stretch) {
        let n = at.pixels;
        let [mx, my] = &mut self.motion;
        motion.fill_row(at.y, at.x..at.x + n, &mut mx[..n], &mut my[..n]);
        let starts = [(at.x as i32, 1, at.width), (at.y as i32, 0, at.height)];
        for (axis, (first, step, side)) in starts.into_iter().enumerate() {
            let line = Line { first, step, side: side as u32 };
            let found = AxisSources {
                whole: &mut self.whole[axis][..n],
                weight: &mut self.weight[axis][..n],
                valid: &mut self.valid[..n],
            };
            let samples = &self.motion[axis][..n];
            let scale = motion.scale()[axis];
            if scale.abs().to_bits() == 1f64.to_bits() {
                follow_signed(samples, scale as f32, line, found);
            } else {
                follow_scaled(samples, scale, line, found);
            }
        }
    }

    /// Leaves out pixels that have a tap with positive weight that does not count.
    fn keep_unmasked(&mut self, mask: &Mask, at: Stretch) {
        for i in 0..at.pixels {
            let taps = self.taps(i, at);
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

    /// The luma at the sources of a stretch. Values are arbitrary where they are not valid.
    pub(crate) fn fetch(&self, before: &KeptPlane, at: Stretch, out: &mut [f32]) {
        fetch(self, before, at, out);
    }

    /// The taps of a pixel, clamped to the frame.
    #[inline(always)]
    fn taps(&self, i: usize, at: Stretch) -> Taps {
        let x = (at.x + i) as i32 + self.whole[0][i];
        let y = at.y as i32 + self.whole[1][i];
        Taps {
            left: within(x, at.width),
            right: within(x + 1, at.width),
            top: within(y, at.height),
            bottom: within(y + 1, at.height),
        }
    }

    /// The index in its plane of the upper left tap of a pixel whose taps are within the frame.
    #[inline(always)]
    fn first_tap(&self, i: usize, at: Stretch) -> usize {
        let x = (at.x + i) as i64 + i64::from(self.whole[0][i]);
        let y = at.y as i64 + i64::from(self.whole[1][i]);
        (y * at.width as i64 + x) as usize
    }
}

#[inline(always)]
fn within(at: i32, side: usize) -> usize {
    at.clamp(0, side as i32 - 1) as usize
}

/// The indices of four taps.
struct Taps {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

/// The positions of the pixels of a stretch along one axis of the frame.
#[derive(Clone, Copy)]
struct Line {
    /// The position of the first pixel.
    first: i32,
    /// The step from each pixel to the next: 1 along the row, 0 across it.
    step: i32,
    /// The side of the frame.
    side: u32,
}

/// The sources of the pixels along one axis.
struct AxisSources<'a> {
    whole: &'a mut [i32],
    weight: &'a mut [f32],
    valid: &'a mut [u32],
}

/// Motion this large, or motion that is not a number, has no source.
const FARTHEST_PX: f32 = (1 << 21) as f32;

/// Finds sources for motion in pixels, with either sign. The calculation is in f32, but a source
/// just inside a pixel is still distinguished from one just outside: the fractional part of the
/// motion is exact or, for small motion to the left or up, so near to 1 that there is no ambiguity.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn follow_signed(motion: &[f32], sign: f32, line: Line, found: AxisSources<'_>) {
    /// Adding it to an integer leaves the integer in the lowest bits. This conversion vectorises.
    const BITS: f32 = (3 << 22) as f32;
    let n = motion.len();
    let AxisSources { whole, weight, valid } = found;
    let (whole, weight, valid) = (&mut whole[..n], &mut weight[..n], &mut valid[..n]);
    for i in 0..n {
        let near = motion[i].abs() < FARTHEST_PX;
        let pixels = if near { motion[i] * sign } else { 0.0 };
        let floor = pixels.floor();
        weight[i] = pixels - floor;
        whole[i] = (floor + BITS).to_bits() as i32 - BITS.to_bits() as i32;
        // Pixel centres are at +0.5: the source lies in the pixel of its tap or, from half a pixel
        // on, in the next one.
        let holder = line.first + line.step * i as i32 + whole[i] + i32::from(weight[i] >= 0.5);
        valid[i] &= u32::from(near) & u32::from((holder as u32) < line.side);
    }
}

/// Finds sources for motion in other units, in f64.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn follow_scaled(motion: &[f32], scale: f64, line: Line, found: AxisSources<'_>) {
    const BITS: f64 = (3u64 << 51) as f64;
    let n = motion.len();
    let AxisSources { whole, weight, valid } = found;
    let (whole, weight, valid) = (&mut whole[..n], &mut weight[..n], &mut valid[..n]);
    for i in 0..n {
        let pixels = f64::from(motion[i]) * scale;
        let near = pixels.abs() < f64::from(FARTHEST_PX);
        let pixels = if near { pixels } else { 0.0 };
        let floor = pixels.floor();
        let part = pixels - floor;
        weight[i] = part as f32;
        whole[i] = ((floor + BITS).to_bits() as i64 - BITS.to_bits() as i64) as i32;
        let holder = line.first + line.step * i as i32 + whole[i] + i32::from(part >= 0.5);
        valid[i] &= u32::from(near) & u32::from((holder as u32) < line.side);
    }
}

/// Finds the position of the taps of each stretch.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn find_tap_layout(across: &[i32], down: &[i32], at: Stretch, layouts: &mut [TapLayout]) {
    for (i, layout) in layouts.iter_mut().enumerate().take(across.len().div_ceil(STRETCH)) {
        let (start, end) = (i * STRETCH, ((i + 1) * STRETCH).min(across.len()));
        let (x, y) = ((at.x + start) as i64, at.y as i64);
        let (left, right) = extremes(&across[start..end]);
        let (up, below) = extremes(&down[start..end]);
        let inside = x + i64::from(left) >= 0
            && y + i64::from(up) >= 0
            && x + i64::from(right) + ((end - start) as i64) < at.width as i64
            && y + i64::from(below) + 1 < at.height as i64;
        *layout = match (inside, left == right && up == below && end - start == STRETCH) {
            (true, true) => TapLayout::Together,
            (true, false) => TapLayout::Inside,
            (false, _) => TapLayout::Beyond,
        };
    }
}

/// The smallest and the largest of some numbers.
#[inline(always)]
fn extremes(numbers: &[i32]) -> (i32, i32) {
    let first = numbers.first().copied().unwrap_or_default();
    let (mut low, mut high) = (first, first);
    for &number in numbers {
        low = low.min(number);
        high = high.max(number);
    }
    (low, high)
}

/// Leaves out pixels whose source has another depth, because they have just become visible.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn compare_depth(sources: &mut Sources, before: &KeptPlane, tolerance: f64, at: Stretch) {
    let mut then = [0.0f32; STRETCH];
    for (part, start) in (0..at.pixels).step_by(STRETCH).enumerate() {
        let end = (start + STRETCH).min(at.pixels);
        let n = end - start;
        let (right, below) = (&sources.weight[0][start..end], &sources.weight[1][start..end]);
        let layout = sources.layouts[part];
        if layout == TapLayout::Together
            && let [Some(top), Some(bottom)] =
                taps_of(before.values(), sources.first_tap(start, at), at)
            && let (Some(right), Some(below)) =
                (right.first_chunk::<STRETCH>(), below.first_chunk::<STRETCH>())
        {
            for i in 0..STRETCH {
                let upper = if right[i] >= 0.5 { top[i + 1] } else { top[i] };
                let lower = if right[i] >= 0.5 { bottom[i + 1] } else { bottom[i] };
                then[i] = if below[i] >= 0.5 { lower } else { upper };
            }
        } else if layout == TapLayout::Inside {
            for i in 0..n {
                let holder = usize::from(right[i] >= 0.5) + usize::from(below[i] >= 0.5) * at.width;
                then[i] = before.values()[sources.first_tap(start + i, at) + holder];
            }
        } else {
            for i in 0..n {
                let taps = sources.taps(start + i, at);
                let row = before.row(if below[i] >= 0.5 { taps.bottom } else { taps.top });
                then[i] = row[if right[i] >= 0.5 { taps.right } else { taps.left }];
            }
        }
        let now = &sources.depth[start..end];
        if let Some(now) = now.first_chunk()
            && clearly_alike(now, &then, tolerance as f32)
        {
            continue;
        }
        let valid = &mut sources.valid[start..end];
        for i in 0..n {
            let (now, then) = (f64::from(now[i]), f64::from(then[i]));
            // This is false for values that are not finite: sky may be far away, but not infinitely
            // far.
            let near = (then - now).abs() <= tolerance * now.abs();
            valid[i] &= u32::from(near) & u32::from(now.abs() < f64::INFINITY);
        }
    }
}

/// Whether depths agree with so much margin that f32 is precise enough, as it usually is.
#[inline(always)]
fn clearly_alike(now: &[f32; STRETCH], then: &[f32; STRETCH], tolerance: f32) -> bool {
    const TO_SPARE: f32 = 0.999;
    let mut alike = true;
    for i in 0..STRETCH {
        let near = (then[i] - now[i]).abs() <= TO_SPARE * tolerance * now[i].abs();
        alike &= near & (now[i].abs() < f32::MAX);
    }
    alike
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn fetch(sources: &Sources, before: &KeptPlane, at: Stretch, out: &mut [f32]) {
    for (part, out) in out[..at.pixels].chunks_mut(STRETCH).enumerate() {
        let (start, n) = (part * STRETCH, out.len());
        let end = start + n;
        let (right, below) = (&sources.weight[0][start..end], &sources.weight[1][start..end]);
        let layout = sources.layouts[part];
        if layout == TapLayout::Together
            && let [Some(top), Some(bottom)] =
                taps_of(before.values(), sources.first_tap(start, at), at)
            && let (Some(right), Some(below)) =
                (right.first_chunk::<STRETCH>(), below.first_chunk::<STRETCH>())
            && let Some(out) = out.first_chunk_mut::<STRETCH>()
        {
            for i in 0..STRETCH {
                let upper = between(top[i], top[i + 1], right[i]);
                let lower = between(bottom[i], bottom[i + 1], right[i]);
                out[i] = between(upper, lower, below[i]);
            }
        } else if layout == TapLayout::Inside {
            for i in 0..n {
                let first = sources.first_tap(start + i, at);
                let (top, bottom) =
                    (&before.values()[first..], &before.values()[first + at.width..]);
                let upper = between(top[0], top[1], right[i]);
                let lower = between(bottom[0], bottom[1], right[i]);
                out[i] = between(upper, lower, below[i]);
            }
        } else {
            for i in 0..n {
                let taps = sources.taps(start + i, at);
                let (top, bottom) = (before.row(taps.top), before.row(taps.bottom));
                let upper = between(top[taps.left], top[taps.right], right[i]);
                let lower = between(bottom[taps.left], bottom[taps.right], right[i]);
                out[i] = between(upper, lower, below[i]);
            }
        }
    }
}

/// The upper and the lower taps of pixels with the same motion; `first` is the index of the first
/// tap.
#[inline(always)]
fn taps_of(values: &[f32], first: usize, at: Stretch) -> [Option<&[f32; STRETCH + 1]>; 2] {
    let below = first + at.width;
    [
        values.get(first..).and_then(<[f32]>::first_chunk),
        values.get(below..).and_then(<[f32]>::first_chunk),
    ]
}

#[inline(always)]
fn between(from: f32, to: f32, weight: f32) -> f32 {
    from + (to - from) * weight
}

//! Where the pixels of a frame were in the frame before it.

use fovqa_frame::{Mask, Motion, Plane};
use multiversion::multiversion;

use super::kept_plane::KeptPlane;
use crate::regions::Regions;

/// How a frame hangs together with the one before it.
#[derive(Debug, Clone, Copy)]
pub struct Link<'a> {
    /// Backward motion; `None`: nothing moves.
    pub motion: Option<&'a Motion>,
    /// Depth of this frame and of the one before it; `None`: it is not looked at.
    pub depth: Option<(&'a Plane, &'a KeptPlane)>,
    /// Which pixels of this frame count, and into which band.
    pub regions: &'a Regions<'a>,
    /// Which pixels of the frame before it count; `None`: all.
    pub mask_before: Option<&'a Mask>,
}

/// Pixels whose sources are fetched from consecutive places where they have one motion: a vector of the
/// widest kind.
const STRETCH: usize = 16;

/// A stretch of a row, and the frame it is of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    pub(crate) x: usize,
    pub(crate) y: usize,
    pub(crate) pixels: usize,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

/// Where the pixels of a stretch come from. A source lies between four taps: the upper left is `whole`
/// pixels away, across and down, and `weight` is that of the taps to its right and below it.
#[derive(Debug)]
pub(crate) struct Sources {
    motion: [Vec<f32>; 2],
    depth: Vec<f32>,
    whole: [Vec<i32>; 2],
    weight: [Vec<f32>; 2],
    /// 1 where the source can be compared, 0 elsewhere.
    valid: Vec<u32>,
    /// How the taps of each [`STRETCH`] lie.
    reach: Vec<Reach>,
}

/// How the taps of some pixels lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reach {
    /// Side by side, within the frame: the pixels, a whole stretch of them, move together.
    Together,
    /// Within the frame.
    Inside,
    /// Some of them beyond its border.
    Beyond,
}

impl Sources {
    /// Room for up to `columns` pixels.
    pub(crate) fn new(columns: usize) -> Self {
        Self {
            motion: std::array::from_fn(|_| vec![0.0; columns]),
            depth: vec![0.0; columns],
            whole: std::array::from_fn(|_| vec![0; columns]),
            weight: std::array::from_fn(|_| vec![0.0; columns]),
            valid: vec![1; columns],
            reach: vec![Reach::Beyond; columns.div_ceil(STRETCH)],
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
        find_reach(across, down, at, &mut self.reach);
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

    /// Leaves out pixels with a tap that has weight and does not count.
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

    /// The luma at the sources of a stretch; anything where they are not valid.
    pub(crate) fn fetch(&self, before: &KeptPlane, at: Stretch, out: &mut [f32]) {
        fetch(self, before, at, out);
    }

    /// The taps of a pixel, kept within the frame.
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

    /// The upper left tap of a pixel whose taps are in the frame, as an index into its plane.
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

/// Four pixels.
struct Taps {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

/// Pixels along one axis of the frame.
#[derive(Clone, Copy)]
struct Line {
    /// Position of the first.
    first: i32,
    /// From each to the next: 1 along the row, 0 across it.
    step: i32,
    /// The frame's side.
    side: u32,
}

/// Where motion along one axis leads.
struct AxisSources<'a> {
    whole: &'a mut [i32],
    weight: &'a mut [f32],
    valid: &'a mut [u32],
}

/// Motion as far as this, or that is not a number, leads nowhere.
const FARTHEST_PX: f32 = (1 << 21) as f32;

/// Follows motion in pixels, of either sign. In f32 throughout, and yet a source just inside of a pixel is told
/// from one just outside of it: the part of the motion beyond whole pixels is exact, or, of small motion
/// to the left or up, too near to 1 to be mistaken.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn follow_signed(motion: &[f32], sign: f32, line: Line, found: AxisSources<'_>) {
    /// Added to a whole number, it leaves that in the lowest bits: a conversion that vectorises.
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
        // Centres are at +0.5: the source is in its tap's pixel, or from half a pixel on in the next.
        let holder = line.first + line.step * i as i32 + whole[i] + i32::from(weight[i] >= 0.5);
        valid[i] &= u32::from(near) & u32::from((holder as u32) < line.side);
    }
}

/// The same of motion in other units, in f64.
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

/// Finds how the taps of each stretch lie.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn find_reach(across: &[i32], down: &[i32], at: Stretch, reach: &mut [Reach]) {
    for (i, reach) in reach.iter_mut().enumerate().take(across.len().div_ceil(STRETCH)) {
        let (start, end) = (i * STRETCH, ((i + 1) * STRETCH).min(across.len()));
        let (x, y) = ((at.x + start) as i64, at.y as i64);
        let (left, right) = extremes(&across[start..end]);
        let (up, below) = extremes(&down[start..end]);
        let inside = x + i64::from(left) >= 0
            && y + i64::from(up) >= 0
            && x + i64::from(right) + ((end - start) as i64) < at.width as i64
            && y + i64::from(below) + 1 < at.height as i64;
        *reach = match (inside, left == right && up == below && end - start == STRETCH) {
            (true, true) => Reach::Together,
            (true, false) => Reach::Inside,
            (false, _) => Reach::Beyond,
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

/// Leaves out pixels whose source lies at another depth: what has just come into sight.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn compare_depth(sources: &mut Sources, before: &KeptPlane, tolerance: f64, at: Stretch) {
    let mut then = [0.0f32; STRETCH];
    for (part, start) in (0..at.pixels).step_by(STRETCH).enumerate() {
        let end = (start + STRETCH).min(at.pixels);
        let n = end - start;
        let (right, below) = (&sources.weight[0][start..end], &sources.weight[1][start..end]);
        let reach = sources.reach[part];
        if reach == Reach::Together
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
        } else if reach == Reach::Inside {
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
            // False for whatever is not finite: sky may be far, but not infinitely far.
            let near = (then - now).abs() <= tolerance * now.abs();
            valid[i] &= u32::from(near) & u32::from(now.abs() < f64::INFINITY);
        }
    }
}

/// Whether depths agree with so much to spare that f32 can tell, as most do.
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
        let reach = sources.reach[part];
        if reach == Reach::Together
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
        } else if reach == Reach::Inside {
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

/// The upper and the lower taps of pixels that move together, the first of which is at an index.
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

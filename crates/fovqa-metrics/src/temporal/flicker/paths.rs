//! The paths of pixels through the frames before, and the variance of luma along them.

use fovqa_frame::Mask;
use multiversion::multiversion;

use super::super::kept_plane::KeptPlane;
use super::super::time_input::TimeInput;

/// The number of pixels that are followed together, a vector of the widest kind.
pub(super) const LANES: usize = 16;

/// Motion this large, or motion that is not a number, leads nowhere.
const FARTHEST_PX: f64 = (1 << 21) as f64;

/// A variance of luma that rounding alone may have: luma near 1 is stored in steps of 2^-24.
const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

/// What all paths of a frame have in common.
pub(super) struct Paths<'a> {
    pub(super) input: &'a TimeInput<'a>,
    pub(super) width: usize,
    pub(super) height: usize,
    /// The number of frames, the present one included.
    pub(super) frames: usize,
    /// Whether the straight line through the values is taken out.
    pub(super) detrend: bool,
    /// The largest change of depth along the motion, as a share of the depth; `None` ignores depth.
    pub(super) depth_tolerance: Option<f64>,
}

/// A position of each pixel on its path. It lies between four pixels: `whole` is the upper left one,
/// and `part` is the weight of those to its right and below it.
#[derive(Clone, Copy)]
struct Points {
    whole: [[i32; LANES]; 2],
    part: [[f64; LANES]; 2],
    /// Depth of the pixels that hold the points.
    depth: [f32; LANES],
    /// 1 where the path is valid up to here, 0 elsewhere.
    valid: [u32; LANES],
}

/// Sums of the differences d_k of the values on a path to the first one.
#[derive(Clone, Copy)]
struct Sums {
    first: [f32; LANES],
    /// Σ d
    sum: [f64; LANES],
    /// Σ d²
    squares: [f64; LANES],
    /// Σ (k - k̄) d
    slope: [f64; LANES],
}

/// The variance of luma along the paths of the pixels of row `y` from column `x` on, of each picture;
/// and 1 in `valid` for each pixel that has a path, 0 for others, whose variance is 0. Each slice has
/// the same number of pixels.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn variances(
    paths: &Paths<'_>,
    x: usize,
    y: usize,
    out: &mut [Vec<f32>],
    valid: &mut [u32],
) {
    let zero = [0.0; LANES];
    let nothing = Sums { first: [0.0; LANES], sum: zero, squares: zero, slope: zero };
    let mut sums = vec![nothing; out.len()];
    for start in (0..valid.len()).step_by(LANES) {
        let n = LANES.min(valid.len() - start);
        sums.fill(nothing);
        let is_valid = follow(paths, x + start, y, n, &mut sums);
        valid[start..start + n].copy_from_slice(&is_valid[..n]);
        for (out, sums) in out.iter_mut().zip(&sums) {
            let found = variance(paths, sums, &is_valid);
            out[start..start + n].copy_from_slice(&found[..n]);
        }
    }
}

#[inline(always)]
fn variance(paths: &Paths<'_>, sums: &Sums, valid: &[u32; LANES]) -> [f32; LANES] {
    let n = paths.frames as f64;
    // Σ (k - k̄)² for k = 0..n-1.
    let spread = n * (n * n - 1.0) / 12.0;
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        let about_mean = sums.squares[i] - sums.sum[i] * sums.sum[i] / n;
        let drift = if paths.detrend { sums.slope[i] * sums.slope[i] / spread } else { 0.0 };
        let variance = (about_mean - drift) / n;
        out[i] = if valid[i] == 1 && variance > ROUNDING { variance as f32 } else { 0.0 };
    }
    out
}

/// Follows the paths of `n` pixels, and sums up the luma of each picture along them.
#[inline(always)]
fn follow(paths: &Paths<'_>, x: usize, y: usize, n: usize, sums: &mut [Sums]) -> [u32; LANES] {
    let input = paths.input;
    let mut points = begin(paths, x, y, n);
    for (sums, picture) in sums.iter_mut().zip(input.pictures) {
        sums.first[..n].copy_from_slice(&picture.lumas[0].row(y)[x..x + n]);
    }
    let middle = (paths.frames - 1) as f64 / 2.0;
    let mut motion = [[0.0; LANES]; 2];
    for (step, before) in input.before[..paths.frames - 1].iter().enumerate() {
        let scale = if step == 0 {
            input.motion.map(|from| {
                let [across, down] = &mut motion;
                from.fill_row(y, x..x + n, &mut across[..n], &mut down[..n]);
                from.scale()
            })
        } else {
            input.before[step - 1].motion.map(|from| {
                let layout = Layout::of(&points, paths);
                motion = [0, 1].map(|axis| at_holders(from.axis(axis), &points, paths, layout));
                from.scale()
            })
        };
        if let Some(scale) = scale {
            advance(&mut points, &motion, scale, paths);
        }
        let layout = Layout::of(&points, paths);
        if let (Some(tolerance), Some(depth)) = (paths.depth_tolerance, before.depth) {
            let depth = at_holders(depth.values(), &points, paths, layout);
            compare_depth(&mut points, depth, tolerance);
        }
        if let Some(mask) = before.mask {
            keep_unmasked(&mut points, mask, paths);
        }
        let from_middle = (step + 1) as f64 - middle;
        for (sums, picture) in sums.iter_mut().zip(input.pictures) {
            let found = fetch(picture.lumas[step + 1], &points, paths, layout);
            for (i, found) in found.into_iter().enumerate() {
                let d = f64::from(found) - f64::from(sums.first[i]);
                sums.sum[i] += d;
                sums.squares[i] += d * d;
                sums.slope[i] += from_middle * d;
            }
        }
    }
    points.valid
}

/// The pixels themselves.
#[inline(always)]
fn begin(paths: &Paths<'_>, x: usize, y: usize, n: usize) -> Points {
    let mut points = Points {
        whole: [[0; LANES], [y as i32; LANES]],
        part: [[0.0; LANES]; 2],
        depth: [0.0; LANES],
        valid: [0; LANES],
    };
    for i in 0..LANES {
        points.whole[0][i] = (x + i) as i32;
        points.valid[i] = u32::from(i < n);
    }
    if let Some(depth) = paths.input.depth.filter(|_| paths.depth_tolerance.is_some()) {
        depth.fill_row(y, x..x + n, &mut points.depth[..n]);
    }
    points
}

/// Moves the points on. A point that leaves the frame, or whose motion is not finite, ends its path.
#[inline(always)]
fn advance(points: &mut Points, motion: &[[f32; LANES]; 2], scale: [f64; 2], paths: &Paths<'_>) {
    /// Adding it to an integer leaves the integer in the lowest bits. This conversion vectorises.
    const BITS: f64 = (3u64 << 51) as f64;
    for (axis, side) in [paths.width, paths.height].into_iter().enumerate() {
        let (whole, part) = (&mut points.whole[axis], &mut points.part[axis]);
        for i in 0..LANES {
            let pixels = f64::from(motion[axis][i]) * scale[axis];
            let near = pixels.abs() < FARTHEST_PX;
            let at = part[i] + if near { pixels } else { 0.0 };
            let floor = at.floor();
            part[i] = at - floor;
            whole[i] += ((floor + BITS).to_bits() as i64 - BITS.to_bits() as i64) as i32;
            // Pixel centres are at +0.5: the point lies in this pixel or, from half a pixel on, in the
            // next one.
            let holder = whole[i] + i32::from(part[i] >= 0.5);
            points.valid[i] &= u32::from(near) & u32::from((holder as u32) < side as u32);
        }
    }
}

/// Where the four pixels around each point are.
#[derive(Clone, Copy)]
enum Layout {
    /// Beside each other and within the frame; this is the index of the first one.
    Together(usize),
    /// Anywhere.
    Apart,
}

impl Layout {
    #[inline(always)]
    fn of(points: &Points, paths: &Paths<'_>) -> Self {
        let [across, down] = &points.whole;
        let (x, y) = (across[0], down[0]);
        let mut apart = 0;
        for i in 0..LANES {
            apart |= ((across[i] - i as i32) ^ x) | (down[i] ^ y);
        }
        let inside =
            x >= 0 && y >= 0 && x as usize + LANES < paths.width && (y as usize) + 1 < paths.height;
        if apart == 0 && inside {
            Self::Together(y as usize * paths.width + x as usize)
        } else {
            Self::Apart
        }
    }
}

/// The upper and the lower row of the pixels around points that are together.
#[inline(always)]
fn rows(values: &[f32], first: usize, width: usize) -> Option<[&[f32; LANES + 1]; 2]> {
    let top = values.get(first..)?.first_chunk()?;
    let bottom = values.get(first + width..)?.first_chunk()?;
    Some([top, bottom])
}

/// The position of a pixel, clamped to the frame.
#[inline(always)]
fn within(at: i32, side: usize) -> usize {
    at.clamp(0, side as i32 - 1) as usize
}

/// The values of the pixels that hold the points.
#[inline(always)]
fn at_holders(values: &[f32], points: &Points, paths: &Paths<'_>, layout: Layout) -> [f32; LANES] {
    let [right, below] = &points.part;
    let mut out = [0.0; LANES];
    if let Layout::Together(first) = layout
        && let Some([top, bottom]) = rows(values, first, paths.width)
    {
        for i in 0..LANES {
            let upper = if right[i] >= 0.5 { top[i + 1] } else { top[i] };
            let lower = if right[i] >= 0.5 { bottom[i + 1] } else { bottom[i] };
            out[i] = if below[i] >= 0.5 { lower } else { upper };
        }
        return out;
    }
    for i in 0..LANES {
        let x = within(points.whole[0][i] + i32::from(right[i] >= 0.5), paths.width);
        let y = within(points.whole[1][i] + i32::from(below[i] >= 0.5), paths.height);
        out[i] = values[y * paths.width + x];
    }
    out
}

/// Ends paths whose next pixel has another depth, because it shows another surface.
#[inline(always)]
fn compare_depth(points: &mut Points, then: [f32; LANES], tolerance: f64) {
    for i in 0..LANES {
        let (now, then) = (f64::from(points.depth[i]), f64::from(then[i]));
        // This is false for values that are not finite.
        let near = (then - now).abs() <= tolerance * now.abs();
        points.valid[i] &= u32::from(near) & u32::from(now.abs() < f64::INFINITY);
    }
    points.depth = then;
}

/// Ends paths at points with a pixel of positive weight that does not count.
#[inline(always)]
fn keep_unmasked(points: &mut Points, mask: &Mask, paths: &Paths<'_>) {
    for i in 0..LANES {
        let [x, y] = points.whole.map(|whole| whole[i]);
        let columns = [within(x, paths.width), within(x + 1, paths.width)];
        let lines = [within(y, paths.height), within(y + 1, paths.height)];
        let [columns, lines] = [(columns, 0), (lines, 1)]
            .map(|(both, axis)| if points.part[axis][i] > 0.0 { both } else { [both[0]; 2] });
        let clean = lines.iter().all(|y| columns.iter().all(|x| mask.row(*y)[*x]));
        points.valid[i] &= u32::from(clean);
    }
}

/// The luma at the points. Values are arbitrary where paths are not valid.
#[inline(always)]
fn fetch(luma: &KeptPlane, points: &Points, paths: &Paths<'_>, layout: Layout) -> [f32; LANES] {
    let mut out = [0.0; LANES];
    let (mut right, mut below) = ([0.0f32; LANES], [0.0f32; LANES]);
    for i in 0..LANES {
        (right[i], below[i]) = (points.part[0][i] as f32, points.part[1][i] as f32);
    }
    if let Layout::Together(first) = layout
        && let Some([top, bottom]) = rows(luma.values(), first, paths.width)
    {
        for i in 0..LANES {
            let upper = between(top[i], top[i + 1], right[i]);
            let lower = between(bottom[i], bottom[i + 1], right[i]);
            out[i] = between(upper, lower, below[i]);
        }
        return out;
    }
    for i in 0..LANES {
        let [x, y] = points.whole.map(|whole| whole[i]);
        let (left, next) = (within(x, paths.width), within(x + 1, paths.width));
        let top = luma.row(within(y, paths.height));
        let bottom = luma.row(within(y + 1, paths.height));
        let upper = between(top[left], top[next], right[i]);
        let lower = between(bottom[left], bottom[next], right[i]);
        out[i] = between(upper, lower, below[i]);
    }
    out
}

#[inline(always)]
fn between(from: f32, to: f32, weight: f32) -> f32 {
    from + (to - from) * weight
}

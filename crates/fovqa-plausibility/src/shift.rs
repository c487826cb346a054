//! A picture that is shifted by whole pixels.

use crate::pair::Looked;
use crate::plane::Plane;
use crate::sample::Sample;
use crate::suspicion::{Check, Suspicion};

/// The search begins where no side is longer than this.
const COARSEST: usize = 96;

/// Largest shift that is found, as a part of the shorter side.
const FARTHEST: usize = 8;

/// Side of the blocks that vote, in pixels.
const BLOCK: usize = 32;

/// The smallest number of blocks with structure.
const FEWEST_BLOCKS: usize = 12;

/// The shares of all blocks and of the quarter that fits best that have to agree with a shift by one
/// pixel, and with a farther one. Temporal jitter can move most of a frame by a pixel.
const ONE: (f32, f32) = (0.75, 0.88);
const FARTHER: (f32, f32) = (0.6, 0.75);

/// Displacement in pixels, estimated from gradients, from which a shift is searched for.
const MOVED: f32 = 0.35;

/// Median correlation within windows below which a shift is searched for.
const UNLIKE: f32 = 0.55;

/// Looks for a shift if there is any sign of one.
pub(crate) fn check(pair: &Looked<'_>, sample: &Sample) -> Option<Suspicion> {
    if is_suspicious(sample) { search(pair) } else { None }
}

/// Looks for a shift.
pub(crate) fn search(pair: &Looked<'_>) -> Option<Suspicion> {
    let planes = [pair.reference, pair.test].map(|frame| Plane::new(frame, pair.tables));
    let shift = best_shift(planes.each_ref());
    if shift == [0, 0] || !is_agreed(planes.each_ref(), shift) {
        return None;
    }
    let [x, y] = shift;
    let along = |by: isize, forward: &str, back: &str| match by {
        0 => None,
        1 | -1 => Some(format!("1 pixel {}", if by > 0 { forward } else { back })),
        _ => Some(format!("{} pixels {}", by.abs(), if by > 0 { forward } else { back })),
    };
    let parts: Vec<String> = [along(x, "to the right", "to the left"), along(y, "down", "up")]
        .into_iter()
        .flatten()
        .collect();
    let message = format!("the test is shifted by {} against the reference", parts.join(" and "));
    let help = "check the viewport, the crop and the frame number: a frame that is one too late or early moves \
                with the camera";
    Some(Suspicion::new(Check::Shifted, message, help))
}

/// Whether the gradients, or the lack of any correlation, suggest that something has moved.
fn is_suspicious(sample: &Sample) -> bool {
    let (mut g, mut pull) = ([0.0f32; 4], [0.0f32; 2]);
    let mut correlations = Vec::new();
    for window in sample.counted() {
        for (sum, value) in g.iter_mut().zip(window.gradients) {
            *sum += value;
        }
        for (sum, value) in pull.iter_mut().zip(window.pull) {
            *sum += value;
        }
        if window.variance[0].min(window.variance[1]) > 4e-4 {
            correlations.push(window.correlation());
        }
    }
    // Gradients are differences across two pixels.
    let (g, pull) = (g.map(|g| g / 4.0), pull.map(|p| p / 2.0));
    let determinant = g[0] * g[3] - g[1] * g[2];
    let moved = [g[3] * pull[0] - g[1] * pull[1], g[0] * pull[1] - g[2] * pull[0]]
        .map(|moved| moved / determinant);
    let far = (moved[0] * moved[0] + moved[1] * moved[1]).sqrt();
    if far > MOVED || !far.is_finite() {
        return true;
    }
    let middle = correlations.len() / 2;
    correlations.len() >= FEWEST_BLOCKS
        && *correlations.select_nth_unstable_by(middle, f32::total_cmp).1 < UNLIKE
}

/// The shift of the test with the smallest mean squared difference, from coarse to fine.
fn best_shift([reference, test]: [&Plane; 2]) -> [isize; 2] {
    let mut levels = vec![[reference.halved(), test.halved()]];
    while let Some([r, t]) = levels.last()
        && r.width.max(r.height) > COARSEST
    {
        let next = [r.halved(), t.halved()];
        levels.push(next);
    }
    let mut levels = levels.iter().rev();
    let Some([r, t]) = levels.next() else { return [0, 0] };
    let most = (r.width.min(r.height) / FARTHEST) as isize;
    let mut shift = nearest([r, t], [0, 0], most);
    for [r, t] in levels {
        shift = nearest([r, t], shift.map(|s| 2 * s), 1);
    }
    nearest([reference, test], shift.map(|s| 2 * s), 2)
}

/// The best shift within `most` of a first one.
fn nearest(planes: [&Plane; 2], first: [isize; 2], most: isize) -> [isize; 2] {
    let mut best = (f64::MAX, [0, 0]);
    for y in -most..=most {
        for x in -most..=most {
            let shift = [first[0] + x, first[1] + y];
            let difference = difference(planes, shift);
            if difference < best.0 {
                best = (difference, shift);
            }
        }
    }
    best.1
}

/// Where a shifted test lies on a reference of the same size, along one axis: first pixels of both, and
/// their number.
fn overlap(side: usize, shift: isize) -> (usize, usize, usize) {
    let by = shift.unsigned_abs().min(side);
    if shift >= 0 { (0, by, side - by) } else { (by, 0, side - by) }
}

/// The mean squared difference of the parts that overlap, without that of their means. Large planes are
/// read in every fourth row.
fn difference([reference, test]: [&Plane; 2], [x, y]: [isize; 2]) -> f64 {
    let (rx, tx, columns) = overlap(reference.width, x);
    let (ry, ty, rows) = overlap(reference.height, y);
    let every = if reference.width * reference.height > 40_000 { 4 } else { 1 };
    let (mut sum, mut squares, mut n) = (0.0f64, 0.0f64, 0.0f64);
    for row in (0..rows).step_by(every) {
        let r = &reference.row(ry + row)[rx..rx + columns];
        let t = &test.row(ty + row)[tx..tx + columns];
        let [s, q] = differences(r, t);
        sum += f64::from(s);
        squares += f64::from(q);
        n += columns as f64;
    }
    squares / n - (sum / n) * (sum / n)
}

/// The sum of the differences and of their squares.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn differences(r: &[f32], t: &[f32]) -> [f32; 2] {
    const LANES: usize = 16;
    let mut sums = [[0.0f32; LANES]; 2];
    let (r, t) = (r.as_chunks::<LANES>().0, t.as_chunks::<LANES>().0);
    for (r, t) in r.iter().zip(t) {
        for lane in 0..LANES {
            let d = t[lane] - r[lane];
            sums[0][lane] += d;
            sums[1][lane] += d * d;
        }
    }
    sums.map(|lanes| lanes.iter().sum())
}

/// Whether blocks agree with a shift: most of them, and nearly all of those that fit best. The
/// jitter of a coarse buffer moves only what lies far from the gaze, where nothing fits well.
fn is_agreed([reference, test]: [&Plane; 2], [x, y]: [isize; 2]) -> bool {
    let (rx, tx, columns) = overlap(reference.width, x);
    let (ry, ty, rows) = overlap(reference.height, y);
    let mut blocks = Vec::new();
    for top in (0..rows / BLOCK).map(|n| n * BLOCK) {
        for left in (0..columns / BLOCK).map(|n| n * BLOCK) {
            // The same part of the test, where it is and where the shift puts it.
            let (at_x, at_y) = (tx + left, ty + top);
            let mut moments = [0.0f32; 2];
            let mut differences = [[0.0f32; 2]; 2];
            for row in 0..BLOCK {
                let t = &test.row(at_y + row)[at_x..at_x + BLOCK];
                let still = &reference.row(at_y + row)[at_x..at_x + BLOCK];
                let moved = &reference.row(ry + top + row)[rx + left..rx + left + BLOCK];
                for ((t, still), moved) in t.iter().zip(still).zip(moved) {
                    moments[0] += t;
                    moments[1] += t * t;
                    for (sums, r) in differences.iter_mut().zip([still, moved]) {
                        sums[0] += t - r;
                        sums[1] += (t - r) * (t - r);
                    }
                }
            }
            let n = (BLOCK * BLOCK) as f32;
            let variance = |[sum, squares]: [f32; 2]| (squares / n - (sum / n).powi(2)).max(0.0);
            let (of_test, [still, moved]) = (variance(moments), differences.map(variance));
            if of_test > 4e-4 {
                blocks.push((still.min(moved) / of_test, moved < still));
            }
        }
    }
    if blocks.len() < FEWEST_BLOCKS {
        return false;
    }
    blocks.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let share = |blocks: &[(f32, bool)]| {
        blocks.iter().filter(|(_, moved)| *moved).count() as f32 / blocks.len() as f32
    };
    let best = &blocks[..(blocks.len() / 4).max(FEWEST_BLOCKS / 2)];
    let (most, nearly_all) = if x.abs().max(y.abs()) > 1 { FARTHER } else { ONE };
    share(&blocks) >= most && share(best) >= nearly_all
}

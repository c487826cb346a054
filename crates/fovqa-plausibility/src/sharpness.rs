//! Where the test is like the reference, and which of the two has more fine detail elsewhere.

use crate::radial::{Cell, best_place, deviation, distance};
use crate::sample::{Sample, Window};
use crate::suspicion::{Check, Suspicion};

/// Windows whose variance is smaller in both pictures have no structure to compare.
const STRUCTURE: f32 = 2e-4;

/// Cells along each side, into which windows are averaged.
const CELLS: usize = 20;

/// The smallest number of cells with structure.
const FEWEST_CELLS: usize = 60;

/// The least share of the variance that a fall with distance explains.
const EXPLAINED: f32 = 0.12;

/// How much sharper the test has to be at the place found than at the gaze: a difference of the
/// logarithms of its blur.
const CLEARER: f32 = 0.12;

/// How much better the fall from the place found describes the cells than that from the gaze:
/// `n (at gaze - at found) / at found`, of n cells and the squared deviations from both.
const BETTER: f32 = 35.0;

/// The least product of the two above.
const BOTH: f32 = 10.0;

/// Distance of gaze and place found from which they differ, in diagonals of the frame.
const APART: f32 = 0.125;

/// How much detail is lost from the sharpest place to the far half, as a difference of logarithms.
const LOST: f32 = 0.1;

/// How much neighbours of the difference have to be alike.
const STRUCTURED: f32 = 0.35;

/// The least part of detail and energy that is left without noise: if less is left, it was no noise, but
/// a pattern that is everywhere.
const LEFT: f32 = 0.1;

/// The same if pictures are to be called swapped.
const LEFT_OF_SWAPPED: f32 = 0.25;

/// Blur in pixels that is told from none.
const LEAST_BLUR: f32 = 0.15;

/// Blur in pixels beyond which nothing is alike.
const MOST_BLUR: f32 = 8.0;

pub(crate) fn check(sample: &Sample, gaze_px: Option<[f64; 2]>) -> Option<Suspicion> {
    let cells = cells(sample);
    if cells.len() < FEWEST_CELLS {
        return None;
    }
    let diagonal = sample.diagonal();
    let n = cells.len() as f32;
    let mean = cells.iter().map(|cell| cell.value).sum::<f32>() / n;
    let total: f32 = cells.iter().map(|cell| (cell.value - mean).powi(2)).sum();
    let (found, at_found) = best_place(&cells, (sample.width, sample.height), diagonal);
    let gaze = gaze_px.map(|gaze| gaze.map(|at| at as f32));
    let is_inside = |[x, y]: [f32; 2]| {
        (0.0..=sample.width as f32).contains(&x) && (0.0..=sample.height as f32).contains(&y)
    };
    // What is sharpest within the frame tells nothing about a gaze outside it.
    if gaze.is_some_and(|gaze| !is_inside(gaze)) {
        return None;
    }
    if let Some(swapped) = swapped(sample, gaze.unwrap_or(found)).or_else(|| swapped(sample, found))
    {
        return Some(swapped);
    }
    let gaze = gaze?;
    let at_gaze = deviation(&cells, gaze, diagonal);
    let better = n * (at_gaze - at_found) / at_found.max(f32::MIN_POSITIVE);
    let level = |place: [f32; 2]| {
        let near = cells.iter().filter(|cell| distance(cell.at, place) < 0.1 * diagonal);
        let (n, sum) = near.fold((0.0f32, 0.0), |(n, sum), cell| (n + 1.0, sum + cell.value));
        (n > 0.0).then_some(sum / n)
    };
    let clearer = level(found)? - level(gaze)?;
    let explained = 1.0 - at_found / total;
    let detail = Detail::around(sample, found);
    let is_elsewhere = distance(found, gaze) > APART * diagonal
        && explained >= EXPLAINED
        && clearer >= CLEARER
        && better >= BETTER
        && clearer * better >= BOTH
        && detail.near - detail.far >= LOST
        && detail.energy <= -LOST
        && detail.structure >= STRUCTURED
        && detail.left >= LEFT;
    is_elsewhere.then(|| {
        let message = format!(
            "the test is sharpest near ({:.0}, {:.0}), not at the gaze ({:.0}, {:.0}) px",
            found[0], found[1], gaze[0], gaze[1]
        );
        let help = "give the gaze with which the test was rendered, in pixels of the frame from its upper left \
                    corner: {gaze_px}; a crop moves the origin";
        Suspicion::new(Check::Gaze, message, help)
    })
}

/// How sharp the test is: the sharpness of the windows with structure, averaged in each cell of a
/// grid.
fn cells(sample: &Sample) -> Vec<Cell> {
    let mut sums = vec![[0.0f32; 4]; CELLS * CELLS];
    for window in sample.counted().filter(|w| w.variance[0].max(w.variance[1]) >= STRUCTURE) {
        let cell = |axis: usize, side: usize| {
            ((window.at[axis] / side as f32 * CELLS as f32) as usize).min(CELLS - 1)
        };
        let sums = &mut sums[cell(1, sample.height) * CELLS + cell(0, sample.width)];
        let values = [1.0, sharpness(window), window.at[0], window.at[1]];
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += value;
        }
    }
    let of = |[n, sharp, x, y]: &[f32; 4]| Cell { at: [x / n, y / n], value: sharp / n };
    sums.iter().filter(|sums| sums[0] > 0.0).map(of).collect()
}

/// The negative logarithm of the blur of a window in pixels. A blur, or an offset, of b pixels takes about
/// `(b k)²` of the correlation of a content with the wave number k: fine content loses more, so what
/// the content is hardly matters. Gain and offset of the brightness do not matter either.
fn sharpness(window: &Window) -> f32 {
    let r = window.correlation().max(0.0);
    let wave_number = (window.energy[0].max(window.energy[1])
        / window.variance[0].max(window.variance[1]))
    .sqrt();
    -libm::logf(((1.0 - r * r).max(0.0).sqrt() / wave_number).clamp(LEAST_BLUR, MOST_BLUR))
}

/// Fine detail of the test divided by that of the reference, as natural logarithms. What the smoothest
/// fifth of the windows has is noise, and does not count.
struct Detail {
    /// Around a place: in the nearest eighth of the windows.
    near: f32,
    /// In the farther half.
    far: f32,
    /// The same of the root mean square of the differences of neighbours, in the farther half.
    energy: f32,
    /// The same of the contrast within windows, in the farther half.
    contrast: f32,
    /// How much neighbours of the difference are alike there: about 0 for other samples of the same
    /// pixels, more if structure is missing.
    structure: f32,
    /// The smallest part of detail and energy that is left without noise.
    left: f32,
}

impl Detail {
    fn around(sample: &Sample, place: [f32; 2]) -> Self {
        let mut windows: Vec<(f32, &Window)> =
            sample.counted().map(|w| (distance(w.at, place), w)).collect();
        let (half, eighth) = (windows.len() / 2, windows.len() / 8);
        windows.select_nth_unstable_by(half, |a, b| a.0.total_cmp(&b.0));
        windows[..half].select_nth_unstable_by(eighth, |a, b| a.0.total_cmp(&b.0));
        let [near, far] = [&windows[..=eighth], &windows[half..]];
        let mut squares: Vec<f32> = far.iter().map(|(_, w)| w.residual[1]).collect();
        let noise = floor(&mut squares);
        let (products, squares) = far.iter().fold((0.0, 0.0), |(p, q), (_, w)| {
            (p + w.residual[0], q + (w.residual[1] - noise).max(0.0))
        });
        let variance = |side: usize| {
            let of = |(_, window): &(f32, &Window)| window.variance[side];
            far.iter().map(of).sum::<f32>().max(f32::MIN_POSITIVE)
        };
        let ([near_detail, _], left_near) = ratios(near, far);
        let ([far_detail, far_energy], left_far) = ratios(far, far);
        Self {
            near: near_detail,
            far: far_detail,
            energy: 0.5 * far_energy,
            contrast: 0.5 * libm::logf(variance(1) / variance(0)),
            structure: products / squares.max(f32::MIN_POSITIVE),
            left: left_near.min(left_far),
        }
    }
}

/// What the smoothest fifth of the windows has.
fn floor(values: &mut [f32]) -> f32 {
    let fifth = values.len() / 5;
    *values.select_nth_unstable_by(fifth, f32::total_cmp).1
}

/// Logarithms of the ratios of detail and of energy in some windows, without noise, which is estimated in
/// others; and the smallest part of them that is left.
fn ratios(windows: &[(f32, &Window)], noise: &[(f32, &Window)]) -> ([f32; 2], f32) {
    let structured = |(_, w): &&(f32, &Window)| w.variance[0].max(w.variance[1]) >= STRUCTURE / 2.0;
    let mut left = 1.0f32;
    let mut ratio = |value: fn(&Window) -> [f32; 2]| {
        let sums = [0, 1].map(|side| {
            let mut all: Vec<f32> = noise.iter().map(|(_, w)| value(w)[side]).collect();
            let floor = floor(&mut all);
            let windows = windows.iter().filter(structured).map(|(_, w)| value(w)[side]);
            let (all, above) = windows.fold((0.0f32, 0.0f32), |(all, above), value| {
                (all + value, above + (value - floor).max(0.0))
            });
            left = left.min(above / all.max(f32::MIN_POSITIVE));
            above.max(f32::MIN_POSITIVE)
        });
        libm::logf(sums[1] / sums[0])
    };
    ([ratio(|w| w.detail), ratio(|w| w.energy)], left)
}

/// The reference has less fine detail than the test away from the place where they are alike.
fn swapped(sample: &Sample, place: [f32; 2]) -> Option<Suspicion> {
    let Detail { near, far, energy, contrast, structure, left } = Detail::around(sample, place);
    let is_clear = structure >= STRUCTURED && left >= LEFT_OF_SWAPPED;
    // A method that enhances contrast raises that of coarse structure as much as that of fine.
    let is_finer = far.min(energy) >= 0.15 && energy - contrast >= LOST;
    (is_clear && is_finer && far - near >= LOST && near <= 0.4 * far).then(|| {
        let message = format!(
            "the reference has {:.0} % less fine detail than the test towards the edges: they seem to be \
             swapped",
            100.0 * (1.0 - libm::expf(-far))
        );
        let help = "give the ground truth as the reference, and the foveated frames as the test";
        Suspicion::new(Check::Swapped, message, help)
    })
}

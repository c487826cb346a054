//! Another scene, and pictures that are mirrored or upside down.

use crate::sample::{Sample, Window};
use crate::suspicion::{Check, Suspicion};

/// Cells along each side of the frame.
const CELLS: usize = 10;

/// Pictures whose cells vary less than this, as a share of white, say nothing about the scene.
const LEAST_SPREAD: f32 = 0.02;

/// How much larger the variance of the cells is than that of windows in any order: fine stripes have
/// none of their own at this scale.
const CERTAIN: f32 = 7.0;

/// Below this correlation of the windows' means, the pictures show different scenes.
const OTHER_SCENE: f32 = 0.6;

/// Below this one they do if fine structure does not correlate either.
const DOUBTFUL: f32 = 0.9;

/// The correlation of fine structure that tells doubtful pictures apart.
const FINE: f32 = 0.25;

/// Correlation within a window that is clear.
const CLEAR: f32 = 0.7;

/// The smallest number of windows with a clear correlation.
const FEWEST_CLEAR: f32 = 30.0;

/// Pictures of one scene are at least as alike as this ([`alike`]): correct pairs reach 0.97.
const ALIKE: f32 = 0.9;

/// A mirrored picture fits at least this many times as well.
const MIRRORED: f32 = 4.0;

/// ... and at least this well.
const LEAST_MIRRORED: f32 = 0.75;

const FLIPS: [(&str, bool, bool); 3] = [
    ("mirrored from left to right", true, false),
    ("upside down", false, true),
    ("turned by 180°", true, true),
];

pub(crate) fn check(sample: &Sample) -> Option<Suspicion> {
    let coarse = Coarse::new(sample);
    let same = coarse.correlation(false, false)?;
    if let Some(mirrored) = mirrored(&coarse, same) {
        return Some(mirrored);
    }
    let is_doubtful = same < OTHER_SCENE || (same < DOUBTFUL && fine(sample)? < FINE);
    let is_other = is_doubtful && alike(sample).is_none_or(|alike| alike < ALIKE);
    is_other.then(|| {
        let message = format!(
            "the test and the reference do not show the same: the correlation of their brightness is {same:.2}"
        );
        let help = "check that both are of the same scene, camera and frame, and that the names pair the right \
                    files";
        Suspicion::new(Check::Scene, message, help)
    })
}

fn mirrored(coarse: &Coarse, same: f32) -> Option<Suspicion> {
    let flipped =
        FLIPS.iter().filter_map(|(name, x, y)| Some((coarse.correlation(*x, *y)?, *name)));
    let (best, name) = flipped.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best >= LEAST_MIRRORED && (1.0 - best) * MIRRORED < 1.0 - same).then(|| {
        let message = format!(
            "the test is {name}: its correlation with the reference is {same:.2}, and {best:.2} if it \
             is flipped"
        );
        let help = if name == FLIPS[0].0 {
            "flip it when it is written, or check the sign of x in the projection"
        } else {
            "flip it when it is written: in files, rows go from the top down; OpenGL and some engines begin \
             at the bottom"
        };
        Suspicion::new(Check::Mirrored, message, help)
    })
}

/// Whether windows with a clear correlation are mostly alike, so that detail can be compared.
pub(crate) fn is_alike(sample: &Sample) -> bool {
    alike(sample).is_some_and(|alike| alike >= ALIKE)
}

/// Of the windows in which the pictures clearly correlate or anticorrelate, the share that
/// correlates less the share that does not: about 0 for pictures of different scenes, and about 1 for the
/// same, however coarse. `None` if there are few.
fn alike(sample: &Sample) -> Option<f32> {
    let clear = sample.counted().map(Window::correlation).filter(|r| r.abs() > CLEAR);
    let (n, sum) = clear.fold((0.0f32, 0.0), |(n, sum), r| (n + 1.0, sum + r.signum()));
    (n >= FEWEST_CLEAR).then(|| sum / n)
}

/// The means of large cells of both pictures. They change little with blur, noise and coarse samples.
struct Coarse {
    /// Means of the luma row by row; `None` where no window counts.
    cells: Vec<Option<[f32; 2]>>,
    /// The variance that the cells would have if windows had their values in any order.
    uncertain: [f32; 2],
}

/// Sums over the windows of a cell.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    n: f32,
    sums: [f32; 2],
    squares: [f32; 2],
}

impl Sums {
    fn add(&mut self, means: [f32; 2]) {
        self.n += 1.0;
        for (side, mean) in means.into_iter().enumerate() {
            self.sums[side] += mean;
            self.squares[side] += mean * mean;
        }
    }

    fn mean(&self) -> Option<[f32; 2]> {
        (self.n > 0.0).then(|| self.sums.map(|sum| sum / self.n))
    }

    /// The variance of the mean if the windows are independent.
    fn uncertain(&self, side: usize) -> f32 {
        if self.n < 2.0 {
            return 0.0;
        }
        let mean = self.sums[side] / self.n;
        (self.squares[side] / self.n - mean * mean).max(0.0) / (self.n - 1.0)
    }
}

impl Coarse {
    fn new(sample: &Sample) -> Self {
        let columns = sample.columns;
        let bands = sample.windows.len() / columns;
        let mut sums = vec![Sums::default(); CELLS * CELLS];
        for (at, window) in sample.windows.iter().enumerate().filter(|(_, window)| window.counts) {
            let (x, y) = (at % columns * CELLS / columns, at / columns * CELLS / bands);
            sums[y * CELLS + x].add(window.mean);
        }
        let cells = sums.iter().map(Sums::mean).collect();
        let n = sums.iter().filter(|sums| sums.n > 0.0).count() as f32;
        let uncertain =
            [0, 1].map(|side| sums.iter().map(|sums| sums.uncertain(side)).sum::<f32>() / n);
        Self { cells, uncertain }
    }

    /// The correlation with the flipped test; `None` if a picture has nearly the same brightness
    /// everywhere, or only fine structure.
    fn correlation(&self, flip_x: bool, flip_y: bool) -> Option<f32> {
        let flipped = |at: usize, flip: bool| if flip { CELLS - 1 - at } else { at };
        let pairs = (0..self.cells.len()).filter_map(|at| {
            let (x, y) = (flipped(at % CELLS, flip_x), flipped(at / CELLS, flip_y));
            Some([self.cells[at]?[0], self.cells[y * CELLS + x]?[1]])
        });
        let pairs: Vec<[f32; 2]> = pairs.collect();
        let (correlation, deviations) = pearson(&pairs)?;
        let tells = deviations.iter().zip(self.uncertain).all(|(deviation, uncertain)| {
            *deviation >= LEAST_SPREAD && deviation * deviation >= CERTAIN * uncertain
        });
        tells.then_some(correlation)
    }
}

/// The correlation of what the mean of each window differs from the mean of its neighbours.
fn fine(sample: &Sample) -> Option<f32> {
    let columns = sample.columns;
    let mut pairs = Vec::new();
    for at in columns..sample.windows.len().saturating_sub(columns) {
        if at % columns == 0 || at % columns == columns - 1 {
            continue;
        }
        let around = [at - columns, at - 1, at + 1, at + columns].map(|n| &sample.windows[n]);
        let window = &sample.windows[at];
        if !window.counts || around.iter().any(|w| !w.counts) {
            continue;
        }
        pairs.push([0, 1].map(|side| {
            window.mean[side] - around.iter().map(|w| w.mean[side]).sum::<f32>() / 4.0
        }));
    }
    Some(pearson(&pairs)?.0)
}

/// Pearson's correlation, and both standard deviations; `None` if one side does not vary.
pub(crate) fn pearson(pairs: &[[f32; 2]]) -> Option<(f32, [f32; 2])> {
    let n = pairs.len() as f64;
    let means = [0, 1].map(|side| pairs.iter().map(|p| f64::from(p[side])).sum::<f64>() / n);
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for pair in pairs {
        let [a, b] = [0, 1].map(|side| f64::from(pair[side]) - means[side]);
        aa += a * a;
        bb += b * b;
        ab += a * b;
    }
    let deviations = [aa, bb].map(|squares| (squares / n).sqrt() as f32);
    (aa > 0.0 && bb > 0.0).then(|| ((ab / (aa * bb).sqrt()) as f32, deviations))
}

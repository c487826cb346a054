//! The latest frames, as many as the temporal filters cover.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use multiversion::multiversion;

use super::grid::{Grid, ROW_STEP};
use super::params::Padding;
use super::temporal_filters::TemporalFilters;

/// The frames that the filters cover at the first frame of a sequence, the oldest first, as indices
/// into the sequence.
///
/// `circular` is as in the reference program: it ends with the last frame but one, and never
/// includes the first frame.
pub(crate) fn at_first_frame(padding: Padding, frames: usize, reach: usize) -> Vec<usize> {
    let frames_signed = frames as isize;
    match padding {
        Padding::Replicate => vec![0; reach],
        Padding::Circular => {
            let oldest = frames_signed - 1 - reach as isize;
            let index = |k: usize| (oldest + k as isize).rem_euclid(frames_signed) as usize;
            (0..reach).map(index).collect()
        }
        Padding::Pingpong => {
            let period = (2 * frames_signed - 2).max(1);
            let index = |back: usize| {
                let at = (-(back as isize)).rem_euclid(period);
                (if at < frames_signed { at } else { period - at }) as usize
            };
            (0..reach).rev().map(index).collect()
        }
    }
}

/// The luminance of the covered frames, the oldest first, each with its number in the sequence.
#[derive(Debug, Clone, Default)]
pub(crate) struct Window(VecDeque<(usize, Arc<Grid>)>);

impl Window {
    /// The window at the first frame.
    pub(crate) fn new(frames: Vec<(usize, Arc<Grid>)>) -> Self {
        Self(frames.into())
    }

    /// Continues with the next frame.
    pub(crate) fn push(&mut self, frame: usize, luminance: Arc<Grid>) {
        self.0.pop_front();
        self.0.push_back((frame, luminance));
    }

    /// The numbers of its frames.
    pub(crate) fn frames(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().map(|(frame, _)| *frame)
    }

    /// The newest frame.
    pub(crate) fn newest(&self) -> Arc<Grid> {
        Arc::clone(&self.0[self.0.len() - 1].1)
    }

    /// Its frames after filtering: sustained and transient.
    pub(crate) fn filtered<'a>(&'a self, filters: &TemporalFilters) -> Vec<Grid> {
        let taps = self.taps(filters);
        let (width, height) = self.0[0].1.size();
        let mut channels = vec![Grid::to_fill(width, height), Grid::to_fill(width, height)];
        Grid::fill_blocks_of(channels.iter_mut(), |first, blocks| {
            let [sustained, transient] = blocks else { return };
            let stride = self.0[0].1.stride();
            let rows = sustained.chunks_exact_mut(stride).zip(transient.chunks_exact_mut(stride));
            let mut weighted = Vec::with_capacity(taps.len());
            for (index, (sustained, transient)) in rows.enumerate() {
                let of_row = |(luminance, weights): &(&'a Grid, [f32; 2])| {
                    (luminance.padded_row(first + index), *weights)
                };
                weighted.clear();
                weighted.extend(taps.iter().map(of_row));
                sums(&weighted, sustained, transient);
            }
        });
        channels
    }

    /// Each frame with its weights in both filters. A frame that occurs several times has the sum
    /// of its weights, and a frame without weight is left out.
    fn taps(&self, filters: &TemporalFilters) -> Vec<(&Grid, [f32; 2])> {
        const NOTHING: f64 = 1e-12;
        let mut weights: BTreeMap<usize, (&Grid, [f64; 2])> = BTreeMap::new();
        for (back, (frame, luminance)) in self.0.iter().rev().enumerate() {
            let (_, sum) = weights.entry(*frame).or_insert((luminance, [0.0; 2]));
            for (sum, taps) in sum.iter_mut().zip(&filters.taps) {
                *sum += taps[back];
            }
        }
        let heavy = |weights: &[f64; 2]| weights.iter().any(|weight| weight.abs() >= NOTHING);
        let taps = weights.into_values().filter(|(_, weights)| heavy(weights));
        taps.map(|(luminance, weights)| (luminance, weights.map(|weight| weight as f32))).collect()
    }
}

/// The weighted sums of padded rows. Few columns are summed at a time, so that the sums stay in
/// registers until they are complete.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn sums(rows: &[(&[f32], [f32; 2])], sustained: &mut [f32], transient: &mut [f32]) {
    let parts = sustained.as_chunks_mut::<ROW_STEP>().0.iter_mut();
    let parts = parts.zip(transient.as_chunks_mut::<ROW_STEP>().0);
    for (part, (sustained, transient)) in parts.enumerate() {
        let (mut slow, mut fast) = ([0.0f32; ROW_STEP], [0.0f32; ROW_STEP]);
        for (row, [weight_sustained, weight_transient]) in rows {
            let luminance = &row.as_chunks::<ROW_STEP>().0[part];
            for i in 0..ROW_STEP {
                slow[i] += weight_sustained * luminance[i];
                fast[i] += weight_transient * luminance[i];
            }
        }
        (*sustained, *transient) = (slow, fast);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn padding_before_the_first_frame() {
        let at = |padding, frames, reach| at_first_frame(padding, frames, reach);
        assert_eq!(at(Padding::Replicate, 5, 3), [0, 0, 0]);
        assert_eq!(at(Padding::Pingpong, 5, 4), [3, 2, 1, 0]);
        assert_eq!(at(Padding::Pingpong, 3, 8), [1, 2, 1, 0, 1, 2, 1, 0]);
        assert_eq!(at(Padding::Pingpong, 2, 4), [1, 0, 1, 0]);
        assert_eq!(at(Padding::Circular, 12, 8), [3, 4, 5, 6, 7, 8, 9, 10]);
        assert_eq!(at(Padding::Circular, 3, 5), [0, 1, 2, 0, 1]);
    }

    #[test]
    fn a_frame_that_occurs_twice_is_filtered_once() {
        let filters = TemporalFilters::new(8.0);
        let grid = |value: f32| {
            let mut grid = Grid::new(3, 2);
            grid.fill_blocks(|_, rows| rows.for_each(|row| row[..3].fill(value)));
            Arc::new(grid)
        };
        let mut window = Window::new(vec![(0, grid(2.0)), (0, grid(2.0))]);
        assert_eq!(window.taps(&filters).len(), 1);
        let [sustained, transient] = [0, 1].map(|c: usize| filters.taps[c].iter().sum::<f64>());
        let filtered = window.filtered(&filters);
        assert!((f64::from(filtered[0].row(1)[2]) - 2.0 * sustained).abs() < 1e-6);
        assert!((f64::from(filtered[1].row(1)[2]) - 2.0 * transient).abs() < 1e-6);
        window.push(1, grid(4.0));
        assert_eq!(window.frames().collect::<Vec<_>>(), [0, 1]);
        let wanted = 4.0 * filters.taps[1][0] + 2.0 * filters.taps[1][1];
        assert!((f64::from(window.filtered(&filters)[1].row(0)[0]) - wanted).abs() < 1e-6);
    }
}

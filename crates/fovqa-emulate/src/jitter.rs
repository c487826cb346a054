//! Jitter: from frame to frame samples stand elsewhere within their cells, so that the temporal filter
//! sees more of the scene than one sample per cell.
//!
//! ξ and η are the points of the Halton sequence of the bases 2 and 3 (Halton 1960), as renderers with
//! temporal antialiasing use them.

use fovqa_params::words;

words! {
    /// Where within their cells samples stand, from frame to frame.
    #[derive(Default)]
    pub enum Jitter {
        /// In the centres of their cells, in all frames.
        #[default]
        None "none" "In the centres of their cells";
        /// At the Halton sequence's point (ξ, η) of the frame, the same in all cells; the 4x4 places
        /// of an area sample at that point of their sixteenths of the cell.
        Halton "halton" "At the frame's point of the Halton sequence, bases 2 and 3";
    }
}

/// The centre of a cell.
pub(crate) const CENTRE: [f64; 2] = [0.5, 0.5];

impl Jitter {
    /// Where samples of a frame, counted from 0, stand within their cells: from 0 to 1 along the
    /// columns and rows of their buffer.
    pub(crate) fn within_cell(self, frame: usize) -> [f64; 2] {
        match self {
            Self::None => CENTRE,
            Self::Halton => [2, 3].map(|base| radical_inverse(base, frame.saturating_add(1))),
        }
    }
}

/// The digits of `index` behind the point, the last one first.
fn radical_inverse(base: usize, index: usize) -> f64 {
    let (mut rest, mut inverse, mut digit) = (index, 0.0, 1.0 / base as f64);
    while rest > 0 {
        inverse += (rest % base) as f64 * digit;
        rest /= base;
        digit /= base as f64;
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_have_their_points_of_the_sequence() {
        let expected = [
            [1.0 / 2.0, 1.0 / 3.0],
            [1.0 / 4.0, 2.0 / 3.0],
            [3.0 / 4.0, 1.0 / 9.0],
            [1.0 / 8.0, 4.0 / 9.0],
            [5.0 / 8.0, 7.0 / 9.0],
        ];
        for (frame, expected) in expected.into_iter().enumerate() {
            let found = Jitter::Halton.within_cell(frame);
            assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-15), "{frame}: {found:?}");
            assert!(Jitter::None.within_cell(frame) == CENTRE);
        }
        let late = Jitter::Halton.within_cell((1 << 30) - 2);
        assert!(late.iter().all(|x| (0.0..1.0).contains(x)), "{late:?}");
    }
}

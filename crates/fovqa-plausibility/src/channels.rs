//! Red and blue in the place of each other.

use fovqa_frame::{Channels, Frame};

use crate::pair::Looked;
use crate::sample::Sample;
use crate::suspicion::{Check, Suspicion};

/// Root mean square of red less blue, as a share of the sum of the channels, below which pictures are
/// nearly gray.
const COLOURED: f32 = 0.03;

/// The correlation of red less blue below which the channels are swapped. It is about 1 for the same
/// colours.
const SWAPPED: f32 = -0.5;

pub(crate) fn check(pair: &Looked<'_>, sample: &Sample) -> Option<Suspicion> {
    let sides = [pair.reference, pair.test];
    if sides.iter().any(|frame| frame.channels() != Channels::Rgb) {
        return None;
    }
    let (mut squares, mut product, mut n) = ([0.0f32; 2], 0.0f32, 0.0f32);
    for window in sample.counted() {
        let [x, y] = window.at.map(|at| at as usize);
        let [Some(r), Some(t)] = sides.map(|frame| red_less_blue(frame, x, y)) else { continue };
        squares[0] += r * r;
        squares[1] += t * t;
        product += r * t;
        n += 1.0;
    }
    let is_coloured = squares.iter().all(|sum| *sum >= COLOURED * COLOURED * n.max(1.0));
    let correlation = product / (squares[0] * squares[1]).sqrt();
    (is_coloured && correlation < SWAPPED).then(|| {
        let message = "red and blue of the test are those of the reference in the place of each other";
        let help = "write the channels in the order red, green, blue: some libraries and engines keep blue first";
        Suspicion::new(Check::Channels, message.to_owned(), help)
    })
}

/// Red less blue, as a share of the sum of the channels; `None` for a pixel that is black or not finite.
fn red_less_blue(frame: &Frame, x: usize, y: usize) -> Option<f32> {
    let [r, g, b] = [0, 1, 2].map(|channel| frame.sample(channel, x, y).max(0.0));
    let sum = r + g + b;
    (sum > 0.0 && sum.is_finite()).then(|| (r - b) / sum)
}

//! What happens to correct pairs, and mistakes.

use fovqa_plausibility::Check;

use crate::picture::{Pair, Picture};

/// Differences that a correct pair may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Innocent {
    /// The render as it is.
    Render,
    /// Noise in the test.
    Noise,
    /// Noise in the test that grows away from the gaze.
    FarNoise,
    /// Blur of the whole test.
    Blur,
    /// A test that is the reference with a blur that grows away from the gaze.
    Foveated,
    /// A test that is the reference in blocks that grow away from the gaze.
    Blocks,
    /// Both are black outside a circle.
    Partial,
    /// The test alone is black outside a circle.
    PartialTest,
}

impl Innocent {
    pub(crate) const ALL: [Self; 8] = [
        Self::Render,
        Self::Noise,
        Self::FarNoise,
        Self::Blur,
        Self::Foveated,
        Self::Blocks,
        Self::Partial,
        Self::PartialTest,
    ];

    pub(crate) fn apply(self, pair: &Pair, seed: u64) -> Pair {
        let (mut pair, gaze) = (pair.clone(), pair.gaze);
        match self {
            Self::Render => {}
            Self::Noise => pair.test = pair.test.noisy(4.0 / 255.0, seed),
            Self::FarNoise => pair.test = far_noise(&pair.test, gaze, seed),
            Self::Blur => pair.test = pair.test.blurred(gaze, |_| 1.0),
            Self::Foveated => pair.test = foveated(&pair.reference, gaze),
            Self::Blocks => pair.test = pair.reference.in_blocks(gaze),
            Self::Partial => {
                pair.reference = pair.reference.in_circle();
                pair.test = pair.test.in_circle();
            }
            Self::PartialTest => pair.test = pair.test.in_circle(),
        }
        pair
    }
}

fn foveated(picture: &Picture, gaze: [f64; 2]) -> Picture {
    picture.blurred(gaze, |distance| ((distance - 0.1) * 10.0).clamp(0.0, 4.0))
}

fn far_noise(picture: &Picture, gaze: [f64; 2], seed: u64) -> Picture {
    let noisy = picture.noisy(1.0, seed);
    let mut far = picture.clone();
    let diagonal = (picture.width as f64).hypot(picture.height as f64);
    for (at, value) in far.values.iter_mut().enumerate() {
        let (x, y) = (at / 3 % picture.width, at / 3 / picture.width);
        let distance = (x as f64 - gaze[0]).hypot(y as f64 - gaze[1]) / diagonal;
        *value += (noisy.values[at] - *value) * 0.08 * distance as f32;
    }
    far
}

/// A mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Mistake {
    Exposure,
    Transfer,
    Swapped,
    Gaze,
    Scene,
    Mirrored,
    Shifted,
    Channels,
    Constant,
}

/// A pair with a mistake, and the checks that may be to notice it.
pub(crate) struct Made {
    pub(crate) pair: Pair,
    pub(crate) check: &'static [Check],
}

impl Mistake {
    pub(crate) const ALL: [Self; 9] = [
        Self::Exposure,
        Self::Transfer,
        Self::Swapped,
        Self::Gaze,
        Self::Scene,
        Self::Mirrored,
        Self::Shifted,
        Self::Channels,
        Self::Constant,
    ];

    /// The checks that may notice it. Linear values that are taken for encoded ones can leave so little
    /// but black that only the exposure is told.
    pub(crate) fn checks(self) -> &'static [Check] {
        match self {
            Self::Exposure => &[Check::Exposure],
            Self::Transfer => &[Check::Transfer, Check::Exposure],
            Self::Swapped => &[Check::Swapped],
            Self::Gaze => &[Check::Gaze],
            Self::Scene => &[Check::Scene],
            Self::Mirrored => &[Check::Mirrored],
            Self::Shifted => &[Check::Shifted],
            Self::Channels => &[Check::Channels],
            Self::Constant => &[Check::Constant],
        }
    }

    /// The share of the cases that has to be noticed. Renders that lose little detail, or that have about
    /// as much as a denoised reference, do not tell which of the two is foveated, and where, nor whether
    /// they are one pixel off.
    pub(crate) fn least(self) -> f64 {
        match self {
            Self::Swapped | Self::Gaze => 0.35,
            Self::Shifted => 0.8,
            _ => 1.0,
        }
    }

    /// Pairs with the mistake.
    pub(crate) fn made(self, correct: &Pair, other: &Picture) -> Vec<Made> {
        let check = self.checks();
        let test = |test: Picture| Made { pair: Pair { test, ..correct.clone() }, check };
        let picture = &correct.test;
        match self {
            Self::Exposure => {
                // A factor of linear light is nearly one of the signal.
                let by = |stops: f32| move |v: f32| encoded(decoded(v) * stops.exp2()).min(1.0);
                [-2.0, -0.8, -0.35, 0.35, 1.0].map(|stops| test(picture.map(by(stops)))).into()
            }
            Self::Transfer => vec![test(picture.map(decoded)), test(picture.map(encoded))],
            Self::Swapped => {
                let (reference, test) = (correct.test.clone(), correct.reference.clone());
                vec![Made { pair: Pair { reference, test, ..correct.clone() }, check }]
            }
            Self::Gaze => {
                let (w, h) = (picture.width as f64, picture.height as f64);
                let places = [[0.15, 0.2], [0.85, 0.25], [0.2, 0.85], [0.75, 0.7]];
                let gaze = places.map(|[x, y]| [x * w, y * h]);
                gaze.map(|gaze| Made { pair: Pair { gaze, ..correct.clone() }, check }).into()
            }
            Self::Scene => vec![test(picture.filled_from(other))],
            Self::Mirrored => {
                let flips = [(true, false), (false, true), (true, true)];
                flips.map(|(across, down)| test(picture.flipped(across, down))).into()
            }
            Self::Shifted => {
                let by = [[1, 0], [0, -1], [2, 3], [-7, 4], [25, -11]];
                by.map(|by| test(picture.shifted(by))).into()
            }
            Self::Channels => vec![test(picture.blue_first())],
            Self::Constant => {
                let half = |v: Picture| {
                    let mut v = v;
                    let n = v.values.len() / 2;
                    v.values[n..].fill(0.0);
                    v
                };
                vec![
                    test(picture.map(|_| 0.0)),
                    test(picture.map(|_| 0.4)),
                    test(half(picture.clone())),
                ]
            }
        }
    }
}

fn decoded(v: f32) -> f32 {
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

fn encoded(v: f32) -> f32 {
    if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }
}

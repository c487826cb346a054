//! Simulated observers. They do not use the models of the crate, so that an error in these shows.

use fovqa_study::distributions::normal_cdf;
use fovqa_study::options::{Direction, Sigmoid};
use fovqa_study::random::Replicate;

/// Φ⁻¹(0.75).
const PROBIT_75: f64 = 0.674_489_750_196_081_7;
/// Φ⁻¹(0.95).
const PROBIT_95: f64 = 1.644_853_626_951_472_2;

/// How an observer's impressions of a method scatter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Impressions {
    /// Gumbel distribution: the choices are those of Bradley and Terry.
    Gumbel,
    /// Normal distribution: the choices are those of Thurstone's case V.
    Normal,
}

impl Impressions {
    /// An impression of a method with this score in JOD. At a difference of 1 JOD, the impression of
    /// the better method is better in 75 % of pairs.
    pub(crate) fn of(self, jod: f64, random: &mut Replicate) -> f64 {
        match self {
            // The difference of two Gumbel numbers is logistic, and 1/(1 + e^(-ln 3)) = 0.75.
            Self::Gumbel => jod * libm::log(3.0) - libm::log(-libm::log(positive(random))),
            // The difference of two normal numbers has the variance 2.
            Self::Normal => jod * PROBIT_75 * std::f64::consts::SQRT_2 + random.normal(),
        }
    }

    /// True if the observer prefers the first of two methods.
    pub(crate) fn prefers_first(self, jod: [f64; 2], random: &mut Replicate) -> bool {
        self.of(jod[0], random) > self.of(jod[1], random)
    }
}

/// A uniform number above 0 and below 1.
fn positive(random: &mut Replicate) -> f64 {
    random.uniform() + 2.0_f64.powi(-54)
}

/// The share of votes at a difference of `jod`, if the scores of participants have the standard
/// deviation `sd`: the mean of Φ(cd) over d ~ N(jod, 2 sd²) is Φ(c jod/√(1 + 2 c² sd²)).
pub(crate) fn share_of_normal(jod: f64, sd: f64) -> f64 {
    normal_cdf(PROBIT_75 * pooled(jod, sd))
}

/// The difference in JOD that pooled votes of such participants show.
pub(crate) fn pooled(jod: f64, sd: f64) -> f64 {
    jod / (1.0 + 2.0 * PROBIT_75 * PROBIT_75 * sd * sd).sqrt()
}

/// An observer with a psychometric function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Observer {
    pub(crate) sigmoid: Sigmoid,
    pub(crate) direction: Direction,
    /// The level at which F = ½.
    pub(crate) threshold: f64,
    /// The distance from F = .05 to F = .95, for Weibull in the logarithm of the level.
    pub(crate) width: f64,
    pub(crate) guess: f64,
    pub(crate) lapse: f64,
}

impl Observer {
    /// The probability of a correct answer.
    pub(crate) fn performance(&self, level: f64) -> f64 {
        let distance = match self.sigmoid {
            Sigmoid::Weibull => libm::log(level / self.threshold),
            Sigmoid::Logistic | Sigmoid::Gaussian => level - self.threshold,
        };
        let z = match self.direction {
            Direction::Increasing => distance / self.width,
            Direction::Decreasing => -distance / self.width,
        };
        let share = match self.sigmoid {
            Sigmoid::Logistic => 1.0 / (1.0 + libm::pow(19.0, -2.0 * z)),
            Sigmoid::Gaussian => normal_cdf(2.0 * PROBIT_95 * z),
            // 1 - 2^-(x/m)^β, with β w = ln(ln .05/ln .95).
            Sigmoid::Weibull => 1.0 - libm::exp2(-libm::pow(libm::log(0.05) / libm::log(0.95), z)),
        };
        self.guess + (1.0 - self.guess - self.lapse) * share
    }

    /// The level of this performance, by bisection.
    pub(crate) fn level_of(&self, performance: f64) -> f64 {
        let lowest = if self.sigmoid == Sigmoid::Weibull { 1e-3 } else { -1e3 };
        let (mut low, mut high) = (lowest, 1e3);
        let is_low_easy = self.direction == Direction::Decreasing;
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if (self.performance(middle) > performance) == is_low_easy {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// The correct answers of a block whose answers are not independent, by Pólya's urn: each answer
    /// makes the same answer more probable. They have a beta-binomial distribution, with the variance
    /// p(1 - p)(n + n(n - 1)η²).
    pub(crate) fn correct_of_block(
        &self,
        level: f64,
        trials: u64,
        eta: f64,
        random: &mut Replicate,
    ) -> u64 {
        let performance = self.performance(level);
        let added = eta * eta / (1.0 - eta * eta);
        let mut correct = 0;
        for before in 0..trials {
            let right = performance + added * correct as f64;
            correct += u64::from(random.bernoulli(right / (1.0 + added * before as f64)));
        }
        correct
    }

    /// Answers a trial.
    pub(crate) fn is_correct(&self, level: f64, random: &mut Replicate) -> bool {
        random.bernoulli(self.performance(level))
    }
}

/// A staircase that becomes harder after two correct answers in a row, and easier after each wrong
/// one.
#[derive(Debug, Clone)]
pub(crate) struct Staircase {
    /// The level of the next trial.
    pub(crate) level: f64,
    /// The sizes of steps: the first until the first reversal, and so on.
    steps: &'static [f64],
    limits: [f64; 2],
    harder: f64,
    correct_in_a_row: u32,
    last_move: f64,
    reversals: usize,
}

impl Staircase {
    /// A staircase before its first trial.
    pub(crate) fn new(
        start: f64,
        steps: &'static [f64],
        limits: [f64; 2],
        direction: Direction,
    ) -> Self {
        let harder = if direction == Direction::Increasing { -1.0 } else { 1.0 };
        Self {
            level: start,
            steps,
            limits,
            harder,
            correct_in_a_row: 0,
            last_move: 0.0,
            reversals: 0,
        }
    }

    /// Moves after an answer.
    pub(crate) fn answer(&mut self, is_correct: bool) {
        if is_correct && self.correct_in_a_row == 0 {
            self.correct_in_a_row = 1;
            return;
        }
        self.correct_in_a_row = 0;
        let direction = if is_correct { self.harder } else { -self.harder };
        if direction + self.last_move == 0.0 {
            self.reversals += 1;
        }
        self.last_move = direction;
        let step = self.steps[self.reversals.min(self.steps.len() - 1)];
        self.level = (self.level + direction * step).clamp(self.limits[0], self.limits[1]);
    }
}

/// The whole-numbered rating from `lowest` to `highest` that is nearest to an impression.
pub(crate) fn rating(impression: f64, lowest: f64, highest: f64) -> f64 {
    impression.round().clamp(lowest, highest)
}

/// The mean of such ratings, if impressions have a normal distribution.
pub(crate) fn mean_rating(mean: f64, sd: f64, lowest: u32, highest: u32) -> f64 {
    let above = |step: u32| normal_cdf((mean - f64::from(step) + 0.5) / sd);
    f64::from(lowest) + (lowest + 1..=highest).map(above).sum::<f64>()
}

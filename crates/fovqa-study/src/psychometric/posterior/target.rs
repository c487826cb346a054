//! The posterior density of a psychometric function, without its constant, and its mode.

use super::super::levels::{Span, Trials};
use super::super::model::{Curve, Model};
use super::likelihood::{dispersion, level, normaliser};
use super::prior;
use crate::simplex::minimise;

/// The largest λ of the prior.
const MOST_LAPSE: f64 = 0.5;
/// The largest η that is considered; the prior has a share of 1e-30 above it.
const MOST_ETA: f64 = 0.999;

/// The parameters of the posterior.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parameters {
    /// m, w and λ.
    pub(super) curve: Curve,
    /// η.
    pub(super) eta: f64,
}

/// The posterior of some trials.
#[derive(Debug, Clone, Copy)]
pub(super) struct Target<'a> {
    /// The kind of function.
    pub(super) model: &'a Model,
    /// The answers, condensed.
    pub(super) trials: &'a Trials,
    /// The span of their levels.
    pub(super) span: &'a Span,
    /// λ, if it is fixed.
    pub(super) lapse: Option<f64>,
    /// True if η is fitted, false if it is 0.
    pub(super) overdispersion: bool,
}

/// A range of each parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Region {
    /// m.
    pub(super) position: [f64; 2],
    /// w.
    pub(super) width: [f64; 2],
    /// λ.
    pub(super) lapse: [f64; 2],
    /// η.
    pub(super) eta: [f64; 2],
}

impl Target<'_> {
    /// The region in which the prior is not 0.
    pub(super) fn support(&self) -> Region {
        let Span { first, last, range, gap } = *self.span;
        let most_lapse = MOST_LAPSE.min(1.0 - self.model.guess);
        Region {
            position: [first - 0.5 * range, last + 0.5 * range],
            width: [gap, 3.0 * range],
            lapse: self.lapse.map_or([0.0, most_lapse], |lapse| [lapse, lapse]),
            eta: if self.overdispersion { [0.0, MOST_ETA] } else { [0.0, 0.0] },
        }
    }

    /// The logarithm of the priors of λ and η.
    pub(super) fn nuisance_prior(&self, lapse: f64, eta: f64) -> f64 {
        let lapse = if self.lapse.is_some() { 0.0 } else { prior::beta(lapse) };
        lapse + if self.overdispersion { prior::beta(eta) } else { 0.0 }
    }

    /// The logarithm of the priors of m and w.
    pub(super) fn curve_prior(&self, position: f64, width: f64) -> f64 {
        prior::position(self.span, position) + prior::width(self.span, width)
    }

    /// The logarithm of the density.
    pub(super) fn log_density(&self, at: &Parameters) -> f64 {
        let Curve { position, width, lapse } = at.curve;
        let prior = self.curve_prior(position, width) + self.nuisance_prior(lapse, at.eta);
        if prior == f64::NEG_INFINITY {
            return prior;
        }
        let (sign, delta) = (self.model.direction.sign(), dispersion(at.eta));
        let term = |(x, correct, count): (f64, f64, f64)| {
            let point = self.model.sigmoid.at(sign * (x - position) / width);
            let (right, wrong) = self.model.outcomes(point, lapse);
            level(correct, count, right, wrong, delta) - normaliser(count, delta)
        };
        let repeats = &self.trials.repeats;
        prior + self.trials.iter().zip(repeats).map(|(level, n)| n * term(level)).sum::<f64>()
    }

    /// The joint mode, from the best of some starts, and the logarithm of its density.
    pub(super) fn mode(&self, starts: &[Parameters]) -> Option<(Parameters, f64)> {
        let best = starts
            .iter()
            .map(|start| (*start, self.log_density(start)))
            .filter(|(_, density)| density.is_finite())
            .max_by(|a, b| a.1.total_cmp(&b.1))?;
        let support = self.support();
        let mut mode = best;
        // Where the mode has λ = 0 or η = 0, the simplex finds it on that face only.
        for lapse in [support.lapse, [support.lapse[0]; 2]] {
            for eta in [support.eta, [support.eta[0]; 2]] {
                let found = self.mode_within(&mode.0, &Region { lapse, eta, ..support });
                if found.1 > mode.1 {
                    mode = found;
                }
            }
        }
        Some(mode)
    }

    fn mode_within(&self, start: &Parameters, region: &Region) -> (Parameters, f64) {
        let of = |p: &[f64; 4]| Parameters {
            curve: Curve { position: p[0], width: libm::exp(p[1]), lapse: p[2] },
            eta: p[3],
        };
        let Curve { position, width, lapse } = start.curve;
        let start = [position, libm::log(width), lapse, start.eta];
        // The first simplex is as large as the standard error of a threshold may be.
        let counts = self.trials.trials.iter().zip(&self.trials.repeats);
        let trials: f64 = counts.map(|(trials, repeats)| trials * repeats).sum();
        let small = 1.0 / libm::sqrt(trials.max(4.0));
        let steps = [width * small, 2.0 * small, 0.03, 0.1];
        let limits = [region.position, region.width.map(libm::log), region.lapse, region.eta];
        let (point, value) = minimise(|p| -self.log_density(&of(p)), start, steps, limits);
        (of(&point), -value)
    }
}

//! The Bayesian fit of a psychometric function with beta-binomial answers, after psignifit 4 (Schütt,
//! Harmeling, Macke and Wichmann 2016, "Painfree and accurate Bayesian estimation of psychometric
//! functions for (potentially) overdispersed data").
//!
//! Summaries are those of the continuous posterior. psignifit's own limits are taken from its grid and
//! lie up to one grid step lower.

mod integral;
mod likelihood;
mod marginal;
mod prior;
mod quadrature;
mod region;
mod table;
mod target;

use serde::Serialize;

use self::integral::Integral;
use self::region::region;
use self::target::{Parameters, Target};
use super::levels::{Span, Trials};
use super::model::Curve;
use super::options::Options;
use crate::bootstrap::Interval;
use crate::json::finite;

/// Levels in excess of this many are condensed.
const MOST_LEVELS: usize = 160;
/// The starts of the search for the mode: shares η of overdispersion.
const STARTS: [f64; 3] = [0.0, 0.1, 0.3];

/// The posterior of a psychometric function.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Posterior {
    /// The joint mode.
    pub map: Estimate,
    /// The means; for `weibull`, the threshold is the exponential of the mean of ln m.
    pub mean: Estimate,
    /// The medians.
    pub median: Estimate,
    /// The equal-tailed intervals.
    pub intervals: Intervals,
    /// The levels at which the requested performance is reached.
    pub thresholds: Vec<Threshold>,
}

/// An estimate of all parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimate {
    /// The level m at which F = ½.
    pub threshold: f64,
    /// The distance w between F = .05 and F = .95, in levels, for `weibull` in their logarithm.
    pub width: f64,
    /// The rate λ of lapses.
    pub lapse: f64,
    /// η: the square root of the share of the largest possible additional variance.
    pub eta: f64,
}

/// Intervals of all parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Intervals {
    /// Of the level m.
    pub threshold: [f64; 2],
    /// Of the width w.
    pub width: [f64; 2],
    /// Of λ.
    pub lapse: [f64; 2],
    /// Of η.
    pub eta: [f64; 2],
}

/// The posterior of the level at which ψ reaches a performance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Threshold {
    /// The performance ψ, from 0 to 1.
    pub performance: f64,
    /// The median level.
    pub median: Option<f64>,
    /// The equal-tailed interval; a limit is undefined if the performance is not reached there.
    pub ci: Option<Interval>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The posterior of trials at two or more levels; `None` if its density is not finite anywhere.
pub(super) fn fit(
    options: &Options,
    trials: &Trials,
    span: &Span,
    start: &Curve,
    confidence: f64,
) -> Option<Posterior> {
    let condensed = trials.condensed(MOST_LEVELS);
    let target = Target {
        model: &options.model,
        trials: &condensed,
        span,
        lapse: options.lapse,
        overdispersion: options.overdispersion,
    };
    let (mode, density) = target.mode(&starts(&target, start))?;
    let region = region(&target, &mode, density);
    let integral = Integral::new(&target, region, density);
    summary(options, &mode, &integral, confidence)
}

/// The fitted curve, and curves over the whole range of levels.
fn starts(target: &Target<'_>, fitted: &Curve) -> Vec<Parameters> {
    let support = target.support();
    let inside = |value: f64, [low, high]: [f64; 2]| {
        // The prior is 0 at its ends.
        let margin = 0.01 * (high - low);
        if margin > 0.0 { value.clamp(low + margin, high - margin) } else { low }
    };
    let mut curves = vec![Curve {
        position: inside(fitted.position, support.position),
        width: inside(fitted.width, support.width),
        lapse: inside(fitted.lapse, support.lapse),
    }];
    for share in [0.1, 0.3, 0.5, 0.7, 0.9] {
        let span = target.span;
        let position = span.first + share * span.range;
        for width in [1.5 * span.gap, 0.5 * span.range, span.range] {
            let lapse = inside(0.02, support.lapse);
            curves.push(Curve { position, width: inside(width, support.width), lapse });
        }
    }
    let etas = STARTS.map(|eta| if target.overdispersion { eta } else { 0.0 });
    let with = |&curve: &Curve| etas.map(|eta| Parameters { curve, eta });
    curves.iter().flat_map(with).collect()
}

fn summary(
    options: &Options,
    mode: &Parameters,
    integral: &Integral,
    confidence: f64,
) -> Option<Posterior> {
    let level = |x: f64| options.model.sigmoid.level(x);
    let (position, width) = (integral.position(), integral.width());
    if !(position.mass() > 0.0 && position.mass().is_finite()) {
        return None;
    }
    let shares = [0.5, 0.5 - 0.5 * confidence, 0.5 + 0.5 * confidence];
    let at = |share: f64| Estimate {
        threshold: level(position.quantile(share)),
        width: width.quantile(share),
        lapse: integral.lapse.quantile(share),
        eta: integral.eta.quantile(share),
    };
    let [median, low, high] = shares.map(at);
    Some(Posterior {
        map: Estimate {
            threshold: level(mode.curve.position),
            width: mode.curve.width,
            lapse: mode.curve.lapse,
            eta: mode.eta,
        },
        mean: Estimate {
            threshold: level(position.mean()),
            width: width.mean(),
            lapse: integral.lapse.mean(),
            eta: integral.eta.mean(),
        },
        median,
        intervals: Intervals {
            threshold: [low.threshold, high.threshold],
            width: [low.width, high.width],
            lapse: [low.lapse, high.lapse],
            eta: [low.eta, high.eta],
        },
        thresholds: options
            .performance
            .iter()
            .map(|&performance| threshold(options, integral, performance, shares))
            .collect(),
    })
}

fn threshold(
    options: &Options,
    integral: &Integral,
    performance: f64,
    shares: [f64; 3],
) -> Threshold {
    let model = &options.model;
    let sign = model.direction.sign();
    let shifts: Option<Vec<f64>> = integral
        .lapse
        .nodes
        .iter()
        .map(|&lapse| model.z_of(performance, lapse).map(|z| sign * z))
        .collect();
    let Some(shifts) = shifts else {
        let reason = Some("the performance is not above the guess rate".to_owned());
        return Threshold { performance, median: None, ci: None, reason };
    };
    let [median, low, high] = integral
        .shifted_quantiles(&shifts, shares)
        .map(|x| finite(x).map(|x| model.sigmoid.level(x)));
    let reason = (median.is_none() || low.is_none() || high.is_none())
        .then(|| "too often, the function does not reach the performance".to_owned());
    Threshold { performance, median, ci: Some([low, high]), reason }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is fixed comes back exactly")]
mod tests;

//! The maximum-likelihood fit of a psychometric function, its goodness of fit, and parametric
//! bootstrap intervals (Wichmann and Hill 2001).

mod grid;
mod likelihood;
mod polish;

use serde::Serialize;

use self::grid::Grid;
use self::likelihood::{Bounds, deviance};
use self::polish::{Maximum, maximum};
use super::levels::{Span, Trials};
use super::model::Curve;
use super::options::Options;
use crate::Settings;
use crate::bootstrap::{Interval, interval, replicates};
use crate::distributions::chi_squared_upper;
use crate::json::finite;

/// Nearer to a bound than this share of the range of levels, a parameter is not determined.
const AT_BOUND: f64 = 1e-6;

/// The fit that makes the answers most probable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MaximumLikelihood {
    /// The level m at which F = ½.
    pub threshold: Option<f64>,
    /// The distance w between F = .05 and F = .95, in levels, for `weibull` in their logarithm.
    pub width: Option<f64>,
    /// The rate λ of lapses.
    pub lapse: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The log-likelihood, without binomial coefficients.
    pub log_likelihood: f64,
    /// The deviance against the saturated model.
    pub deviance: f64,
    /// Levels minus fitted parameters; may be 0 or below.
    pub df: i64,
    /// P(χ² ≥ deviance).
    pub p_chi2: Option<f64>,
    /// The share of simulated deviances that are at least as large.
    pub p_bootstrap: Option<f64>,
    /// The number of bootstrap fits with a parameter at a bound.
    pub at_bound: Option<usize>,
    /// The levels at which the requested performance is reached.
    pub thresholds: Vec<LevelAt>,
}

/// The level at which ψ reaches a performance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelAt {
    /// The performance ψ, from 0 to 1.
    pub performance: f64,
    /// The level.
    pub level: Option<f64>,
    /// The bootstrap interval; a limit is undefined if the performance is not reached there.
    pub ci: Option<Interval>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// What all fits to the same levels have in common.
struct Fitter<'a> {
    options: &'a Options,
    bounds: Bounds,
    tolerance: f64,
    grid: Grid,
}

impl Fitter<'_> {
    fn fit(&self, trials: &Trials) -> Option<Maximum> {
        let starts = self.grid.best(&trials.correct);
        maximum(&self.options.model, trials, &self.bounds, &starts)
    }

    fn at_bound(&self, fit: &Maximum) -> bool {
        self.bounds.touches(&fit.curve, self.tolerance)
    }

    /// The level at a performance; infinite if it is not reached, `None` if it is not above γ.
    fn level(&self, fit: &Maximum, performance: f64) -> Option<f64> {
        let x = self.options.model.x_of(performance, &fit.curve)?;
        Some(self.options.model.sigmoid.level(x))
    }
}

/// The fit of one bootstrap replicate.
struct Refit {
    curve: Curve,
    deviance: f64,
    at_bound: bool,
    levels: Vec<Option<f64>>,
}

/// The fit, and the curves behind it.
pub(super) struct Fit {
    pub(super) result: MaximumLikelihood,
    /// The fitted curve, even where it is not determined.
    pub(super) best: Curve,
    /// The curves of the bootstrap replicates.
    pub(super) refits: Vec<Curve>,
}

/// The fit to trials at two or more levels.
pub(super) fn fit(
    options: &Options,
    trials: &Trials,
    span: &Span,
    settings: &Settings,
) -> Option<Fit> {
    let lapse = options.lapse.map_or([0.0, options.lapse_max], |lapse| [lapse, lapse]);
    let bounds = Bounds::new(span, lapse);
    let grid = Grid::new(&options.model, trials, &bounds);
    let fitter = Fitter { options, bounds, tolerance: AT_BOUND * span.range, grid };
    let best = fitter.fit(trials)?;
    let refits = bootstrap(&fitter, trials, &best, settings);
    let undetermined = fitter.at_bound(&best);
    let shown = |value: f64| if undetermined { None } else { finite(value) };
    let deviance = deviance(trials, best.log_likelihood);
    let df = trials.x.len() as i64 - if options.lapse.is_some() { 2 } else { 3 };
    let p_bootstrap = (!refits.is_empty()).then(|| {
        let as_large = refits.iter().filter(|refit| refit.deviance >= deviance).count();
        (1 + as_large) as f64 / (refits.len() + 1) as f64
    });
    let result = MaximumLikelihood {
        threshold: shown(options.model.sigmoid.level(best.curve.position)),
        width: shown(best.curve.width),
        lapse: shown(best.curve.lapse),
        reason: reason(undetermined, df, refits.is_empty()),
        log_likelihood: best.log_likelihood,
        deviance,
        df,
        p_chi2: chi_squared_upper(deviance, df as f64),
        p_bootstrap,
        at_bound: (!refits.is_empty())
            .then(|| refits.iter().filter(|refit| refit.at_bound).count()),
        thresholds: thresholds(&fitter, &best, &refits, settings.confidence),
    };
    Some(Fit { result, best: best.curve, refits: refits.iter().map(|refit| refit.curve).collect() })
}

fn reason(undetermined: bool, df: i64, no_replicates: bool) -> Option<String> {
    let mut reasons = Vec::new();
    if undetermined {
        reasons.push(
            "the likelihood is highest at a bound of threshold or width: the answers do not \
             determine the curve"
                .to_owned(),
        );
    }
    if df <= 0 {
        reasons.push(format!("{df} degrees of freedom leave no p_chi2"));
    }
    if no_replicates {
        reasons.push("there are no bootstrap replicates".to_owned());
    }
    (!reasons.is_empty()).then(|| reasons.join("; "))
}

/// Draws the trials of the fitted function, levels ascending, and fits them again.
fn bootstrap(
    fitter: &Fitter<'_>,
    trials: &Trials,
    best: &Maximum,
    settings: &Settings,
) -> Vec<Refit> {
    let model = &fitter.options.model;
    let chances: Vec<f64> = trials.x.iter().map(|&x| model.performance(&best.curve, x)).collect();
    let refits = replicates(settings, |random| {
        let mut drawn = trials.clone();
        for ((correct, &count), &chance) in
            drawn.correct.iter_mut().zip(&trials.trials).zip(&chances)
        {
            let right = (0..count as u64).filter(|_| random.bernoulli(chance)).count();
            *correct = right as f64;
        }
        let fit = fitter.fit(&drawn)?;
        let level = |&performance: &f64| fitter.level(&fit, performance);
        Some(Refit {
            curve: fit.curve,
            deviance: deviance(&drawn, fit.log_likelihood),
            at_bound: fitter.at_bound(&fit),
            levels: fitter.options.performance.iter().map(level).collect(),
        })
    });
    refits.into_iter().flatten().collect()
}

fn thresholds(
    fitter: &Fitter<'_>,
    best: &Maximum,
    refits: &[Refit],
    confidence: f64,
) -> Vec<LevelAt> {
    let at = |(index, &performance): (usize, &f64)| {
        let undetermined = fitter.at_bound(best);
        let exact = fitter.level(best, performance);
        let level = if undetermined { None } else { exact.and_then(finite) };
        let drawn: Vec<f64> = refits.iter().filter_map(|refit| refit.levels[index]).collect();
        let reason = if exact.is_none() {
            Some("the performance is not above the guess rate")
        } else if undetermined {
            Some("the answers do not determine the curve")
        } else if level.is_none() {
            Some("the fitted function does not reach the performance")
        } else if refits.is_empty() {
            Some("there are no bootstrap replicates")
        } else {
            None
        };
        LevelAt {
            performance,
            level,
            ci: interval(drawn, confidence),
            reason: reason.map(str::to_owned),
        }
    };
    fitter.options.performance.iter().enumerate().map(at).collect()
}

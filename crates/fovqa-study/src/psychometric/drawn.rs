//! A fitted psychometric function at many levels, as figures show it.

use super::levels::Span;
use super::model::{Curve, Model};
use super::posterior::Estimate;
use crate::quantile::{quantile, sort};

/// The number of levels.
const POINTS: usize = 101;
/// Space beside the levels of the trials, as a share of their range.
const BESIDE: f64 = 0.05;

/// A fitted function at equally spaced levels, for `weibull` at equal ratios.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnCurve {
    /// The levels, ascending, from a little below the trials to a little above them.
    pub points: Vec<CurvePoint>,
    /// True if the function is one of the logarithm of the level.
    pub is_logarithmic: bool,
    /// True for the posterior's mode, which has no bootstrap interval.
    pub is_mode: bool,
}

/// The function at one level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// The level.
    pub level: f64,
    /// ψ, from 0 to 1.
    pub performance: f64,
    /// The bootstrap interval of ψ at this level.
    pub interval: Option<[f64; 2]>,
}

impl DrawnCurve {
    /// A fitted curve with the bootstrap interval at each level: the quantiles of the curves that
    /// were fitted to the replicates.
    pub(super) fn with_band(
        model: &Model,
        span: &Span,
        (best, refits): (&Curve, &[Curve]),
        confidence: f64,
    ) -> Self {
        let interval = |x: f64| {
            let mut values: Vec<f64> =
                refits.iter().map(|curve| model.performance(curve, x)).collect();
            sort(&mut values);
            let at = |p: f64| quantile(&values, p);
            Some([at(0.5 - 0.5 * confidence)?, at(0.5 + 0.5 * confidence)?])
        };
        Self { points: points(model, span, best, interval), ..Self::empty(model, false) }
    }

    /// The joint mode of the posterior.
    pub(super) fn of_mode(model: &Model, span: &Span, mode: &Estimate) -> Self {
        let position = model.sigmoid.scale(mode.threshold);
        let curve = Curve { position, width: mode.width, lapse: mode.lapse };
        Self { points: points(model, span, &curve, |_| None), ..Self::empty(model, true) }
    }

    fn empty(model: &Model, is_mode: bool) -> Self {
        Self { points: Vec::new(), is_logarithmic: model.sigmoid.is_logarithmic(), is_mode }
    }
}

fn points(
    model: &Model,
    span: &Span,
    curve: &Curve,
    interval: impl Fn(f64) -> Option<[f64; 2]>,
) -> Vec<CurvePoint> {
    let point = |i: usize| {
        let share = (1.0 + 2.0 * BESIDE) * i as f64 / (POINTS - 1) as f64 - BESIDE;
        let x = span.first + share * span.range;
        CurvePoint {
            level: model.sigmoid.level(x),
            performance: model.performance(curve, x),
            interval: interval(x),
        }
    };
    (0..POINTS).map(point).filter(|point| point.performance.is_finite()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Level, Options, fit};
    use super::*;
    use crate::Settings;
    use crate::options::Sigmoid;

    fn drawn(correct: &[u64], trials: u64, bootstrap: usize) -> DrawnCurve {
        let level = |(i, &correct): (usize, &u64)| Level { level: 1.0 + i as f64, correct, trials };
        let levels = correct.iter().enumerate().map(level).collect();
        let settings = Settings { bootstrap, ..Settings::default() };
        fit(levels, &Options::default(), &settings).drawn.unwrap()
    }

    fn width(drawn: &DrawnCurve) -> f64 {
        let widths = drawn.points.iter().filter_map(|point| point.interval);
        widths.map(|[low, high]| high - low).sum::<f64>() / drawn.points.len() as f64
    }

    #[test]
    fn the_band_contains_the_curve_and_narrows_with_more_trials() {
        let few = drawn(&[11, 13, 16, 19, 20], 20, 200);
        let many = drawn(&[110, 130, 160, 190, 200], 200, 200);
        for point in few.points.iter().chain(&many.points) {
            let [low, high] = point.interval.unwrap();
            assert!(low <= point.performance && point.performance <= high, "{point:?}");
        }
        assert!(width(&few) > 2.0 * width(&many) && width(&many) > 0.0);
        let [first, last] = [few.points.first(), few.points.last()].map(|p| p.unwrap().level);
        assert!((first - 0.8).abs() < 1e-12 && (last - 5.2).abs() < 1e-12);
    }

    #[test]
    fn without_replicates_there_is_no_band() {
        let none = drawn(&[11, 13, 16, 19, 20], 20, 0);
        assert!(!none.is_mode && none.points.iter().all(|point| point.interval.is_none()));
    }

    #[test]
    fn answers_that_do_not_determine_the_curve_show_the_mode() {
        let step = drawn(&[10, 10, 20, 20], 20, 20);
        assert!(step.is_mode && step.points.iter().all(|point| point.interval.is_none()));
        assert!(step.points[0].performance < 0.6 && step.points[100].performance > 0.9);
    }

    #[test]
    fn levels_of_a_weibull_function_rise_by_equal_ratios() {
        let row = |level, correct| Level { level, correct, trials: 20 };
        let levels = vec![row(1.0, 10), row(10.0, 15), row(100.0, 20)];
        let mut options = Options::default();
        options.model.sigmoid = Sigmoid::Weibull;
        let settings = Settings { bootstrap: 0, ..Settings::default() };
        let drawn = fit(levels, &options, &settings).drawn.unwrap();
        assert!(drawn.is_logarithmic && (drawn.points[50].level - 10.0).abs() < 1e-9);
        let ratio = |i: usize| drawn.points[i + 1].level / drawn.points[i].level;
        assert!((ratio(0) - ratio(99)).abs() < 1e-9);
    }
}

//! The logistic function that maps scores of a metric to mean opinion scores (VQEG 2003):
//! β₂ + (β₁ - β₂)/(1 + exp(-(x - β₃)/β₄)), by least squares.
//!
//! β₁ and β₂ follow from β₃ and β₄ by linear regression, so that the search has two dimensions.

use serde::Serialize;

use super::correlation::{is_constant, pearson};
use crate::moments::mean;
use crate::simplex::minimise;

/// The fewest conditions of a fit.
pub(super) const LEAST_CONDITIONS: usize = 5;
/// Points along β₃ and ln β₄.
const POINTS: [usize; 2] = [81, 41];
/// How many of the lowest local minima are polished.
const STARTS: usize = 3;
/// β₄ in ranges of the scores.
const SCALES: [f64; 2] = [0.02, 5.0];

/// A fitted logistic function.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fit {
    /// β₁ to β₄.
    pub beta: [f64; 4],
    /// The root of the mean squared error; divided by n, while VQEG divides by n - d.
    pub rmse: f64,
    /// The mean absolute error.
    pub mae: f64,
    /// The correlation of fitted and mean opinion scores.
    pub pearson: Option<f64>,
    /// The conditions whose error is larger than two standard errors of the mean opinion score.
    pub outliers: Option<usize>,
    /// Their share.
    pub outlier_ratio: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Fit {
    /// The fitted mean opinion score at a score of the metric.
    pub fn at(&self, score: f64) -> f64 {
        let [upper, lower, position, scale] = self.beta;
        lower + (upper - lower) / (1.0 + libm::exp(-(score - position) / scale))
    }
}

/// Fits the function to scores `x` and mean opinion scores `y` with standard errors. `None` with fewer
/// than 5 conditions, or equal scores.
pub(super) fn fit(x: &[f64], y: &[f64], errors: &[Option<f64>]) -> Option<Fit> {
    if x.len() < LEAST_CONDITIONS || is_constant(x) {
        return None;
    }
    let problem = Problem::new(x, y)?;
    let [position, log_scale] = problem.best();
    let linear = problem.regression(position, log_scale);
    let fitted: Vec<f64> = linear.fitted(&problem, position, log_scale);
    let residuals: Vec<f64> = y.iter().zip(&fitted).map(|(y, fitted)| y - fitted).collect();
    let squares: Vec<f64> = residuals.iter().map(|e| e * e).collect();
    let absolute: Vec<f64> = residuals.iter().map(|e| e.abs()).collect();
    let errors: Option<Vec<f64>> = errors.iter().copied().collect();
    let outliers = errors.map(|errors| {
        residuals.iter().zip(errors).filter(|(e, error)| e.abs() > 2.0 * error).count()
    });
    let pearson = pearson(&fitted, y);
    let mut reasons = Vec::new();
    if pearson.is_none() {
        reasons.push("the fitted scores or the mean opinion scores are constant");
    }
    if outliers.is_none() {
        reasons.push("without standard errors (column se) there are no outliers");
    }
    let lower = linear.mean_y - linear.slope * linear.mean_basis;
    let scale = libm::exp(log_scale) * problem.range;
    Some(Fit {
        beta: [lower + linear.slope, lower, problem.first + position * problem.range, scale],
        rmse: libm::sqrt(mean(&squares)?),
        mae: mean(&absolute)?,
        pearson,
        outliers,
        outlier_ratio: outliers.map(|count| count as f64 / x.len() as f64),
        reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
    })
}

/// Scores from 0 to 1, and mean opinion scores.
struct Problem<'a> {
    x: Vec<f64>,
    y: &'a [f64],
    first: f64,
    range: f64,
}

/// The regression of y on the logistic function.
struct Linear {
    mean_basis: f64,
    mean_y: f64,
    slope: f64,
    squared_error: f64,
}

fn basis(x: f64, position: f64, scale: f64) -> f64 {
    1.0 / (1.0 + libm::exp((position - x) / scale))
}

impl<'a> Problem<'a> {
    fn new(x: &[f64], y: &'a [f64]) -> Option<Self> {
        let first = x.iter().copied().min_by(f64::total_cmp)?;
        let last = x.iter().copied().max_by(f64::total_cmp)?;
        let range = last - first;
        let x = x.iter().map(|x| (x - first) / range).collect();
        (range.is_finite() && range > 0.0).then_some(Self { x, y, first, range })
    }

    fn regression(&self, position: f64, log_scale: f64) -> Linear {
        let scale = libm::exp(log_scale);
        let n = self.x.len() as f64;
        let values: Vec<f64> = self.x.iter().map(|&x| basis(x, position, scale)).collect();
        let mean_basis = values.iter().sum::<f64>() / n;
        let mean_y = self.y.iter().sum::<f64>() / n;
        let (mut ss, mut sy) = (0.0, 0.0);
        for (value, y) in values.iter().zip(self.y) {
            ss += (value - mean_basis) * (value - mean_basis);
            sy += (value - mean_basis) * (y - mean_y);
        }
        // A basis that is constant but for rounding has no slope.
        let slope = if ss > 1e-24 * n { sy / ss } else { 0.0 };
        let error = |(value, y): (&f64, &f64)| {
            let e = y - mean_y - slope * (value - mean_basis);
            e * e
        };
        let squared_error = values.iter().zip(self.y).map(error).sum();
        Linear { mean_basis, mean_y, slope, squared_error }
    }

    /// β₃ and ln β₄ of the least squared error, in ranges of the scores.
    fn best(&self) -> [f64; 2] {
        let limits = [[-0.5, 1.5], SCALES.map(libm::log)];
        let value = |axis: usize, index: usize| {
            let [low, high] = limits[axis];
            low + (high - low) * index as f64 / (POINTS[axis] - 1) as f64
        };
        let mut errors = vec![[0.0; POINTS[1]]; POINTS[0]];
        for (i, row) in errors.iter_mut().enumerate() {
            for (j, error) in row.iter_mut().enumerate() {
                *error = self.regression(value(0, i), value(1, j)).squared_error;
            }
        }
        let mut minima = Vec::new();
        for i in 0..POINTS[0] {
            for j in 0..POINTS[1] {
                let rows = i.saturating_sub(1)..=(i + 1).min(POINTS[0] - 1);
                let columns = j.saturating_sub(1)..=(j + 1).min(POINTS[1] - 1);
                let mut near = errors[rows].iter().flat_map(|row| &row[columns.clone()]);
                if near.all(|other| *other >= errors[i][j]) {
                    minima.push((errors[i][j], [value(0, i), value(1, j)]));
                }
            }
        }
        minima.sort_by(|a, b| a.0.total_cmp(&b.0));
        let steps = [0, 1].map(|axis| (limits[axis][1] - limits[axis][0]) / POINTS[axis] as f64);
        let error = |p: &[f64; 2]| self.regression(p[0], p[1]).squared_error;
        let polished = minima
            .iter()
            .take(STARTS)
            .map(|(_, start)| minimise(error, *start, steps, limits))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        polished.map_or([0.5, 0.0], |(point, _)| point)
    }
}

impl Linear {
    fn fitted(&self, problem: &Problem, position: f64, log_scale: f64) -> Vec<f64> {
        let scale = libm::exp(log_scale);
        let value =
            |&x: &f64| self.mean_y + self.slope * (basis(x, position, scale) - self.mean_basis);
        problem.x.iter().map(value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logistic_function_is_found_again() {
        let x: Vec<f64> = (0..12).map(|i| 20.0 + 2.0 * f64::from(i)).collect();
        let of = |x: f64| 1.2 + 3.4 / (1.0 + f64::exp(-(x - 29.0) / 2.5));
        let y: Vec<f64> = x.iter().map(|&x| of(x)).collect();
        let fit = fit(&x, &y, &[Some(0.1); 12]).unwrap();
        for (found, expected) in fit.beta.iter().zip([4.6, 1.2, 29.0, 2.5]) {
            assert!((found - expected).abs() < 1e-4, "{:?}", fit.beta);
        }
        assert!(fit.rmse < 1e-6 && fit.outliers == Some(0));
    }

    #[test]
    fn few_or_equal_scores_have_no_fit() {
        assert_eq!(fit(&[1.0, 2.0, 3.0, 4.0], &[1.0; 4], &[None; 4]), None);
        assert_eq!(fit(&[1.0; 6], &[1.0; 6], &[None; 6]), None);
        let flat = fit(&[1.0, 2.0, 3.0, 4.0, 5.0], &[2.0; 5], &[None; 5]).unwrap();
        assert!(flat.rmse < 1e-12 && flat.pearson.is_none() && flat.reason.is_some());
    }
}

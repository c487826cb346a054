//! Paired t tests of the levels of a factor.

use serde::Serialize;

use super::cells::{Cells, Factor};
use crate::Settings;
use crate::adjust::adjusted_where_defined;
use crate::distributions::{t_quantile, t_two_sided};
use crate::moments::Moments;

/// A paired t test of two levels, averaged over the levels of the other factor.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairedTest {
    /// The factor.
    pub factor: String,
    /// One level.
    pub a: String,
    /// The other level.
    pub b: String,
    /// The mean of the participants' differences a - b.
    pub mean_difference: f64,
    /// The statistic t.
    pub t: Option<f64>,
    /// The degrees of freedom.
    pub df: usize,
    /// The two-sided p-value.
    pub p: Option<f64>,
    /// `p`, adjusted for the number of pairs of levels of the factor.
    pub p_adjusted: Option<f64>,
    /// The t interval of the difference.
    pub ci: Option<[f64; 2]>,
    /// The mean difference divided by the standard deviation of differences.
    pub cohen_dz: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The mean of a level of a factor.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelMean {
    /// The factor.
    pub factor: String,
    /// The level.
    pub level: String,
    /// Moments of the participants' means over the levels of the other factor.
    pub moments: Moments,
}

/// The means of the levels of all factors.
pub(super) fn levels(cells: &Cells, confidence: f64) -> Vec<LevelMean> {
    let of_factor = |(index, factor): (usize, &Factor)| {
        let values = level_means(cells, index);
        let level = |(level, values): (&String, Vec<f64>)| LevelMean {
            factor: factor.name.clone(),
            level: level.clone(),
            moments: Moments::of(&values, confidence),
        };
        factor.levels.names().iter().zip(values).map(level).collect::<Vec<LevelMean>>()
    };
    cells.factors.iter().enumerate().flat_map(of_factor).collect()
}

/// The tests of all factors; there are at least two participants.
pub(super) fn posthoc(cells: &Cells, settings: &Settings) -> Vec<PairedTest> {
    let mut all = Vec::new();
    for (index, factor) in cells.factors.iter().enumerate() {
        let names = factor.levels.names();
        let levels = level_means(cells, index);
        let mut tests = Vec::new();
        for a in 0..names.len() {
            for b in a + 1..names.len() {
                let mut test = PairedTest::of(&levels[a], &levels[b], settings.confidence);
                test.factor.clone_from(&factor.name);
                test.a.clone_from(&names[a]);
                test.b.clone_from(&names[b]);
                tests.push(test);
            }
        }
        let p: Vec<Option<f64>> = tests.iter().map(|test| test.p).collect();
        for (test, p) in tests.iter_mut().zip(adjusted_where_defined(&p, settings.adjust)) {
            test.p_adjusted = p;
        }
        all.extend(tests);
    }
    all
}

/// Per level of a factor, the participants' means over the other factor.
fn level_means(cells: &Cells, factor: usize) -> Vec<Vec<f64>> {
    let levels = cells.factors[factor].levels.len();
    let others = (cells.count() / levels) as f64;
    let mut means = vec![vec![0.0; cells.values.len()]; levels];
    for (participant, values) in cells.values.iter().enumerate() {
        for (cell, value) in values.iter().enumerate() {
            means[cells.level(factor, cell)][participant] += value / others;
        }
    }
    means
}

impl PairedTest {
    fn of(a: &[f64], b: &[f64], confidence: f64) -> Self {
        let n = a.len() as f64;
        let differences: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
        let mean = differences.iter().sum::<f64>() / n;
        let squares: f64 = differences.iter().map(|d| (d - mean) * (d - mean)).sum();
        let sizes: f64 = a.iter().chain(b).map(|value| value * value).sum();
        let df = a.len() - 1;
        let se = libm::sqrt(squares / (df as f64 * n));
        // Differences that are equal but for rounding.
        let is_equal = squares <= 1e-24 * sizes;
        let t = (!is_equal).then(|| mean / se);
        let half = t_quantile(confidence, df as f64).map(|quantile| quantile * se);
        let reason = is_equal.then(|| "all differences are equal".to_owned());
        Self {
            factor: String::new(),
            a: String::new(),
            b: String::new(),
            mean_difference: mean,
            t,
            df,
            p: t.and_then(|t| t_two_sided(t, df as f64)),
            p_adjusted: None,
            ci: half.map(|half| [mean - half, mean + half]),
            cohen_dz: t.map(|t| t / libm::sqrt(n)),
            reason,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Data, Selection, Table};

    #[test]
    fn differences_are_tested() {
        // Differences 1, 2, 3: t = 2√3, dz = 2.
        let test = PairedTest::of(&[2.0, 3.0, 8.0], &[1.0, 1.0, 5.0], 0.95);
        assert!((test.t.unwrap() - 12.0_f64.sqrt()).abs() < 1e-12);
        assert!((test.cohen_dz.unwrap() - 2.0).abs() < 1e-12);
        assert_eq!((test.mean_difference, test.df), (2.0, 2));
        let equal = PairedTest::of(&[0.1, 0.2], &[0.3, 0.4], 0.95);
        assert!(equal.t.is_none() && equal.p.is_none() && equal.reason.is_some());
    }

    #[test]
    fn levels_are_averaged_over_the_other_factor() {
        let csv = b"participant,a,b,value\nP,x,u,1\nP,x,v,2\nP,y,u,3\nP,y,v,4\n\
            Q,x,u,3\nQ,x,v,4\nQ,y,u,9\nQ,y,v,8\n";
        let table = Table::read("c.csv", csv).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap();
        let cells = Cells::read(&data, &["a".to_owned(), "b".to_owned()]).unwrap();
        let levels = levels(&cells, 0.95);
        let found: Vec<_> = levels.iter().map(|l| (l.level.as_str(), l.moments.mean)).collect();
        let expected = [2.5, 6.0, 4.0, 4.5].map(Some);
        assert_eq!(found, ["x", "y", "u", "v"].into_iter().zip(expected).collect::<Vec<_>>());
        // The means of P and Q at x are 1.5 and 3.5.
        assert_eq!((levels[0].factor.as_str(), levels[0].moments.se), ("a", Some(1.0)));
    }
}

//! The effects of factors: sums of squares, F tests and effect sizes.

use serde::Serialize;

use super::cells::Cells;
use super::contrasts::{Matrix, apply, average, helmert, kronecker};
use super::sphericity::{Corrected, Mauchly, greenhouse_geisser, huynh_feldt};
use crate::distributions::f_upper;

/// The share of all squares below which an error is rounding alone.
const ROUNDING: f64 = 1e-12;

/// The effect of a factor or of the interaction of two.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Effect {
    /// The factor, or `A:B`.
    pub effect: String,
    /// The sum of squares.
    pub ss: f64,
    /// The sum of squares of the error.
    pub ss_error: f64,
    /// The degrees of freedom.
    pub df: usize,
    /// The degrees of freedom of the error.
    pub df_error: usize,
    /// The statistic F.
    pub f: Option<f64>,
    /// The upper tail of F, if sphericity holds.
    pub p: Option<f64>,
    /// SS/(SS + SS_error).
    pub partial_eta_squared: Option<f64>,
    /// SS/(SS + SS_subject + all SS_error) (Olejnik and Algina 2003).
    pub generalized_eta_squared: Option<f64>,
    /// The test without sphericity (Greenhouse and Geisser 1959).
    pub greenhouse_geisser: Corrected,
    /// The test without sphericity (Huynh and Feldt 1976).
    pub huynh_feldt: Corrected,
    /// The test of sphericity (Mauchly 1940).
    pub mauchly: Mauchly,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Squares of an effect.
pub(super) struct Squares {
    name: String,
    ss: f64,
    /// E = Σ(Z-Z̄)(Z-Z̄)ᵀ.
    error: Matrix,
}

/// All effects; there are at least two participants.
pub(super) fn effects(cells: &Cells) -> Vec<Effect> {
    let squares: Vec<Squares> = contrasts(cells)
        .into_iter()
        .map(|(name, contrasts)| Squares::new(name, &apply(&cells.values, &contrasts)))
        .collect();
    let between = between(cells);
    let errors: f64 = squares.iter().map(Squares::ss_error).sum();
    let total = between + errors + squares.iter().map(|squares| squares.ss).sum::<f64>();
    let n = cells.values.len();
    squares.iter().map(|squares| Effect::new(squares, n, between + errors, total)).collect()
}

/// The contrasts of each effect.
fn contrasts(cells: &Cells) -> Vec<(String, Matrix)> {
    let name = |index: usize| cells.factors[index].name.clone();
    let levels: Vec<usize> = cells.factors.iter().map(|factor| factor.levels.len()).collect();
    match levels[..] {
        [a, b] => vec![
            (name(0), kronecker(&helmert(a), &average(b))),
            (name(1), kronecker(&average(a), &helmert(b))),
            (format!("{}:{}", name(0), name(1)), kronecker(&helmert(a), &helmert(b))),
        ],
        _ => vec![(name(0), helmert(levels[0]))],
    }
}

/// The sum of squares between participants.
fn between(cells: &Cells) -> f64 {
    let means = cells.participant_means();
    let mean = means.iter().sum::<f64>() / means.len() as f64;
    cells.count() as f64 * means.iter().map(|m| (m - mean) * (m - mean)).sum::<f64>()
}

impl Squares {
    fn new(name: String, z: &Matrix) -> Self {
        let n = z.len() as f64;
        let p = z.first().map_or(0, Vec::len);
        let means: Vec<f64> = (0..p).map(|k| z.iter().map(|row| row[k]).sum::<f64>() / n).collect();
        let mut error = vec![vec![0.0; p]; p];
        for row in z {
            let deviations: Vec<f64> = row.iter().zip(&means).map(|(z, mean)| z - mean).collect();
            for (sums, d) in error.iter_mut().zip(&deviations) {
                for (sum, other) in sums.iter_mut().zip(&deviations) {
                    *sum += d * other;
                }
            }
        }
        Self { name, ss: n * means.iter().map(|mean| mean * mean).sum::<f64>(), error }
    }

    fn ss_error(&self) -> f64 {
        (0..self.error.len()).map(|k| self.error[k][k]).sum()
    }
}

impl Effect {
    /// `other` is the sum of squares between participants and of all errors, `total` that of
    /// everything.
    fn new(squares: &Squares, n: usize, other: f64, total: f64) -> Self {
        let df = squares.error.len();
        let df_error = df * (n - 1);
        let (ss, ss_error) = (squares.ss, squares.ss_error());
        let reason = if df == 0 {
            Some("a factor has one level")
        } else if ss_error <= ROUNDING * total {
            Some("the participants differ by a constant, so there is no error")
        } else {
            None
        };
        let f = reason.is_none().then(|| ss / ss_error * (n - 1) as f64);
        let p = |epsilon: f64| f_upper(f?, epsilon * df as f64, epsilon * df_error as f64);
        let share = |of: f64| (ss + of > 0.0).then(|| ss / (ss + of));
        let corrected = |epsilon: Option<f64>| Corrected {
            epsilon,
            df: epsilon.map(|epsilon| epsilon * df as f64),
            df_error: epsilon.map(|epsilon| epsilon * df_error as f64),
            p: epsilon.and_then(p),
            reason: reason.map(str::to_owned),
        };
        let error = reason.is_none().then_some(&squares.error);
        let geisser = error.map(greenhouse_geisser);
        Self {
            effect: squares.name.clone(),
            ss,
            ss_error,
            df,
            df_error,
            f,
            p: p(1.0),
            partial_eta_squared: share(ss_error),
            generalized_eta_squared: share(other),
            greenhouse_geisser: corrected(geisser),
            huynh_feldt: corrected(geisser.map(|epsilon| huynh_feldt(epsilon, df, n))),
            mauchly: match reason {
                Some(reason) => Mauchly::undefined(df, reason),
                None => Mauchly::of(&squares.error, n),
            },
            reason: reason.map(str::to_owned),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Data, Selection, Table};

    fn of(csv: &str, within: &[&str]) -> Vec<Effect> {
        let table = Table::read("a.csv", csv.as_bytes()).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap();
        let within: Vec<String> = within.iter().map(|name| (*name).to_owned()).collect();
        effects(&Cells::read(&data, &within).unwrap())
    }

    #[test]
    fn two_levels_are_a_paired_t_test() {
        // Differences 1, 2, 3: t = 2/(1/√3) = 2√3, F = 12, p = 0.0742.
        let csv = "participant,m,value\nP,x,1\nP,y,2\nQ,x,1\nQ,y,3\nR,x,5\nR,y,8\n";
        let effect = &of(csv, &["m"])[0];
        assert!((effect.f.unwrap() - 12.0).abs() < 1e-12);
        assert!((effect.p.unwrap() - (1.0 - (12.0_f64 / 14.0).sqrt())).abs() < 1e-12);
        assert_eq!((effect.df, effect.df_error), (1, 2));
        assert!((effect.partial_eta_squared.unwrap() - 12.0 / 14.0).abs() < 1e-12);
        assert!((effect.huynh_feldt.epsilon.unwrap() - 1.0).abs() < 1e-12);
        assert!(effect.mauchly.w.is_none() && effect.mauchly.reason.is_some());
    }

    #[test]
    fn squares_add_up_to_the_total() {
        let csv = "participant,a,b,value\nP,x,u,1\nP,x,v,2\nP,y,u,4\nP,y,v,9\nQ,x,u,3\nQ,x,v,2\nQ,y,u,7\nQ,y,v,5\n";
        let effects = of(csv, &["a", "b"]);
        let names: Vec<_> = effects.iter().map(|effect| effect.effect.as_str()).collect();
        assert_eq!(names, ["a", "b", "a:b"]);
        let within: f64 = effects.iter().map(|effect| effect.ss + effect.ss_error).sum();
        let values = [1.0, 2.0, 4.0, 9.0, 3.0, 2.0, 7.0, 5.0_f64];
        let mean = values.iter().sum::<f64>() / 8.0;
        let total: f64 = values.iter().map(|y| (y - mean) * (y - mean)).sum();
        // Participants' means are 4 and 4.25.
        assert!((within + 4.0 * 2.0 * 0.125 * 0.125 - total).abs() < 1e-12);
    }

    #[test]
    fn constant_differences_have_no_test() {
        let csv = "participant,m,value\nP,x,0.1\nP,y,0.3\nQ,x,0.2\nQ,y,0.4\n";
        let effect = &of(csv, &["m"])[0];
        assert_eq!((effect.f, effect.p), (None, None));
        assert!(effect.reason.is_some() && effect.greenhouse_geisser.reason.is_some());
        let one = &of("participant,m,value\nP,x,1\nQ,x,2\n", &["m"])[0];
        assert_eq!((one.df, one.f), (0, None));
    }
}

//! Consistency of judges (Kendall and Babington Smith 1940, "On the method of paired comparisons").

use serde::Serialize;

use super::votes::{JudgeName, Votes};
use crate::distributions::chi_squared_upper;
use crate::json::{finite, votes as whole};

/// The consistency of the judges of a group. A judge is a participant who saw a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Consistency {
    /// The judges, by first appearance.
    pub judges: Vec<Judge>,
    /// Judges with a winner of every pair.
    pub judges_complete: usize,
    /// The mean of `zeta` over these judges.
    pub mean_zeta: Option<f64>,
    /// Agreement between the complete judges, if there are at least two.
    #[serde(flatten)]
    pub agreement: Option<Agreement>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The consistency of a judge.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Judge {
    /// The participant.
    pub participant: String,
    /// The scene, if the table has scenes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// Triads A > B > C > A.
    pub circular_triads: Option<f64>,
    /// The coefficient of consistency: 1 without circular triads, 0 with as many as possible.
    pub zeta: Option<f64>,
    /// Why the values are undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Agreement between complete judges.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Agreement {
    /// Σ C(a_ij, 2): pairs of judges with the same winner.
    #[serde(serialize_with = "whole")]
    pub sigma: f64,
    /// The coefficient of agreement: 1 if all judges agree.
    pub u: f64,
    /// The least possible `u`.
    pub u_min: f64,
    /// The test of agreement beyond chance, with more than two judges.
    #[serde(flatten)]
    pub test: Option<AgreementTest>,
}

/// The test of agreement beyond chance, without continuity correction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AgreementTest {
    /// The statistic.
    pub chi2: f64,
    /// Its degrees of freedom, which need not be whole.
    pub df: f64,
    /// The upper tail of χ².
    pub p: Option<f64>,
}

/// The consistency of all judges, and their agreement.
pub(super) fn consistency(votes: &Votes) -> Consistency {
    let t = votes.methods.len();
    let mut by_judge: Vec<Vec<usize>> = vec![Vec::new(); votes.judges.len()];
    for (index, vote) in votes.votes.iter().enumerate() {
        by_judge[vote.judge].push(index);
    }
    let mut preferring = vec![0.0_f64; t * t];
    let mut complete = 0;
    let mut zetas = 0.0;
    let mut judges = Vec::with_capacity(by_judge.len());
    for (name, indices) in votes.judges.iter().zip(by_judge) {
        let winners = winners(votes, &indices);
        let judge = Judge::new(name, winners.as_deref(), t);
        if let (Some(zeta), Some(winners)) = (judge.zeta, &winners) {
            complete += 1;
            zetas += zeta;
            for (sum, wins) in preferring.iter_mut().zip(winners) {
                *sum += f64::from(u8::from(*wins));
            }
        }
        judges.push(judge);
    }
    Consistency {
        judges,
        judges_complete: complete,
        mean_zeta: finite(zetas / complete as f64),
        agreement: (complete >= 2).then(|| Agreement::new(&preferring, t, complete)),
        reason: (complete == 0)
            .then(|| "no judge has a winner of every pair of at least three methods".to_owned()),
    }
}

/// The cells `winner · methods + loser` of a judge by the majority of votes; `None` if a pair is
/// missing or tied.
fn winners(votes: &Votes, indices: &[usize]) -> Option<Vec<bool>> {
    let t = votes.methods.len();
    let pairs = t * (t - 1) / 2;
    let mut lead = vec![0.0; t * t];
    for vote in indices.iter().map(|&index| &votes.votes[index]) {
        let [a, b] = vote.won(votes.ties);
        lead[vote.a * t + vote.b] += a - b;
        lead[vote.b * t + vote.a] += b - a;
    }
    let winners: Vec<bool> = lead.into_iter().map(|lead| lead > 0.0).collect();
    (winners.iter().filter(|wins| **wins).count() == pairs).then_some(winners)
}

impl Judge {
    fn new(name: &JudgeName, winners: Option<&[bool]>, methods: usize) -> Self {
        let t = methods as f64;
        let reason = match winners {
            _ if methods < 3 => Some("two methods have no triads"),
            None => Some("a pair is missing or tied"),
            Some(_) => None,
        };
        let triads = winners.filter(|_| methods >= 3).map(|winners| {
            let won = winners.chunks(methods).map(|row| row.iter().filter(|wins| **wins).count());
            let squares: f64 = won.map(|won| (won * won) as f64).sum();
            t * (t - 1.0) * (2.0 * t - 1.0) / 12.0 - 0.5 * squares
        });
        let cubic = t * t * t - if methods.is_multiple_of(2) { 4.0 * t } else { t };
        Self {
            participant: name.participant.clone(),
            scene: name.scene.clone(),
            circular_triads: triads,
            zeta: triads.map(|triads| 1.0 - 24.0 * triads / cubic),
            reason: reason.map(str::to_owned),
        }
    }
}

impl Agreement {
    /// The agreement of `judges` judges; `preferring` has how many of them prefer one method to
    /// another.
    fn new(preferring: &[f64], methods: usize, judges: usize) -> Self {
        let two_of = |n: f64| 0.5 * n * (n - 1.0);
        let (t, m) = (methods as f64, judges as f64);
        let sigma: f64 = preferring.iter().map(|&n| two_of(n)).sum();
        let most = two_of(m) * two_of(t);
        let test = (judges > 2).then(|| {
            let chi2 = 4.0 / (m - 2.0) * (sigma - 0.5 * most * (m - 3.0) / (m - 2.0));
            let df = two_of(t) * m * (m - 1.0) / ((m - 2.0) * (m - 2.0));
            AgreementTest { chi2, df, p: chi_squared_upper(chi2, df) }
        });
        let u_min = if judges.is_multiple_of(2) { -1.0 / (m - 1.0) } else { -1.0 / m };
        Self { sigma, u: 2.0 * sigma / most - 1.0, u_min, test }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Data, Selection, Table};
    use crate::options::Ties;

    fn of(rows: &str) -> Consistency {
        let csv = format!("participant,method_a,method_b,answer\n{rows}");
        let table = Table::read("v.csv", csv.as_bytes()).unwrap();
        let selection = Selection::default();
        let data = Data::new(&table, &selection).unwrap();
        consistency(&Votes::read(&data, Ties::Drop, &[]).unwrap())
    }

    #[test]
    fn a_circle_is_the_least_consistent_judgement_of_three() {
        let circle = of("P,A,B,a\nP,B,C,a\nP,A,C,b\n");
        assert_eq!(
            (circle.judges[0].circular_triads, circle.judges[0].zeta),
            (Some(1.0), Some(0.0))
        );
        let order = of("P,A,B,a\nP,B,C,a\nP,A,C,a\n");
        assert_eq!((order.judges[0].circular_triads, order.judges[0].zeta), (Some(0.0), Some(1.0)));
        assert_eq!(order.agreement, None);
    }

    #[test]
    fn equal_judges_agree_and_opposite_ones_do_not() {
        let same = of("P,A,B,a\nP,B,C,a\nP,A,C,a\nQ,A,B,a\nQ,B,C,a\nQ,A,C,a\n").agreement.unwrap();
        assert_eq!((same.sigma, same.u, same.test), (3.0, 1.0, None));
        let other = of("P,A,B,a\nP,B,C,a\nP,A,C,a\nQ,A,B,b\nQ,B,C,b\nQ,A,C,b\n").agreement.unwrap();
        assert_eq!((other.u, other.u_min), (-1.0, -1.0));
    }

    #[test]
    fn incomplete_judges_have_a_reason() {
        let tied = of("P,A,B,a\nP,A,B,b\nP,B,C,a\nP,A,C,a\n");
        assert_eq!((tied.judges_complete, tied.mean_zeta), (0, None));
        assert!(tied.judges[0].reason.is_some() && tied.reason.is_some());
        assert!(of("P,A,B,a\n").judges[0].zeta.is_none());
    }
}

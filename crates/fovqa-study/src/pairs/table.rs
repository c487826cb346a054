//! Shares of pairs, with binomial tests and intervals.

use serde::Serialize;

use super::votes::{Outcome, Votes, wins};
use crate::Settings;
use crate::adjust::adjusted_where_defined;
use crate::bootstrap::{Interval, interval, replicates};
use crate::distributions::{
    binomial_at_least, binomial_at_most, clopper_pearson, half_two_sided, wilson,
};
use crate::json::votes as whole;
use crate::options::Ties;

/// The votes between two methods.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pair {
    /// The method whose wins are counted.
    pub method: String,
    /// The other method.
    pub opponent: String,
    /// Votes for `method`, with half of the ties if ties count half.
    #[serde(serialize_with = "whole")]
    pub wins: f64,
    /// Votes for `opponent`, with half of the ties if ties count half.
    #[serde(serialize_with = "whole")]
    pub losses: f64,
    /// Tied votes, also if they are left out.
    #[serde(serialize_with = "whole")]
    pub ties: f64,
    /// Wins and losses.
    #[serde(serialize_with = "whole")]
    pub trials: f64,
    /// Wins divided by trials.
    pub share: f64,
    /// Exact binomial test of a share of ½: the sum of all probabilities that are not above that of
    /// the wins.
    pub p_two_sided: Option<f64>,
    /// The probability of at least as many wins at a share of ½.
    pub p_greater: Option<f64>,
    /// The probability of at most as many wins at a share of ½.
    pub p_less: Option<f64>,
    /// `p_two_sided`, adjusted for the number of pairs.
    pub p_adjusted: Option<f64>,
    /// The exact interval of the share (Clopper and Pearson 1934).
    pub clopper_pearson: Option<[f64; 2]>,
    /// The interval of the share of Wilson (1927).
    pub wilson: Option<[f64; 2]>,
    /// The bootstrap interval of the share, with participants resampled, because the trials of a
    /// participant are not independent.
    pub cluster: Option<Interval>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The pairs with votes.
pub(super) fn table(votes: &Votes, settings: &Settings) -> Vec<Pair> {
    let t = votes.methods.len();
    let by_participant = votes.by_participant();
    let everyone: Vec<usize> = (0..by_participant.len()).collect();
    let all = wins(&by_participant, &everyone, t);
    let ties = ties(votes);
    let of = |wins: &[f64], i: usize, j: usize| (wins[i * t + j], wins[j * t + i]);
    let with_votes: Vec<(usize, usize)> = (0..t)
        .flat_map(|i| (i + 1..t).map(move |j| (i, j)))
        .filter(|&(i, j)| of(&all, i, j) != (0.0, 0.0))
        .collect();
    let mut clusters = vec![Vec::new(); with_votes.len()];
    if everyone.len() > 1 {
        let shares = replicates(settings, |random| {
            let drawn = wins(&by_participant, &random.resample(everyone.len()), t);
            let share = |&(i, j): &(usize, usize)| share(of(&drawn, i, j));
            with_votes.iter().map(share).collect::<Vec<Option<f64>>>()
        });
        for replicate in shares {
            for (cluster, share) in clusters.iter_mut().zip(replicate) {
                cluster.extend(share);
            }
        }
    }
    let mut pairs = Vec::new();
    for (&(i, j), cluster) in with_votes.iter().zip(clusters) {
        let ties = ties[i * t + j] + ties[j * t + i];
        // Half votes are no binomial counts.
        let is_binomial = ties == 0.0 || votes.ties != Ties::Half;
        let mut pair = Pair::new(of(&all, i, j), ties, is_binomial, settings.confidence);
        pair.method.clone_from(&votes.methods.names()[i]);
        pair.opponent.clone_from(&votes.methods.names()[j]);
        pair.cluster = interval(cluster, settings.confidence);
        pair.reason = pair.undefined(everyone.len(), settings.bootstrap);
        pairs.push(pair);
    }
    let p: Vec<Option<f64>> = pairs.iter().map(|pair| pair.p_two_sided).collect();
    for (pair, p) in pairs.iter_mut().zip(adjusted_where_defined(&p, settings.adjust)) {
        pair.p_adjusted = p;
    }
    pairs
}

/// Tied votes per pair of methods `a · methods + b`.
fn ties(votes: &Votes) -> Vec<f64> {
    let t = votes.methods.len();
    let mut ties = vec![0.0; t * t];
    for vote in votes.votes.iter().filter(|vote| vote.outcome == Outcome::Tie) {
        ties[vote.a * t + vote.b] += vote.count;
    }
    ties
}

fn share((wins, losses): (f64, f64)) -> Option<f64> {
    (wins + losses > 0.0).then(|| wins / (wins + losses))
}

impl Pair {
    fn new((wins, losses): (f64, f64), ties: f64, is_binomial: bool, confidence: f64) -> Self {
        let trials = wins + losses;
        let (k, n) = (wins as u64, trials as u64);
        Self {
            method: String::new(),
            opponent: String::new(),
            wins,
            losses,
            ties,
            trials,
            share: share((wins, losses)).unwrap_or_default(),
            p_two_sided: is_binomial.then(|| half_two_sided(k, n)),
            p_greater: is_binomial.then(|| binomial_at_least(k, n, 0.5)),
            p_less: is_binomial.then(|| binomial_at_most(k, n, 0.5)),
            p_adjusted: None,
            clopper_pearson: is_binomial.then(|| clopper_pearson(k, n, confidence)),
            wilson: is_binomial.then(|| wilson(wins, trials, confidence)),
            cluster: None,
            reason: None,
        }
    }

    fn undefined(&self, participants: usize, bootstrap: usize) -> Option<String> {
        let mut reasons = Vec::new();
        if self.p_two_sided.is_none() {
            reasons.push("tied votes count half, so the wins have no binomial distribution");
        }
        if self.cluster.is_none() {
            reasons.push(if participants < 2 {
                "one participant cannot be resampled"
            } else if bootstrap == 0 {
                "there are no bootstrap replicates"
            } else {
                "no bootstrap replicate has trials of the pair"
            });
        }
        (!reasons.is_empty()).then(|| reasons.join("; "))
    }
}

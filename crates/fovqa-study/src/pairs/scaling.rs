//! Scores of methods in JOD from pairwise comparisons.

use serde::Serialize;

use super::linked::is_linked;
use super::newton::{Model, cells};
use super::options::Options;
use super::votes::{Votes, wins};
use crate::Settings;
use crate::bootstrap::{Interval, interval, replicates};
use crate::distributions::chi_squared_upper;

/// The share of failed replicates above which there are no intervals.
const MOST_FAILED: f64 = 0.05;

/// Scores of the methods, in just-objectionable differences: at a difference of 1 JOD, 75 % of the
/// votes are for the better method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scaling {
    /// Bradley and Terry's model: P(d) = 1/(1 + 3^-d).
    pub bradley_terry: Scaled,
    /// Thurstone's case V: P(d) = Φ(0.6745 d).
    pub thurstone: Scaled,
}

/// Scores of maximum likelihood in one model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scaled {
    /// The scores, in the order of the methods.
    pub scores: Option<Vec<Score>>,
    /// The log-likelihood, without binomial coefficients.
    pub log_likelihood: Option<f64>,
    /// 2 Σ w ln((w/n)/P), against the shares themselves.
    pub deviance: Option<f64>,
    /// Pairs with votes, minus the number of free scores.
    pub df: Option<usize>,
    /// The upper tail of χ² at the deviance.
    pub p: Option<f64>,
    /// Bootstrap replicates without finite scores.
    pub failed_replicates: Option<usize>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The score of a method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Score {
    /// The method.
    pub method: String,
    /// Its score in JOD.
    pub jod: f64,
    /// The lower limit of the bootstrap interval.
    pub lo: Option<f64>,
    /// The upper limit of the bootstrap interval.
    pub hi: Option<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The scores of a group in both models.
pub(super) fn scaling(votes: &Votes, options: &Options, settings: &Settings) -> Scaling {
    let methods = votes.methods.len();
    let by_participant = votes.by_participant();
    let everyone: Vec<usize> = (0..by_participant.len()).collect();
    let all = with_pseudo_votes(wins(&by_participant, &everyone, methods), methods, options);
    if !is_linked(&all, methods) {
        let missing = Scaled::missing(
            "wins do not link every method to every other one in both directions, so scores would \
             be infinite; --pseudo-votes makes them finite",
        );
        return Scaling { bradley_terry: missing.clone(), thurstone: missing };
    }
    let models = [Model::BradleyTerry, Model::Thurstone];
    let zero = options.reference.as_deref().and_then(|name| votes.methods.index(name));
    let is_absent = options.reference.is_some() && zero.is_none();
    let drawn = if everyone.len() > 1 {
        replicates(settings, |random| {
            let drawn = wins(&by_participant, &random.resample(everyone.len()), methods);
            let drawn = with_pseudo_votes(drawn, methods, options);
            let scores = |model: Model| shifted(model.scores(&drawn, methods), zero);
            is_linked(&drawn, methods).then(|| models.map(scores))
        })
    } else {
        Vec::new()
    };
    let [bradley_terry, thurstone] = [0, 1].map(|index| {
        let model = models[index];
        let scores = shifted(model.scores(&all, methods), zero);
        let of_model = drawn.iter().map(|scores| scores.as_ref().map(|scores| &scores[index]));
        let of_model: Vec<_> = of_model.collect();
        let limits = Limits::new(&of_model, methods, everyone.len(), settings);
        let absent = "the reference has no votes here, so the mean score is 0";
        Scaled::new(votes, model, &all, &scores, &limits, is_absent.then_some(absent))
    });
    Scaling { bradley_terry, thurstone }
}

/// Adds votes to both sides of each pair with votes.
fn with_pseudo_votes(mut wins: Vec<f64>, methods: usize, options: &Options) -> Vec<f64> {
    if options.pseudo_votes > 0.0 {
        for i in 0..methods {
            for j in 0..i {
                let (a, b) = (i * methods + j, j * methods + i);
                if wins[a] + wins[b] > 0.0 {
                    wins[a] += options.pseudo_votes;
                    wins[b] += options.pseudo_votes;
                }
            }
        }
    }
    wins
}

/// Scores with 0 for one method, or with a mean of 0.
fn shifted(scores: Vec<f64>, zero: Option<usize>) -> Vec<f64> {
    let mean = scores.iter().sum::<f64>() / scores.len() as f64;
    let origin = zero.map_or(mean, |zero| scores[zero]);
    scores.into_iter().map(|score| score - origin).collect()
}

/// Bootstrap intervals of all scores.
struct Limits {
    of: Vec<Interval>,
    failed: usize,
    /// Why there are no intervals.
    reason: Option<String>,
}

impl Limits {
    fn new(
        replicates: &[Option<&Vec<f64>>],
        methods: usize,
        participants: usize,
        settings: &Settings,
    ) -> Self {
        let drawn: Vec<&Vec<f64>> = replicates.iter().copied().flatten().collect();
        let failed = replicates.len() - drawn.len();
        let why = if participants < 2 {
            "one participant cannot be resampled".to_owned()
        } else if settings.bootstrap == 0 {
            "there are no bootstrap replicates".to_owned()
        } else if failed as f64 > MOST_FAILED * settings.bootstrap as f64 {
            format!(
                "{failed} of {} bootstrap replicates have no finite scores, so there are no intervals",
                settings.bootstrap
            )
        } else {
            let of = |i: usize| drawn.iter().map(|scores| scores[i]).collect();
            let limits = |i| interval(of(i), settings.confidence).unwrap_or_default();
            return Self { of: (0..methods).map(limits).collect(), failed, reason: None };
        };
        Self { of: vec![[None; 2]; methods], failed, reason: Some(why) }
    }
}

impl Scaled {
    fn missing(reason: &str) -> Self {
        Self {
            scores: None,
            log_likelihood: None,
            deviance: None,
            df: None,
            p: None,
            failed_replicates: None,
            reason: Some(reason.to_owned()),
        }
    }

    fn new(
        votes: &Votes,
        model: Model,
        wins: &[f64],
        scores: &[f64],
        limits: &Limits,
        absent: Option<&str>,
    ) -> Self {
        let mut reasons: Vec<String> = limits.reason.iter().cloned().collect();
        reasons.extend(absent.map(str::to_owned));
        let methods = scores.len();
        let of_pair = |i: usize, j: usize| wins[i * methods + j] + wins[j * methods + i];
        let saturated: f64 =
            cells(wins, methods).map(|(i, j, w)| w * libm::log(w / of_pair(i, j))).sum();
        let pairs = (0..methods).flat_map(|i| (0..i).map(move |j| (i, j)));
        let with_votes = pairs.filter(|&(i, j)| of_pair(i, j) > 0.0).count();
        // Linked methods have at least as many pairs as free scores.
        let df = with_votes.saturating_sub(methods - 1);
        let log_likelihood = model.log_likelihood(wins, scores);
        let deviance = (2.0 * (saturated - log_likelihood)).max(0.0);
        if df == 0 {
            reasons
                .push("there are as many scores as pairs, so the deviance has no test".to_owned());
        }
        let scores = votes.methods.names().iter().zip(scores).zip(&limits.of);
        let scores = scores.map(|((method, &jod), &[lo, hi])| Score {
            method: method.clone(),
            jod,
            lo,
            hi,
            reason: limits.reason.clone(),
        });
        Self {
            scores: Some(scores.collect()),
            log_likelihood: Some(log_likelihood),
            deviance: Some(deviance),
            df: Some(df),
            p: chi_squared_upper(deviance, df as f64),
            failed_replicates: Some(limits.failed),
            reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
        }
    }
}

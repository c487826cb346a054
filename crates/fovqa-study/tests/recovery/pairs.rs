//! Pairwise comparisons: scores in JOD, and shares.

use std::fmt::Write;

use fovqa_study::pairs::{Options, Pairs, Scaled, pairs};
use fovqa_study::random::Replicate;

use crate::analyses::{one_group, settings};
use crate::coverage::{check, contains, contains_finite};
use crate::observers::{Impressions, pooled, share_of_normal};

/// True scores in JOD, with a mean of 0.
const JOD: [f64; 5] = [-1.1, -0.4, 0.0, 0.3, 1.2];
const PARTICIPANTS: usize = 30;

/// A study in which each participant votes `repeats` times on each pair of methods. The scores of
/// participants have the standard deviation `sd`.
#[derive(Debug, Clone, Copy)]
struct Design<'a> {
    impressions: Impressions,
    jod: &'a [f64],
    sd: f64,
    repeats: usize,
}

impl Design<'_> {
    fn votes(&self, random: &mut Replicate) -> String {
        let mut csv = "participant,method_a,method_b,answer\n".to_owned();
        for participant in 0..PARTICIPANTS {
            let own: Vec<f64> =
                self.jod.iter().map(|jod| jod + self.sd * random.normal()).collect();
            for a in 0..own.len() {
                for b in a + 1..own.len() {
                    for _ in 0..self.repeats {
                        let first = self.impressions.prefers_first([own[a], own[b]], random);
                        let answer = if first { "a" } else { "b" };
                        writeln!(csv, "{participant},M{a},M{b},{answer}").unwrap();
                    }
                }
            }
        }
        csv
    }

    fn result(&self, seed: u64, repetition: u64) -> Pairs {
        let csv = self.votes(&mut Replicate::new(seed, repetition));
        one_group(&csv, |data| pairs(data, &Options::default(), &settings(repetition)))
    }

    /// Whether the interval of each score contains the truth of pooled votes.
    fn inside(&self, scaled: &Scaled) -> Vec<bool> {
        let scores = scaled.scores.as_ref().unwrap().iter().zip(self.jod);
        let truth = |jod: &f64| pooled(*jod, self.sd);
        scores.map(|(score, jod)| contains(Some([score.lo, score.hi]), truth(jod))).collect()
    }
}

#[test]
#[ignore = "slow: make recovery"]
fn scores_of_bradley_and_terry() {
    let design = Design { impressions: Impressions::Gumbel, jod: &JOD, sd: 0.0, repeats: 4 };
    check(["pairs: Bradley-Terry scores, 5 methods"], |repetition| {
        [design.inside(&design.result(101, repetition).scaling.bradley_terry)]
    });
}

#[test]
#[ignore = "slow: make recovery"]
fn scores_of_thurstone() {
    let design = Design { impressions: Impressions::Normal, jod: &JOD, sd: 0.0, repeats: 4 };
    check(["pairs: Thurstone V scores, 5 methods"], |repetition| {
        [design.inside(&design.result(102, repetition).scaling.thurstone)]
    });
    let design = Design { sd: 0.4, ..design };
    check(["pairs: Thurstone V scores, participants vary"], |repetition| {
        [design.inside(&design.result(103, repetition).scaling.thurstone)]
    });
}

#[test]
#[ignore = "slow: make recovery"]
fn shares_of_participants_who_vary() {
    let design =
        Design { impressions: Impressions::Normal, jod: &[0.6, 0.0], sd: 0.6, repeats: 12 };
    let truth = share_of_normal(0.6, 0.6);
    check(["pairs: share, by participants who vary"], |repetition| {
        [vec![contains(design.result(104, repetition).pairs[0].cluster, truth)]]
    });
}

#[test]
#[ignore = "slow: make recovery"]
fn shares_of_independent_trials() {
    let design = Design { impressions: Impressions::Normal, jod: &[0.6, 0.0], sd: 0.0, repeats: 4 };
    let truth = share_of_normal(0.6, 0.0);
    let quantities = [
        "pairs: share, Clopper-Pearson, independent trials",
        "pairs: share, Wilson, independent trials",
        "pairs: share, by participants, independent trials",
    ];
    check(quantities, |repetition| {
        let pair = &design.result(105, repetition).pairs[0];
        [
            vec![contains_finite(pair.clopper_pearson, truth)],
            vec![contains_finite(pair.wilson, truth)],
            vec![contains(pair.cluster, truth)],
        ]
    });
}

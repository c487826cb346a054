//! Metrics: correlations with mean opinion scores.

use std::f64::consts::FRAC_2_PI;
use std::fmt::Write;

use fovqa_study::input::Table;
use fovqa_study::metrics::{Metric, Options, metrics};
use fovqa_study::random::Replicate;

use crate::analyses::{one_group, settings};
use crate::coverage::{check, contains, contains_finite};

const CONDITIONS: usize = 40;
/// The correlation of the normal distribution of metric and opinion.
const CORRELATION: f64 = 0.7;

fn study(seed: u64, repetition: u64) -> Metric {
    let mut random = Replicate::new(seed, repetition);
    let mut opinions = "scene,method,value\n".to_owned();
    let mut scores = "scene,method,metric,value\n".to_owned();
    for condition in 0..CONDITIONS {
        let score = random.normal();
        let rest = (1.0 - CORRELATION * CORRELATION).sqrt();
        let opinion = CORRELATION * score + rest * random.normal();
        writeln!(opinions, "hall,{condition},{opinion}").unwrap();
        writeln!(scores, "hall,{condition},psnr,{score}").unwrap();
    }
    let scores = Table::read("results.csv", scores.as_bytes()).unwrap();
    let (options, settings) = (Options::default(), settings(repetition));
    one_group(&opinions, |data| metrics(data, &scores, &options, &settings)).metrics.remove(0)
}

#[test]
#[ignore = "slow: make recovery"]
fn correlations() {
    let quantities = [
        "metrics: Pearson's correlation, Fisher",
        "metrics: Pearson's correlation, bootstrap",
        "metrics: Kendall's correlation, bootstrap",
    ];
    check(quantities, |repetition| {
        let metric = study(601, repetition);
        [
            vec![contains_finite(metric.pearson_fisher, CORRELATION)],
            vec![contains(metric.pearson_bootstrap, CORRELATION)],
            vec![contains(metric.kendall_bootstrap, FRAC_2_PI * CORRELATION.asin())],
        ]
    });
}

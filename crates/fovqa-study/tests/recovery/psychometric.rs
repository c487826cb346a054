//! Psychometric functions: thresholds of both fits.

use std::f64::consts::PI;

use fovqa_study::Settings;
use fovqa_study::options::{Direction, Sigmoid};
use fovqa_study::psychometric::{Level, Model, Options, fit};
use fovqa_study::random::Replicate;

use crate::analyses::settings;
use crate::coverage::{check, contains, contains_finite};
use crate::observers::Observer;

/// The performance of the thresholds.
const PERFORMANCE: f64 = 0.75;
/// Trials in a block of answers that are not independent.
const BLOCK: u64 = 40;
const LEVELS: [f64; 8] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0];
/// The range of the levels, and their least gap.
const RANGE: f64 = 5.0;
const GAP: f64 = 0.5;

fn observer(sigmoid: Sigmoid, direction: Direction) -> Observer {
    let width = if sigmoid == Sigmoid::Weibull { 1.2 } else { 3.0 };
    Observer { sigmoid, direction, threshold: 2.8, width, guess: 0.5, lapse: 0.02 }
}

fn options(observer: &Observer, overdispersion: bool) -> Options {
    let Observer { sigmoid, direction, guess, .. } = *observer;
    let model = Model { sigmoid, direction, guess };
    Options { model, performance: vec![PERFORMANCE], overdispersion, ..Options::default() }
}

/// Both fits to observers whose answers are independent. The posterior has no overdispersion.
fn thresholds(sigmoid: Sigmoid, direction: Direction, seed: u64) {
    let observer = observer(sigmoid, direction);
    let truth = observer.level_of(PERFORMANCE);
    let options = options(&observer, false);
    let name = format!("psychometric: {}, {}", sigmoid_name(sigmoid), direction_name(direction));
    let quantities = ["ML level of 75 %", "posterior level of 75 %", "posterior threshold m"]
        .map(|quantity| format!("{name}, {quantity}"));
    check(quantities.each_ref().map(String::as_str), |repetition| {
        let mut random = Replicate::new(seed, repetition);
        let answers = LEVELS.map(|level| {
            let trials = 60;
            let correct = (0..trials).filter(|_| observer.is_correct(level, &mut random)).count();
            Level { level, correct: correct as u64, trials }
        });
        let result = fit(answers.to_vec(), &options, &settings(repetition));
        let (ml, posterior) = (result.ml.unwrap(), result.posterior.unwrap());
        [
            vec![contains(ml.thresholds[0].ci, truth)],
            vec![contains(posterior.thresholds[0].ci, truth)],
            vec![contains_finite(Some(posterior.intervals.threshold), observer.threshold)],
        ]
    });
}

/// Observers whose parameters have the distribution of the prior. All intervals of the posterior then
/// contain the truth in 95 % of studies, whatever the levels and the number of trials.
#[test]
#[ignore = "slow: make recovery"]
fn observers_of_the_prior() {
    let prior = observer(Sigmoid::Logistic, Direction::Increasing);
    let options = options(&prior, true);
    let quantities = ["threshold m", "width", "lapse", "eta", "level of 75 %"]
        .map(|quantity| format!("psychometric: observers of the prior, posterior {quantity}"));
    check(quantities.each_ref().map(String::as_str), |repetition| {
        let mut random = Replicate::new(207, repetition);
        let lapse = draw(0.0, 0.5, &mut random, |lapse| libm::pow(1.0 - lapse, 9.0));
        let eta = draw(0.0, 1.0, &mut random, |eta| libm::pow(1.0 - eta, 9.0));
        let threshold = draw(-1.5, 8.5, &mut random, prior_of_position);
        let width = draw(GAP, 3.0 * RANGE, &mut random, prior_of_width);
        let observer = Observer { threshold, width, lapse, ..prior };
        let answers = LEVELS.map(|level| {
            let correct = observer.correct_of_block(level, BLOCK, eta, &mut random);
            Level { level, correct, trials: BLOCK }
        });
        let settings = Settings { bootstrap: 0, ..settings(repetition) };
        let posterior = fit(answers.to_vec(), &options, &settings).posterior.unwrap();
        let is_inside = |limits: [f64; 2], truth| vec![contains_finite(Some(limits), truth)];
        let limits = posterior.intervals;
        // Levels that are not reached are infinite.
        let [low, high] = posterior.thresholds[0].ci.unwrap();
        let level = if lapse < 1.0 - PERFORMANCE { observer.level_of(PERFORMANCE) } else { 1e9 };
        [
            is_inside(limits.threshold, threshold),
            is_inside(limits.width, width),
            is_inside(limits.lapse, lapse),
            is_inside(limits.eta, eta),
            is_inside([low.unwrap_or(1e9), high.unwrap_or(1e9)], level),
        ]
    });
}

/// A number between the limits with this density, whose maximum is 1.
fn draw(low: f64, high: f64, random: &mut Replicate, density: impl Fn(f64) -> f64) -> f64 {
    loop {
        let value = low + (high - low) * random.uniform();
        if random.uniform() < density(value) {
            return value;
        }
    }
}

/// psignifit's prior of m: 1 over the levels, and a cosine to half a range outside.
fn prior_of_position(position: f64) -> f64 {
    let distance = (LEVELS[0] - position).max(position - LEVELS[LEVELS.len() - 1]).max(0.0);
    0.5 * (1.0 + libm::cos(2.0 * PI * distance / RANGE))
}

/// psignifit's prior of w: 1 from twice the least gap of levels to their range.
fn prior_of_width(width: f64) -> f64 {
    if width < 2.0 * GAP {
        0.5 * (1.0 - libm::cos(PI * (width - GAP) / GAP))
    } else if width <= RANGE {
        1.0
    } else {
        0.5 * (1.0 + libm::cos(PI * (width - RANGE) / (2.0 * RANGE)))
    }
}

fn sigmoid_name(sigmoid: Sigmoid) -> &'static str {
    match sigmoid {
        Sigmoid::Logistic => "logistic",
        Sigmoid::Gaussian => "gaussian",
        Sigmoid::Weibull => "weibull",
    }
}

fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Increasing => "increasing",
        Direction::Decreasing => "decreasing",
    }
}

#[test]
#[ignore = "slow: make recovery"]
fn thresholds_of_logistic_functions() {
    thresholds(Sigmoid::Logistic, Direction::Increasing, 201);
    thresholds(Sigmoid::Logistic, Direction::Decreasing, 202);
}

#[test]
#[ignore = "slow: make recovery"]
fn thresholds_of_gaussian_functions() {
    thresholds(Sigmoid::Gaussian, Direction::Increasing, 203);
    thresholds(Sigmoid::Gaussian, Direction::Decreasing, 204);
}

#[test]
#[ignore = "slow: make recovery"]
fn thresholds_of_weibull_functions() {
    thresholds(Sigmoid::Weibull, Direction::Increasing, 205);
    thresholds(Sigmoid::Weibull, Direction::Decreasing, 206);
}

//! Staircases: the mean threshold of a method. Its truth is the mean that the procedure has, which
//! differs a little from the level of 70.7 % correct answers.

use std::fmt::Write;

use fovqa_study::options::{Direction, LevelMean, Sigmoid};
use fovqa_study::plan::{StaircaseOptions, plan_staircase};
use fovqa_study::psychometric::Model;
use fovqa_study::random::Replicate;
use fovqa_study::staircase::{Options, staircase};

use crate::analyses::{one_group, settings};
use crate::coverage::{check, contains_finite};
use crate::observers::{Observer, Staircase};

const PARTICIPANTS: usize = 12;
const TRIALS: usize = 60;
const STEPS: &[f64] = &[0.5, 0.25, 0.125];
const LIMITS: [f64; 2] = [0.125, 8.0];
/// Of the thresholds of participants; for Weibull, of their logarithms.
const BETWEEN_SD: f64 = 0.2;

/// A study with staircases.
struct Design {
    observer: Observer,
    start: f64,
    mean: LevelMean,
}

impl Design {
    fn trials(&self, random: &mut Replicate) -> String {
        let mut csv = "participant,trial,level,correct\n".to_owned();
        for participant in 0..PARTICIPANTS {
            let shift = BETWEEN_SD * random.normal();
            let threshold = match self.observer.sigmoid {
                Sigmoid::Weibull => self.observer.threshold * libm::exp(shift),
                Sigmoid::Logistic | Sigmoid::Gaussian => self.observer.threshold + shift,
            };
            let observer = Observer { threshold, ..self.observer };
            let direction = observer.direction;
            let mut staircase = Staircase::new(self.start, STEPS, LIMITS, direction);
            for trial in 0..TRIALS {
                let level = staircase.level;
                let is_correct = observer.is_correct(level, random);
                let correct = u8::from(is_correct);
                writeln!(csv, "{participant},{trial},{level},{correct}").unwrap();
                staircase.answer(is_correct);
            }
        }
        csv
    }

    fn options(&self) -> Options {
        Options { mean: self.mean, ..Options::default() }
    }

    /// The mean threshold of 10 000 studies that the plan simulates, whose code is not the observers'.
    fn truth(&self) -> f64 {
        let observer = &self.observer;
        let model = Model {
            sigmoid: observer.sigmoid,
            direction: observer.direction,
            guess: observer.guess,
        };
        let options = StaircaseOptions {
            participants: PARTICIPANTS,
            trials: TRIALS,
            threshold: observer.threshold,
            width: observer.width,
            lapse: observer.lapse,
            between_sd: BETWEEN_SD,
            model,
            start: self.start,
            steps: STEPS.to_vec(),
            lowest: Some(LIMITS[0]),
            highest: Some(LIMITS[1]),
            down: 2,
            studies: 10_000,
            reversals: self.options(),
        };
        let plan = plan_staircase(&options, &settings(0)).unwrap().result;
        assert!(plan.failed < 10);
        plan.mean.unwrap()
    }

    fn check(&self, quantity: &str, seed: u64) {
        let truth = self.truth();
        check([quantity], |repetition| {
            let csv = self.trials(&mut Replicate::new(seed, repetition));
            let result =
                one_group(&csv, |data| staircase(data, &self.options(), &settings(repetition)));
            [vec![contains_finite(result.methods[0].ci, truth)]]
        });
    }
}

#[test]
#[ignore = "slow: make recovery"]
fn mean_thresholds() {
    let observer = Observer {
        sigmoid: Sigmoid::Logistic,
        direction: Direction::Increasing,
        threshold: 2.0,
        width: 1.2,
        guess: 0.5,
        lapse: 0.01,
    };
    let arithmetic = Design { observer, start: 4.0, mean: LevelMean::Arithmetic };
    arithmetic.check("staircase: mean threshold, logistic, increasing", 301);
    let observer = Observer {
        sigmoid: Sigmoid::Weibull,
        direction: Direction::Decreasing,
        width: 0.8,
        ..observer
    };
    let geometric = Design { observer, start: 0.5, mean: LevelMean::Geometric };
    geometric.check("staircase: geometric mean threshold, weibull, decreasing", 302);
}

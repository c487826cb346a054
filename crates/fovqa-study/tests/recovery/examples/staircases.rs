//! Trials of staircases, which psychometric functions fit too.

use std::fmt::Write;

use fovqa_study::options::{Direction, Sigmoid};

use super::participants;
use crate::observers::{Observer, Staircase};

/// Trials of each staircase.
const TRIALS: usize = 40;
const STEPS: &[f64] = &[0.5, 0.25];
const LIMITS: [f64; 2] = [0.25, 6.0];

/// Two interleaved staircases of each of six participants and three methods. One begins with easy
/// trials, the other one with hard trials.
pub(super) fn staircases() -> String {
    let mut csv = "participant,method,staircase,trial,level,correct\n".to_owned();
    for (name, mut random) in participants(6, 16) {
        for (method, threshold) in [("A", 1.2), ("B", 1.35), ("C", 2.1)] {
            let observer = Observer {
                sigmoid: Sigmoid::Logistic,
                direction: Direction::Increasing,
                threshold: threshold + 0.2 * random.normal(),
                width: 1.4,
                guess: 0.5,
                lapse: 0.01,
            };
            let start =
                |level: f64| (Staircase::new(level, STEPS, LIMITS, observer.direction), TRIALS);
            let mut staircases = [start(4.0), start(0.5)];
            for trial in 1..=2 * TRIALS {
                let drawn = random.index(2);
                let index = if staircases[drawn].1 > 0 { drawn } else { 1 - drawn };
                let (staircase, left) = &mut staircases[index];
                let level = staircase.level;
                let is_correct = observer.is_correct(level, &mut random);
                let correct = u8::from(is_correct);
                let start = ["easy", "hard"][index];
                writeln!(csv, "{name},{method},{start},{trial},{level},{correct}").unwrap();
                staircase.answer(is_correct);
                *left -= 1;
            }
        }
    }
    csv
}

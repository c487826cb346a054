//! Ratings: the mean of each level, and the level at which the mean crosses a threshold.

use std::fmt::Write;

use fovqa_study::random::Replicate;
use fovqa_study::ratings::{LevelRatings, Options, Ratings, ratings};

use crate::analyses::{one_group, settings};
use crate::coverage::{check, contains, contains_finite};
use crate::observers::{mean_rating, rating};

const PARTICIPANTS: usize = 24;
const REPEATS: usize = 4;
const LEVELS: [f64; 5] = [1.0, 1.5, 2.0, 2.5, 3.0];
/// Mean impressions of the levels, on the scale of ratings from 0 to 3.
const IMPRESSIONS: [f64; 5] = [3.0, 2.6, 2.2, 1.6, 0.9];
/// Standard deviations between participants, and between the impressions of a participant.
const SD: [f64; 2] = [0.3, 0.5];
const THRESHOLD: f64 = 2.0;

fn study(seed: u64, repetition: u64) -> LevelRatings {
    let mut random = Replicate::new(seed, repetition);
    let mut csv = "participant,level,value\n".to_owned();
    for participant in 0..PARTICIPANTS {
        let shift = SD[0] * random.normal();
        for (level, mean) in LEVELS.iter().zip(IMPRESSIONS) {
            for _ in 0..REPEATS {
                let value = rating(mean + shift + SD[1] * random.normal(), 0.0, 3.0);
                writeln!(csv, "{participant},{level},{value}").unwrap();
            }
        }
    }
    let options = Options { threshold: Some(THRESHOLD), ..Options::default() };
    match one_group(&csv, |data| ratings(data, &options, &settings(repetition))) {
        Ratings::Levels(levels) => levels,
        Ratings::Grid(_) => panic!("the levels are no grid"),
    }
}

#[test]
#[ignore = "slow: make recovery"]
fn means_and_crossings() {
    let sd = SD[0].hypot(SD[1]);
    let means = IMPRESSIONS.map(|mean| mean_rating(mean, sd, 0, 3));
    let below = means.iter().position(|&mean| mean < THRESHOLD).unwrap();
    let (high, low) = (means[below - 1], means[below]);
    let step = LEVELS[below] - LEVELS[below - 1];
    let crossing = LEVELS[below - 1] + step * (high - THRESHOLD) / (high - low);
    check(["ratings: mean of a level", "ratings: crossing of the threshold"], |repetition| {
        let result = study(401, repetition);
        let levels = result.levels.iter().zip(means);
        let inside = levels.map(|(level, mean)| contains_finite(level.moments.ci, mean)).collect();
        [inside, vec![contains(result.acceptable.unwrap().crossing_ci, crossing)]]
    });
}

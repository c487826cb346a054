//! Ratings: Likert scales, sliders, scores by level, and scores over a grid.

use std::fmt::Write;

use super::participants;
use crate::observers::rating;

/// Ratings from 1 to 5 of four methods by 16 participants.
pub(super) fn ranking() -> String {
    let methods = [("full", 4.4), ("A", 4.2), ("B", 3.5), ("C", 2.4)];
    let mut csv = "participant,method,value\n".to_owned();
    for (name, mut random) in participants(16, 12) {
        let shift = 0.4 * random.normal();
        for (method, mean) in methods {
            let value = rating(mean + shift + 0.6 * random.normal(), 1.0, 5.0);
            writeln!(csv, "{name},{method},{value}").unwrap();
        }
    }
    csv
}

/// The slider that 16 participants set for three methods and both eyes: the size of the region with
/// full resolution, in degrees.
pub(super) fn slider() -> String {
    let methods = [("A", [15.0, 14.8]), ("B", [15.6, 14.2]), ("C", [21.0, 17.5])];
    let mut csv = "participant,method,eye,value\n".to_owned();
    for (name, mut random) in participants(16, 13) {
        let shift = 3.0 * random.normal();
        for (method, means) in methods {
            for (eye, mean) in ["dominant", "other"].iter().zip(means) {
                let value = (mean + shift + 1.8 * random.normal()).max(0.0);
                writeln!(csv, "{name},{method},{eye},{value:.1}").unwrap();
            }
        }
    }
    csv
}

/// Scores from 0 to 3 by level of foveation, with validation trials without foveation, whose score
/// should be 3. The participant P07 answers at random.
pub(super) fn scores() -> String {
    let levels = [(1.4, 3.0), (1.8, 2.7), (2.2, 2.2), (2.6, 1.6), (3.0, 0.9)];
    let mut csv = "participant,level,value,validation\n".to_owned();
    for (name, mut random) in participants(12, 14) {
        let shift = 0.3 * random.normal();
        let is_careless = name == "P07";
        for block in 0..4 {
            let trials = levels.iter().take(if block < 3 { levels.len() } else { 0 });
            for (level, mean, validation) in
                trials.map(|&(level, mean)| (level, mean + shift, 0)).chain([(1.0, 3.3, 1)])
            {
                let careful = rating(mean + 0.5 * random.normal(), 0.0, 3.0);
                let careless = random.index(4) as f64;
                let value = if is_careless { careless } else { careful };
                writeln!(csv, "{name},{level},{value},{validation}").unwrap();
            }
        }
    }
    csv
}

/// Scores from 0 to 3 of eight participants over two parameters, best at fx = fy = 0.35.
pub(super) fn grid() -> String {
    let values = [0.05, 0.2, 0.35, 0.5, 0.65];
    let mut csv = "participant,fx,fy,value\n".to_owned();
    for (name, mut random) in participants(8, 15) {
        let shift = 0.2 * random.normal();
        for fx in values {
            for fy in values {
                let loss = 12.0 * ((fx - 0.35) * (fx - 0.35) + (fy - 0.35) * (fy - 0.35));
                let value = rating(2.5 - loss + shift + 0.5 * random.normal(), 0.0, 3.0);
                writeln!(csv, "{name},{fx},{fy},{value}").unwrap();
            }
        }
    }
    csv
}

//! Votes between two methods (2AFC).

use std::fmt::Write;

use super::{participants, shuffle};
use crate::observers::Impressions;

const METHODS: [&str; 5] = ["full", "A", "B", "C", "D"];
/// Scenes with the scores of the methods in JOD.
const SCENES: [(&str, [f64; 5]); 2] =
    [("hall", [0.0, -0.2, -0.8, -0.9, -1.8]), ("garden", [0.0, -0.1, -0.3, -1.1, -1.5])];
/// The standard deviation of the scores between participants, in JOD.
const BETWEEN_SD: f64 = 0.3;

/// The votes of 20 participants on all pairs, in random order and on random sides.
pub(super) fn votes() -> String {
    let mut csv = "participant,scene,method_a,method_b,answer\n".to_owned();
    for (name, mut random) in participants(20, 21) {
        for (scene, jod) in SCENES {
            let own = jod.map(|jod| jod + BETWEEN_SD * random.normal());
            let mut pairs: Vec<(usize, usize)> =
                (0..own.len()).flat_map(|a| (0..a).map(move |b| (a, b))).collect();
            shuffle(&mut pairs, &mut random);
            for (a, b) in pairs {
                let (a, b) = if random.bernoulli(0.5) { (a, b) } else { (b, a) };
                let first = Impressions::Normal.prefers_first([own[a], own[b]], &mut random);
                let answer = if first { "a" } else { "b" };
                writeln!(csv, "{name},{scene},{},{},{answer}", METHODS[a], METHODS[b]).unwrap();
            }
        }
    }
    csv
}

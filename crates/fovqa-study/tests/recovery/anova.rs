//! Analysis of variance: means of cells, and differences of levels.

use std::fmt::Write;

use fovqa_study::anova::{Anova, anova};
use fovqa_study::random::Replicate;

use crate::analyses::{one_group, settings};
use crate::coverage::{check, contains_finite};

const PARTICIPANTS: usize = 12;
/// Means by method, for each eye.
const MEANS: [[f64; 2]; 3] = [[2.0, 2.4], [2.5, 2.8], [3.6, 3.5]];
/// Standard deviations between participants: of their level, of their response to each method, and
/// of the rest.
const SD: [f64; 3] = [0.6, 0.3, 0.4];

fn study(seed: u64, repetition: u64) -> Anova {
    let mut random = Replicate::new(seed, repetition);
    let mut csv = "participant,method,eye,value\n".to_owned();
    for participant in 0..PARTICIPANTS {
        let shift = SD[0] * random.normal();
        for (method, means) in MEANS.iter().enumerate() {
            let of_method = SD[1] * random.normal();
            for (eye, mean) in means.iter().enumerate() {
                let value = mean + shift + of_method + SD[2] * random.normal();
                writeln!(csv, "{participant},{method},{eye},{value}").unwrap();
            }
        }
    }
    let within = ["method".to_owned(), "eye".to_owned()];
    one_group(&csv, |data| anova(data, &within, &settings(repetition)))
}

#[test]
#[ignore = "slow: make recovery"]
fn differences_and_cells() {
    let of_method = |method: usize| 0.5 * (MEANS[method][0] + MEANS[method][1]);
    check(["anova: difference of two methods", "anova: mean of a cell"], |repetition| {
        let result = study(501, repetition);
        let tests = result.posthoc.unwrap();
        let of_methods = tests.iter().filter(|test| test.factor == "method");
        let differences = of_methods.map(|test| {
            let [a, b] = [&test.a, &test.b].map(|name| of_method(name.parse().unwrap()));
            contains_finite(test.ci, a - b)
        });
        let truths = MEANS.iter().flatten();
        let cells = result.cells.iter().zip(truths);
        let cells = cells.map(|(cell, mean)| contains_finite(cell.moments.ci, *mean));
        [differences.collect(), cells.collect()]
    });
}

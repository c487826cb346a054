//! How often intervals contain the truth.

use rayon::prelude::*;

/// Simulated studies of each design.
pub(crate) const REPETITIONS: u64 = 300;
/// The least and the largest share of intervals of 95 % that may contain the truth. The standard
/// error of a share of 300 studies is 1.3 %.
const ALLOWED: [f64; 2] = [0.90, 0.99];

/// Repeats a study, and prints for each quantity the share of intervals that contain the truth.
/// `study` says for each quantity whether each of its intervals does.
///
/// # Panics
///
/// If a share is not allowed.
pub(crate) fn check<const N: usize>(
    quantities: [&str; N],
    study: impl Fn(u64) -> [Vec<bool>; N] + Sync + Send,
) {
    let studies: Vec<[Vec<bool>; N]> = (0..REPETITIONS).into_par_iter().map(study).collect();
    // Ends the line on which the name of the test may stand.
    println!();
    let mut wrong = Vec::new();
    for (index, quantity) in quantities.iter().enumerate() {
        let all: Vec<bool> = studies.iter().flat_map(|study| study[index].clone()).collect();
        let inside = all.iter().filter(|&&inside| inside).count();
        let share = inside as f64 / all.len() as f64;
        let row = format!("{quantity:<62}{:>6.1} %  {inside} of {}", 100.0 * share, all.len());
        println!("  {row}");
        if !(ALLOWED[0]..=ALLOWED[1]).contains(&share) {
            wrong.push(row);
        }
    }
    assert!(wrong.is_empty(), "the share inside is not from 90 to 99 %: {wrong:#?}");
}

/// True if both limits are defined and the truth lies between them.
pub(crate) fn contains(interval: Option<[Option<f64>; 2]>, truth: f64) -> bool {
    matches!(interval, Some([Some(low), Some(high)]) if (low..=high).contains(&truth))
}

/// The same for limits that are always defined.
pub(crate) fn contains_finite(interval: Option<[f64; 2]>, truth: f64) -> bool {
    contains(interval.map(|limits| limits.map(Some)), truth)
}

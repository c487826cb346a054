//! The spacing of a sequence's frames in time, from their numbers, and the numbers that are
//! missing.
//!
//! If all distances between neighbouring numbers are multiples of the smallest distance, that is
//! the step of the sequence, and a frame is missing wherever a step has no number: 3 is missing in
//! 0, 1, 2, 4, and nothing is missing in 0, 10, 20. Numbers without such a step, such as time
//! stamps, define only the order.

use std::collections::BTreeSet;
use std::fmt;

/// The positions of frames in time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spacing {
    /// All numbers in rising order.
    numbers: Vec<i64>,
    /// The distance between neighbours, if there is a common one.
    step: Option<u64>,
}

impl Spacing {
    /// The spacing of all known frames of a sequence, from both sides.
    pub fn of(numbers: &BTreeSet<i64>) -> Self {
        let numbers: Vec<i64> = numbers.iter().copied().collect();
        let distances = || numbers.windows(2).map(|pair| pair[1].abs_diff(pair[0]));
        let least = distances().min();
        let step = least.filter(|step| distances().all(|distance| distance.is_multiple_of(*step)));
        Self { numbers, step }
    }

    /// The position of a frame, in steps from the first. Two frames are consecutive if their
    /// positions differ by 1.
    pub fn place(&self, number: i64) -> usize {
        let first = self.numbers.first().copied().unwrap_or(number);
        match self.step {
            Some(step) if number >= first => {
                usize::try_from(number.abs_diff(first) / step).unwrap_or(usize::MAX)
            }
            _ => self.numbers.partition_point(|known| *known < number),
        }
    }

    /// The number at a position, as far as the known numbers define it.
    pub(super) fn number(&self, place: usize) -> Option<i64> {
        let first = *self.numbers.first()?;
        match self.step {
            Some(step) => {
                let steps = (place as u64).checked_mul(step)?;
                first.checked_add_unsigned(steps)
            }
            None if self.numbers.len() == 1 => first.checked_add_unsigned(place as u64),
            None => self.numbers.get(place).copied(),
        }
    }

    /// The wanted numbers that neither side has.
    pub fn missing(&self, wanted: impl Fn(i64) -> bool) -> MissingFrames {
        /// Larger gaps are reported as a whole, without asking which of their numbers are wanted.
        const MOST: u64 = 1 << 20;
        let mut missing = MissingFrames::default();
        let Some(step) = self.step else { return missing };
        let mut left = MOST;
        for pair in self.numbers.windows(2) {
            let count = pair[1].abs_diff(pair[0]) / step - 1;
            if count > left {
                let (from, to) =
                    (pair[0].saturating_add_unsigned(step), pair[1].saturating_sub_unsigned(step));
                missing.add(from, to, count, step);
                continue;
            }
            left -= count;
            for nth in 1..=count {
                let number = pair[0].saturating_add_unsigned(nth * step);
                if wanted(number) {
                    missing.add(number, number, 1, step);
                }
            }
        }
        missing
    }
}

/// Numbers of frames that are missing inside a sequence.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MissingFrames {
    /// The first and the last number of each run, and how many numbers it has.
    runs: Vec<(i64, i64, u64)>,
}

impl MissingFrames {
    /// Whether no frame is missing.
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// How many frames are missing.
    pub fn count(&self) -> u64 {
        self.runs.iter().fold(0, |all, (.., count)| all.saturating_add(*count))
    }

    fn add(&mut self, from: i64, to: i64, count: u64, step: u64) {
        match self.runs.last_mut() {
            Some(run) if run.1.checked_add_unsigned(step) == Some(from) => {
                *run = (run.0, to, run.2 + count);
            }
            _ => self.runs.push((from, to, count)),
        }
    }
}

/// `frame 2`, or `frames 2, 5 to 9 and 12 more`.
impl fmt::Display for MissingFrames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 5;
        let run = |(from, to, count): &(i64, i64, u64)| match count {
            1 => from.to_string(),
            2 => format!("{from}, {to}"),
            _ => format!("{from} to {to}"),
        };
        let shown: Vec<String> = self.runs.iter().take(SHOWN).map(run).collect();
        let more = self.runs.iter().skip(SHOWN).fold(0u64, |all, (.., n)| all.saturating_add(*n));
        let frames = if self.count() == 1 { "frame" } else { "frames" };
        write!(f, "{frames} {}", shown.join(", "))?;
        if more > 0 { write!(f, " and {more} more") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spacing(numbers: &[i64]) -> Spacing {
        Spacing::of(&numbers.iter().copied().collect())
    }

    fn missing(numbers: &[i64]) -> String {
        spacing(numbers).missing(|_| true).to_string()
    }

    #[test]
    fn a_constant_step_has_no_gap() {
        for whole in [&[0, 10, 20][..], &[-2, -1, 0], &[7], &[], &[3, 90], &[0, 11, 22, 34]] {
            assert!(spacing(whole).missing(|_| true).is_empty(), "{whole:?}");
        }
        assert_eq!(spacing(&[0, 10, 20]).place(20), 2);
        assert_eq!(spacing(&[0, 11, 22, 34]).place(34), 3, "time stamps say the order alone");
        assert_eq!(spacing(&[5]).place(5), 0);
    }

    #[test]
    fn missing_frames_are_listed_briefly() {
        assert_eq!(missing(&[0, 1, 3]), "frame 2");
        assert_eq!(missing(&[0, 10, 30, 70]), "frames 20, 40 to 60");
        assert_eq!(missing(&[-4, -3, 0]), "frames -2, -1");
        assert_eq!(missing(&[0, 1, 3, 5, 7, 9, 11, 14, 20]), "frames 2, 4, 6, 8, 10 and 7 more");
        let spacing = spacing(&[0, 1, 3, 5]);
        assert_eq!([0, 1, 3, 5].map(|n| spacing.place(n)), [0, 1, 3, 5]);
        assert_eq!(spacing.missing(|number| number > 2).to_string(), "frame 4");
    }

    #[test]
    fn the_largest_gap_is_counted_quickly() {
        let far = spacing(&[i64::MIN, i64::MIN + 1, i64::MAX]);
        assert_eq!(far.missing(|_| true).count(), u64::MAX - 2);
        assert!(far.place(i64::MAX) > 1 << 60);
    }
}

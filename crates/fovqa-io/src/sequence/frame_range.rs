//! `--frames A..B:STEP`.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A selection of frames by their numbers: every STEP-th frame from A up to B, without B itself.
/// Steps are counted from A or, if A is missing, from 0. Numbers may be negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct FrameRange {
    from: Option<i64>,
    to: Option<i64>,
    step: u64,
}

/// The text is not a range of frames.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "{0:?} is not a range of frames: write A..B or A..B:STEP, A and B may be left out, STEP is at least 1"
)]
pub struct FrameRangeError(String);

impl FrameRange {
    /// Whether frame `number` is selected.
    pub fn contains(&self, number: i64) -> bool {
        let offset = i128::from(number) - i128::from(self.from.unwrap_or(0));
        self.from.is_none_or(|from| number >= from)
            && self.to.is_none_or(|to| number < to)
            && offset.rem_euclid(i128::from(self.step)) == 0
    }
}

impl fmt::Display for FrameRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let end = |end: Option<i64>| end.map(|end| end.to_string()).unwrap_or_default();
        write!(f, "{}..{}:{}", end(self.from), end(self.to), self.step)
    }
}

impl TryFrom<String> for FrameRange {
    type Error = FrameRangeError;

    fn try_from(text: String) -> Result<Self, FrameRangeError> {
        text.parse()
    }
}

impl From<FrameRange> for String {
    fn from(range: FrameRange) -> Self {
        range.to_string()
    }
}

impl FromStr for FrameRange {
    type Err = FrameRangeError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        // Only plain digits of a number that fits, with an optional minus sign where it is allowed.
        // `parse` alone would accept more.
        let number = |text: &str| {
            let digits = text.strip_prefix('-').unwrap_or(text);
            let plain = digits.len() <= 18 && digits.bytes().all(|b| b.is_ascii_digit());
            if plain { text.parse::<i64>().ok() } else { None }
        };
        let parse = || {
            let (range, step) = match text.split_once(':') {
                Some((range, step)) => {
                    (range, u64::try_from(number(step)?).ok().filter(|s| *s > 0)?)
                }
                None => (text, 1),
            };
            let (from, to) = range.split_once("..")?;
            let from = if from.is_empty() { None } else { Some(number(from)?) };
            let (to, inclusive) = to.strip_prefix('=').map_or((to, 0), |to| (to, 1));
            let to =
                if to.is_empty() && inclusive == 0 { None } else { Some(number(to)? + inclusive) };
            Some(Self { from, to, step })
        };
        parse().ok_or_else(|| FrameRangeError(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selects_by_number() {
        let picked = |text: &str| {
            let range: FrameRange = text.parse().unwrap();
            (-4..12).filter(|n| range.contains(*n)).collect::<Vec<_>>()
        };
        assert_eq!(picked("2..5"), [2, 3, 4]);
        assert_eq!(picked("2..=5"), [2, 3, 4, 5]);
        assert_eq!(picked("1..:4"), [1, 5, 9]);
        assert_eq!(picked("..3"), [-4, -3, -2, -1, 0, 1, 2]);
        assert_eq!(picked("..:5"), [0, 5, 10]);
        assert_eq!(picked("-2..2"), [-2, -1, 0, 1]);
        assert_eq!(picked("-3..=-1:2"), [-3, -1]);
        for text in ["2..=5", "-2..:3", "..-1", ".."] {
            let range: FrameRange = text.parse().unwrap();
            assert_eq!(range.to_string().parse(), Ok(range), "{text}");
        }
        for bad in [
            "",
            "3",
            "a..b",
            "1..2:0",
            "1..2:x",
            "..=",
            "--1..2",
            "-..2",
            "0..2:-1",
            "+0..2",
            "0..9999999999999999999",
        ] {
            assert!(bad.parse::<FrameRange>().is_err(), "{bad}");
        }
    }
}

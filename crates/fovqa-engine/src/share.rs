//! Shards of a run: which of all its pairs are scored here.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// One of several shards of a run: the I-th of N, written `I/N`. The pairs of all views are put in
/// one sequence, which is cut into N ranges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Shard {
    index: u32,
    of: u32,
}

/// A text that does not name a shard.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0:?} is not a shard: write I/N, with I from 1 to N and N at most {most}", most = Shard::MOST)]
pub struct ShardError(String);

impl Shard {
    /// Maximum number of shards of a run.
    pub const MOST: u32 = 10_000;

    /// Index of the shard, counted from 1.
    pub fn index(self) -> u32 {
        self.index
    }

    /// Number of shards of the run.
    pub fn of(self) -> u32 {
        self.of
    }

    /// The range of this shard among `pairs` pairs.
    pub(crate) fn range(self, pairs: usize) -> Range<usize> {
        let end = |index: u32| (pairs as u64 * u64::from(index) / u64::from(self.of)) as usize;
        end(self.index - 1)..end(self.index)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        // Only plain digits are allowed; a sign or anything else that parses is refused.
        let number = |digits: &str| {
            let plain = digits.len() <= 6 && digits.bytes().all(|b| b.is_ascii_digit());
            if plain { digits.parse::<u32>().ok() } else { None }
        };
        let parsed = text.split_once('/').and_then(|(index, of)| {
            let (index, of) = (number(index)?, number(of)?);
            (1 <= index && index <= of && of <= Self::MOST).then_some(Self { index, of })
        });
        parsed.ok_or_else(|| ShardError(text.to_owned()))
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl TryFrom<String> for Shard {
    type Error = ShardError;

    fn try_from(text: String) -> Result<Self, ShardError> {
        text.parse()
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

/// The range of pairs of each view in a shard; `None` stands for the whole run. `pairs` contains
/// the number of pairs of each view.
pub(crate) fn shares(shard: Option<Shard>, pairs: &[usize]) -> Vec<Range<usize>> {
    let total = pairs.iter().sum();
    let own = shard.map_or(0..total, |shard| shard.range(total));
    let mut before = 0;
    let share = |pairs: &usize| {
        let clip = |at: usize| at.clamp(before, before + pairs) - before;
        let share = clip(own.start)..clip(own.end);
        before += pairs;
        share
    };
    pairs.iter().map(share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_stretches_and_together_all_there_is() {
        for pairs in [vec![], vec![5], vec![3, 0, 4, 1], vec![1; 20]] {
            let total: usize = pairs.iter().sum();
            for of in [1, 2, 3, 7, 30] {
                let mut next = vec![0; pairs.len()];
                let mut sizes = Vec::new();
                for index in 1..=of {
                    let own = shares(Some(Shard { index, of }), &pairs);
                    for (view, range) in own.iter().enumerate().filter(|(_, r)| !r.is_empty()) {
                        assert_eq!(range.start, next[view]);
                        next[view] = range.end;
                    }
                    sizes.push(own.iter().map(ExactSizeIterator::len).sum::<usize>());
                }
                assert_eq!(next, pairs);
                let (least, most) = (sizes.iter().min(), sizes.iter().max());
                assert!(most.unwrap() - least.unwrap() <= 1, "{sizes:?}");
                assert_eq!(sizes.iter().sum::<usize>(), total);
            }
            assert_eq!(shares(None, &pairs).len(), pairs.len());
        }
        // T (I - 1) / N, rounded down.
        assert_eq!(Shard { index: 2, of: 3 }.range(10), 3..6);
        assert_eq!(
            Shard { index: 10_000, of: 10_000 }.range(usize::MAX >> 20).end,
            usize::MAX >> 20
        );
    }

    #[test]
    fn a_shard_is_written_as_it_is_read() {
        for text in ["1/1", "3/7", "10000/10000"] {
            let shard: Shard = text.parse().unwrap();
            assert_eq!(shard.to_string(), text);
            let json = serde_json::to_string(&shard).unwrap();
            assert_eq!(serde_json::from_str::<Shard>(&json).unwrap(), shard);
        }
        for text in
            ["", "1", "0/3", "4/3", "1/0", "1/10001", "-1/3", "+1/3", "1/3/5", "1.0/3", "a/b"]
        {
            let error = text.parse::<Shard>().unwrap_err();
            assert!(error.to_string().contains("write I/N"), "{error}");
        }
    }
}

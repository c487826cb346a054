//! Grids over parameters of emulated methods.

use std::ops::Range;

use fovqa_params::ParamValue;
use serde::{Deserialize, Serialize};

/// A key of an emulated method that is swept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweptKey {
    /// Its name, as in `emulate = { … }`: a parameter, or `budget`, `filter`, ….
    pub key: String,
    /// Its values, in the order of the file.
    pub values: Vec<ParamValue>,
}

/// An emulated method that is scored at each point of a grid over some of its keys. Each point is a
/// method of the plan; they follow each other, and the last key changes fastest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// The method, as the file names it.
    pub method: String,
    /// The keys, in the order of the file.
    pub keys: Vec<SweptKey>,
    /// Index of its first point among the methods of the plan.
    pub first: usize,
}

impl Sweep {
    /// The number of points; `None` if it does not fit into a `usize`.
    pub fn points(&self) -> Option<usize> {
        let lengths = self.keys.iter().map(|key| key.values.len());
        lengths.into_iter().try_fold(1, usize::checked_mul)
    }

    /// The indices of its points among the methods of the plan.
    pub fn methods(&self) -> Range<usize> {
        self.first..self.first + self.points().unwrap_or(0)
    }

    /// The index of each key's value at a point.
    pub fn place(&self, point: usize) -> Vec<usize> {
        let mut rest = point;
        let mut place: Vec<usize> = Vec::with_capacity(self.keys.len());
        for key in self.keys.iter().rev() {
            let values = key.values.len().max(1);
            place.push(rest % values);
            rest /= values;
        }
        place.reverse();
        place
    }

    /// The keys at a point with their values.
    pub fn at(&self, point: usize) -> impl Iterator<Item = (&str, &ParamValue)> {
        let place = self.place(point).into_iter();
        let keys = self.keys.iter().zip(place);
        keys.filter_map(|(key, index)| Some((key.key.as_str(), key.values.get(index)?)))
    }

    /// The keys at a point with their values, as results write them: `fx=0.1;fy=0.2`.
    pub fn parameters(&self, point: usize) -> String {
        let written = |(key, value): (&str, &ParamValue)| format!("{key}={}", shown(value));
        self.at(point).map(written).collect::<Vec<_>>().join(";")
    }

    /// The keys with their values, in words: `20 points, fx (10 values: 0.1 to 1), fy (2 values: 0.3, 0.4)`.
    pub fn in_words(&self) -> String {
        const SHOWN: usize = 4;
        let of_key = |SweptKey { key, values }: &SweptKey| {
            let all: Vec<String> = values.iter().map(shown).collect();
            let listed = match all.as_slice() {
                [first, .., last] if all.len() > SHOWN => format!("{first} to {last}"),
                all => all.join(", "),
            };
            let count = if all.len() == 1 { "1 value" } else { &format!("{} values", all.len()) };
            format!("{key} ({count}: {listed})")
        };
        let keys: Vec<String> = self.keys.iter().map(of_key).collect();
        let points = self.methods().len();
        let points = if points == 1 { "1 point".to_owned() } else { format!("{points} points") };
        format!("{points}, {}", keys.join(", "))
    }

    /// The name of the method at a point.
    pub fn label(&self, point: usize) -> String {
        swept_label(&self.method, &self.parameters(point))
    }
}

/// A swept value as results and figures show it.
pub fn shown(value: &ParamValue) -> String {
    match value {
        ParamValue::Text(text) => text.clone(),
        other => other.in_words(),
    }
}

/// The name of a swept method at a point: `RMFR (fx=0.1;fy=0.2)`; the method alone without parameters.
pub fn swept_label(method: &str, parameters: &str) -> String {
    if parameters.is_empty() { method.to_owned() } else { format!("{method} ({parameters})") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_key_changes_fastest() {
        let key = |key: &str, values: &[f64]| SweptKey {
            key: key.to_owned(),
            values: values.iter().copied().map(ParamValue::Number).collect(),
        };
        let sweep = Sweep {
            method: "RMFR".to_owned(),
            keys: vec![key("fx", &[0.1, 0.2]), key("fy", &[1.0, 2.0, 3.0])],
            first: 4,
        };
        assert_eq!(sweep.points(), Some(6));
        assert_eq!(sweep.methods(), 4..10);
        let all: Vec<String> = (0..6).map(|point| sweep.parameters(point)).collect();
        let expected = ["0.1;fy=1", "0.1;fy=2", "0.1;fy=3", "0.2;fy=1", "0.2;fy=2", "0.2;fy=3"];
        assert_eq!(all, expected.map(|rest| format!("fx={rest}")));
        assert_eq!(sweep.label(5), "RMFR (fx=0.2;fy=3)");
        assert_eq!(sweep.place(4), [1, 1]);
        assert_eq!(sweep.in_words(), "6 points, fx (2 values: 0.1, 0.2), fy (3 values: 1, 2, 3)");
    }
}

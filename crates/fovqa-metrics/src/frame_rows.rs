//! The values of a frame as they are kept until the end of a run: packed, as frames are many and what their
//! values are of is the same for all.

use std::sync::Arc;

use crate::pooling::{Parts, Pooling, pool};
use crate::registry::Metric;
use crate::row::{Key, Row, Rows};

/// The values of a frame, in the order of results.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FrameRows {
    layout: Arc<[Place]>,
    /// Values, each with its parts behind it.
    numbers: Box<[f64]>,
}

/// Where a value stands.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Place {
    key: Key,
    shape: Shape,
    /// Of its first number.
    at: u32,
}

/// What numbers there are of a value.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    /// None.
    Nothing,
    /// The value alone.
    Value,
    /// The value, sum and weight.
    Mean,
    /// The value; N, Σ and Σ².
    Deviation,
}

/// What the values of the last frames were of, for those after them.
#[derive(Debug, Clone, Default)]
pub struct Layouts(Vec<Arc<[Place]>>);

impl Layouts {
    /// First frames have no differences over time, and some no SSIM: a few kinds take turns.
    const KEPT: usize = 4;

    /// Packs the values of a frame.
    pub fn pack(&mut self, mut rows: Rows) -> FrameRows {
        rows.sort();
        let mut numbers = Vec::new();
        let mut places = Vec::with_capacity(rows.iter().len());
        for Row { key, value, parts } in rows.iter().copied() {
            let at = numbers.len() as u32;
            let shape = match (value, parts) {
                (None, _) => Shape::Nothing,
                (Some(value), Parts::Value) => {
                    numbers.push(value);
                    Shape::Value
                }
                (Some(value), Parts::Mean { sum, weight }) => {
                    numbers.extend([value, sum, weight]);
                    Shape::Mean
                }
                (Some(value), Parts::Deviation { count, sum, squares }) => {
                    numbers.extend([value, count, sum, squares]);
                    Shape::Deviation
                }
            };
            places.push(Place { key, shape, at });
        }
        FrameRows { layout: self.shared(places), numbers: numbers.into() }
    }

    fn shared(&mut self, places: Vec<Place>) -> Arc<[Place]> {
        let known = self.0.iter().position(|known| **known == *places);
        let layout = match known {
            Some(index) => self.0.remove(index),
            None => places.into(),
        };
        self.0.insert(0, Arc::clone(&layout));
        self.0.truncate(Self::KEPT);
        layout
    }
}

impl From<Rows> for FrameRows {
    fn from(rows: Rows) -> Self {
        Layouts::default().pack(rows)
    }
}

impl FrameRows {
    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = Row> + Clone + '_ {
        self.layout.iter().map(|place| self.row(place))
    }

    fn row(&self, &Place { key, shape, at }: &Place) -> Row {
        let numbers = &self.numbers[at as usize..];
        let (value, parts) = match shape {
            Shape::Nothing => (None, Parts::Value),
            Shape::Value => (Some(numbers[0]), Parts::Value),
            Shape::Mean => (Some(numbers[0]), Parts::Mean { sum: numbers[1], weight: numbers[2] }),
            Shape::Deviation => {
                let [count, sum, squares] = [numbers[1], numbers[2], numbers[3]];
                (Some(numbers[0]), Parts::Deviation { count, sum, squares })
            }
        };
        Row { key, value, parts }
    }

    /// The row of a key.
    pub fn get(&self, key: Key) -> Option<Row> {
        let found = self.layout.binary_search_by(|place| place.key.cmp(&key)).ok()?;
        Some(self.row(&self.layout[found]))
    }

    /// The value of a key; `None` where there is no row, or nothing to have a value of.
    pub fn value(&self, key: Key) -> Option<f64> {
        self.get(key)?.value
    }

    /// The number of a key; 0 without a row.
    pub fn number(&self, key: Key) -> u64 {
        self.value(key).map_or(0, |value| value as u64)
    }

    /// Whether there is a row of a metric.
    pub fn has(&self, metric: Metric) -> bool {
        self.layout.iter().any(|place| place.key.metric() == Some(metric))
    }

    /// The same without some of them.
    #[must_use]
    pub fn without(&self, leave_out: impl Fn(&Row) -> bool) -> Self {
        self.iter().filter(|row| !leave_out(row)).collect::<Rows>().into()
    }

    /// The values of both eyes: of what both have, pooled as each statistic says. Where an eye has
    /// nothing to have a value of, it is the other's.
    pub fn of_both_eyes(left: &Self, right: &Self) -> Rows {
        let both = left.iter().filter_map(|l| {
            let r = right.get(l.key)?;
            let pooling = l.key.statistic().eyes;
            let (value, parts) = pool(pooling, [(l.value, l.parts), (r.value, r.parts)]);
            (pooling != Pooling::None).then_some(Row { key: l.key, value, parts })
        });
        both.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(offset: f64) -> Rows {
        let mut rows = Rows::default();
        rows.push(Key::of(Metric::Ssim), Some(0.1 + offset), Parts::Mean { sum: 0.3, weight: 3.0 });
        rows.push(Key::of(Metric::Mse), None, Parts::Value);
        let parts = Parts::Deviation { count: 3.0, sum: offset, squares: f64::MAX };
        rows.push(Key::of(Metric::Psnr), Some(f64::INFINITY), parts);
        rows.score(Key::of(Metric::MsSsim), -0.0);
        rows
    }

    #[test]
    fn what_is_packed_is_the_same() {
        let mut layouts = Layouts::default();
        let packed = layouts.pack(rows(0.5));
        let mut sorted = rows(0.5);
        sorted.sort();
        let again: Vec<Row> = packed.iter().collect();
        assert_eq!(format!("{again:?}"), format!("{:?}", sorted.iter().collect::<Vec<_>>()));
        assert_eq!(packed.value(Key::of(Metric::Psnr)), Some(f64::INFINITY));
        assert_eq!(packed.get(Key::of(Metric::Mse)).map(|row| row.value), Some(None));
        assert!(packed.get(Key::of(Metric::Fssim)).is_none() && packed.has(Metric::Mse));
        let other = layouts.pack(rows(0.25));
        assert!(Arc::ptr_eq(&packed.layout, &other.layout), "what they are of is kept once");
        let fewer = packed.without(|row| row.key.metric() == Some(Metric::Ssim));
        assert!(!fewer.has(Metric::Ssim) && fewer.iter().count() == 3);
    }

    #[test]
    fn what_one_eye_has_not_is_the_others_and_what_it_was_not_asked_for_is_nobodys() {
        let key = Key::of(Metric::Ssim);
        let mut left = Rows::default();
        left.score(key, 0.5);
        left.push(key.in_band(0), Some(0.25), Parts::Value);
        left.push(key.in_band(1), None, Parts::Value);
        left.score(Key::of(Metric::MsSsim), 0.1);
        let mut right = Rows::default();
        right.score(key, 1.0);
        right.push(key.in_band(0), None, Parts::Value);
        right.push(key.in_band(1), None, Parts::Value);
        let both = FrameRows::of_both_eyes(&left.into(), &right.into());
        let both = FrameRows::from(both);
        assert_eq!(both.value(key), Some(0.75));
        assert_eq!(both.value(key.in_band(0)), Some(0.25));
        assert_eq!(both.get(key.in_band(1)).map(|row| row.value), Some(None));
        assert!(!both.has(Metric::MsSsim));
    }
}

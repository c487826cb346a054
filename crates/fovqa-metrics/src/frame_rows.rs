//! The values of a frame in packed form. A run keeps them to its end, and frames with the same keys
//! share one list of keys.

use std::sync::Arc;

use crate::kinds::MetricKind;
use crate::metric::Metric;
use crate::pooling::{Parts, Pooling, pool};
use crate::row::{Key, Row, Rows};
use crate::spool::{Numbers, Spool};

/// The values of a frame, in the order of results.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FrameRows {
    layout: Layout,
    /// The values, each followed by its parts, as bits.
    numbers: Numbers,
}

/// The keys of a frame's values, with the number of parts of each. Frames share it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Layout(Arc<[ValuePlace]>);

/// The place of a value in the packed numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct ValuePlace {
    /// The position of the key in the order of results.
    order: u64,
    key: Key,
    shape: Shape,
    /// Index of its first number.
    at: u32,
}

/// The numbers that are stored for a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    /// The value alone.
    Value,
    /// The value, sum and weight.
    Mean,
    /// The value; N, Σ and Σ².
    Deviation,
}

impl Shape {
    const ALL: [Shape; 3] = [Shape::Value, Shape::Mean, Shape::Deviation];

    fn of(parts: Parts) -> Self {
        match parts {
            Parts::Value => Shape::Value,
            Parts::Mean { .. } => Shape::Mean,
            Parts::Deviation { .. } => Shape::Deviation,
        }
    }

    /// The number of parts.
    fn parts(self) -> usize {
        match self {
            Shape::Value => 0,
            Shape::Mean => 2,
            Shape::Deviation => 3,
        }
    }
}

impl Layout {
    /// The layout of keys in the order of results, each with its number of parts. `None` if there
    /// is no such order, or no such number of parts.
    pub fn new(keys: impl IntoIterator<Item = (Key, usize)>) -> Option<Self> {
        let mut at = 0;
        let place = |(key, parts): (Key, usize)| {
            let shape = Shape::ALL.into_iter().find(|shape| shape.parts() == parts)?;
            let place = ValuePlace { order: key.order(), key, shape, at };
            at += 1 + parts as u32;
            Some(place)
        };
        let places: Vec<ValuePlace> = keys.into_iter().map(place).collect::<Option<_>>()?;
        places.is_sorted_by(|a, b| a.order < b.order).then(|| Self(places.into()))
    }

    /// Its keys, each with its number of parts.
    pub fn keys(&self) -> impl Iterator<Item = (Key, usize)> + '_ {
        self.0.iter().map(|place| (place.key, place.shape.parts()))
    }

    /// Whether two layouts are equal.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self == other
    }
}

/// The most numbers that one value needs: it has three parts.
const MOST_NUMBERS: usize = 4;

/// A value from its numbers.
fn row(&ValuePlace { key, shape, .. }: &ValuePlace, numbers: &[u64]) -> Row {
    let value = (numbers[0] != NOTHING).then(|| f64::from_bits(numbers[0]));
    let number = |index: usize| f64::from_bits(numbers[index]);
    let parts = match shape {
        Shape::Value => Parts::Value,
        Shape::Mean => Parts::Mean { sum: number(1), weight: number(2) },
        Shape::Deviation => {
            Parts::Deviation { count: number(1), sum: number(2), squares: number(3) }
        }
    };
    Row { key, value, parts }
}

/// The bits for a missing value: a NaN that no arithmetic produces.
const NOTHING: u64 = 0x7ff8_0000_6e6f_6e65;

/// Packs the values of frames. Later frames share the lists of keys of the last frames, and the values of most
/// frames are written to a temporary file.
#[derive(Debug, Clone, Default)]
pub struct Layouts {
    known: Vec<Known>,
    spool: Spool,
}

/// A list of keys as it came, and its order in results.
#[derive(Debug, Clone)]
struct Known {
    came: Vec<(Key, Shape)>,
    /// The indices of the sorted keys in the list as it came.
    order: Vec<u32>,
    layout: Layout,
}

impl Layouts {
    /// A few kinds of frames alternate: the first frame has no temporal differences, others have no
    /// SSIM.
    const KEPT: usize = 4;

    /// Packs the values of a frame.
    pub fn pack(&mut self, rows: &Rows) -> FrameRows {
        let known = self.known(rows);
        let layout = known.layout.clone();
        let mut numbers = Vec::with_capacity(3 * known.order.len());
        let rows = rows.as_slice();
        for &came in &known.order {
            let Row { value, parts, .. } = rows[came as usize];
            numbers.push(value.map_or(NOTHING, f64::to_bits));
            match parts {
                Parts::Value => {}
                Parts::Mean { sum, weight } => numbers.extend([sum, weight].map(f64::to_bits)),
                Parts::Deviation { count, sum, squares } => {
                    numbers.extend([count, sum, squares].map(f64::to_bits));
                }
            }
        }
        FrameRows { layout, numbers: self.spool.keep(numbers) }
    }

    /// The values of a layout: each value, or `None`, with its parts behind it. `None` where there are
    /// more or fewer numbers, or parts are missing.
    pub fn read(&mut self, layout: &Layout, numbers: &[Option<f64>]) -> Option<FrameRows> {
        let mut bits = Vec::with_capacity(numbers.len());
        let mut rest = numbers;
        for (_, parts) in layout.keys() {
            let (value, of_value) = rest.split_at_checked(1 + parts)?.0.split_first()?;
            bits.push(value.map_or(NOTHING, f64::to_bits));
            for part in of_value {
                bits.push((*part)?.to_bits());
            }
            rest = &rest[1 + parts..];
        }
        let numbers = rest.is_empty().then_some(bits)?;
        Some(FrameRows { layout: layout.clone(), numbers: self.spool.keep(numbers) })
    }

    /// The list of keys of these rows, which is usually that of the frame before.
    fn known(&mut self, rows: &Rows) -> &Known {
        let came = || rows.iter().map(|row| (row.key, Shape::of(row.parts)));
        let index = self.known.iter().position(|known| came().eq(known.came.iter().copied()));
        let known = match index {
            Some(index) => self.known.remove(index),
            None => Known::new(came().collect()),
        };
        self.known.truncate(Self::KEPT - 1);
        self.known.insert(0, known);
        &self.known[0]
    }
}

impl Known {
    fn new(came: Vec<(Key, Shape)>) -> Self {
        let mut order: Vec<u32> = (0..came.len() as u32).collect();
        order.sort_by_cached_key(|at| came[*at as usize].0.order());
        let sorted = order.iter().map(|at| came[*at as usize]);
        let mut at = 0;
        let place = |(key, shape): (Key, Shape)| {
            let place = ValuePlace { order: key.order(), key, shape, at };
            at += 1 + shape.parts() as u32;
            place
        };
        let places: Vec<ValuePlace> = sorted.map(place).collect();
        debug_assert!(places.is_sorted_by(|a, b| a.order < b.order), "one row per key");
        Self { layout: Layout(places.into()), came, order }
    }
}

impl From<Rows> for FrameRows {
    fn from(rows: Rows) -> Self {
        Layouts::default().pack(&rows)
    }
}

impl FrameRows {
    /// The layout of its values.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// All rows.
    pub fn iter(&self) -> impl Iterator<Item = Row> + Clone + '_ {
        let numbers = self.numbers.all();
        self.layout.0.iter().map(move |place| row(place, &numbers[place.at as usize..]))
    }

    /// The rows of the wanted keys.
    pub fn of_keys(&self, wanted: impl Fn(&Key) -> bool) -> impl Iterator<Item = Row> {
        let is_wanted = move |place: &&ValuePlace| wanted(&place.key);
        let mut places = self.layout.0.iter().filter(is_wanted).peekable();
        // Reading values that nobody wants would cost a system call.
        let numbers = places.peek().map(|_| self.numbers.all()).unwrap_or_default();
        places.map(move |place| row(place, &numbers[place.at as usize..]))
    }

    /// The row of a key.
    pub fn get(&self, key: Key) -> Option<Row> {
        self.find(key.order())
    }

    fn find(&self, order: u64) -> Option<Row> {
        let found = self.layout.0.binary_search_by_key(&order, |place| place.order).ok()?;
        let place = &self.layout.0[found];
        Some(row(place, &self.numbers.some::<MOST_NUMBERS>(place.at as usize)))
    }

    /// The same values, held in memory. Looking up many keys in them reads the temporary file once.
    #[must_use]
    pub fn held(&self) -> Self {
        Self { layout: self.layout.clone(), numbers: Numbers::Held(self.numbers.all()) }
    }

    /// The value of a key; `None` if there is no such row or the row has no value.
    pub fn value(&self, key: Key) -> Option<f64> {
        self.get(key)?.value
    }

    /// The number of a key; 0 if there is no such row.
    pub fn number(&self, key: Key) -> u64 {
        self.value(key).map_or(0, |value| value as u64)
    }

    /// Whether a metric has a row.
    pub fn has(&self, metric: Metric) -> bool {
        self.layout.0.iter().any(|place| place.key.metric() == Some(metric))
    }

    /// Whether a metric of a kind has a row.
    pub fn has_kind(&self, kind: MetricKind) -> bool {
        let of_kind = |key: Key| key.metric().is_some_and(|metric| metric.is(kind));
        self.layout.0.iter().any(|place| of_kind(place.key))
    }

    /// Combines the values that both eyes have, as each statistic declares. Where one eye has no value,
    /// the other eye's is used.
    pub fn of_both_eyes(left: &Self, right: &Self) -> Rows {
        let both = left.iter().filter_map(|l| {
            let r = right.get(l.key)?;
            let pooling = l.key.statistic().eyes;
            let (value, parts) = pool(pooling, [(l.value, l.parts), (r.value, r.parts)]);
            (pooling != Pooling::None).then_some(Row { key: l.key, value, parts })
        });
        let mut rows: Rows = both.collect();
        rows.derive();
        rows
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "fractions of two are exact")]
mod tests {
    use super::*;
    use crate::decibels::psnr_db;

    fn rows(offset: f64) -> Rows {
        let mut rows = Rows::default();
        rows.push(Key::of(Metric::Ssim), Some(0.1 + offset), Parts::Mean { sum: 0.3, weight: 3.0 });
        rows.push(Key::of(Metric::Mse), None, Parts::Mean { sum: 0.0, weight: 0.0 });
        let parts = Parts::Deviation { count: 3.0, sum: offset, squares: f64::MAX };
        rows.push(Key::of(Metric::Psnr), Some(f64::INFINITY), parts);
        rows.score(Key::of(Metric::MsSsim), -0.0);
        rows
    }

    #[test]
    fn packed_values_are_unchanged() {
        let mut layouts = Layouts::default();
        let packed = layouts.pack(&rows(0.5));
        let mut sorted: Vec<Row> = rows(0.5).iter().copied().collect();
        sorted.sort_by_key(|row| row.key);
        let again: Vec<Row> = packed.iter().collect();
        assert_eq!(format!("{again:?}"), format!("{sorted:?}"));
        assert_eq!(packed.value(Key::of(Metric::Psnr)), Some(f64::INFINITY));
        assert_eq!(packed.get(Key::of(Metric::Mse)).map(|row| row.value), Some(None));
        assert!(packed.get(Key::of(Metric::Fssim)).is_none() && packed.has(Metric::Mse));
        assert_eq!(packed.held(), packed);
        let numbers: Vec<Option<f64>> = packed.iter().flat_map(|row| row.numbers()).collect();
        let mut read = |layout: &Layout, numbers: &[Option<f64>]| layouts.read(layout, numbers);
        let again = read(&Layout::new(packed.layout.keys()).unwrap(), &numbers);
        assert_eq!(again.as_ref(), Some(&packed));
        assert!(read(&packed.layout, &numbers[1..]).is_none());
        assert!(read(&packed.layout, &[&numbers[..], &[None]].concat()).is_none());
        let twice = packed.layout.keys().chain(packed.layout.keys());
        assert!(Layout::new(twice).is_none() && Layout::new([(Key::of(Metric::Mse), 1)]).is_none());
        let other = layouts.pack(&rows(0.25));
        assert!(Arc::ptr_eq(&packed.layout.0, &other.layout.0), "what they are of is kept once");
        // This holds as well if another frame has no value, and after frames of other kinds.
        for metric in [Metric::Psnr, Metric::Fssim, Metric::Fpsnr] {
            let mut alone = Rows::default();
            alone.push(Key::of(metric), Some(1.0), Parts::Mean { sum: 1.0, weight: 1.0 });
            layouts.pack(&alone);
        }
        let mut nothing = rows(0.5);
        nothing = nothing.iter().map(|row| Row { value: None, ..*row }).collect();
        assert!(Arc::ptr_eq(&packed.layout.0, &layouts.pack(&nothing).layout.0));
    }

    fn of_one_eye(values: &[(Key, Option<f64>, Parts)]) -> FrameRows {
        let rows = values.iter().map(|&(key, value, parts)| Row { key, value, parts });
        rows.collect::<Rows>().into()
    }

    #[test]
    fn a_value_missing_in_one_eye_is_the_other_eyes() {
        let key = Key::of(Metric::Ssim);
        let left = of_one_eye(&[
            (key, Some(0.5), Parts::Value),
            (key.in_band(0), Some(0.25), Parts::Value),
            (key.in_band(1), None, Parts::Value),
            (Key::of(Metric::MsSsim), Some(0.1), Parts::Value),
        ]);
        let right = of_one_eye(&[
            (key, Some(1.0), Parts::Value),
            (key.in_band(0), None, Parts::Value),
            (key.in_band(1), None, Parts::Value),
        ]);
        let both = FrameRows::from(FrameRows::of_both_eyes(&left, &right));
        assert_eq!(both.value(key), Some(0.75));
        assert_eq!(both.value(key.in_band(0)), Some(0.25));
        assert_eq!(both.get(key.in_band(1)).map(|row| row.value), Some(None));
        assert!(!both.has(Metric::MsSsim), "the other eye was not asked for it");
    }

    /// Errors are pooled by pixels, wavelets by coefficients and FPSNR by its weight; other scores
    /// are averaged.
    #[test]
    fn both_eyes_are_pooled_as_each_statistic_says() {
        let haar = |statistic: &str| {
            let key = Key::named(crate::row::Subject::Metric(Metric::Haar), statistic).unwrap();
            key.of_image(crate::row::Image::Test).on_level(1).in_band(0)
        };
        let atd = Key::of(Metric::Atd).of_image(crate::row::Image::Test);
        let of = |mse: f64, pixels: f64, weight: f64| {
            let mean = |value: f64, weight: f64| Parts::Mean { sum: value * weight, weight };
            of_one_eye(&[
                (Key::of(Metric::Mse), Some(mse), mean(mse, pixels)),
                (Key::of(Metric::Psnr), Some(psnr_db(mse)), mean(mse, pixels)),
                (Key::of(Metric::Fpsnr), Some(psnr_db(mse)), mean(mse, weight)),
                (Key::of(Metric::Ssim), Some(mse), mean(mse, pixels)),
                (haar("energy"), Some(mse), mean(mse, pixels)),
                (haar("max_abs"), Some(mse), Parts::Value),
                (atd, Some(mse), mean(mse, pixels)),
            ])
        };
        let both = FrameRows::of_both_eyes(&of(0.25, 100.0, 8.0), &of(0.5, 300.0, 8.0));
        let both = FrameRows::from(both);
        assert_eq!(both.value(Key::of(Metric::Mse)), Some(0.4375));
        assert_eq!(both.value(Key::of(Metric::Psnr)), Some(psnr_db(0.4375)));
        assert_eq!(both.value(Key::of(Metric::Fpsnr)), Some(psnr_db(0.375)), "by weight");
        assert_eq!(both.value(Key::of(Metric::Ssim)), Some(0.375));
        assert_eq!(both.value(haar("energy")), Some(0.4375));
        assert_eq!(both.value(haar("max_abs")), Some(0.5));
        assert_eq!(both.value(atd), Some(0.4375));
    }
}

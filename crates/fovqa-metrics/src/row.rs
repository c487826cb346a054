//! The common form of every measured value: its key, the value, and the numbers needed to pool it.
//!
//! Rows belong to one frame. The frame's number is stored with the frame; scene, method and eye are
//! stored with the sequence.

use std::cmp::Ordering;
use std::ops::RangeInclusive;

use crate::kinds::MetricKind;
use crate::metric::Metric;
use crate::pooling::{Parts, Pooling, Statistic};

/// What a value measures, without its eye and frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// The metric or count that the value belongs to.
    pub subject: Subject,
    /// Index of its statistic in the metric's table.
    statistic: u8,
    /// The picture that the value describes.
    pub image: Image,
    /// Level of the wavelet or index of the spatial-frequency band, from 1 on; half octave of the
    /// spectrum, from below 0 on.
    pub level: Option<i16>,
    /// Index of the eccentricity band; `None` for the whole frame.
    pub band: Option<u16>,
}

/// The metric or count that a value belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// The number of pixels of a band that count.
    Pixels,
    /// The number of pixels that count and lie outside all bands.
    PixelsOutsideBands,
    /// The number of pixels that a mask leaves out.
    PixelsLeftOut,
    /// The number of samples that an emulated method shades within its own field.
    Samples,
    /// The number of its samples whose position is in the frame.
    SamplesOnScreen,
    /// The number of samples that it shades beyond its own field.
    SamplesBeyond,
    /// All of its samples over the pixels of the frame.
    SamplesShare,
    /// The share of an eye's own samples that it shades, because their pixels cannot be taken from the
    /// frame of the other eye.
    ReshadedShare,
    /// The number of quads, blocks of 2x2 samples that a rasteriser shades together, of which at least
    /// one sample is shaded.
    Quads,
    /// The quads over those of the frame.
    QuadsShare,
    /// The budget that was asked for, as a share of the frame's pixels.
    BudgetShare,
    /// The share that the method shades at its budget, before the sizes of its buffers are rounded.
    BudgetIdealShare,
    /// The parameter that the budget solves; of a list, one value per level.
    BudgetValue,
    /// A metric.
    Metric(Metric),
}

/// Which picture a value describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Image {
    /// Test and reference together.
    #[default]
    Pair,
    /// The reference.
    Reference,
    /// The test.
    Test,
    /// The ratio of test to reference.
    Ratio,
}

impl Image {
    /// All values, in the order of results.
    pub const ALL: [Image; 4] = [Image::Pair, Image::Reference, Image::Test, Image::Ratio];

    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Image::Pair => "pair",
            Image::Reference => "reference",
            Image::Test => "test",
            Image::Ratio => "ratio",
        }
    }

    /// The picture of a name.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|image| image.name() == name)
    }
}

/// The statistic of pixel counts.
const PIXELS: Statistic = Statistic::count("");

/// The statistic of sample counts. They are not whole numbers for methods with a continuous rate.
const SAMPLES: Statistic = Statistic::of_test("").over_eyes(Pooling::Sum);

/// The statistic of shares of samples.
const SHARE: Statistic = Statistic::of_test("");

/// The statistic of parameters. Each eye has its own.
const PARAMETER: Statistic = Statistic::of_test("").over_eyes(Pooling::None);

impl Subject {
    const COUNTS: [Subject; 13] = [
        Subject::Pixels,
        Subject::PixelsOutsideBands,
        Subject::PixelsLeftOut,
        Subject::Samples,
        Subject::SamplesOnScreen,
        Subject::SamplesBeyond,
        Subject::SamplesShare,
        Subject::ReshadedShare,
        Subject::Quads,
        Subject::QuadsShare,
        Subject::BudgetShare,
        Subject::BudgetIdealShare,
        Subject::BudgetValue,
    ];

    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Subject::Pixels => "pixels",
            Subject::PixelsOutsideBands => "pixels_outside_bands",
            Subject::PixelsLeftOut => "pixels_left_out",
            Subject::Samples => "samples",
            Subject::SamplesOnScreen => "samples_on_screen",
            Subject::SamplesBeyond => "samples_beyond",
            Subject::SamplesShare => "samples_share",
            Subject::ReshadedShare => "reshaded_share",
            Subject::Quads => "quads",
            Subject::QuadsShare => "quads_share",
            Subject::BudgetShare => "budget_share",
            Subject::BudgetIdealShare => "budget_ideal_share",
            Subject::BudgetValue => "budget_value",
            Subject::Metric(metric) => metric.key(),
        }
    }

    /// The subject of a name.
    pub fn find(name: &str) -> Option<Self> {
        let metric = || Metric::ALL.into_iter().find(|metric| metric.key() == name);
        let count = Self::COUNTS.into_iter().find(|count| count.name() == name);
        count.or_else(|| metric().map(Subject::Metric))
    }

    fn statistics(self) -> &'static [Statistic] {
        match self {
            Subject::Metric(metric) => metric.info().statistics,
            Subject::Pixels | Subject::PixelsOutsideBands | Subject::PixelsLeftOut => &[PIXELS],
            Subject::Samples
            | Subject::SamplesOnScreen
            | Subject::SamplesBeyond
            | Subject::Quads => &[SAMPLES],
            Subject::SamplesShare
            | Subject::ReshadedShare
            | Subject::QuadsShare
            | Subject::BudgetShare
            | Subject::BudgetIdealShare => &[SHARE],
            Subject::BudgetValue => &[PARAMETER],
        }
    }

    fn metric(self) -> Option<Metric> {
        match self {
            Subject::Metric(metric) => Some(metric),
            _ => None,
        }
    }
}

impl Key {
    /// The levels that a key can have.
    pub const LEVELS: RangeInclusive<i16> = -MOST_LEVEL..=MOST_LEVEL;

    /// The key of the metric's first statistic, for the whole frame and the pair.
    pub fn of(metric: Metric) -> Self {
        Self::pixels(Subject::Metric(metric))
    }

    /// The key of a number of pixels of the whole frame.
    pub fn pixels(subject: Subject) -> Self {
        Self { subject, statistic: 0, image: Image::Pair, level: None, band: None }
    }

    /// The key of a statistic by its name; `None` if the metric has no such statistic.
    pub fn named(subject: Subject, statistic: &str) -> Option<Self> {
        let index = subject.statistics().iter().position(|known| known.name == statistic)?;
        Some(Self { statistic: u8::try_from(index).ok()?, ..Self::pixels(subject) })
    }

    /// The same key for another statistic, by its index in the metric's table.
    pub(crate) fn nth(self, statistic: usize) -> Self {
        debug_assert!(statistic < self.subject.statistics().len(), "a statistic of the metric");
        Self { statistic: statistic as u8, ..self }
    }

    /// The same key for a band.
    #[must_use]
    pub fn in_band(self, band: usize) -> Self {
        debug_assert!(band < usize::from(u16::MAX), "as many bands as a map of them may have");
        Self { band: Some(band as u16), ..self }
    }

    /// The same key for a level.
    #[must_use]
    pub fn on_level(self, level: usize) -> Self {
        self.at_level(level as i16)
    }

    /// The same key for a level that may be below 0.
    #[must_use]
    pub fn at_level(self, level: i16) -> Self {
        debug_assert!(Self::LEVELS.contains(&level), "a level that keys can have");
        Self { level: Some(level), ..self }
    }

    /// The same key for a picture.
    #[must_use]
    pub fn of_image(self, image: Image) -> Self {
        Self { image, ..self }
    }

    /// The metric; `None` for a number of pixels or samples.
    pub fn metric(&self) -> Option<Metric> {
        self.subject.metric()
    }

    /// Its statistic.
    pub fn statistic(&self) -> &'static Statistic {
        &self.subject.statistics()[usize::from(self.statistic)]
    }

    /// Whether it is the metric's own value for a pair.
    pub fn is_score(&self) -> bool {
        self.image == Image::Pair && self.statistic().name.is_empty() && self.metric().is_some()
    }

    /// The position among the rows of a frame: first the whole frame, then bands, then levels with
    /// bands. Within each of these, the order is pixel counts, other counts, scores, other
    /// statistics of the pair, and statistics of each picture. It is a single number because rows
    /// are sorted and looked up by it.
    pub(crate) fn order(&self) -> u64 {
        let (subject, counted) = match self.subject {
            Subject::Pixels => (0, false),
            Subject::PixelsOutsideBands => (1, true),
            Subject::PixelsLeftOut => (2, true),
            Subject::Samples => (3, true),
            Subject::SamplesOnScreen => (4, true),
            Subject::SamplesBeyond => (5, true),
            Subject::SamplesShare => (6, true),
            Subject::ReshadedShare => (7, true),
            Subject::Quads => (8, true),
            Subject::QuadsShare => (9, true),
            Subject::BudgetShare => (10, true),
            Subject::BudgetIdealShare => (11, true),
            Subject::BudgetValue => (12, true),
            Subject::Metric(metric) => (13 + metric as u64, false),
        };
        let area = match (self.band, self.level) {
            (None, _) if counted => 1,
            (None, _) => 0,
            (Some(_), None) => 2,
            (Some(_), Some(_)) => 3,
        };
        let of_picture = self.metric().is_some_and(|metric| !metric.is(MetricKind::Fidelity));
        let statistic = self.statistic();
        let kind = match () {
            () if self.subject == Subject::Pixels => 0,
            () if statistic.is_count || counted => 1,
            () if of_picture => 4,
            () if statistic.name.is_empty() => 2,
            () => 3,
        };
        let level = self.level.map_or(0, |level| (level + MOST_LEVEL) as u64);
        let outer_level = if area == 3 { level } else { 0 };
        // Each part has as many bits as it needs.
        let parts = [
            (area, 2),
            (outer_level, LEVEL_BITS),
            (self.band.map_or(0, u64::from), 16),
            (kind, 3),
            (subject, 8),
            (level, LEVEL_BITS),
            (u64::from(self.statistic), 8),
            (self.image as u64, 2),
        ];
        parts.into_iter().fold(0, |order, (part, bits)| order << bits | part)
    }
}

/// The number of bits of a level in the order of keys.
const LEVEL_BITS: u32 = 12;

/// The largest level, which is added to levels in the order of keys so that they are not negative.
const MOST_LEVEL: i16 = (1 << (LEVEL_BITS - 1)) - 1;

impl PartialOrd for Key {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Key {
    fn cmp(&self, other: &Self) -> Ordering {
        self.order().cmp(&other.order())
    }
}

/// A measured value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The description of the value.
    pub key: Key,
    /// The value; `None` if there is nothing to measure.
    pub value: Option<f64>,
    /// The numbers that are needed to pool it.
    pub parts: Parts,
}

impl Row {
    /// The value, followed by the numbers of its parts.
    pub fn numbers(&self) -> impl Iterator<Item = Option<f64>> + use<> {
        let parts = match self.parts {
            Parts::Value => [None; 3],
            Parts::Mean { sum, weight } => [Some(sum), Some(weight), None],
            Parts::Deviation { count, sum, squares } => [Some(count), Some(sum), Some(squares)],
        };
        std::iter::once(self.value).chain(parts.into_iter().flatten().map(Some))
    }
}

/// The values of a frame, in the order in which they are measured.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rows(Vec<Row>);

impl Rows {
    /// Adds a value.
    pub fn push(&mut self, key: Key, value: Option<f64>, parts: Parts) {
        self.0.push(Row { key, value, parts });
    }

    /// Adds a value without parts.
    pub fn score(&mut self, key: Key, value: f64) {
        self.push(key, Some(value), Parts::Value);
    }

    /// Adds a count.
    pub fn count(&mut self, key: Key, count: u64) {
        self.score(key, count as f64);
    }

    /// Adds all values of another set.
    pub fn extend(&mut self, other: &Rows) {
        self.0.extend_from_slice(&other.0);
    }

    /// Adds the values of the pair that follow from the values of both pictures.
    pub fn derive(&mut self) {
        for metric in Metric::ALL {
            let Some(derive) = metric.info().derive else { continue };
            if self.0.iter().any(|row| row.key.metric() == Some(metric)) {
                let derived = derive(self);
                self.extend(&derived);
            }
        }
    }

    /// All rows.
    pub(crate) fn as_slice(&self) -> &[Row] {
        &self.0
    }

    /// All rows.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Row> {
        self.0.iter()
    }

    /// The row of a key.
    pub fn get(&self, key: Key) -> Option<&Row> {
        self.0.iter().find(|row| row.key == key)
    }

    /// The value of a key; `None` if there is no such row or the row has no value.
    pub fn value(&self, key: Key) -> Option<f64> {
        self.get(key)?.value
    }

    /// The number of a key; 0 if there is no such row.
    pub fn number(&self, key: Key) -> u64 {
        self.value(key).map_or(0, |value| value as u64)
    }
}

impl FromIterator<Row> for Rows {
    fn from_iter<I: IntoIterator<Item = Row>>(rows: I) -> Self {
        Self(rows.into_iter().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pooling::Weight;

    #[test]
    fn every_key_is_found_by_its_names() {
        for metric in Metric::ALL {
            let statistics = metric.info().statistics;
            assert!(!statistics.is_empty(), "{}", metric.key());
            for (index, statistic) in statistics.iter().enumerate() {
                let subject = Subject::find(metric.key()).unwrap();
                let key = Key::named(subject, statistic.name).unwrap();
                assert_eq!(key, Key::of(metric).nth(index));
                assert_eq!(key.statistic(), statistic);
                let named = |name: &str| statistics.iter().any(|known| known.name == name);
                match statistic.weight {
                    Weight::Pixels => {}
                    Weight::Statistic(name) => assert!(named(name)),
                    Weight::Moments { count, mean } => assert!(named(count) && named(mean)),
                }
            }
        }
        assert_eq!(Subject::find("pixels"), Some(Subject::Pixels));
        assert!(Subject::find("pixel").is_none() && Key::named(Subject::Pixels, "x").is_none());
        for image in Image::ALL {
            assert_eq!(Image::find(image.name()), Some(image));
        }
    }

    #[test]
    fn whole_frames_come_before_bands_and_bands_before_levels() {
        let (psnr, haar) = (Key::of(Metric::Psnr), Key::of(Metric::Haar).on_level(1));
        let named = |metric, statistic| Key::named(Subject::Metric(metric), statistic).unwrap();
        let [sustained, transient] =
            ["q_sustained", "q_transient"].map(|name| named(Metric::Fvvdp, name));
        let left_out = Key::pixels(Subject::PixelsLeftOut);
        let atd = Key::of(Metric::Atd).of_image(Image::Reference);
        let pixels = Key::pixels(Subject::Pixels);
        let order = [
            psnr,
            // Scores come before statistics, whatever the order of metrics.
            Key::of(Metric::PuPsnr),
            named(Metric::Fvvdp, "q"),
            sustained.on_level(1),
            transient.on_level(1),
            sustained.on_level(2),
            transient.on_level(2),
            atd,
            atd.of_image(Image::Test),
            named(Metric::Atd, "left_out").of_image(Image::Reference),
            left_out,
            pixels.in_band(0),
            named(Metric::Ssim, "map_pixels").in_band(0),
            psnr.in_band(0),
            named(Metric::Fvvdp, "share").in_band(0),
            Key::of(Metric::RmsContrast).of_image(Image::Reference).in_band(0),
            pixels.in_band(1),
            psnr.in_band(1),
            haar.in_band(0),
            haar.in_band(1),
            haar.on_level(2).in_band(0),
        ];
        let mut mixed: Vec<Key> = order.iter().rev().copied().collect();
        mixed.sort();
        assert_eq!(mixed, order);
    }
}

//! The values of single frames in a baseline: compact text, one line of a commit for forty frames.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use fovqa_plan::Quantity;
use serde::{Deserialize, Serialize};

use crate::gate::Series;

/// Number of values on a line.
const LINE: usize = 40;
/// Number of values up to which those of bands have six significant digits. More have four: they say where
/// a loss is, and no rule is checked against them.
const MOST_IN_FULL: usize = 20_000;

/// The values of the frames of a comparison.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct FrameRecords {
    /// The numbers of the frames: `0..599 601`, ends included.
    frames: String,
    /// Values of whole frames by the names of their quantities, in full precision. `-` stands for no value.
    values: BTreeMap<String, Vec<String>>,
    /// Significant digits of the values of bands.
    band_digits: usize,
    /// Values of bands by the names of their quantities and by the edges of the bands, `0..5`.
    bands: BTreeMap<String, BTreeMap<String, Vec<String>>>,
}

impl FrameRecords {
    /// The records of some quantities; `None` if there is no frame.
    pub(super) fn of(series: &[(Quantity, Series)]) -> Option<Self> {
        let mut numbers: Vec<i64> =
            series.iter().flat_map(|(_, series)| series.frames.keys().copied()).collect();
        numbers.sort_unstable();
        numbers.dedup();
        if numbers.is_empty() {
            return None;
        }
        let count: usize = series.iter().map(|(_, series)| series.bands.len()).sum();
        let band_digits = if count * numbers.len() <= MOST_IN_FULL { 6 } else { 4 };
        let mut records = Self { frames: ranges(&numbers), band_digits, ..Self::default() };
        for (quantity, series) in series {
            let in_full = lines(&numbers, &series.frames, f64::to_string);
            records.values.insert(quantity.to_string(), in_full);
            let whole = Quantity { band_deg: None, ..quantity.clone() }.to_string();
            if series.bands.is_empty() || records.bands.contains_key(&whole) {
                continue;
            }
            let short = |value: &f64| rounded(*value, band_digits).to_string();
            let bands = series.bands.iter().map(|([from, to], frames)| {
                (format!("{from}..{to}"), lines(&numbers, frames, short))
            });
            records.bands.insert(whole, bands.collect());
        }
        Some(records)
    }

    /// The values of a quantity; `None` if there are none. The values of bands are rounded.
    pub(super) fn series(&self, quantity: &Quantity) -> Option<Series> {
        let numbers = numbers(&self.frames)?;
        let frames = values(&numbers, self.values.get(&quantity.to_string())?)?;
        let whole = Quantity { band_deg: None, ..quantity.clone() }.to_string();
        let bands = self.bands.get(&whole).into_iter().flatten();
        let bands = bands.map(|(edges, lines)| Some((edges_of(edges)?, values(&numbers, lines)?)));
        Some(Series {
            frames,
            bands: bands.collect::<Option<_>>()?,
            digits: Some(self.band_digits),
        })
    }

    /// For each quantity that both have, the frame that differs most from an earlier record, with its number
    /// and how many differ, and the earlier and the new value.
    pub(super) fn differences(&self, before: &Self) -> Vec<(String, [f64; 2])> {
        let of = |records: &Self, name: &str| {
            let numbers = numbers(&records.frames)?;
            values(&numbers, records.values.get(name)?)
        };
        let difference = |name: &String| {
            let (was, is) = of(before, name).zip(of(self, name))?;
            let pairs = is.iter().filter_map(|(frame, is)| Some((*frame, *was.get(frame)?, *is)));
            let changed: Vec<(i64, f64, f64)> =
                pairs.filter(|(_, was, is)| was.to_bits() != is.to_bits()).collect();
            let apart = |(_, was, is): &(i64, f64, f64)| (is - was).abs();
            let most = changed.iter().copied();
            let (frame, was, is) = most.reduce(|a, b| if apart(&b) > apart(&a) { b } else { a })?;
            let more = match changed.len() - 1 {
                0 => String::new(),
                1 => " (and 1 more)".to_owned(),
                more => format!(" (and {more} more)"),
            };
            Some((format!("{name}, frame {frame}{more}"), [was, is]))
        };
        self.values.keys().filter_map(difference).collect()
    }

    /// Whether every list has a value for each frame.
    pub(super) fn is_sound(&self) -> bool {
        // A range may claim more frames than any list has values for.
        let lists = || self.values.values().chain(self.bands.values().flat_map(BTreeMap::values));
        let longest = lists().map(|lines| count(lines)).max().unwrap_or(0);
        if frames_in(&self.frames) != Some(longest as u64) || !(1..=17).contains(&self.band_digits)
        {
            return false;
        }
        let Some(numbers) = numbers(&self.frames) else { return false };
        let edges = self.bands.values().flat_map(BTreeMap::keys);
        lists().all(|lines| values(&numbers, lines).is_some())
            && edges.map(|edges| edges_of(edges)).all(|edges| edges.is_some())
    }
}

/// A value rounded to significant digits.
pub(crate) fn rounded(value: f64, digits: usize) -> f64 {
    if !value.is_finite() {
        return value;
    }
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

fn lines(
    numbers: &[i64],
    values: &BTreeMap<i64, f64>,
    text: impl Fn(&f64) -> String,
) -> Vec<String> {
    let word = |number: &i64| values.get(number).map_or_else(|| "-".to_owned(), &text);
    let line = |numbers: &[i64]| numbers.iter().map(word).collect::<Vec<_>>().join(" ");
    numbers.chunks(LINE).map(line).collect()
}

fn count(lines: &[String]) -> usize {
    lines.iter().map(|line| line.split_whitespace().count()).sum()
}

/// The values of frames; `None` if they are not as many as the frames, or not numbers.
fn values(numbers: &[i64], lines: &[String]) -> Option<BTreeMap<i64, f64>> {
    if count(lines) != numbers.len() {
        return None;
    }
    let words = lines.iter().flat_map(|line| line.split_whitespace());
    let known = numbers.iter().zip(words).filter(|(_, word)| *word != "-");
    known.map(|(number, word)| Some((*number, word.parse().ok()?))).collect()
}

/// Ascending numbers as ranges.
fn ranges(numbers: &[i64]) -> String {
    let mut text = String::new();
    for run in numbers.chunk_by(|a, b| a.checked_add(1) == Some(*b)) {
        if !text.is_empty() {
            text.push(' ');
        }
        match run {
            [first, .., last] => _ = write!(text, "{first}..{last}"),
            [only] => _ = write!(text, "{only}"),
            [] => {}
        }
    }
    text
}

/// The first and the last number of each range.
fn ends(text: &str) -> Option<Vec<(i64, i64)>> {
    let range = |word: &str| {
        let (first, last) = word.split_once("..").unwrap_or((word, word));
        Some((first.parse().ok()?, last.parse().ok()?)).filter(|(first, last)| first <= last)
    };
    text.split_whitespace().map(range).collect()
}

fn frames_in(text: &str) -> Option<u64> {
    ends(text)?.iter().try_fold(0_u64, |sum, (first, last)| {
        sum.checked_add(last.abs_diff(*first).checked_add(1)?)
    })
}

fn numbers(text: &str) -> Option<Vec<i64>> {
    Some(ends(text)?.into_iter().flat_map(|(first, last)| first..=last).collect())
}

fn edges_of(text: &str) -> Option<[f64; 2]> {
    let (from, to) = text.split_once("..")?;
    Some([from.parse().ok()?, to.parse().ok()?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use fovqa_metrics::Metric;
    use fovqa_plan::Aggregate;

    fn quantity(metric: Metric) -> Quantity {
        Quantity::of(metric, Aggregate::Mean).of_frames()
    }

    /// A band's edges and its values by frames.
    type Band<'a> = ([f64; 2], &'a [(i64, f64)]);

    fn series(frames: &[(i64, f64)], bands: &[Band<'_>]) -> Series {
        let of = |values: &[(i64, f64)]| values.iter().copied().collect();
        let bands = bands.iter().map(|(edges, values)| (*edges, of(values))).collect();
        Series { frames: of(frames), bands, digits: None }
    }

    #[test]
    fn values_come_back_as_they_were_and_those_of_bands_rounded() {
        let psnr = [(-1, 31.204_567_890_123_4), (0, f64::INFINITY), (7, 0.1 + 0.2)];
        let bands: [Band<'_>; 2] =
            [([0.0, 2.5], &[(-1, 40.123_456_789), (7, 1e-7)]), ([2.5, 60.0], &[(0, 30.0)])];
        let records = FrameRecords::of(&[
            (quantity(Metric::Psnr), series(&psnr, &bands)),
            (quantity(Metric::Ssim), series(&[(0, 0.5)], &[])),
        ])
        .unwrap();
        assert_eq!(records.frames, "-1..0 7");
        assert!(records.is_sound());
        let found = records.series(&quantity(Metric::Psnr)).unwrap();
        assert_eq!(found.frames, series(&psnr, &[]).frames);
        assert_eq!(found.bands[0].1[&-1].to_bits(), 40.1235_f64.to_bits());
        assert_eq!(found.bands[1].0.map(f64::to_bits), [2.5, 60.0].map(f64::to_bits));
        assert_eq!(found.bands[1].1.len(), 1);
        assert_eq!(records.series(&quantity(Metric::Ssim)).unwrap().frames.len(), 1);
        assert_eq!(records.series(&quantity(Metric::Mse)), None);
    }

    #[test]
    fn six_hundred_frames_of_five_rules_stay_small() {
        // Values between 0.9 and 1, and decibels, in the default bands of a view of 110°.
        let values = |seed: usize, scale: f64| {
            (0..600)
                .map(move |i| (i, scale * (0.95 + 0.05 * libm::sin((seed + i as usize) as f64))))
        };
        let metrics = [Metric::Psnr, Metric::Ssim, Metric::Fpsnr, Metric::Gmsd, Metric::Mse];
        let all: Vec<_> = metrics
            .iter()
            .map(|metric| {
                let scale = if metric.is_decibel() { 40.0 } else { 1.0 };
                let band =
                    |b: usize| ([5.0 * b as f64, 5.0 * (b + 1) as f64], values(b, scale).collect());
                let frames = values(9, scale).collect();
                let series = Series { frames, bands: (0..11).map(band).collect(), digits: None };
                (quantity(*metric), series)
            })
            .collect();
        let records = FrameRecords::of(&all).unwrap();
        let text = serde_json::to_string_pretty(&records).unwrap();
        assert!(text.len() < 290_000, "{}", text.len());
    }

    #[test]
    fn damaged_records_are_not_sound() {
        let good =
            FrameRecords::of(&[(quantity(Metric::Psnr), series(&[(0, 1.0), (1, 2.0)], &[]))]);
        let good = good.unwrap();
        assert!(good.is_sound());
        for frames in
            ["0..2", "0", "1..0", "0..9223372036854775807", "x", "-9223372036854775808..1"]
        {
            assert!(
                !FrameRecords { frames: frames.to_owned(), ..good.clone() }.is_sound(),
                "{frames}"
            );
        }
        assert!(!FrameRecords { band_digits: 0, ..good.clone() }.is_sound());
        let mut words = good;
        words.values.values_mut().for_each(|lines| lines[0] = "1.0 ?".to_owned());
        assert!(!words.is_sound());
    }
}

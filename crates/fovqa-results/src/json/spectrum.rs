//! JSON for the power spectrum: of one frame (`T` is a number), or over frames (`T` is a mean with its
//! extremes).

use std::collections::BTreeMap;

use fovqa_metrics::{Image, Key, Metric, Parts, Rows, Subject, spectrum};
use serde::{Deserialize, Serialize};

use super::compared::{SideValues, of_frame, of_summary};
use crate::report::{FrameResult, ViewResult};
use crate::spread::Spread;
use crate::summary::Summary;

/// The spectrum of one band.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpectrumRecord<T> {
    /// Lower edge in degrees.
    pub from_deg: f64,
    /// Upper edge in degrees.
    pub to_deg: f64,
    /// Number of blocks.
    pub blocks: u64,
    /// The frequency up to which the test has the reference's power; `None` if it lacks the lowest
    /// half octave already.
    pub cutoff_cpd: Option<f64>,
    /// The half octaves, from the lowest up.
    pub bins: Vec<SpectrumBin<T>>,
}

/// The power of one half octave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpectrumBin<T> {
    /// The frequency in its middle, in cycles per degree.
    pub cpd: f64,
    /// Number of frequencies of all blocks.
    pub samples: u64,
    /// Values of the reference.
    pub reference: SpectrumValues<T>,
    /// Values of the test.
    pub test: SpectrumValues<T>,
    /// test / reference of the power; `None` where the reference has next to none.
    pub ratio: Option<f64>,
}

/// The power of one picture in a half octave.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpectrumValues<T> {
    /// Power in luma².
    pub power: Option<T>,
    /// Power per area of frequencies, in luma²/cpd².
    pub density: Option<T>,
}

/// The spectra of a frame, band by band.
pub(crate) fn spectra(frame: &FrameResult, view: Option<&ViewResult>) -> Vec<SpectrumRecord<f64>> {
    let edges = view.map(|view| view.bands_deg.as_slice()).unwrap_or_default();
    if !frame.rows.has(Metric::Spectrum) {
        return Vec::new();
    }
    records(of_frame(frame), edges, |key| frame.rows.number(key), |value| *value)
}

/// The spectra over the frames, band by band; empty if they were not requested. The cut-off is that of
/// the means.
pub fn summary_spectra(summary: &Summary) -> Vec<SpectrumRecord<Spread>> {
    if !summary.counts.keys().any(|key| key.metric() == Some(Metric::Spectrum)) {
        return Vec::new();
    }
    let edges: Vec<(f64, f64)> =
        summary.bands.iter().map(|band| (band.from_deg, band.to_deg)).collect();
    let count = |key| summary.counts.get(&key).copied().unwrap_or_default();
    records(of_summary(summary), &edges, count, |spread| spread.mean)
}

/// Power and density of the half octaves of a band.
type Bins<T> = BTreeMap<i16, [Option<SideValues<T>>; 2]>;

fn records<T: Copy>(
    values: impl Iterator<Item = (Key, SideValues<T>)>,
    edges: &[(f64, f64)],
    count: impl Fn(Key) -> u64,
    number: impl Fn(&T) -> f64,
) -> Vec<SpectrumRecord<T>> {
    let mut bands: BTreeMap<u16, Bins<T>> = BTreeMap::new();
    let mut powers = Rows::default();
    for (key, sides) in values.filter(|(key, _)| key.metric() == Some(Metric::Spectrum)) {
        let (Some(level), Some(band)) = (key.level, key.band) else { continue };
        let is_power = key.statistic().name == "power";
        if is_power {
            for (image, value) in [(Image::Reference, &sides.reference), (Image::Test, &sides.test)]
            {
                powers.push(key.of_image(image), value.as_ref().map(&number), Parts::Value);
            }
        }
        let bin = bands.entry(band).or_default().entry(level).or_default();
        bin[usize::from(!is_power)] = Some(sides);
    }
    powers.derive();
    let named = |statistic, band| {
        let key = Key::named(Subject::Metric(Metric::Spectrum), statistic)?;
        Some(key.in_band(band))
    };
    let counted = |key: Option<Key>| key.map_or(0, &count);
    let record = |(band, &(from_deg, to_deg)): (usize, &(f64, f64))| {
        let bins = bands.remove(&(band as u16)).unwrap_or_default();
        let bin = |(level, [power, density]): (i16, [Option<SideValues<T>>; 2])| {
            let samples = named(spectrum::SAMPLES, band).map(|key| key.at_level(level));
            let of = |picture: fn(&SideValues<T>) -> Option<T>| SpectrumValues {
                power: power.as_ref().and_then(picture),
                density: density.as_ref().and_then(picture),
            };
            SpectrumBin {
                cpd: spectrum::centre_cpd(level),
                samples: counted(samples),
                reference: of(|sides| sides.reference),
                test: of(|sides| sides.test),
                ratio: power.as_ref().and_then(|sides| sides.ratio),
            }
        };
        SpectrumRecord {
            from_deg,
            to_deg,
            blocks: counted(named(spectrum::BLOCKS, band)),
            cutoff_cpd: named(spectrum::CUTOFF, band).and_then(|key| powers.value(key)),
            bins: bins.into_iter().map(bin).collect(),
        }
    };
    edges.iter().enumerate().map(record).collect()
}

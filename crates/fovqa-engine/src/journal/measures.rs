//! Profiles, differences over time and FovVideoVDP of a frame as lines of a journal have them.

use fovqa_metrics::fvvdp::{FvvdpBand, FvvdpFrame};
use fovqa_metrics::temporal::{AtdBand, AtdFrame};
use fovqa_metrics::{HaarBand, HaarStatistics, Profile};
use fovqa_results::{AtdGuides, GuideSource, Sides};
use serde::de::{Deserializer, Error};
use serde::ser::{SerializeSeq, Serializer};
use serde::{Deserialize, Serialize};

use super::number::{Number, maybe, read};

/// Something of the reference and of the test.
#[derive(Serialize, Deserialize)]
pub(super) struct SidesRecord<T> {
    reference: T,
    test: T,
}

impl<T> SidesRecord<T> {
    pub(super) fn of<U>(sides: &Sides<U>, of: impl Fn(&U) -> T) -> Self {
        Self { reference: of(&sides.reference), test: of(&sides.test) }
    }

    pub(super) fn read<U>(self, of: impl Fn(T) -> U) -> Sides<U> {
        Sides { reference: of(self.reference), test: of(self.test) }
    }
}

#[derive(Serialize, Deserialize)]
pub(super) struct ProfileRecord {
    rms_contrast: Option<Vec<Option<Number>>>,
    haar: Option<Vec<Vec<HaarRecord>>>,
}

impl From<&Profile> for ProfileRecord {
    fn from(profile: &Profile) -> Self {
        let contrasts = |bands: &Vec<Option<f64>>| bands.iter().copied().map(maybe).collect();
        let level = |level: &Vec<HaarBand>| level.iter().cloned().map(HaarRecord).collect();
        Self {
            rms_contrast: profile.rms_contrast.as_ref().map(contrasts),
            haar: profile.haar.as_ref().map(|levels| levels.iter().map(level).collect()),
        }
    }
}

impl From<ProfileRecord> for Profile {
    fn from(record: ProfileRecord) -> Self {
        let level =
            |level: Vec<HaarRecord>| level.into_iter().map(|HaarRecord(band)| band).collect();
        Self {
            rms_contrast: record.rms_contrast.map(|bands| bands.into_iter().map(read).collect()),
            haar: record.haar.map(|levels| levels.into_iter().map(level).collect()),
        }
    }
}

/// Wavelet coefficients of a band as a list: their number, then mean, maximum and energy of all, then
/// those of each orientation, where they are there.
struct HaarRecord(HaarBand);

impl Serialize for HaarRecord {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let HaarRecord(band) = self;
        let mut list = serializer.serialize_seq(None)?;
        list.serialize_element(&band.coefficients)?;
        let orientations = band.orientations.as_deref().into_iter().flatten();
        for value in band.statistics.iter().chain(orientations).flat_map(HaarStatistics::values) {
            list.serialize_element(&Number(value))?;
        }
        list.end()
    }
}

impl<'de> Deserialize<'de> for HaarRecord {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list: Vec<Number> = Vec::deserialize(deserializer)?;
        let [Number(coefficients), values @ ..] = list.as_slice() else {
            return Err(D::Error::custom("a list without a number of coefficients"));
        };
        let values: Vec<HaarStatistics> = values
            .chunks_exact(3)
            .map(|three| [three[0].0, three[1].0, three[2].0].into())
            .collect();
        let (statistics, orientations) = match values.as_slice() {
            [] => (None, None),
            [all] => (Some(*all), None),
            [lh, hl, hh] => (None, Some(Box::new([*lh, *hl, *hh]))),
            [all, lh, hl, hh] => (Some(*all), Some(Box::new([*lh, *hl, *hh]))),
            _ => return Err(D::Error::custom("a list of another length")),
        };
        let coefficients = *coefficients as u64;
        Ok(Self(HaarBand { coefficients, statistics, orientations }))
    }
}

/// Mean, and valid pixels.
type DifferenceRecord = (Option<Number>, u64);

/// Pixels that count, then the mean and the valid pixels of the whole frame, and of each band.
#[derive(Serialize, Deserialize)]
struct AtdSideRecord {
    pixels: u64,
    whole: DifferenceRecord,
    bands: Vec<DifferenceRecord>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct AtdRecord {
    reference: AtdSideRecord,
    test: AtdSideRecord,
    motion: GuideSource,
    depth: GuideSource,
}

impl AtdRecord {
    pub(super) fn of(atd: &Sides<AtdFrame>, AtdGuides { motion, depth }: AtdGuides) -> Self {
        let band = |band: &AtdBand| (maybe(band.mean), band.valid);
        let side = |side: &AtdFrame| AtdSideRecord {
            pixels: side.pixels,
            whole: band(&side.whole),
            bands: side.bands.iter().map(band).collect(),
        };
        Self { reference: side(&atd.reference), test: side(&atd.test), motion, depth }
    }

    pub(super) fn read(self) -> (Sides<AtdFrame>, AtdGuides) {
        let band = |(mean, valid): DifferenceRecord| AtdBand { mean: read(mean), valid };
        let side = |side: AtdSideRecord| AtdFrame {
            whole: band(side.whole),
            pixels: side.pixels,
            bands: side.bands.into_iter().map(band).collect(),
        };
        let sides = Sides { reference: side(self.reference), test: side(self.test) };
        (sides, AtdGuides { motion: self.motion, depth: self.depth })
    }
}

/// Bands of spatial frequency as lists: frequency, sustained and transient Q.
#[derive(Serialize, Deserialize)]
pub(super) struct FvvdpRecord {
    q: Number,
    frame_jod: Number,
    bands: Vec<(Number, Number, Option<Number>)>,
    shares: Option<Vec<Number>>,
}

impl From<&FvvdpFrame> for FvvdpRecord {
    fn from(frame: &FvvdpFrame) -> Self {
        let band =
            |band: &FvvdpBand| (Number(band.cpd), Number(band.sustained), maybe(band.transient));
        let numbers = |shares: &Vec<f64>| shares.iter().copied().map(Number).collect();
        Self {
            q: Number(frame.q),
            frame_jod: Number(frame.frame_jod),
            bands: frame.bands.iter().map(band).collect(),
            shares: frame.shares.as_ref().map(numbers),
        }
    }
}

impl From<FvvdpRecord> for FvvdpFrame {
    fn from(record: FvvdpRecord) -> Self {
        let bands = record.bands.into_iter().map(|(cpd, sustained, transient)| FvvdpBand {
            cpd: cpd.0,
            sustained: sustained.0,
            transient: read(transient),
        });
        let numbers = |shares: Vec<Number>| shares.into_iter().map(|share| share.0).collect();
        Self {
            q: record.q.0,
            frame_jod: record.frame_jod.0,
            bands: bands.collect(),
            shares: record.shares.map(numbers),
        }
    }
}

//! The score of a test frame against its reference: the pyramids are built and compared level by
//! level.

use std::sync::Arc;

use fovqa_frame::map_row_blocks;
use fovqa_vision::{BandEdges, BandMap, Eccentricity, View};

use super::band::Band;
use super::bands::bands;
use super::calibration::BETA;
use super::geometry::{BandDirections, Geometry};
use super::grid::Grid;
use super::heat_map::DifferenceMap;
use super::level::{DifferenceRows, KeptRows, Levels, Reference, ReferenceRows, Viewing};
use super::masking::powers;
use super::params::Params;
use super::pooling::{jod, over_bands, over_channels, over_pixels, shares_of_channels};
use super::pyramid::{RightEdge, reduce};
use crate::metric::Metric;
use crate::pooling::Parts;
use crate::row::{Key, Rows};
use crate::sums::add_by_band;

/// Q of one spatial-frequency band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FvvdpBand {
    /// Its frequency at the centre of the display, in cycles per degree.
    pub cpd: f64,
    /// Q of its sustained channel.
    pub sustained: f64,
    /// Q of its transient channel, before the channel's weight; `None` for a still.
    pub transient: Option<f64>,
}

/// The score of a test frame against its reference.
#[derive(Debug, Clone, PartialEq)]
pub struct FvvdpFrame {
    /// The pooled difference Q, 0 and above.
    pub q: f64,
    /// 10 - a Q^b of this frame alone. The mean over frames is not the JOD of the sequence.
    pub frame_jod: f64,
    /// Q by spatial frequency, the finest first.
    pub bands: Vec<FvvdpBand>,
    /// The contribution of each eccentricity band, and at the end of the pixels outside all bands,
    /// to Q, as shares of 1; `None` if there is no difference at all.
    pub shares: Option<Vec<f64>>,
}

impl FvvdpFrame {
    /// Adds the rows of a frame: its JOD and Q, Q by spatial frequency (one level each), and the
    /// share of each of the `bands` eccentricity bands.
    pub fn rows(&self, bands: usize, rows: &mut Rows) {
        let [frame_jod, q, sustained, transient, share, outside] =
            std::array::from_fn(|statistic| Key::of(Metric::Fvvdp).nth(statistic));
        rows.score(frame_jod, self.frame_jod);
        rows.score(q, self.q);
        for (level, band) in (1..).zip(&self.bands) {
            rows.score(sustained.on_level(level), band.sustained);
            if let Some(value) = band.transient {
                rows.score(transient.on_level(level), value);
            }
        }
        let mut shared = |key: Key, band: usize| {
            let value = self.share(band);
            let sum = value.unwrap_or(0.0) * self.q;
            rows.push(key, value, Parts::Mean { sum, weight: self.q });
        };
        for band in 0..bands {
            shared(share.in_band(band), band);
        }
        shared(outside, bands);
    }

    /// The share of an eccentricity band in Q; `None` if there is no difference at all.
    pub fn share(&self, band: usize) -> Option<f64> {
        self.shares.as_ref()?.get(band).copied()
    }
}

/// The eccentricity bands of every level of the pyramid.
#[derive(Debug, Clone)]
pub struct FvvdpRegions(Vec<BandMap>);

impl FvvdpRegions {
    /// The memory they take, in bytes.
    pub fn bytes(&self) -> usize {
        self.0.iter().map(BandMap::bytes).sum()
    }
}

/// A reference, prepared for the comparison with tests.
#[derive(Debug)]
pub struct FvvdpReference {
    channels: Vec<Arc<Grid>>,
    /// The directions of the pixels; `None` means foveal vision at every pixel.
    directions: Option<Vec<BandDirections>>,
    /// The rows of each level, if they are stored for several tests.
    kept: Option<Vec<KeptRows>>,
}

impl FvvdpReference {
    /// Its sustained channel, or the still itself, as luminance in cd/m².
    pub fn sustained(&self) -> &Grid {
        &self.channels[0]
    }
}

fn planes(channels: &[Arc<Grid>]) -> Vec<&Grid> {
    channels.iter().map(Arc::as_ref).collect()
}

/// The metric for frames of one size on one display.
#[derive(Debug)]
pub struct Fvvdp {
    geometry: Geometry,
    bands: Vec<Band>,
    foveated: bool,
    right_edge: RightEdge,
}

impl Fvvdp {
    /// The metric for frames in a geometry. Their sides must be at least [`SMALLEST_SIDE`].
    pub fn new(geometry: Geometry, params: &Params) -> Self {
        Self {
            bands: bands(&geometry),
            geometry,
            foveated: params.foveated,
            right_edge: if params.exact_edges { RightEdge::ByColumns } else { RightEdge::ByRows },
        }
    }

    /// The geometry of its frames.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Frequencies of its bands at the centre of the display, in cycles per degree, the finest
    /// first.
    pub fn frequencies_cpd(&self) -> impl Iterator<Item = f64> + '_ {
        self.bands.iter().map(|band| band.cpd)
    }

    /// The eccentricity bands of each of its levels, all of which are stretched over the whole
    /// frame.
    pub fn regions(&self, eccentricity: &Eccentricity, edges: &BandEdges) -> FvvdpRegions {
        let View { width, height, .. } = *eccentricity.view();
        let maps = self.bands.iter().map(|band| {
            let scale = [band.size.0 as f64 / width as f64, band.size.1 as f64 / height as f64];
            BandMap::new(&eccentricity.scaled(band.size, scale), edges)
        });
        FvvdpRegions(maps.collect())
    }

    /// Prepares a reference from its filtered planes, for a gaze in pixels of the frame. With
    /// `keep`, values that depend only on the reference are stored for several tests.
    pub fn reference(
        &self,
        channels: Vec<Arc<Grid>>,
        gaze_px: [f64; 2],
        keep: bool,
    ) -> FvvdpReference {
        let directions = self.foveated.then(|| {
            let of = |band: &Band| BandDirections::new(&self.geometry, band, gaze_px);
            self.bands.iter().map(of).collect::<Vec<_>>()
        });
        let mut reference = FvvdpReference { channels, directions, kept: None };
        if keep {
            let mut kept = Vec::with_capacity(self.bands.len());
            self.descend(&planes(&reference.channels), |index, fine, coarse| {
                let levels = Levels::new(fine, coarse);
                kept.push(KeptRows::new(self.viewing(&reference, index), levels));
            });
            reference.kept = Some(kept);
        }
        reference
    }

    fn viewing<'a>(&'a self, reference: &'a FvvdpReference, index: usize) -> Viewing<'a> {
        let directions = reference.directions.as_ref().map(|directions| &directions[index]);
        Viewing { band: &self.bands[index], directions }
    }

    /// Calls `visit` with each level of some pyramids and the next level.
    fn descend(&self, planes: &[&Grid], mut visit: impl FnMut(usize, &[&Grid], &[Grid])) {
        let mut coarse = reduce(planes, self.right_edge);
        visit(0, planes, &coarse);
        for index in 1..self.bands.len() {
            let kept = coarse;
            let fine: Vec<&Grid> = kept.iter().collect();
            coarse = reduce(&fine, self.right_edge);
            visit(index, &fine, &coarse);
        }
    }

    /// Scores a test frame, given by its filtered planes, against its reference. If a map is
    /// wanted, it receives the differences of every level.
    pub fn score(
        &self,
        reference: &FvvdpReference,
        test: &[Arc<Grid>],
        regions: &FvvdpRegions,
        map: Option<&mut DifferenceMap>,
    ) -> FvvdpFrame {
        let mut sums = Vec::with_capacity(self.bands.len());
        let mut map = map;
        let test = planes(test);
        if let Some(kept) = &reference.kept {
            self.descend(&test, |index, fine, coarse| {
                let rows = || Reference::Kept(&kept[index]);
                let test = Levels::new(fine, coarse);
                sums.push(self.level(index, test, rows, regions, map.as_deref_mut()));
            });
            return self.pooled(&sums);
        }
        let channels = test.len();
        // Both pyramids together: there is less waiting for threads.
        let both = [planes(&reference.channels), test].concat();
        self.descend(&both, |index, fine, coarse| {
            let reference_levels = Levels::new(&fine[..channels], &coarse[..channels]);
            let test = Levels::new(&fine[channels..], &coarse[channels..]);
            let viewing = self.viewing(reference, index);
            let rows =
                || Reference::Computed(Box::new(ReferenceRows::new(viewing, reference_levels)));
            sums.push(self.level(index, test, rows, regions, map.as_deref_mut()));
        });
        self.pooled(&sums)
    }

    /// Σ D^β of a level for each channel: one sum per eccentricity band, and at the end that of the
    /// pixels outside all bands.
    fn level<'a>(
        &'a self,
        index: usize,
        test: Levels<'a>,
        reference: impl Fn() -> Reference<'a> + Sync + Send,
        regions: &FvvdpRegions,
        map: Option<&mut DifferenceMap>,
    ) -> Vec<Vec<f64>> {
        let (band, region) = (&self.bands[index], &regions.0[index]);
        let rows = || DifferenceRows::new(band, reference(), test);
        let blocks = map_row_blocks(band.size.1, |block| {
            let mut rows = rows();
            let mut power = vec![0.0; band.size.0];
            let mut sums = vec![vec![0.0; region.bands() + 1]; test.channels()];
            for y in block {
                for (log2_differences, sums) in rows.row(y).iter().zip(&mut sums) {
                    powers(log2_differences, BETA as f32, &mut power);
                    add_by_band(&power, 0, region.row(y), sums);
                }
            }
            sums
        });
        if let Some(map) = map {
            map.add_level(index, band.size, rows);
        }
        let mut all = vec![vec![0.0; region.bands() + 1]; test.channels()];
        for block in &blocks {
            for (mine, theirs) in all.iter_mut().flatten().zip(block.iter().flatten()) {
                *mine += theirs;
            }
        }
        all
    }

    /// The score of a frame from the sums of its levels.
    fn pooled(&self, sums: &[Vec<Vec<f64>>]) -> FvvdpFrame {
        let channels = sums[0].len();
        let q = |level: usize, channel: usize| {
            let (width, height) = self.bands[level].size;
            over_pixels(sums[level][channel].iter().sum(), width * height)
        };
        let levels = 0..sums.len();
        let of_channel =
            |channel| over_bands(channel, levels.clone().map(|level| q(level, channel)));
        let q_of_channels: Vec<f64> = (0..channels).map(of_channel).collect();
        let q_of_frame = over_channels(&q_of_channels);
        let bands = self.bands.iter().enumerate().map(|(level, band)| FvvdpBand {
            cpd: band.cpd,
            sustained: q(level, 0),
            transient: (channels > 1).then(|| q(level, 1)),
        });
        let shares = (q_of_frame > 0.0).then(|| {
            let of_channels = shares_of_channels(&q_of_channels);
            let mut shares = vec![0.0; sums[0][0].len()];
            for (channel, of_channel) in of_channels.iter().enumerate() {
                let all: f64 = levels.clone().map(|level| q(level, channel)).sum();
                for level in levels.clone() {
                    let powers = &sums[level][channel];
                    let sum: f64 = powers.iter().sum();
                    if sum > 0.0 {
                        let weight = of_channel * q(level, channel) / all / sum;
                        for (share, power) in shares.iter_mut().zip(powers) {
                            *share += weight * power;
                        }
                    }
                }
            }
            shares
        });
        FvvdpFrame { q: q_of_frame, frame_jod: jod(q_of_frame), bands: bands.collect(), shares }
    }
}

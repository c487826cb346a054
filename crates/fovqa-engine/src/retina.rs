//! Data that depend only on view and gaze. They are computed once per gaze, because a fixation
//! covers many frames and the eyes return to earlier positions.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use fovqa_frame::Mask;
use fovqa_metrics::fvvdp::{Fvvdp, FvvdpRegions};
use fovqa_metrics::{BlockRegions, Params, Regions, WeightField};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, View};

/// Maximum size in bytes of a precomputed weight field. 8K UHD fits; the retinal resolution of
/// 11520x6480 is computed row by row.
const MAX_FIELD_BYTES: usize = 256 << 20;

/// Bytes of memory for retinas that may be needed again.
const KEPT_BYTES: usize = 256 << 20;

/// Minimum number of pairs per gaze at which precomputing the weight field saves time.
const USES_OF_A_FIELD: usize = 3;

/// Bands and weights of one gaze.
#[derive(Debug)]
pub(crate) struct Retina {
    pub(crate) bands: BandMap,
    /// Bands of blocks, by the number of block levels that a metric needs.
    blocks: BTreeMap<usize, Vec<BandMap>>,
    pub(crate) weight: Option<WeightField>,
    /// Bands of the levels of FovVideoVDP.
    pub(crate) fvvdp: Option<FvvdpRegions>,
    /// The bands without the pixels that the mask leaves out.
    masked: Option<(Regions<'static>, Blocks<'static>)>,
    /// Bytes of memory in use. The masked copy, which has the same size, is not included.
    bytes: usize,
}

/// Bands of blocks without the blocks that a mask leaves out, by the number of block levels that a
/// metric needs.
pub(crate) type Blocks<'a> = BTreeMap<usize, BlockRegions<'a>>;

impl Retina {
    /// The regions of a frame: bands without the pixels that the mask leaves out.
    pub(crate) fn regions(&self) -> (Cow<'_, Regions<'_>>, Cow<'_, Blocks<'_>>) {
        if let Some((regions, blocks)) = &self.masked {
            return (Cow::Borrowed(regions), Cow::Borrowed(blocks));
        }
        let blocks = self.blocks.iter();
        let blocks = blocks.map(|(levels, maps)| (*levels, BlockRegions::unmasked(maps)));
        (Cow::Owned(Regions::unmasked(&self.bands)), Cow::Owned(blocks.collect()))
    }

    /// The regions of a frame in which only some pixels count.
    pub(crate) fn regions_within(
        &self,
        mask: &Mask,
        window_radius: usize,
    ) -> (Cow<'_, Regions<'_>>, Cow<'_, Blocks<'_>>) {
        let regions = Regions::masked(&self.bands, mask, window_radius);
        (Cow::Owned(regions), Cow::Owned(masked(&self.blocks, mask)))
    }
}

fn masked(blocks: &BTreeMap<usize, Vec<BandMap>>, mask: &Mask) -> Blocks<'static> {
    let masked = blocks.iter().map(|(levels, maps)| (*levels, BlockRegions::masked(maps, mask)));
    masked.collect()
}

/// The conditions under which an eye sees the frames.
#[derive(Debug)]
pub(crate) struct Viewing {
    pub(crate) view: View,
    pub(crate) kind: EccentricityKind,
    pub(crate) edges: BandEdges,
}

/// Makes retinas.
#[derive(Debug)]
pub(crate) struct RetinaMaker<'a> {
    /// The viewing conditions; `None` without a view, and then there are no bands.
    pub(crate) viewing: Option<Viewing>,
    pub(crate) size: (usize, usize),
    pub(crate) params: &'a Params,
    pub(crate) foveal: bool,
    /// The numbers of block levels that the metrics need.
    pub(crate) block_levels: BTreeSet<usize>,
    pub(crate) fvvdp: Option<Fvvdp>,
    pub(crate) mask: Option<Mask>,
    /// Radius in pixels of the windows in which every pixel has to count.
    pub(crate) window_radius: usize,
    /// The number of pairs for each gaze.
    pub(crate) uses: BTreeMap<Key, usize>,
}

/// A gaze position, compared bit by bit.
pub(crate) type Key = [u64; 2];

pub(crate) fn key(gaze_px: [f64; 2]) -> Key {
    gaze_px.map(f64::to_bits)
}

impl RetinaMaker<'_> {
    fn make(&self, gaze_px: [f64; 2]) -> Retina {
        let (bands, blocks, weight) = match &self.viewing {
            None => {
                let levels = self.block_levels.iter();
                let maps = |levels: &usize| {
                    (*levels, BlockRegions::maps_without_bands(self.size, *levels))
                };
                let bands = BandMap::without_bands(self.size.0, self.size.1);
                (bands, levels.map(maps).collect(), None)
            }
            Some(viewing) => self.seen(viewing, gaze_px),
        };
        let masked = self.mask.as_ref().map(|mask| {
            let regions = Regions::masked(&bands, mask, self.window_radius);
            (regions, masked(&blocks, mask))
        });
        let fvvdp = self.viewing.as_ref().zip(self.fvvdp.as_ref()).map(|(viewing, fvvdp)| {
            let eccentricity = Eccentricity::new(viewing.view, gaze_px, viewing.kind);
            fvvdp.regions(&eccentricity, &viewing.edges)
        });
        let maps = blocks.values().flatten().chain([&bands]).map(BandMap::bytes).sum::<usize>();
        let bytes = maps
            + weight.as_ref().map_or(0, WeightField::bytes)
            + fvvdp.as_ref().map_or(0, FvvdpRegions::bytes);
        Retina { bands, blocks, weight, fvvdp, masked, bytes }
    }

    fn seen(
        &self,
        viewing: &Viewing,
        gaze_px: [f64; 2],
    ) -> (BandMap, BTreeMap<usize, Vec<BandMap>>, Option<WeightField>) {
        let eccentricity = Eccentricity::new(viewing.view, gaze_px, viewing.kind);
        let fits = self.size.0 * self.size.1 * size_of::<f32>() <= MAX_FIELD_BYTES;
        let often = self.uses.get(&key(gaze_px)).is_some_and(|uses| *uses >= USES_OF_A_FIELD);
        let weight = self.foveal.then(|| {
            let field = WeightField::new(eccentricity, &self.params.fpsnr);
            if often && fits { field.precomputed() } else { field }
        });
        let maps =
            |levels: &usize| (*levels, BlockRegions::maps(&eccentricity, &viewing.edges, *levels));
        let blocks = self.block_levels.iter().map(maps).collect();
        (BandMap::new(&eccentricity, &viewing.edges), blocks, weight)
    }
}

/// The most recently used retinas, as many as fit into a limit.
#[derive(Debug)]
pub(crate) struct Retinas<'a> {
    pub(crate) maker: RetinaMaker<'a>,
    kept: BTreeMap<Key, Kept>,
    bound_bytes: usize,
    bytes: usize,
    clock: u64,
}

#[derive(Debug)]
struct Kept {
    retina: Arc<Retina>,
    used: u64,
}

impl<'a> Retinas<'a> {
    pub(crate) fn new(maker: RetinaMaker<'a>) -> Self {
        Self { maker, kept: BTreeMap::new(), bound_bytes: KEPT_BYTES, bytes: 0, clock: 0 }
    }

    /// The retina for a gaze.
    pub(crate) fn at(&mut self, gaze_px: [f64; 2]) -> Arc<Retina> {
        self.clock += 1;
        if let Some(kept) = self.kept.get_mut(&key(gaze_px)) {
            kept.used = self.clock;
            return Arc::clone(&kept.retina);
        }
        let retina = Arc::new(self.maker.make(gaze_px));
        self.bytes += retina.bytes;
        let kept = Kept { retina: Arc::clone(&retina), used: self.clock };
        self.kept.insert(key(gaze_px), kept);
        self.forget();
        retina
    }

    /// Removes the retinas that have not been used for the longest time, until the rest fits into
    /// the limit.
    fn forget(&mut self) {
        while self.bytes > self.bound_bytes && self.kept.len() > 1 {
            let oldest = self.kept.iter().min_by_key(|(_, kept)| kept.used).map(|(key, _)| *key);
            let Some(kept) = oldest.and_then(|key| self.kept.remove(&key)) else { return };
            self.bytes -= kept.retina.bytes;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fovqa_vision::ViewSpec;

    fn retinas(params: &Params) -> Retinas<'_> {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(90.0) };
        let viewing = Viewing {
            view: spec.resolve(64, 48).unwrap().view,
            kind: EccentricityKind::Angular,
            edges: BandEdges::new(vec![0.0, 10.0, 20.0]).unwrap(),
        };
        Retinas::new(RetinaMaker {
            viewing: Some(viewing),
            size: (64, 48),
            params,
            foveal: true,
            block_levels: BTreeSet::from([3]),
            fvvdp: None,
            mask: None,
            window_radius: 5,
            uses: BTreeMap::from([(key([1.0, 1.0]), USES_OF_A_FIELD), (key([2.0, 2.0]), 1)]),
        })
    }

    #[test]
    fn a_gaze_that_comes_back_is_not_computed_again() {
        let params = Params::default();
        let mut retinas = retinas(&params);
        let first = retinas.at([1.0, 1.0]);
        let other = retinas.at([2.0, 2.0]);
        assert!(!Arc::ptr_eq(&first, &other));
        assert!(Arc::ptr_eq(&first, &retinas.at([1.0, 1.0])));
        assert_eq!(first.blocks[&3].len(), 3);
        assert!(first.bytes > other.bytes + 64 * 48 * 4 - 1000, "its weights are written down");
    }

    #[test]
    fn as_many_are_kept_as_fit_and_those_used_last() {
        let params = Params::default();
        let mut retinas = retinas(&params);
        let gaze = |i: usize| [10.0 + i as f64, 3.0];
        let first = retinas.at(gaze(0));
        retinas.bound_bytes = 4 * first.bytes;
        for i in 1..50 {
            retinas.at(gaze(i));
            assert!(Arc::ptr_eq(&first, &retinas.at(gaze(0))), "used all the time");
            assert!(retinas.bytes <= retinas.bound_bytes && retinas.kept.len() <= 5);
        }
        assert!(retinas.kept.contains_key(&key(gaze(49))));
        assert!(!retinas.kept.contains_key(&key(gaze(30))));
        retinas.bound_bytes = 0;
        retinas.at(gaze(60));
        assert_eq!(retinas.kept.len(), 1, "the present one stays");
    }
}

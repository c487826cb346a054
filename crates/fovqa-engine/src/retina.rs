//! What depends on view and gaze alone, computed once for as long as they stay.

use fovqa_metrics::{Params, WeightField};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, View};

/// Largest precomputed weight field: 8K UHD fits, the retinal 11520x6480 is computed row by row.
const MAX_FIELD_BYTES: usize = 256 << 20;

/// Bands and weights of one gaze.
#[derive(Debug)]
pub(crate) struct Retina {
    gaze_px: [f64; 2],
    pub(crate) bands: BandMap,
    pub(crate) weight: Option<WeightField>,
}

impl Retina {
    /// Whether it is of this gaze.
    pub(crate) fn is_at(&self, gaze_px: [f64; 2]) -> bool {
        self.gaze_px.map(f64::to_bits) == gaze_px.map(f64::to_bits)
    }
}

/// How to make them.
#[derive(Debug)]
pub(crate) struct RetinaMaker<'a> {
    pub(crate) view: View,
    pub(crate) kind: EccentricityKind,
    pub(crate) edges: BandEdges,
    pub(crate) params: &'a Params,
    pub(crate) foveal: bool,
    /// Whether one gaze serves many frames.
    pub(crate) keep: bool,
}

impl RetinaMaker<'_> {
    /// Bands and weights of a gaze; `last` is used again if it is of the same gaze.
    pub(crate) fn at(&self, gaze_px: [f64; 2], last: Option<Retina>) -> Retina {
        if let Some(retina) = last.filter(|retina| retina.is_at(gaze_px)) {
            return retina;
        }
        let eccentricity = Eccentricity::new(self.view, gaze_px, self.kind);
        let fits = self.view.width * self.view.height * size_of::<f32>() <= MAX_FIELD_BYTES;
        let weight = self.foveal.then(|| {
            let field = WeightField::new(eccentricity, &self.params.fpsnr);
            if self.keep && fits { field.precomputed() } else { field }
        });
        Retina { gaze_px, bands: BandMap::new(&eccentricity, &self.edges), weight }
    }
}

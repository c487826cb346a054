//! Heat maps of metrics' maps: the colours of the metric's scale, the bands as rings and the gaze.

use fovqa_metrics::{Map, MapInfo, MapScale};
use fovqa_plot::{HeatMap, HeatMapLayout, HeatRing, HeatScale, PlotError};
use fovqa_vision::{Seen, View};

/// The smallest distance between two rings at the principal point, in pixels and as a share of the
/// frame's shorter side.
const LEAST_GAP_PX: f64 = 16.0;
const LEAST_GAP_SHARE: f64 = 1.0 / 30.0;

/// A sheet for the heat maps of one kind, of frames that have the same size, view and gaze. Its
/// lines and its text are drawn once.
#[derive(Debug, Clone)]
pub struct MapSheet {
    sheet: HeatMap,
}

impl MapSheet {
    /// A sheet for the maps of a metric, of frames of this size in pixels. Without a view there are
    /// no rings and no gaze.
    ///
    /// # Errors
    /// When the frame is larger than a PNG can be.
    pub fn new(
        info: &MapInfo,
        size: (usize, usize),
        seen: Option<&Seen>,
    ) -> Result<Self, PlotError> {
        let layout = HeatMapLayout {
            rings: seen.map(rings).unwrap_or_default(),
            gaze: seen.map(|seen| seen.eccentricity.gaze_px()),
            ..layout(info, size)
        };
        Ok(Self { sheet: HeatMap::new(&layout)? })
    }

    /// A sheet for the maps of another metric of the same frames, with the same rings and gaze. It
    /// is made faster than a new one.
    ///
    /// # Errors
    /// As [`MapSheet::new`].
    pub fn with_map(&self, info: &MapInfo) -> Result<Self, PlotError> {
        let layout = layout(info, self.sheet.frame_size());
        Ok(Self { sheet: self.sheet.with_rings(&layout)? })
    }

    /// The picture of a map as a PNG: the frame pixel by pixel, and the colour bar in a strip below
    /// it.
    ///
    /// # Errors
    /// When the map has another size than the sheet.
    pub fn png(&self, map: &Map) -> Result<Vec<u8>, PlotError> {
        self.sheet.png(&map.values)
    }
}

fn layout(info: &MapInfo, size: (usize, usize)) -> HeatMapLayout {
    let scale = match info.scale {
        MapScale::Linear { none, most } => HeatScale { none, most, log: false },
        MapScale::Logarithmic { none, most } => HeatScale { none, most, log: true },
    };
    let label = match info.unit {
        Some(unit) => format!("{} ({unit})", info.label),
        None => info.label.to_owned(),
    };
    HeatMapLayout {
        size,
        block: info.block,
        label,
        bright: info.bright,
        scale,
        rings: Vec::new(),
        gaze: None,
    }
}

/// The rings at the edges of the bands, or at every second, third, … edge if they would be too
/// close. Those at even places come first, because the first rings are labelled first: of the
/// default bands, these are 10°, 20°, 30°, ….
fn rings(seen: &Seen) -> Vec<HeatRing> {
    let edges: Vec<f64> = seen.bands.edges_deg().to_vec();
    let step = step(&edges, seen.eccentricity.view());
    let chosen: Vec<f64> = edges.into_iter().step_by(step).collect();
    let even = chosen.iter().step_by(2);
    let odd = chosen.iter().skip(1).step_by(2);
    let ring =
        |deg: &f64| HeatRing { label: format!("{deg}°"), lines: seen.eccentricity.ring(*deg) };
    even.chain(odd).map(ring).filter(|ring| !ring.lines.is_empty()).collect()
}

/// The smallest number of edges from ring to ring at which the rings are far enough apart.
fn step(edges: &[f64], view: &View) -> usize {
    let side = view.width.min(view.height) as f64;
    let least_deg = LEAST_GAP_PX.max(side * LEAST_GAP_SHARE) / view.pixels_per_degree();
    let is_apart = |step: &usize| {
        let chosen: Vec<f64> = edges.iter().step_by(*step).copied().collect();
        let length = chosen.last().zip(chosen.first()).map_or(0.0, |(last, first)| last - first);
        length >= least_deg * (chosen.len() as f64 - 1.0)
    };
    (1..edges.len()).find(is_apart).unwrap_or(edges.len().max(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use fovqa_metrics::Metric;
    use fovqa_vision::{BandEdges, Eccentricity, EccentricityKind};

    const SIZE: (usize, usize) = (400, 300);

    fn seen(edges: Vec<f64>) -> Seen {
        let view = View {
            width: SIZE.0,
            height: SIZE.1,
            focal_px: [220.0; 2],
            principal_px: [200.0, 150.0],
        };
        let eccentricity = Eccentricity::new(view, [120.0, 150.0], EccentricityKind::Angular);
        Seen { eccentricity, bands: BandEdges::new(edges).unwrap() }
    }

    fn labels(edges: Vec<f64>) -> Vec<String> {
        rings(&seen(edges)).into_iter().map(|ring| ring.label).collect()
    }

    #[test]
    fn rings_are_the_edges_of_bands_that_can_be_told_apart() {
        let fives = (0..=4).map(|i| f64::from(i) * 5.0).collect();
        assert_eq!(labels(fives), ["10°", "20°", "5°", "15°"]);
        assert_eq!(labels(vec![0.0, 7.5, 100.0]), ["7.5°"], "100° is nowhere in the frame");
        let halves = (0..=40).map(|i| f64::from(i) * 0.5).collect();
        let found = labels(halves);
        // At 3.8 pixels per degree, 16 pixels are more than 4 degrees.
        assert!((3..=5).contains(&found.len()) && !found.contains(&"0.5°".to_owned()), "{found:?}");
    }

    #[test]
    fn only_frames_with_a_view_have_rings() {
        let info = Metric::Ssim.info().map.unwrap();
        let map = Map {
            info,
            frame_size: SIZE,
            values: vec![0.5; SIZE.0 * SIZE.1],
            is_half: false,
            pictures: Vec::new(),
        };
        let png = |seen: Option<&Seen>| MapSheet::new(info, SIZE, seen).unwrap().png(&map).unwrap();
        let ringed = seen(vec![0.0, 10.0, 20.0]);
        let (plain, ringed) = (png(None), png(Some(&ringed)));
        assert!(ringed.len() > plain.len() + 1000, "{} and {}", ringed.len(), plain.len());
        let small = MapSheet::new(info, (40, 30), None).unwrap();
        assert!(small.png(&map).is_err(), "another size");
    }
}

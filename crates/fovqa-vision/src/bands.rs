//! Eccentricity bands: half-open ranges in degrees, and the band of each pixel.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::eccentricity::Eccentricity;

/// Width of the default bands in degrees.
pub const DEFAULT_BAND_DEG: f64 = 5.0;

/// The edges of bands `[edge[i], edge[i + 1])`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub struct BandEdges(Vec<f64>);

/// Edges that do not make bands.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum BandEdgesError {
    /// There are fewer than two edges.
    #[error("bands need at least two edges")]
    TooFew,
    /// There are more than [`BandEdges::MAX_BANDS`] bands.
    #[error("{found} bands are too many: at most {} are allowed", BandEdges::MAX_BANDS)]
    TooMany {
        /// Number of bands asked for.
        found: usize,
    },
    /// An edge is not a number from 0° to 180°.
    #[error("the band edge {edge_deg} is not between 0° and 180°")]
    OutOfRange {
        /// The edge.
        edge_deg: f64,
    },
    /// The edges do not rise.
    #[error("the band edge {edge_deg} is not above the edge before it, {before_deg}")]
    NotRising {
        /// The edge that does not rise.
        edge_deg: f64,
        /// The edge before it.
        before_deg: f64,
    },
}

impl TryFrom<Vec<f64>> for BandEdges {
    type Error = BandEdgesError;

    fn try_from(edges: Vec<f64>) -> Result<Self, BandEdgesError> {
        Self::new(edges)
    }
}

impl From<BandEdges> for Vec<f64> {
    fn from(edges: BandEdges) -> Self {
        edges.0
    }
}

impl BandEdges {
    /// The largest number of bands.
    pub const MAX_BANDS: usize = 1000;

    /// Bands between the given edges.
    ///
    /// # Errors
    /// When there are fewer than two edges, too many of them, or they do not rise within 0° to
    /// 180°.
    pub fn new(edges_deg: Vec<f64>) -> Result<Self, BandEdgesError> {
        if edges_deg.len() < 2 {
            return Err(BandEdgesError::TooFew);
        }
        if edges_deg.len() > Self::MAX_BANDS + 1 {
            return Err(BandEdgesError::TooMany { found: edges_deg.len() - 1 });
        }
        if let Some(&edge_deg) = edges_deg.iter().find(|e| !(0.0..=180.0).contains(*e)) {
            return Err(BandEdgesError::OutOfRange { edge_deg });
        }
        match edges_deg.windows(2).find(|pair| pair[1] <= pair[0]) {
            Some(pair) => Err(BandEdgesError::NotRising { edge_deg: pair[1], before_deg: pair[0] }),
            None => Ok(Self(edges_deg)),
        }
    }

    /// The default bands: 0, 5, 10, … to the first multiple of 5 above `max_deg`.
    pub fn default_up_to(max_deg: f64) -> Self {
        let last = (max_deg / DEFAULT_BAND_DEG).floor() as usize + 1;
        Self((0..=last).map(|i| i as f64 * DEFAULT_BAND_DEG).collect())
    }

    /// The number of bands.
    pub fn count(&self) -> usize {
        self.0.len() - 1
    }

    /// The edges in degrees, rising: one more than there are bands.
    pub fn edges_deg(&self) -> &[f64] {
        &self.0
    }

    /// The `(from_deg, to_deg)` of each band.
    pub fn iter(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.0.windows(2).map(|pair| (pair[0], pair[1]))
    }
}

/// Neighbouring pixels of one row that fall into one band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// First column beyond the run; it starts where the one before it ends.
    pub end: u32,
    /// Index of the band; for pixels outside all bands, the number of bands.
    pub band: u16,
}

/// The band of each pixel (or block of pixels), stored as the runs of each row from left to right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BandMap {
    bands: usize,
    starts: Vec<usize>,
    runs: Vec<Run>,
}

impl BandMap {
    /// The bands of every pixel centre of a view, decided in f64.
    pub fn new(eccentricity: &Eccentricity, edges: &BandEdges) -> Self {
        let (width, height) = (eccentricity.view().width, eccentricity.view().height);
        Self::of_blocks(eccentricity, edges, 1, [width, height])
    }

    /// The bands of square blocks of `side` pixels. `count` is the number of blocks across and down
    /// from the top-left corner; the centre of a block decides its band.
    pub fn of_blocks(
        eccentricity: &Eccentricity,
        edges: &BandEdges,
        side: usize,
        count: [usize; 2],
    ) -> Self {
        let counter = EdgeCounter::new(eccentricity, edges, side);
        let mut ends = [vec![0; edges.0.len() + 1], vec![0; edges.0.len() + 1]];
        let [columns, rows] = count;
        Self::from_rows(edges.count(), rows, |y, runs| {
            RowRuns::new(&counter, y, &mut ends, runs).fill(columns);
        })
    }

    /// A map without bands: every pixel is outside.
    pub fn without_bands(width: usize, height: usize) -> Self {
        Self::from_rows(0, height, |_, runs| runs.push(Run { end: width as u32, band: 0 }))
    }

    /// A map from a function that appends the runs of row `y` to a list.
    pub fn from_rows(
        bands: usize,
        height: usize,
        mut row: impl FnMut(usize, &mut Vec<Run>),
    ) -> Self {
        let mut starts = Vec::with_capacity(height + 1);
        let mut runs = Vec::with_capacity(height * (2 * bands + 1).min(64));
        for y in 0..height {
            starts.push(runs.len());
            row(y, &mut runs);
        }
        starts.push(runs.len());
        Self { bands, starts, runs }
    }

    /// The memory it takes, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + size_of_val(self.runs.as_slice())
    }

    /// The number of bands.
    pub fn bands(&self) -> usize {
        self.bands
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// The runs of row `y`. Together they cover the row.
    pub fn row(&self, y: usize) -> &[Run] {
        &self.runs[self.starts[y]..self.starts[y + 1]]
    }

    /// The number of pixels in each band, then the number of pixels outside all bands.
    pub fn pixels(&self) -> Vec<u64> {
        let mut pixels = vec![0; self.bands + 1];
        for y in 0..self.rows() {
            let mut from = 0;
            for run in self.row(y) {
                if let Some(count) = pixels.get_mut(usize::from(run.band)) {
                    *count += u64::from(run.end - from);
                }
                from = run.end;
            }
        }
        pixels
    }
}

/// Relative distance of an ordering tangent from that of an edge, well above the rounding error. A
/// pixel nearer to an edge than this is decided by its exact eccentricity.
const NEAR: f64 = 1e-12;

struct EdgeCounter<'a> {
    eccentricity: &'a Eccentricity,
    /// The ordering tangents of the edges.
    edge_tangents: Vec<f64>,
    /// For each number of edges below a pixel: the open range of ordering tangents that have this
    /// number and are not near any edge.
    clear: Vec<(f64, f64)>,
    edges_deg: &'a [f64],
    /// Side of the blocks whose band is decided, in pixels; 1 for single pixels.
    side_px: f64,
}

impl<'a> EdgeCounter<'a> {
    fn new(eccentricity: &'a Eccentricity, edges: &'a BandEdges, side: usize) -> Self {
        let tangents = edges.0.iter().map(|&deg| eccentricity.ordering_tangent_of_deg(deg));
        let edge_tangents: Vec<_> = tangents.collect();
        let from = edge_tangents.iter().map(|edge| edge * (1.0 + 2.0 * NEAR));
        let to = edge_tangents.iter().map(|edge| edge * (1.0 - 2.0 * NEAR));
        let clear = [f64::NEG_INFINITY].into_iter().chain(from).zip(to.chain([f64::INFINITY]));
        let clear = clear.collect();
        Self { eccentricity, edge_tangents, clear, edges_deg: &edges.0, side_px: side as f64 }
    }

    fn centre_px(&self, index: usize) -> f64 {
        (index as f64 + 0.5) * self.side_px
    }

    /// The number of edges at or below the eccentricity of a point.
    fn edges_below(&self, tangent: f64, [x_px, y_px]: [f64; 2]) -> usize {
        let below = self.edge_tangents.partition_point(|edge| *edge <= tangent);
        let is_near =
            |edge: Option<&f64>| edge.is_some_and(|e| (e - tangent).abs() <= NEAR * tangent);
        let near_one_below = below > 0 && is_near(self.edge_tangents.get(below - 1));
        if near_one_below || is_near(self.edge_tangents.get(below)) {
            let deg = self.eccentricity.at_deg(x_px, y_px);
            return self.edges_deg.partition_point(|edge| *edge <= deg);
        }
        below
    }
}

/// Collects the runs of one row.
struct RowRuns<'a> {
    counter: &'a EdgeCounter<'a>,
    y_px: f64,
    /// The column where a run last ended, in this row or in one above, by the number of edges below
    /// it. The first list is for falling eccentricity, the second for rising.
    ends: &'a mut [Vec<usize>; 2],
    /// The runs of the rows above, then those of this row from index `first`.
    runs: &'a mut Vec<Run>,
    first: usize,
    /// The number of edges below the last pixel.
    below: usize,
}

impl<'a> RowRuns<'a> {
    fn new(
        counter: &'a EdgeCounter<'a>,
        y: usize,
        ends: &'a mut [Vec<usize>; 2],
        runs: &'a mut Vec<Run>,
    ) -> Self {
        Self { counter, y_px: counter.centre_px(y), ends, first: runs.len(), runs, below: 0 }
    }

    /// The number of edges at or below the eccentricity of the centre of a pixel or block. It is
    /// found faster if it is `expected`, by a branch that the processor predicts well.
    fn edges_below(&self, x: usize, expected: usize) -> usize {
        let x_px = self.counter.centre_px(x);
        let tangent = self.counter.eccentricity.ordering_tangent(x_px, self.y_px);
        let (from, to) = self.counter.clear[expected];
        if from < tangent && tangent < to {
            return expected;
        }
        self.counter.edges_below(tangent, [x_px, self.y_px])
    }

    /// Finds all runs of the row. Along a row, eccentricity has at most one turning point and is
    /// monotone on each side of it, so a stretch with the same band at both ends lies in that band
    /// entirely.
    fn fill(&mut self, width: usize) {
        let turn = self.counter.eccentricity.turning_x_px(self.y_px) / self.counter.side_px - 0.5;
        // The pixels near the turning point are decided one by one, because its own position is
        // rounded.
        let turn =
            if turn.is_finite() { turn.floor().clamp(-8.0, width as f64 + 8.0) } else { -8.0 };
        let near = |offset: f64| ((turn + offset).max(0.0) as usize).min(width);
        let (left, right) = (near(-2.0), near(4.0));
        self.stretch(0, left);
        for x in left..right {
            self.push(x + 1, self.edges_below(x, self.below));
        }
        self.stretch(right, width);
    }

    fn stretch(&mut self, from: usize, to: usize) {
        if from >= to {
            return;
        }
        let last = (to - 1, self.edges_below(to - 1, self.below));
        let mut start = (from, self.edges_below(from, self.below));
        while start.1 != last.1 {
            let next = self.next_run(start, last);
            self.ends[usize::from(last.1 > start.1)][start.1] = next.0;
            self.push(next.0, start.1);
            start = next;
        }
        self.push(to, last.1);
    }

    /// The first pixel after `inside` whose number of edges below it differs; `outside` is a later
    /// pixel for which it differs. Neighbouring rows are alike, so the search starts where the run
    /// of the row above ended, takes growing steps until it has passed the end, and then halves the
    /// remaining range.
    fn next_run(
        &self,
        (mut inside, below): (usize, usize),
        mut outside: (usize, usize),
    ) -> (usize, usize) {
        let rises = outside.1 > below;
        let beyond = if rises { below + 1 } else { below - 1 };
        let (mut x, mut step) = (self.ends[usize::from(rises)][below], 1);
        let mut expected = beyond;
        while outside.0 - inside > 1 {
            if x <= inside || x >= outside.0 {
                x = inside.midpoint(outside.0);
            }
            let below_x = self.edges_below(x, expected);
            if below_x == below {
                (inside, expected) = (x, beyond);
                x += step;
            } else {
                (outside, expected) = ((x, below_x), below);
                x = x.saturating_sub(step);
            }
            step = (2 * step).min(outside.0 - inside);
        }
        outside
    }

    /// Ends a run at column `end`, or extends the previous run if it has the same band.
    fn push(&mut self, end: usize, edges_below: usize) {
        self.below = edges_below;
        let bands = self.counter.edges_deg.len() - 1;
        let inside = (1..=bands).contains(&edges_below);
        let band = if inside { edges_below - 1 } else { bands } as u16;
        match self.runs[self.first..].last_mut() {
            Some(run) if run.band == band => run.end = end as u32,
            _ => self.runs.push(Run { end: end as u32, band }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eccentricity::EccentricityKind;
    use crate::view::{View, ViewSpec};
    use proptest::array::uniform2;
    use proptest::collection::vec;
    use proptest::prelude::*;

    fn brute(e: &Eccentricity, edges: &BandEdges, x: usize, y: usize) -> usize {
        let deg = e.at_deg(x as f64 + 0.5, y as f64 + 0.5);
        edges.iter().position(|(from, to)| (from..to).contains(&deg)).unwrap_or(edges.count())
    }

    proptest! {
        #[test]
        fn every_pixel_is_in_the_band_of_its_eccentricity(
            fov in 20.0..172.0f64, gx in -60.0..160.0f64, gy in -60.0..130.0f64,
            planar in any::<bool>(), step in 0.7..40.0f64, from in 0.0..3.0f64,
        ) {
            let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(fov) };
            let view = spec.resolve(97, 71).unwrap().view;
            let kind = if planar { EccentricityKind::Planar } else { EccentricityKind::Angular };
            let e = Eccentricity::new(view, [gx, gy], kind);
            let edges: Vec<f64> = (0..30).map(|i| from + f64::from(i) * step).take_while(|e| *e <= 180.0).collect();
            let edges = BandEdges::new(edges).unwrap();
            let map = BandMap::new(&e, &edges);
            let mut counted = vec![0; edges.count() + 1];
            for y in 0..71 {
                let row = map.row(y);
                prop_assert_eq!(row.last().unwrap().end, 97);
                for x in 0..97 {
                    let run = row.iter().find(|run| x < run.end as usize).unwrap();
                    let want = brute(&e, &edges, x, y);
                    prop_assert_eq!(usize::from(run.band), want, "({}, {})", x, y);
                    counted[want] += 1;
                }
                prop_assert!(row.windows(2).all(|p| p[0].end < p[1].end && p[0].band != p[1].band));
            }
            prop_assert_eq!(map.pixels(), counted);
        }

        #[test]
        fn a_block_is_in_the_band_of_its_centre(
            fov in 20.0..172.0f64, gx in -60.0..160.0f64, gy in -60.0..130.0f64,
            planar in any::<bool>(), step in 0.7..40.0f64, side in 2usize..20,
        ) {
            let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(fov) };
            let view = spec.resolve(97, 71).unwrap().view;
            let kind = if planar { EccentricityKind::Planar } else { EccentricityKind::Angular };
            let e = Eccentricity::new(view, [gx, gy], kind);
            let edges: Vec<f64> = (0..30).map(|i| f64::from(i) * step).take_while(|e| *e <= 180.0).collect();
            let edges = BandEdges::new(edges).unwrap();
            let (columns, rows) = (97 / side, 71 / side);
            let map = BandMap::of_blocks(&e, &edges, side, [columns, rows]);
            prop_assert_eq!(map.rows(), rows);
            for j in 0..rows {
                prop_assert_eq!(map.row(j).last().unwrap().end as usize, columns);
                for i in 0..columns {
                    let centre = |index: usize| (index as f64 + 0.5) * side as f64;
                    let deg = e.at_deg(centre(i), centre(j));
                    let want = edges.iter().position(|(from, to)| (from..to).contains(&deg));
                    let run = map.row(j).iter().find(|run| i < run.end as usize).unwrap();
                    prop_assert_eq!(usize::from(run.band), want.unwrap_or(edges.count()));
                }
            }
        }

        #[test]
        fn bands_that_come_and_go_between_rows_are_found(
            (width, height) in (1usize..130, 1usize..60), side in 1usize..4,
            focal_px in uniform2(30.0..300.0f64), principal_px in uniform2(-50.0..150.0f64),
            gaze_px in uniform2(-150.0..250.0f64), far in 0i32..2, on_grid in any::<bool>(),
            planar in any::<bool>(), on_pixels in vec((0usize..130, 0usize..60, -1i8..=1), 0..40),
            between_deg in vec(0.0..=180.0f64, 2..12), straight_back in any::<bool>(),
        ) {
            let view = View { width, height, focal_px, principal_px };
            let kind = if planar { EccentricityKind::Planar } else { EccentricityKind::Angular };
            let gaze_px = gaze_px.map(|v| v * 10f64.powi(far));
            let gaze_px = if on_grid { gaze_px.map(|v| v.floor() + 0.5) } else { gaze_px };
            let e = Eccentricity::new(view, gaze_px, kind);
            let centre = |index: usize| (index as f64 + 0.5) * side as f64;
            // The gaze is exactly on a pixel, or the smallest step of a float to one side of it.
            let on_pixels = on_pixels.iter().map(|&(x, y, aside)| {
                let deg = e.at_deg(centre(x % width), centre(y % height));
                match aside {
                    -1 => deg.next_down().max(0.0),
                    1 => deg.next_up().min(180.0),
                    _ => deg,
                }
            });
            let mut edges: Vec<f64> = on_pixels.chain(between_deg).collect();
            edges.extend(straight_back.then_some(180.0));
            edges.sort_by(f64::total_cmp);
            edges.dedup();
            let edges = BandEdges::new(edges).unwrap();
            let map = BandMap::of_blocks(&e, &edges, side, [width, height]);
            for y in 0..height {
                let mut want: Vec<Run> = Vec::new();
                for x in 0..width {
                    let deg = e.at_deg(centre(x), centre(y));
                    let band = edges.iter().position(|(from, to)| (from..to).contains(&deg));
                    let run = Run { end: x as u32 + 1, band: band.unwrap_or(edges.count()) as u16 };
                    match want.last_mut() {
                        Some(last) if last.band == run.band => *last = run,
                        _ => want.push(run),
                    }
                }
                prop_assert_eq!(map.row(y), want, "row {}", y);
            }
        }
    }

    #[test]
    fn a_pixel_on_an_edge_belongs_to_the_band_above() {
        // Planar eccentricity with a focal length of 4 px: the pixel 4 px from the gaze lies at
        // exactly 45°.
        let view =
            ViewSpec::PixelPitch { distance_m: 0.004, pitch_mm: 1.0 }.resolve(16, 1).unwrap().view;
        let e = Eccentricity::new(view, [8.5, 0.5], EccentricityKind::Planar);
        let map = BandMap::new(&e, &BandEdges::new(vec![0.0, 45.0, 60.0]).unwrap());
        assert_eq!(map.pixels(), [7, 6, 3]);
        assert_eq!(map.row(0)[1], Run { end: 5, band: 1 });
    }

    #[test]
    fn default_edges_reach_above_the_farthest_pixel() {
        assert_eq!(BandEdges::default_up_to(12.0).0, [0.0, 5.0, 10.0, 15.0]);
        assert_eq!(BandEdges::default_up_to(15.0).0.last(), Some(&20.0));
        assert_eq!(BandEdges::default_up_to(0.0).0, [0.0, 5.0]);
    }

    #[test]
    fn refuses_edges_that_do_not_make_bands() {
        assert_eq!(BandEdges::new(vec![0.0]), Err(BandEdgesError::TooFew));
        for bad in [vec![0.0, f64::NAN], vec![-1.0, 5.0], vec![0.0, 181.0]] {
            assert!(matches!(BandEdges::new(bad), Err(BandEdgesError::OutOfRange { .. })));
        }
        assert!(matches!(
            BandEdges::new(vec![0.0, 5.0, 5.0]),
            Err(BandEdgesError::NotRising { .. })
        ));
    }
}

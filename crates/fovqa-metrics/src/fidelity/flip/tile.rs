//! FLIP of a tile of two pictures, of which only the pixels within reach of the kernels are read.

use std::ops::Range;

use fovqa_frame::{Frame, LightKind, LightSignal};

use super::colour::{Colours, compare};
use super::filters::{Filter, LANES};
use super::kernels::Kernels;
use crate::pair_input::PairInput;
use crate::regions::Regions;

/// The number of columns of a tile: the rows that are kept of both pictures stay in the second-level cache.
pub(crate) const TILE_COLUMNS: usize = 256;

/// Computes maps, tile by tile.
#[derive(Debug)]
pub(crate) struct Tiles<'a> {
    kernels: &'a Kernels,
    pictures: [LightSignal<'a>; 2],
    regions: &'a Regions<'a>,
    filters: [Filter<'a>; 2],
    colours: &'a Colours,
    light: [Light; 2],
    /// The rows and columns of the tile, and of what is read around it.
    rows: Range<usize>,
    columns: Range<usize>,
    read_rows: Range<usize>,
    read_columns: Range<usize>,
    /// A row after the change of its light.
    changed: [Vec<f32>; 3],
}

/// The light of a tile, and of the pixels around it: red, green and blue, row by row.
type Light = [Vec<f32>; 3];

/// A change of the light of a row: red, green and blue as read, and as they are to be compared.
pub(crate) type Change<'a> = &'a dyn Fn([&[f32]; 3], [&mut [f32]; 3]);

/// The conversions and kernels of all tiles.
#[derive(Debug)]
pub(crate) struct Optics {
    pub(crate) kernels: Kernels,
    pub(crate) colours: Colours,
}

impl Optics {
    pub(crate) fn new(pixels_per_degree: f64) -> Self {
        Self { kernels: Kernels::new(pixels_per_degree), colours: Colours::new() }
    }
}

impl<'a> Tiles<'a> {
    pub(crate) fn new(input: &PairInput<'a>, kind: LightKind, optics: &'a Optics) -> Self {
        let Optics { kernels, colours } = optics;
        let columns = TILE_COLUMNS.min(input.reference.width());
        let picture = |frame: &'a Frame| LightSignal::new(frame, input.tables, kind);
        let filter = || Filter::new(kernels, colours, columns);
        Self {
            kernels,
            pictures: [picture(input.reference), picture(input.test)],
            regions: input.regions,
            filters: [filter(), filter()],
            colours,
            light: Default::default(),
            rows: 0..0,
            columns: 0..0,
            read_rows: 0..0,
            read_columns: 0..0,
            changed: std::array::from_fn(|_| vec![0.0; columns + 2 * kernels.radius()]),
        }
    }

    /// Reads a tile. Pixels that a mask leaves out are black in both pictures.
    pub(crate) fn read(&mut self, rows: Range<usize>, columns: Range<usize>) {
        let radius = self.kernels.radius();
        let around = |range: &Range<usize>, side: usize| {
            range.start.saturating_sub(radius)..(range.end + radius).min(side)
        };
        let [picture, _] = &self.pictures;
        self.read_rows = around(&rows, picture.height());
        self.read_columns = around(&columns, picture.width());
        (self.rows, self.columns) = (rows, columns);
        let width = self.read_columns.len();
        for (picture, light) in self.pictures.iter().zip(&mut self.light) {
            for plane in light.iter_mut() {
                plane.resize(width * self.read_rows.len(), 0.0);
            }
            for (row, y) in self.read_rows.clone().enumerate() {
                let row = row * width..(row + 1) * width;
                let [r, g, b] = light.each_mut().map(|plane| &mut plane[row.clone()]);
                picture.fill(y, self.read_columns.clone(), [r, g, b]);
                let from = self.read_columns.start;
                for stretch in self.regions.left_out_in(y, self.read_columns.clone()) {
                    for plane in light.iter_mut() {
                        plane[row.start + stretch.start - from..row.start + stretch.end - from]
                            .fill(0.0);
                    }
                }
            }
        }
    }

    /// Computes the map of the tile that was read, row by row, after a change of its light.
    pub(crate) fn map(
        &mut self,
        change: Option<Change<'_>>,
        mut put: impl FnMut(usize, &mut [f32]),
    ) {
        let height = self.pictures[0].height();
        let (radius, columns) = (self.kernels.radius(), self.columns.len());
        let mut next = self.read_rows.start;
        let mut values = [0.0; TILE_COLUMNS];
        for y in self.rows.clone() {
            let last = (y + radius).min(height - 1);
            while next <= last {
                self.take(next, change);
                next += 1;
            }
            let [reference, test] =
                self.filters.each_mut().map(|filter| filter.filter(y, height, columns));
            let vectors = columns.next_multiple_of(LANES);
            compare(self.colours, reference, test, &mut values[..vectors]);
            put(y, &mut values[..columns]);
        }
    }

    /// Filters row `y` of both pictures across.
    fn take(&mut self, y: usize, change: Option<Change<'_>>) {
        let width = self.read_columns.len();
        let row = (y - self.read_rows.start) * width;
        for (light, filter) in self.light.iter().zip(&mut self.filters) {
            let read = light.each_ref().map(|plane| &plane[row..row + width]);
            let rgb = match change {
                None => read,
                Some(change) => {
                    change(read, self.changed.each_mut().map(|plane| &mut plane[..width]));
                    self.changed.each_ref().map(|plane| &plane[..width])
                }
            };
            filter.take(y, rgb, self.read_columns.start, &self.columns);
        }
    }
}

//! What pixels read in a polar buffer of ragged columns.

use fovqa_methods::Setting;
use multiversion::multiversion;

use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::{Detail, Radial};
use crate::ragged::{Ragged, Values};
use crate::texel::narrowed;
use crate::turn::turn;

/// From pixels to a buffer of ragged columns.
#[derive(Debug)]
pub(crate) struct PolarView {
    /// A pixel's column coordinate.
    column: Radial,
    offsets: Offsets,
}

impl PolarView {
    /// `column` leads from the distance from the gaze in pixels to the buffer's column coordinate.
    pub(crate) fn new(setting: &Setting, column: impl Fn(f64) -> f64 + Sync + Send) -> Self {
        let column = Radial::new(Detail::Coarse, setting.corner_px(), column);
        Self { column, offsets: Offsets::new(setting) }
    }

    /// The frame as read from a buffer; 0 beyond a distance from the gaze.
    pub(crate) fn show<const C: usize>(
        &self,
        buffer: &Ragged,
        values: &Values,
        reach_px: f64,
    ) -> Image<C> {
        let width = self.offsets.width();
        Image::by_blocks(width, self.offsets.height(), |rows, pixels| {
            let (mut columns, mut turns) = (vec![0.0; width], vec![0.0; width]);
            for (y, out) in rows.zip(pixels.chunks_exact_mut(width)) {
                let (xs, dy) = (&self.offsets.x, self.offsets.y[y]);
                coordinates(&self.column, xs, dy, &mut columns, &mut turns);
                for x in self.offsets.within(y, reach_px) {
                    out[x] = narrowed(buffer.read(values, columns[x], turns[x]));
                }
            }
        })
    }
}

/// Column coordinates, less 0.5, and directions of a row of pixels.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn coordinates(column: &Radial, xs: &[f32], dy: f32, columns: &mut [f32], turns: &mut [f32]) {
    // Two loops: the one without a table works on many pixels at once.
    for (dx, direction) in xs.iter().zip(turns) {
        *direction = turn(*dx, dy);
    }
    for (dx, at) in xs.iter().zip(columns) {
        *at = column.at(dx * dx + dy * dy) - 0.5;
    }
}

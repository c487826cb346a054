//! What pixels read in a polar buffer.

use std::ops::Range;

use fovqa_methods::Setting;

use crate::image::Image;
use crate::offsets::Offsets;
use crate::piece::Piece;
use crate::piece_samples::{PieceSamples, readers};
use crate::pixels::Pixels;
use crate::places::{Places, TILE};
use crate::radial::{Detail, Radial};
use crate::ragged::Ragged;
use crate::value::Value;
use crate::values::{Values, Window};

/// Rows of a strip, whose pieces are sampled for themselves.
const STRIP_ROWS: usize = 128;

/// From pixels to a polar buffer.
#[derive(Debug)]
pub(crate) struct PolarView {
    /// A pixel's column coordinate.
    column: Radial,
    /// Between which distances pixels read each column.
    readers: Vec<[f32; 2]>,
    pub(crate) offsets: Offsets,
    /// Up to where the frame is shown.
    reach_px: f64,
}

/// A rectangle of pixels.
struct Rectangle {
    xs: Range<usize>,
    ys: Range<usize>,
}

impl PolarView {
    /// `column` leads from the distance from the gaze in pixels to the buffer's column coordinate, from 0
    /// to `columns`. Beyond `reach_px` the picture is black.
    pub(crate) fn new(
        setting: &Setting,
        columns: usize,
        reach_px: f64,
        column: impl Fn(f64) -> f64 + Sync + Send,
    ) -> Self {
        let column = Radial::new(Detail::Coarse, setting.corner_px(), column);
        let readers = readers(&column, columns);
        Self { column, readers, offsets: Offsets::new(setting), reach_px }
    }

    /// A frame as read from its buffer, of which only what pixels read is sampled.
    pub(crate) fn show<const C: usize, V: Value>(
        &self,
        buffer: &Ragged,
        frame: &impl Pixels<C>,
    ) -> Image<C, V> {
        let (width, height) = (self.offsets.width(), self.offsets.height());
        let [left, upper] =
            [&self.offsets.x, &self.offsets.y].map(|axis| axis.partition_point(|d| *d < 0.0));
        Image::by_strips(width, height, STRIP_ROWS, |rows, pixels| {
            let mut samples = PieceSamples::default();
            for ys in parts(&rows, upper) {
                for xs in parts(&(0..width), left) {
                    let (dx, dy) = (&self.offsets.x[xs.clone()], &self.offsets.y[ys.clone()]);
                    let columns = (&self.column, self.readers.as_slice());
                    samples.take(buffer, frame, columns, &Piece::new(dx, dy));
                    let at = Rectangle { xs, ys: ys.clone() };
                    self.read(buffer, samples.window(), &at, rows.start, pixels);
                }
            }
        })
    }

    /// A frame as read from a buffer that is there.
    pub(crate) fn show_values<const C: usize, V: Value>(
        &self,
        buffer: &Ragged,
        values: &Values,
    ) -> Image<C, V> {
        let (width, height) = (self.offsets.width(), self.offsets.height());
        Image::by_strips(width, height, STRIP_ROWS, |ys, pixels| {
            let at = Rectangle { xs: 0..width, ys };
            self.read(buffer, buffer.window(values), &at, at.ys.start, pixels);
        })
    }

    /// Reads a rectangle of the picture, whose rows in `pixels` begin with `first`. Tile by tile: what
    /// neighbours read is close together.
    fn read<const C: usize, V: Value>(
        &self,
        buffer: &Ragged,
        window: Window,
        at: &Rectangle,
        first: usize,
        pixels: &mut [[V; C]],
    ) {
        let (width, last) = (self.offsets.width(), buffer.columns().len() - 1);
        let (mut places, mut signal) = (Places::default(), Vec::new());
        for from in at.xs.clone().step_by(TILE) {
            let xs = from..(from + TILE).min(at.xs.end);
            for y in at.ys.clone() {
                let start = (y - first) * width;
                let out = &mut pixels[start + xs.start..start + xs.end];
                let seen = self.seen(y, &xs);
                V::keep_row(out, &mut signal, |out| {
                    if seen != xs {
                        out.fill([0.0; C]);
                    }
                    let out = &mut out[seen.start - xs.start..seen.end - xs.start];
                    places.set(&self.column, &self.offsets.x[seen], self.offsets.y[y], last);
                    window.read_all(&places, out);
                });
            }
        }
    }

    /// Those pixels `xs` of row `y` that are not black.
    fn seen(&self, y: usize, xs: &Range<usize>) -> Range<usize> {
        if self.reach_px == f64::INFINITY {
            return xs.clone();
        }
        let seen = self.offsets.within(y, self.reach_px);
        let start = seen.start.clamp(xs.start, xs.end);
        start..seen.end.clamp(start, xs.end)
    }
}

/// The parts of a range before and behind a number that are not empty.
fn parts(range: &Range<usize>, at: usize) -> impl Iterator<Item = Range<usize>> + use<> {
    let at = at.clamp(range.start, range.end);
    [range.start..at, at..range.end].into_iter().filter(|part| !part.is_empty())
}

#[cfg(test)]
mod tests {
    use fovqa_vision::ViewSpec;

    use super::*;
    use crate::jitter::CENTRE;
    use crate::sample_places::SamplePlaces;
    use crate::sampling::Sampling;

    /// Sampled piece by piece, whatever lies in the room from the piece before, the picture is that of
    /// the whole buffer.
    #[test]
    fn pieces_show_what_the_whole_buffer_shows() {
        let frame = Image::<3>::by_rows(230, 300, |y, row| {
            for (x, pixel) in row.iter_mut().enumerate() {
                let noise = ((y * 230 + x) as u32).wrapping_mul(2_654_435_761);
                *pixel = [0, 8, 16].map(|shift| ((noise >> shift) & 255) as f32 / 255.0);
            }
        });
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(60.0) };
        let view = spec.resolve(230, 300).unwrap().view;
        let places = SamplePlaces::new(Sampling::Point, CENTRE);
        let gazes = [[115.0, 150.0], [0.0, 128.0], [230.0, 300.0], [99.5, 127.5], [12.3, 255.0]];
        for gaze in gazes {
            let setting = Setting::new(&view, gaze).unwrap();
            let reach = setting.corner_px();
            for (columns, power) in [(1, 1.0), (2, 1.0), (150, 0.5), (700, 0.7), (90, 2.0)] {
                let n = columns as f64;
                let column = |r: f64| n * (r / reach).min(1.0).powf(power);
                let distance = |u: f64| reach * (u / n).powf(1.0 / power);
                for rows in [1.0, 30.0, 2000.0] {
                    let rows = |r: f64| 1 + (rows * (r / 40.0).min(1.0)) as usize;
                    let buffer = Ragged::new(columns, &setting, places, distance, rows);
                    let view = PolarView::new(&setting, columns, f64::INFINITY, column);
                    let whole: Image<3> = view.show_values(&buffer, &buffer.sample(&frame));
                    let pieces: Image<3> = view.show(&buffer, &frame);
                    let values = |image: &Image<3>| image.pixels().as_flattened().to_vec();
                    let off =
                        values(&whole).into_iter().zip(values(&pieces)).map(|(a, b)| (a - b).abs());
                    let worst = off.fold(0.0, f32::max);
                    assert!(worst < 1e-4, "{gaze:?} {columns} {power}: {worst:e}");
                }
            }
        }
    }
}

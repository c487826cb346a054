//! KFR and LaFR: a buffer of w x h over the logarithm of the distance and the direction from the gaze
//! (VaFR, Eq. 14-17). Columns are distances, rows directions.
//!
//! Buffer filter: [1 2 1] / 4 along both axes. Screen filter (ours; the papers print none): a blur of
//! `factor` times the local spacing of samples in pixels less one.

use std::f64::consts::TAU;

use fovqa_methods::{Mapping, Place, Setting};
use multiversion::multiversion;

use crate::arcs::Surroundings;
use crate::blur::Blur;
use crate::counts::Counts;
use crate::fetch::{lerp, mean16};
use crate::image::Image;
use crate::offsets::Offsets;
use crate::pixels::Pixels;
use crate::radial::{Detail, Radial};
use crate::rounded::rounded;
use crate::sampling::Sampling;
use crate::split::split;
use crate::taps::{PLACES, Taps};
use crate::texel::{Texel, narrowed};
use crate::turn::turn;
use crate::value::Value;

/// Which filters are on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Filters {
    pub(crate) buffer: bool,
    /// The factor of the filter on screen.
    pub(crate) screen: Option<f64>,
}

/// A log-polar buffer of a frame and a gaze.
#[derive(Debug)]
pub(crate) struct LogPolar {
    size: [usize; 2],
    gaze_px: [f64; 2],
    sampling: Sampling,
    /// Samples whose own place is in the frame.
    on_screen: usize,
    /// Distances from the gaze of the places of each column.
    distances_px: Vec<f64>,
    /// Unit vectors of the places of each row.
    directions: Vec<[f64; 2]>,
    /// How many columns of each row pixels read.
    seen: Vec<usize>,
    /// A pixel's column coordinate.
    column: Radial,
    offsets: Offsets,
    buffer_filter: bool,
    screen_filter: Option<Blur>,
}

impl LogPolar {
    /// A method whose columns are a function of the distance from the gaze.
    pub(crate) fn new(
        mapped: &(impl Mapping + Sync),
        setting: &Setting,
        sampling: Sampling,
        filters: Filters,
    ) -> Self {
        let ideal = mapped.buffer(0);
        let size = ideal.map(rounded);
        let [w, h] = size.map(|n| n as f64);
        let distance = |u: f64| mapped.to_screen(0, [u * ideal[0] / w, 0.0]).radius_px;
        let u = |r: f64| {
            let place = Place { radius_px: r, direction: [1.0, 0.0] };
            mapped.to_buffer(0, place)[0] * w / ideal[0]
        };
        let direction = |v: f64| Place::polar(1.0, v / h * 360.0).direction;
        let reach = setting.corner_px();
        let offsets = Offsets::new(setting);
        let screen_filter = filters.screen.map(|factor| {
            let width_px = |r: f64| {
                let u = u(r).clamp(0.5, w - 0.5);
                let along = distance(u + 0.5) - distance(u - 0.5);
                let spacing = (along * TAU * r.max(1.0) / h).sqrt();
                (factor * (spacing - 1.0)).max(0.0)
            };
            Blur::new(Radial::new(Detail::Coarse, reach, width_px))
        });
        let columns: Vec<f64> = Sampling::Point.coordinates(size[0]).map(distance).collect();
        let frame = Surroundings::frame(setting);
        // A pixel is less than a row away across the line to the gaze.
        let around = frame.widened(1.01 * reach * TAU / h + 1.0);
        let seen_in = |direction: [f64; 2]| {
            let within = around.border_px(direction);
            let behind = columns.partition_point(|distance| *distance <= within) + 2;
            behind.min(size[0])
        };
        Self {
            size,
            gaze_px: setting.gaze_px(),
            sampling,
            on_screen: columns.iter().map(|distance| frame.count(*distance, size[1])).sum(),
            seen: Sampling::Point.coordinates(size[1]).map(direction).map(seen_in).collect(),
            distances_px: sampling.coordinates(size[0]).map(distance).collect(),
            directions: sampling.coordinates(size[1]).map(direction).collect(),
            column: Radial::new(Detail::Coarse, reach, u),
            offsets,
            buffer_filter: filters.buffer,
            screen_filter,
        }
    }

    pub(crate) fn counts(&self) -> Counts {
        let [w, h] = self.size;
        let samples_on_screen = self.on_screen as f64;
        Counts { samples_on_screen, ..Counts::on_screen(vec![[w, h]], (w * h) as f64) }
    }

    /// The buffer of a frame, with its own filter where that is on.
    pub(crate) fn buffer<const C: usize, const L: usize>(
        &self,
        frame: &impl Pixels<C>,
    ) -> Image<L> {
        let [w, h] = self.size;
        let buffer = Image::by_rows(w, h, |j, row| self.sample_row(frame, j, row));
        if self.buffer_filter { smoothed(&buffer) } else { buffer }
    }

    /// The samples of row `j`, from the gaze on.
    fn sample_row<const C: usize, const L: usize>(
        &self,
        frame: &impl Pixels<C>,
        j: usize,
        row: &mut [[f32; L]],
    ) {
        let [gx, gy] = self.gaze_px;
        match self.sampling {
            Sampling::Point => {
                let [x, y] = self.directions[j];
                let (mut xs, mut ys) = (Taps::new(), Taps::new());
                for (out, distances) in row.chunks_mut(PLACES).zip(self.distances_px.chunks(PLACES))
                {
                    xs.set(gx, x, distances, frame.width());
                    ys.set(gy, y, distances, frame.height());
                    for (i, out) in out.iter_mut().enumerate() {
                        *out = narrowed(frame.fetch(xs.get(i), ys.get(i)));
                    }
                }
            }
            Sampling::Area => {
                let directions = &self.directions[4 * j..4 * j + 4];
                for (out, distances) in row.iter_mut().zip(self.distances_px.chunks_exact(4)) {
                    *out = narrowed(mean16(|p, q| {
                        let ([x, y], distance) = (directions[q], distances[p]);
                        frame.at_place(gx + distance * x, gy + distance * y)
                    }));
                }
            }
        }
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, frame: &impl Pixels<C>) -> Image<C, V> {
        let [w, h] = self.size;
        let buffer: Image<4> = if self.buffer_filter {
            self.buffer(frame)
        } else {
            Image::by_rows(w, h, |j, row| self.sample_row(frame, j, &mut row[..self.seen[j]]))
        };
        match &self.screen_filter {
            Some(blur) => V::keep(blur.apply(&self.read_all(&buffer), &self.offsets)),
            None => self.read_all(&buffer),
        }
    }

    /// What all pixels read in a buffer.
    fn read_all<const C: usize, V: Value>(&self, buffer: &Image<4>) -> Image<C, V> {
        let (width, height) = (self.offsets.width(), self.offsets.height());
        let room = || vec![At::default(); width];
        Image::by_rows_with(width, height, room, |places, y, out| {
            let dy = self.offsets.y[y];
            coordinates(&self.column, &self.offsets.x, dy, self.size, places);
            for (out, place) in out.iter_mut().zip(places) {
                *out = narrowed(self.read(buffer, *place));
            }
        })
    }

    /// The buffer at a place.
    #[inline(always)]
    fn read(&self, buffer: &Image<4>, place: At) -> Texel {
        let [w, h] = self.size;
        let (i, j) = (place.column as usize, place.row as usize);
        let next = usize::from(w > 1);
        let upper = j * w + i;
        let lower = if j + 1 == h { i } else { upper + w };
        let pixels = buffer.pixels();
        let along = |at: usize| {
            let pair = &pixels[at..=at + next];
            lerp(pair[0], pair[next], place.t)
        };
        lerp(along(upper), along(lower), place.s)
    }
}

/// Where a pixel reads the buffer.
#[derive(Debug, Clone, Copy, Default)]
struct At {
    /// A column with a next one, where there are two, and how far behind it.
    column: u32,
    t: f32,
    /// A row, and how far behind it.
    row: u32,
    s: f32,
}

/// Where a row of pixels reads the buffer: columns clamped, rows wrapped.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn coordinates(column: &Radial, xs: &[f32], dy: f32, size: [usize; 2], places: &mut [At]) {
    let (last, rows) = ((size[0] - 1) as f32, size[1] as f32);
    let most = size[0].saturating_sub(2) as f32;
    // Two loops: the one without a table works on many pixels at once.
    for (dx, place) in xs.iter().zip(&mut *places) {
        let row = turn(*dx, dy) * rows - 0.5;
        let row = if row < 0.0 { row + rows } else { row };
        (place.row, place.s) = split(if row >= rows { 0.0 } else { row });
    }
    for (dx, place) in xs.iter().zip(places) {
        let at = (column.at(dx * dx + dy * dy) - 0.5).max(0.0).min(last);
        let (whole, t) = split(at.min(most));
        (place.column, place.t) = (whole, t + (at - at.min(most)));
    }
}

/// [1 2 1] / 4 along columns, whose ends go on, and along rows, which are wrapped.
fn smoothed<const C: usize>(buffer: &Image<C>) -> Image<C> {
    let (w, h) = (buffer.width(), buffer.height());
    let weigh = |a: [f32; C], b: [f32; C], c: [f32; C]| lerp(b, lerp(a, c, 0.5), 0.5);
    let along = Image::by_rows(w, h, |j, out| {
        let row = buffer.row(j);
        for (i, out) in out.iter_mut().enumerate() {
            *out = weigh(row[i.saturating_sub(1)], row[i], row[(i + 1).min(w - 1)]);
        }
    });
    Image::by_rows(w, h, |j, out| {
        let rows = [(j + h - 1) % h, j, (j + 1) % h].map(|j| along.row(j));
        for (i, out) in out.iter_mut().enumerate() {
            *out = weigh(rows[0][i], rows[1][i], rows[2][i]);
        }
    })
}

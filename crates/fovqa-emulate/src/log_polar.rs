//! KFR and LaFR: a buffer of w x h over the logarithm of the distance and the direction from the gaze
//! (VaFR, Eq. 14-17). Columns are distances, rows directions.
//!
//! Buffer filter: [1 2 1] / 4 along both axes. Screen filter (ours; the papers print none): a blur of
//! `factor` times the local spacing of samples in pixels less one.

use std::f64::consts::TAU;

use fovqa_methods::{Mapping, Place, Setting};
use multiversion::multiversion;

use crate::blur::Blur;
use crate::counts::Counts;
use crate::fetch::{lerp, mean16};
use crate::image::Image;
use crate::offsets::Offsets;
use crate::places::{in_frame, place};
use crate::radial::{Detail, Radial};
use crate::rounded::rounded;
use crate::sampling::Sampling;
use crate::texel::{Texel, narrowed, widened};
use crate::turn::turn;

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
    setting: Setting,
    sampling: Sampling,
    /// Samples whose own place is in the frame.
    on_screen: usize,
    /// Distances from the gaze of the places of each column.
    distances_px: Vec<f64>,
    /// Unit vectors of the places of each row.
    directions: Vec<[f64; 2]>,
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
        let rows = Sampling::Point.coordinates(size[1]).map(direction);
        let in_row = |direction| {
            let at = |distance: &&f64| in_frame(setting, place(setting, **distance, direction));
            columns.iter().filter(at).count()
        };
        Self {
            size,
            setting: *setting,
            sampling,
            on_screen: rows.map(in_row).sum(),
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
    pub(crate) fn buffer<const C: usize, const L: usize>(&self, frame: &Image<C>) -> Image<L> {
        let [w, h] = self.size;
        let read = |distance_px: f64, direction: [f64; 2]| {
            let [x, y] = place(&self.setting, distance_px, direction);
            widened(frame.at(x, y))
        };
        let buffer = Image::by_rows(w, h, |j, row| match self.sampling {
            Sampling::Point => {
                for (out, distance) in row.iter_mut().zip(&self.distances_px) {
                    *out = read(*distance, self.directions[j]);
                }
            }
            Sampling::Area => {
                let directions = &self.directions[4 * j..4 * j + 4];
                for (out, distances) in row.iter_mut().zip(self.distances_px.chunks_exact(4)) {
                    *out = mean16(|p, q| read(distances[p], directions[q]));
                }
            }
        });
        if self.buffer_filter { smoothed(&buffer) } else { buffer }
    }

    pub(crate) fn show<const C: usize>(&self, frame: &Image<C>) -> Image<C> {
        let buffer: Image<4> = self.buffer(frame);
        let width = frame.width();
        let shown = Image::by_blocks(width, frame.height(), |rows, pixels| {
            let (mut us, mut vs) = (vec![0.0; width], vec![0.0; width]);
            for (y, out) in rows.zip(pixels.chunks_exact_mut(width)) {
                let dy = self.offsets.y[y];
                coordinates(&self.column, &self.offsets.x, dy, self.size, &mut us, &mut vs);
                for ((out, u), v) in out.iter_mut().zip(&us).zip(&vs) {
                    *out = narrowed(self.read(&buffer, *u, *v));
                }
            }
        });
        match &self.screen_filter {
            Some(blur) => blur.apply(&shown, &self.offsets),
            None => shown,
        }
    }

    /// The buffer at columns and rows less 0.5, both from 0 to below their number.
    #[inline(always)]
    fn read(&self, buffer: &Image<4>, u: f32, v: f32) -> Texel {
        let [w, h] = self.size.map(|n| n as u32);
        let (i, j) = (u as u32, v as u32);
        let next = u32::from(i + 1 < w);
        let upper = (j * w + i) as usize;
        let lower = (if j + 1 == h { i } else { (j + 1) * w + i }) as usize;
        let (t, pixels) = (u - i as f32, buffer.pixels());
        let along = |at: usize| lerp(pixels[at], pixels[at + next as usize], t);
        lerp(along(upper), along(lower), v - j as f32)
    }
}

/// Coordinates of a row of pixels in the buffer, less 0.5: columns clamped, rows wrapped.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn coordinates(
    column: &Radial,
    xs: &[f32],
    dy: f32,
    size: [usize; 2],
    us: &mut [f32],
    vs: &mut [f32],
) {
    let (last, rows) = ((size[0] - 1) as f32, size[1] as f32);
    // Two loops: the one without a table works on many pixels at once.
    for (dx, v) in xs.iter().zip(vs) {
        let row = turn(*dx, dy) * rows - 0.5;
        let row = if row < 0.0 { row + rows } else { row };
        *v = if row >= rows { 0.0 } else { row };
    }
    for (dx, u) in xs.iter().zip(us) {
        *u = (column.at(dx * dx + dy * dy) - 0.5).max(0.0).min(last);
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

//! KFR and LaFR: a buffer of w x h over the logarithm of the distance and the direction from the gaze
//! (VaFR, Eq. 14-17). Columns are distances, rows directions.
//!
//! Buffer filter: [1 2 1] / 4 along both axes. Screen filter (ours; the papers print none): a blur of
//! `factor` times the local spacing of samples in pixels less one.

use std::f64::consts::TAU;

use fovqa_methods::{Mapping, Place, Setting};

use crate::blur::Blur;
use crate::counts::Counts;
use crate::fetch::lerp;
use crate::image::Image;
use crate::polar_view::PolarView;
use crate::radial::{Detail, Radial};
use crate::ragged::Ragged;
use crate::rounded::rounded;
use crate::sample_places::SamplePlaces;
use crate::source::Source;
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
    buffer: Ragged,
    view: PolarView,
    on_screen: usize,
    buffer_filter: bool,
    screen_filter: Option<Blur>,
}

impl LogPolar {
    /// A method whose columns are a function of the distance from the gaze.
    pub(crate) fn new(
        mapped: &(impl Mapping + Sync),
        setting: &Setting,
        places: SamplePlaces,
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
        let screen_filter = filters.screen.map(|factor| {
            let width_px = |r: f64| {
                let u = u(r).clamp(0.5, w - 0.5);
                let along = distance(u + 0.5) - distance(u - 0.5);
                let spacing = (along * TAU * r.max(1.0) / h).sqrt();
                (factor * (spacing - 1.0)).max(0.0)
            };
            Blur::new(Radial::new(Detail::Coarse, setting.corner_px(), width_px))
        });
        let buffer = Ragged::new(size[0], setting, places, distance, |_| size[1]);
        Self {
            on_screen: buffer.on_screen(setting),
            buffer,
            view: PolarView::new(setting, size[0], f64::INFINITY, u),
            buffer_filter: filters.buffer,
            screen_filter,
        }
    }

    /// Where samples stand, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.buffer.positions()
    }

    pub(crate) fn counts(&self) -> Counts {
        let [w, h] = self.buffer.size();
        let samples_on_screen = self.on_screen as f64;
        Counts { samples_on_screen, ..Counts::on_screen(vec![[w, h]], (w * h) as f64) }
    }

    /// The buffer of a frame, with its own filter where that is on.
    pub(crate) fn buffer<const C: usize, const L: usize>(
        &self,
        source: &impl Source<C>,
    ) -> Image<L> {
        let buffer = self.buffer.image(&source.sample_polar(&self.buffer));
        if self.buffer_filter { smoothed(&buffer) } else { buffer }
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        match &self.screen_filter {
            Some(blur) => blur.apply(&self.unblurred(source), &self.view.offsets).kept(),
            None => self.unblurred(source),
        }
    }

    fn unblurred<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        if !self.buffer_filter {
            return source.show_polar(&self.view, &self.buffer);
        }
        let smoothed: Image<4> = self.buffer(source);
        let values = self.buffer.fill(|column, out| {
            for (j, out) in out.iter_mut().enumerate() {
                *out = smoothed.row(j)[column.index];
            }
        });
        self.view.show_values(&self.buffer, &values)
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

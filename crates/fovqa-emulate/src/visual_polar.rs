//! Visual-Polar space, a reconstruction: a polar buffer as dense as acuity, with square samples inside
//! 5.79° (Koskela et al. 2019).

use fovqa_methods::visual_polar::{Params, VisualPolar as Mapped};
use fovqa_methods::{Mapping, Place, Setting};

use crate::counts::Counts;
use crate::image::Image;
use crate::polar_view::PolarView;
use crate::ragged::Ragged;
use crate::rounded::rounded;
use crate::sample_places::SamplePlaces;
use crate::source::Source;
use crate::value::Value;

/// Visual-Polar of a frame and a gaze.
#[derive(Debug)]
pub(crate) struct VisualPolar {
    buffer: Ragged,
    view: PolarView,
    counts: Counts,
}

impl VisualPolar {
    pub(crate) fn new(params: Params, setting: &Setting, places: SamplePlaces) -> Self {
        let mapped = Mapped::new(&params, setting);
        let ideal = mapped.buffer(0)[0];
        let n = rounded(ideal);
        let stretch = n as f64 / ideal;
        let distance = |column: f64| mapped.to_screen(0, [column / stretch, 0.0]).radius_px;
        let rows = |r: f64| rounded(mapped.rows_at(r));
        let buffer = Ragged::new(n, setting, places, distance, rows);
        let view = PolarView::new(setting, n, f64::INFINITY, |r| {
            mapped.to_buffer(0, Place { radius_px: r, direction: [1.0, 0.0] })[0] * stretch
        });
        let samples: usize = buffer.columns().iter().map(|column| column.rows).sum();
        let counts = Counts {
            samples_on_screen: buffer.on_screen(setting) as f64,
            ..Counts::on_screen(vec![buffer.size()], samples as f64)
        };
        Self { buffer, view, counts }
    }

    /// Where samples stand, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.buffer.positions()
    }

    pub(crate) fn counts(&self) -> Counts {
        self.counts.clone()
    }

    pub(crate) fn buffer<const C: usize>(&self, source: &impl Source<C>) -> Image<C> {
        self.buffer.image(&source.sample_polar(&self.buffer))
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        source.show_polar(&self.view, &self.buffer)
    }
}

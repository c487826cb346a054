//! VaFR: a polar buffer whose columns and rows follow acuity (Zhang, Gai, Li, Eq. 3-12, 19). Buffer filter:
//! FXAA.

use fovqa_frame::Mask;
use fovqa_methods::vafr::{Beyond, FIELD_DEG, Params, Vafr as Mapped};
use fovqa_methods::{Foveation, Mapping, MethodError, Place, Setting};

use crate::counts::Counts;
use crate::fxaa::Fxaa;
use crate::image::Image;
use crate::polar_view::PolarView;
use crate::ragged::Ragged;
use crate::rounded::rounded;
use crate::sample_places::SamplePlaces;
use crate::source::Source;
use crate::sums::count_on;
use crate::value::Value;

/// VaFR of a frame and a gaze.
#[derive(Debug)]
pub(crate) struct Vafr {
    buffer: Ragged,
    view: PolarView,
    counts: Counts,
    shaded_share: f64,
    filter: Option<Fxaa>,
}

impl Vafr {
    pub(crate) fn new(
        params: &Params,
        setting: &Setting,
        places: SamplePlaces,
        filter: Option<Fxaa>,
    ) -> Result<Self, MethodError> {
        let mapped = Mapped::new(params, setting)?;
        let ideal = mapped.buffer(0)[0];
        let n = rounded(ideal);
        let stretch = n as f64 / ideal;
        let distance = |column: f64| mapped.to_screen(0, [column / stretch, 0.0]).radius_px;
        let rows = |r: f64| rounded(mapped.rows_at(setting.eccentricity_deg(r)));
        let buffer = Ragged::new(n, setting, places, distance, rows);
        let reach_px = match params.beyond {
            Beyond::Black => setting.radius_px(FIELD_DEG),
            Beyond::Extend | Beyond::Clamp => f64::INFINITY,
        };
        let view = PolarView::new(setting, n, reach_px, |r| {
            mapped.to_buffer(0, Place { radius_px: r, direction: [1.0, 0.0] })[0] * stretch
        });
        let shaded_share = mapped.shaded_share();
        let counts = counts(&buffer, setting, shaded_share);
        Ok(Self { buffer, view, counts, shaded_share, filter })
    }

    /// Where samples stand, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.buffer.positions()
    }

    pub(crate) fn counts(&self) -> Counts {
        self.counts.clone()
    }

    /// Samples on the pixels of a mask, of which a share is shaded.
    pub(crate) fn samples_on(&self, mask: &Mask) -> f64 {
        count_on(mask, self.positions()) as f64 * self.shaded_share
    }

    /// The buffer of a frame, with its own filter where that is on.
    pub(crate) fn buffer<const C: usize>(&self, source: &impl Source<C>) -> Image<C> {
        let values = source.sample_polar(&self.buffer);
        self.buffer.image(&match &self.filter {
            Some(filter) => filter.apply(&self.buffer, &values),
            None => values,
        })
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        match &self.filter {
            Some(filter) => {
                let values = filter.apply(&self.buffer, &source.sample_polar(&self.buffer));
                self.view.show_values(&self.buffer, &values)
            }
            None => source.show_polar(&self.view, &self.buffer),
        }
    }
}

/// Samples up to 60° and beyond, of which a share is shaded.
fn counts(buffer: &Ragged, setting: &Setting, shaded: f64) -> Counts {
    let (mut within, mut beyond) = (0, 0);
    for column in buffer.columns() {
        if setting.eccentricity_deg(column.distance_px) <= FIELD_DEG {
            within += column.rows;
        } else {
            beyond += column.rows;
        }
    }
    Counts {
        buffers: vec![buffer.size()],
        samples: within as f64 * shaded,
        samples_on_screen: buffer.on_screen(setting) as f64 * shaded,
        samples_beyond: beyond as f64 * shaded,
        quads: None,
        buffer_quads: None,
    }
}

//! Guenter's three layers: squares around the gaze, each coarser than the one inside, blended before each
//! bound (Guenter et al. 2012).

use std::ops::Range;

use fovqa_methods::guenter::{Guenter as Mapped, Params};
use fovqa_methods::{MethodError, Setting};

use crate::borders::{Border, circle};
use crate::counts::Counts;
use crate::fetch::lerp;
use crate::image::Image;
use crate::offsets::Offsets;
use crate::radial::{Detail, Radial};
use crate::rounded::rounded;
use crate::sample_places::SamplePlaces;
use crate::separable::{Axis, Separable};
use crate::source::Source;
use crate::value::Value;

#[derive(Debug)]
struct Layer {
    /// The rectangle of whole pixels it covers.
    columns: Range<usize>,
    rows: Range<usize>,
    buffer: Separable,
    /// Whether it has as many samples as pixels.
    is_one_to_one: bool,
}

/// Where a layer gives way to the next one.
#[derive(Debug)]
struct Bound {
    radius_px: f64,
    /// Weight of the coarser layer; `None` for a hard bound.
    weight: Option<Radial>,
}

/// Three layers of a frame and a gaze.
#[derive(Debug)]
pub(crate) struct Guenter {
    layers: [Layer; 3],
    bounds: [Bound; 2],
    offsets: Offsets,
}

impl Guenter {
    pub(crate) fn new(
        params: &Params,
        setting: &Setting,
        places: SamplePlaces,
    ) -> Result<Self, MethodError> {
        let mapped = Mapped::new(params, setting)?;
        let (size, gaze) = (setting.size_px(), setting.gaze_px());
        let radii_px = mapped.bounds_deg().map(|e| setting.radius_px(e));
        let layers = [0, 1, 2].map(|k: usize| {
            let extent = |axis: usize| match radii_px.get(k) {
                Some(radius) => {
                    let from = (gaze[axis] - radius).floor().max(0.0);
                    let to = (gaze[axis] + radius).ceil().min(size[axis]);
                    from as usize..to as usize
                }
                None => 0..size[axis] as usize,
            };
            Layer::new([extent(0), extent(1)], size, mapped.scales()[k], places)
        });
        let transition_deg = params.transition_deg;
        let bounds = [0, 1].map(|k: usize| {
            let bound_deg = mapped.bounds_deg()[k];
            let weight = |r: f64| {
                let e = setting.eccentricity_deg(r);
                let t = ((e - bound_deg + transition_deg) / transition_deg).clamp(0.0, 1.0);
                t * t * (3.0 - 2.0 * t)
            };
            let weight = (transition_deg > 0.0)
                .then(|| Radial::new(Detail::Fine, setting.corner_px(), weight));
            Bound { radius_px: radii_px[k], weight }
        });
        Ok(Self { layers, bounds, offsets: Offsets::new(setting) })
    }

    /// Where samples of all layers stand, the innermost first, in pixels.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.layers.iter().flat_map(|layer| layer.buffer.positions())
    }

    /// The circles within which a pixel shows the inner layers.
    pub(crate) fn borders(&self) -> Vec<Border> {
        let gaze = self.offsets.gaze_px();
        self.bounds.iter().filter_map(|bound| circle(gaze, bound.radius_px)).collect()
    }

    pub(crate) fn counts(&self) -> Counts {
        let buffers: Vec<[usize; 2]> = self.layers.iter().map(Layer::size).collect();
        let samples = buffers.iter().map(|[w, h]| w * h).sum::<usize>();
        Counts::rectangular(buffers, samples as f64)
    }

    pub(crate) fn buffers<const C: usize>(&self, source: &impl Source<C>) -> Vec<Image<C>> {
        self.layers.iter().map(|layer| layer.sample(source)).collect()
    }

    pub(crate) fn show<const C: usize, V: Value>(&self, source: &impl Source<C>) -> Image<C, V> {
        // `None` where the frame's own pixels are the samples.
        let sample = |layer: &Layer| {
            let are_pixels = layer.is_one_to_one && source.has_pixels(layer.buffer.places);
            (!are_pixels).then(|| source.sample_grid(&layer.buffer))
        };
        let buffers: Vec<Option<Image<4>>> = self.layers.iter().map(sample).collect();
        let (width, height) = (self.offsets.width(), self.offsets.height());
        let room = || (Vec::new(), vec![[0.0; C]; width]);
        Image::by_rows_with(width, height, room, |(scratch, finer), y, out| {
            let mut read = |k: usize, xs: Range<usize>, out: &mut [[f32; C]]| {
                let layer = &self.layers[k].buffer;
                match &buffers[k] {
                    Some(buffer) => layer.read_row(buffer, y, xs, scratch, out),
                    None => source.sample_pixels(layer.places, y, xs, out),
                }
            };
            read(2, 0..width, out);
            for k in [1, 0] {
                let xs = self.offsets.within(y, self.bounds[k].radius_px);
                if xs.is_empty() {
                    continue;
                }
                let (out, finer) = (&mut out[xs.clone()], &mut finer[..xs.len()]);
                read(k, xs.clone(), finer);
                self.blend(k, y, xs, finer, out);
            }
        })
    }

    /// Puts a finer layer over the pixels `xs` of row `y`.
    fn blend<const C: usize>(
        &self,
        k: usize,
        y: usize,
        xs: Range<usize>,
        finer: &[[f32; C]],
        out: &mut [[f32; C]],
    ) {
        match &self.bounds[k].weight {
            None => out.copy_from_slice(finer),
            Some(weight) => {
                let squares = self.offsets.squares(y, xs);
                for ((out, finer), square) in out.iter_mut().zip(finer).zip(squares) {
                    *out = lerp(*finer, *out, weight.at(square));
                }
            }
        }
    }
}

impl Layer {
    fn new(extent: [Range<usize>; 2], size: [f64; 2], scale: f64, places: SamplePlaces) -> Self {
        let [columns, rows] = extent;
        let counts = [&columns, &rows].map(|range| rounded(range.len() as f64 / scale));
        let axis = |axis: usize, range: &Range<usize>| {
            let (n, start) = (counts[axis], range.start as f64);
            let pixels = range.len() as f64 / n as f64;
            let position = |b: f64| start + b * pixels;
            Axis::new(n, size[axis] as usize, places.axis(axis), position, |x| (x - start) / pixels)
        };
        let buffer = Separable::new(axis(0, &columns), axis(1, &rows), places);
        let is_one_to_one = counts == [columns.len(), rows.len()];
        Self { columns, rows, buffer, is_one_to_one }
    }

    fn size(&self) -> [usize; 2] {
        self.buffer.size()
    }

    fn sample<const C: usize>(&self, source: &impl Source<C>) -> Image<C> {
        let places = self.buffer.places;
        if !(self.is_one_to_one && source.has_pixels(places)) {
            return source.sample_grid(&self.buffer);
        }
        Image::by_rows(self.columns.len(), self.rows.len(), |j, row| {
            source.sample_pixels(places, self.rows.start + j, self.columns.clone(), row);
        })
    }
}

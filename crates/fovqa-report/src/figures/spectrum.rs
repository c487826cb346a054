//! The power spectrum against spatial frequency, one panel per band: one line per method, with a dashed
//! line for the reference.

use fovqa_plot::{Axis, Figure, LineChart, LineSeries, PanelChart};

use super::Selection;
use super::compared::{COLUMNS, Shown};
use crate::overview::{SpectrumBand, SpectrumPoint};

impl Selection<'_> {
    /// The spectra of a scene; `None` if it has none.
    pub(super) fn spectrum(&self, scene: &str, shown: Shown) -> Option<Figure> {
        let found = self.methods.iter().filter_map(|(method, look)| {
            let measured = self.source.overview.of(scene, method)?;
            Some((*method, *look, &*measured.spectrum))
        });
        let found: Vec<_> = found.filter(|(.., bands)| !bands.is_empty()).collect();
        let (.., bands) = found.first()?;
        let test = |point: &SpectrumPoint| match shown {
            Shown::Values => point.test(),
            Shown::Ratio => point.ratio(),
        };
        let reference = |point: &SpectrumPoint| match shown {
            Shown::Values => point.reference(),
            Shown::Ratio => Some(1.0),
        };
        let panel = |band: &SpectrumBand| {
            let same = |of: &&SpectrumBand| of.edges() == band.edges();
            let of_methods = found.iter().filter_map(|(method, look, bands)| {
                let points = points(bands.iter().find(same)?, test);
                let name = (*method).to_owned();
                Some(LineSeries { name, look: *look, points, ..LineSeries::default() })
            });
            let reference = LineSeries {
                name: "reference".to_owned(),
                reference: true,
                points: points(band, reference),
                ..LineSeries::default()
            };
            // The reference is drawn last, because the other lines might hide it.
            let series = of_methods.chain([reference]).collect();
            let (from, to) = (band.from_deg, band.to_deg);
            let y = Axis::new(match shown {
                Shown::Values => "Power density (luma²/cpd²)",
                Shown::Ratio => "Power (test / reference)",
            });
            LineChart {
                title: Some(format!("{from}° to {to}°")),
                x: Axis { log: true, ..Axis::new("Spatial frequency (cpd)") },
                y: Axis { log: true, ..y },
                series,
                ..LineChart::default()
            }
        };
        let mut panels: Vec<LineChart> =
            bands.iter().filter(|band| !band.points.is_empty()).map(panel).collect();
        align(&mut panels);
        let title = self.title(scene);
        (!panels.is_empty()).then_some(Figure::Panels(PanelChart {
            title,
            panels,
            columns: COLUMNS,
        }))
    }
}

/// Values below this share of the largest one are cut off.
const SMALLEST_SHARE: f64 = 1e-8;

/// Markers at the ends of the frequency axis are whole with this factor.
const MARGIN: f64 = 1.25;

/// Gives all panels the same axes, so that bands can be compared.
fn align(panels: &mut [LineChart]) {
    let points = || panels.iter().flat_map(|panel| &panel.series).flat_map(|line| &line.points);
    let extent = |values: &mut dyn Iterator<Item = f64>| {
        let above_0 = values.filter(|value| *value > 0.0 && value.is_finite());
        above_0.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), value| {
            (low.min(value), high.max(value))
        })
    };
    let (first, last) = extent(&mut points().map(|(cpd, _)| *cpd));
    let (low, high) = extent(&mut points().filter_map(|(_, value)| *value));
    for LineChart { x, y, .. } in panels {
        (x.min, x.max) = (Some(first / MARGIN), Some(last * MARGIN));
        (y.min, y.max) = (Some(0.5 * low.max(high * SMALLEST_SHARE)), Some(2.0 * high));
    }
}

/// The values of a band by frequency.
fn points(
    band: &SpectrumBand,
    value: impl Fn(&SpectrumPoint) -> Option<f64>,
) -> Vec<(f64, Option<f64>)> {
    band.points.iter().map(|point| (point.cpd, value(point))).collect()
}

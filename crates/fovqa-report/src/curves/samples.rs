//! Where the samples of a method lie on the screen, and how many there are.

use fovqa_methods::curves::{Curve, CurveSetting, CurveSource};
use fovqa_methods::{Mapping, Method, Place};
use fovqa_plan::{CurvePlot, PanelOf};
use fovqa_plot::{Axis, BarChart, BarSeries, Figure, RasterChart, RasterPanel};

use super::Source;
use super::labels::{Labels, resolution, screen};
use super::looks::Looks;
use super::picture::{gaze_of, rings};
use super::tables::alike;
use crate::sheet::{NamedFigure, ReportError};

/// The number of samples that are drawn in a panel, about.
const DOTS: f64 = 1500.0;
/// How exactly a sample is found again from its place on the screen, in samples. Samples that are
/// not are those of rows that a column does not have.
const AGAIN: f64 = 1e-6;

/// The positions of samples: every n-th column and row of each buffer.
pub(super) fn positions(source: &Source<'_>, plot: &CurvePlot) -> Result<NamedFigure, ReportError> {
    let mut curves = source.chosen(plot.curves.as_deref());
    curves.retain(|curve| curve.counts.is_some());
    let curves = alike(curves);
    let labels = Labels::of(&curves);
    let mut panels: Vec<RasterPanel> = Vec::new();
    for curve in curves {
        let CurveSource::Method { method, setting } = &curve.spec.source else { continue };
        let title = labels.title(curve, PanelOf::Curve);
        let failed = |error| ReportError::Curve { name: title.clone(), error };
        let Some((dots, each)) = dots(method, setting).map_err(failed)? else { continue };
        let (width, height) = (setting.view.width as f64, setting.view.height as f64);
        panels.push(RasterPanel {
            title: Some(format!("{title}: every {} column and row", ordinal(each))),
            x: Axis::new("x (px)"),
            y: Axis::new("y (px)"),
            x_range: (0.0, width),
            y_range: (0.0, height),
            lines: rings(plot, setting),
            cross: Some(gaze_of(setting)),
            dots,
            ..RasterPanel::default()
        });
    }
    let columns = if panels.len() <= 4 { 2 } else { 3 };
    let figure = Figure::Raster(RasterChart {
        title: plot.title.clone(),
        panels,
        columns,
        ..RasterChart::default()
    });
    let name = plot.name.clone().unwrap_or_else(|| "samples".to_owned());
    let caption = plot.title.clone().unwrap_or_else(|| "Positions of the samples".to_owned());
    Ok(NamedFigure::new(name, format!("{caption}; rings of equal eccentricity"), figure))
}

/// "12th".
fn ordinal(n: usize) -> String {
    let ending = match (n % 10, n % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    format!("{n}{ending}")
}

type Dots = (Vec<(f64, f64)>, usize);

/// The places of every n-th sample within the frame, and n. `None` if the method has no buffer.
fn dots(
    method: &Method,
    setting: &CurveSetting,
) -> Result<Option<Dots>, fovqa_methods::curves::CurveError> {
    let over = setting.setting()?;
    let foveation = method.apply(&over)?;
    let Some(mapping) = foveation.mapping() else { return Ok(None) };
    let each = (foveation.counts().samples / DOTS).sqrt().ceil().max(1.0);
    let gaze = over.gaze_px();
    let size = [setting.view.width as f64, setting.view.height as f64];
    let mut found = Vec::new();
    for layer in 0..mapping.layers() {
        let counts = mapping.buffer(layer).map(|side| (side / each).floor() as u32);
        for row in 0..=counts[1] {
            for column in 0..=counts[0] {
                let at = [column, row].map(|i| f64::from(i) * each + 0.5);
                if let Some(place) = seen(mapping, layer, at) {
                    let offset = place.offset_px();
                    let (x, y) = (gaze[0] + offset[0], gaze[1] + offset[1]);
                    if (0.0..=size[0]).contains(&x) && (0.0..=size[1]).contains(&y) {
                        found.push((x, y));
                    }
                }
            }
        }
    }
    Ok(Some((found, each as usize)))
}

/// The place of a sample, if its layer is the one that is seen there.
fn seen(mapping: &dyn Mapping, layer: usize, at: [f64; 2]) -> Option<Place> {
    let place = mapping.to_screen(layer, at);
    let again = mapping.to_buffer(layer, place);
    let same = (0..2).all(|i| (again[i] - at[i]).abs() < AGAIN * mapping.buffer(layer)[i].max(1.0));
    (same && mapping.layer_at(place) == layer).then_some(place)
}

/// Numbers of samples as bars, in groups by resolution.
pub(super) fn bars(source: &Source<'_>, plot: &CurvePlot) -> NamedFigure {
    let mut curves = source.chosen(plot.curves.as_deref());
    curves.retain(|curve| curve.counts.is_some());
    let curves = alike(curves);
    let labels = Labels::of(&curves);
    let looks = Looks::of(source, &curves, &labels, PanelOf::Resolution);
    let mut groups: Vec<String> = Vec::new();
    let mut series: Vec<(&Curve, String)> = Vec::new();
    for curve in &curves {
        let size = screen(curve).map(resolution).unwrap_or_default();
        if !groups.contains(&size) {
            groups.push(size);
        }
        let row = labels.row(curve);
        if !series.iter().any(|(_, known)| *known == row) {
            series.push((curve, row));
        }
    }
    let value = |row: &str, size: &String| {
        let here = |curve: &&&Curve| {
            labels.row(curve) == row && screen(curve).map(resolution).as_ref() == Some(size)
        };
        let found = curves.iter().find(here).and_then(|curve| curve.counts.as_ref());
        found.map(|counts| counts.whole() / 1000.0)
    };
    let series = series.iter().map(|(curve, row)| BarSeries {
        name: row.clone(),
        look: looks.look(&curve.spec.name, &labels.label(curve, PanelOf::Resolution)),
        values: groups.iter().map(|size| value(row, size)).collect(),
        ..BarSeries::default()
    });
    let figure = Figure::Bar(BarChart {
        title: plot.title.clone(),
        y: Axis { log: plot.log, ..Axis::new("Samples per frame and eye (thousands)") },
        series: series.collect(),
        groups: groups.clone(),
        ..BarChart::default()
    });
    let name = plot.name.clone().unwrap_or_else(|| "samples-bars".to_owned());
    let caption = plot.title.clone().unwrap_or_else(|| "Samples per frame and eye".to_owned());
    NamedFigure::new(name, caption, figure)
}

//! Samples per pixel over the field of view, as an image with rings of equal eccentricity.

use fovqa_methods::Place;
use fovqa_methods::curves::{CurveSetting, CurveSource, density_map};
use fovqa_plan::{CurvePlot, DensityStyle, PanelOf};
use fovqa_plot::{Axis, Figure, RasterChart, RasterLine, RasterPanel};
use fovqa_vision::{PixelScale, Tangential};

use super::Source;
use super::contours::contours;
use super::labels::Labels;
use super::tables::alike;
use crate::sheet::{NamedFigure, ReportError};

/// Number of cells along the longer side of the frame. This is fine enough for a panel in print,
/// and the data file is small enough to open.
const CELLS: usize = 240;
/// Up to this number of images, each is large enough for that resolution. If there are more, each
/// is small.
const FEW: usize = 6;
/// Angle in degrees between neighbouring points of a ring.
const RING_STEP_DEG: u32 = 2;
const RINGS_DEG: [f64; 4] = [10.0, 20.0, 40.0, 60.0];

pub(super) fn figure(source: &Source<'_>, plot: &CurvePlot) -> Result<NamedFigure, ReportError> {
    let name = plot.name.clone().unwrap_or_else(|| "density".to_owned());
    let mut curves = source.chosen(plot.curves.as_deref());
    curves.retain(|curve| curve.counts.is_some());
    // Curves that differ only in direction have the same image.
    let curves = alike(curves);
    let labels = Labels::of(&curves);
    let cells = if curves.len() <= FEW { CELLS } else { CELLS / 2 };
    let mut panels: Vec<RasterPanel> = Vec::new();
    for curve in curves {
        let CurveSource::Method { method, setting } = &curve.spec.source else { continue };
        let title = labels.title(curve, PanelOf::Curve);
        let map = density_map(method, setting, cells)
            .map_err(|error| ReportError::Curve { name: title.clone(), error })?;
        let (width, height) = (setting.view.width as f64, setting.view.height as f64);
        let lines = match plot.style {
            DensityStyle::Rings => rings(plot, setting),
            DensityStyle::Contours => contours(&map, (width, height)),
        };
        panels.push(RasterPanel {
            title: Some(title),
            x: Axis::new("x (px)"),
            y: Axis::new("y (px)"),
            x_range: (0.0, width),
            y_range: (0.0, height),
            columns: map.columns,
            rows: map.rows,
            values: map.values.iter().copied().map(short).collect(),
            lines,
            cross: Some(gaze_of(setting)),
            ..RasterPanel::default()
        });
    }
    let columns = if panels.len() <= 4 { 2 } else { 3 };
    let figure = Figure::Raster(RasterChart {
        title: plot.title.clone(),
        panels,
        columns,
        colour: Axis::new("Samples per pixel"),
        log: plot.log,
        range: None,
    });
    let caption =
        plot.title.clone().unwrap_or_else(|| "Sampling density over the field".to_owned());
    let lines = match plot.style {
        DensityStyle::Rings => "rings of equal eccentricity",
        DensityStyle::Contours => "lines of equal density, in samples per pixel",
    };
    Ok(NamedFigure::new(name, format!("{caption}; {lines}"), figure))
}

/// A value with six digits. Colours cannot show more, and the data of the figure needs only a third
/// of the bytes.
fn short(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// The gaze that the method uses if the given gaze is outside the frame.
pub(super) fn gaze_of(setting: &CurveSetting) -> (f64, f64) {
    let [x, y] = setting.gaze_px;
    (x.clamp(0.0, setting.view.width as f64), y.clamp(0.0, setting.view.height as f64))
}

/// The rings of a plot around the gaze.
pub(super) fn rings(plot: &CurvePlot, setting: &CurveSetting) -> Vec<RasterLine> {
    let given = plot.rings_deg.as_slice();
    let rings = if given.is_empty() { RINGS_DEG.as_slice() } else { given };
    let seen = CurveSetting { gaze_px: gaze_of(setting).into(), ..*setting };
    rings.iter().map(|e| ring(&seen, *e)).collect()
}

/// The ring around the gaze at an eccentricity in degrees.
fn ring(setting: &CurveSetting, e: f64) -> RasterLine {
    let [gaze_x, gaze_y] = setting.gaze_px;
    // The ring starts at the upper right, where its label does not cover the axes.
    let points = (0..=360 / RING_STEP_DEG).map(|i| {
        let direction = Place::polar(0.0, f64::from(i * RING_STEP_DEG) - 45.0).direction;
        let at = PixelScale::at(
            &setting.view,
            setting.gaze_px,
            setting.eccentricity,
            Tangential::Paper,
            direction,
            e,
        );
        let r = at.map_or(f64::NAN, |at| at.radius_px);
        (gaze_x + r * direction[0], gaze_y + r * direction[1])
    });
    RasterLine { name: format!("{e}°"), points: points.collect() }
}

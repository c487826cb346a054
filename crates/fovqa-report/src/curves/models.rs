//! Figures for a single method: DEAMP's shaded pixels within an angle (Fig. 5b), and RMFR's mapping
//! of a half axis (Fig. 3).

use fovqa_methods::Method;
use fovqa_methods::curves::CurveSource;
use fovqa_methods::deamp::Deamp;
use fovqa_methods::rmfr::half_axis as mapped;
use fovqa_plan::{CurvePlot, PanelOf};
use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look};

use super::Source;
use super::labels::Labels;
use super::looks::Looks;
use crate::sheet::NamedFigure;

/// Number of points of a curve.
const POINTS: u32 = 180;

pub(super) fn accumulated(source: &Source<'_>, plot: &CurvePlot) -> NamedFigure {
    let mut curves = source.chosen(plot.curves.as_deref());
    curves.retain(|curve| {
        matches!(curve.spec.source, CurveSource::Method { method: Method::Deamp(_), .. })
    });
    let labels = Labels::of(&curves);
    let looks = Looks::of(source, &curves, &labels, PanelOf::One);
    let mut series = Vec::new();
    for curve in curves {
        let CurveSource::Method { method: Method::Deamp(params), setting } = &curve.spec.source
        else {
            continue;
        };
        // This does not fail, because the method was already applied when the file was read.
        let Some(deamp) = setting.setting().ok().and_then(|over| Deamp::new(params, &over).ok())
        else {
            continue;
        };
        let points = (0..=POINTS).map(|i| {
            let half_deg = deamp.whole_deg() * f64::from(i) / f64::from(POINTS);
            (2.0 * half_deg, Some(100.0 * deamp.share_within(half_deg)))
        });
        series.push(LineSeries {
            look: looks.look(&curve.spec.name, &labels.label(curve, PanelOf::One)),
            name: labels.label(curve, PanelOf::One),
            points: points.collect(),
            smooth: true,
            ..LineSeries::default()
        });
    }
    let figure = Figure::Line(LineChart {
        title: plot.title.clone(),
        x: Axis::new("Full angle of the layer, in the paper's 90° frame (°)"),
        y: Axis::new("Rendered pixels (% of the frame)"),
        y_from_zero: true,
        series,
        ..LineChart::default()
    });
    named(plot, "accumulated", "Rendered pixels within a layer's angle", figure)
}

pub(super) fn half_axis(plot: &CurvePlot) -> NamedFigure {
    let line = |f: Option<f64>| {
        let points = (0..=POINTS).map(|i| {
            let d = f64::from(i) / f64::from(POINTS) * 2.0 - 1.0;
            (d, Some(f.map_or(d, |f| mapped(f, d) / mapped(f, 1.0))))
        });
        points.collect()
    };
    let mut series = vec![LineSeries {
        name: "Full".to_owned(),
        reference: true,
        points: line(None),
        ..LineSeries::default()
    }];
    series.extend(plot.f.iter().enumerate().map(|(i, &f)| LineSeries {
        name: format!("f = {f}"),
        look: Look::new(i),
        points: line(Some(f)),
        smooth: true,
        ..LineSeries::default()
    }));
    let figure = Figure::Line(LineChart {
        title: plot.title.clone(),
        x: Axis::new("In the buffer, distance from the gaze dₒ"),
        y: Axis::new("On the screen, dᵢ (normalised)"),
        series,
        ..LineChart::default()
    });
    named(plot, "half-axis", "RMFR's mapping of a half axis", figure)
}

fn named(plot: &CurvePlot, name: &str, caption: &str, figure: Figure) -> NamedFigure {
    let name = plot.name.clone().unwrap_or_else(|| name.to_owned());
    NamedFigure::new(name, plot.title.clone().unwrap_or_else(|| caption.to_owned()), figure)
}

//! Figures for a single method: DEAMP's shaded pixels within an angle (Fig. 5b), and RMFR's mapping
//! of a half axis (Fig. 3).

use fovqa_methods::Method;
use fovqa_methods::curves::{Curve, CurveSource};
use fovqa_methods::deamp::Deamp;
use fovqa_methods::guenter::Guenter;
use fovqa_methods::rmfr::half_axis as mapped;
use fovqa_methods::vafr::{FIELD_DEG, Vafr};
use fovqa_plan::{CurvePlot, PanelOf};
use fovqa_plot::{Axis, Figure, Fill, FillKind, LineChart, LineSeries, Look};

use super::Source;
use super::labels::Labels;
use super::looks::Looks;
use super::tables::alike;
use crate::sheet::NamedFigure;

/// Number of points of a curve.
const POINTS: u32 = 180;
/// Number of steps between the dots of a half axis.
const DOTS: u32 = 24;
/// Eccentricities in degrees between the dots of an outline.
const OUTLINE_STEP_DEG: f64 = 10.0;

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
    let dots = plot.f.iter().enumerate().filter(|_| plot.dots).map(|(i, &f)| {
        let place = |i: u32| f64::from(i) / f64::from(DOTS) * 2.0 - 1.0;
        LineSeries {
            name: format!("f = {f}, samples"),
            look: Look::new(i),
            dots: true,
            unlisted: true,
            points: (0..=DOTS)
                .map(|i| (place(i), Some(mapped(f, place(i)) / mapped(f, 1.0))))
                .collect(),
            ..LineSeries::default()
        }
    });
    series.extend(dots);
    let figure = Figure::Line(LineChart {
        title: plot.title.clone(),
        x: Axis::new("In the buffer, distance from the gaze dₒ"),
        y: Axis::new("On the screen, dᵢ (normalised)"),
        series,
        ..LineChart::default()
    });
    named(plot, "half-axis", "RMFR's mapping of a half axis", figure)
}

/// The scale of each layer against the angle up to which it reaches.
pub(super) fn steps(source: &Source<'_>, plot: &CurvePlot) -> NamedFigure {
    let layers = |curve: &Curve| -> Option<Vec<(f64, f64)>> {
        let CurveSource::Method { method, setting } = &curve.spec.source else { return None };
        let end_deg = source.file.plan.range.to_deg;
        match method {
            Method::Deamp(params) => {
                let layers = params.bounds_deg.iter().zip(&params.sigmas);
                Some(layers.map(|(bound, sigma)| (*bound, 1.0 / sigma)).collect())
            }
            Method::Guenter(params) => {
                let over = setting.setting().ok()?;
                let fixed = Guenter::new(params, &over).ok()?.fixed(params);
                let bounds = fixed.bounds_deg.iter().copied().chain([end_deg]);
                Some(bounds.zip(&fixed.scales).map(|(bound, scale)| (bound, 1.0 / scale)).collect())
            }
            _ => None,
        }
    };
    let mut curves = source.chosen(plot.curves.as_deref());
    curves.retain(|curve| layers(curve).is_some());
    let curves = alike(curves);
    let labels = Labels::of(&curves);
    let looks = Looks::of(source, &curves, &labels, PanelOf::One);
    let series = curves.iter().filter_map(|curve| {
        let mut points = Vec::new();
        let mut from = 0.0;
        for (to, scale) in layers(curve)? {
            points.extend([(from, Some(scale)), (to, Some(scale))]);
            from = to;
        }
        let name = labels.label(curve, PanelOf::One);
        let look = looks.look(&curve.spec.name, &name);
        Some(LineSeries { name, look, points, smooth: true, ..LineSeries::default() })
    });
    let figure = Figure::Line(LineChart {
        title: plot.title.clone(),
        x: Axis::new("Half-angle of the layer (°)"),
        y: Axis::new("Scale of the layer, 1 / σ"),
        y_from_zero: true,
        series: series.collect(),
        ..LineChart::default()
    });
    named(plot, "steps", "Scale of each layer", figure)
}

/// The outline of VaFR's buffer: the rows of each column, with a dot at every 10°.
pub(super) fn outline(source: &Source<'_>, plot: &CurvePlot) -> NamedFigure {
    let mut curves = source.chosen(plot.curves.as_deref());
    curves.retain(|curve| {
        matches!(curve.spec.source, CurveSource::Method { method: Method::Vafr(_), .. })
    });
    let curves = alike(curves);
    let labels = Labels::of(&curves);
    let looks = Looks::of(source, &curves, &labels, PanelOf::One);
    let (mut series, mut fills) = (Vec::new(), Vec::new());
    for curve in &curves {
        let CurveSource::Method { method: Method::Vafr(params), setting } = &curve.spec.source
        else {
            continue;
        };
        // This does not fail, because the method was already applied when the file was read.
        let Some(vafr) = setting.setting().ok().and_then(|over| Vafr::new(params, &over).ok())
        else {
            continue;
        };
        let name = labels.label(curve, PanelOf::One);
        let look = looks.look(&curve.spec.name, &name);
        let at = |e: f64| (vafr.columns_to(e), Some(vafr.rows_at(e)));
        let line = LineSeries {
            name: name.clone(),
            look,
            points: (0..=POINTS)
                .map(|i| at(FIELD_DEG * f64::from(i) / f64::from(POINTS)))
                .collect(),
            smooth: true,
            ..LineSeries::default()
        };
        if curves.len() == 1 {
            let points = line.points.iter().map(|(u, l)| (*u, 0.0, l.unwrap_or(f64::NAN)));
            let fill =
                Fill { name: String::new(), kind: FillKind::Band(look), points: points.collect() };
            fills.push(fill);
        }
        let steps = (FIELD_DEG / OUTLINE_STEP_DEG) as u32;
        series.push(line);
        series.push(LineSeries {
            name: format!("{name}, every {OUTLINE_STEP_DEG}°"),
            look,
            points: (0..=steps).map(|i| at(OUTLINE_STEP_DEG * f64::from(i))).collect(),
            dots: true,
            unlisted: true,
            ..LineSeries::default()
        });
    }
    let figure = Figure::Line(LineChart {
        title: plot.title.clone(),
        x: Axis::new("Column u"),
        y: Axis::new("Rows of the column, l"),
        y_from_zero: true,
        series,
        fills,
        ..LineChart::default()
    });
    let caption = "Outline of VaFR's buffer up to 60°, with dots at every 10° of eccentricity";
    named(plot, "outline", caption, figure)
}

pub(super) fn named(plot: &CurvePlot, name: &str, caption: &str, figure: Figure) -> NamedFigure {
    let name = plot.name.clone().unwrap_or_else(|| name.to_owned());
    NamedFigure::new(name, plot.title.clone().unwrap_or_else(|| caption.to_owned()), figure)
}

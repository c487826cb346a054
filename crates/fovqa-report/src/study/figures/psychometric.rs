//! Figures of psychometric functions: one panel per group.

use fovqa_plot::{Axis, Figure, Fill, FillKind, LineChart, LineSeries, Look, PanelChart, Span};
use fovqa_study::json::{Document, Group};
use fovqa_study::psychometric::{DrawnCurve, Psychometric};

use super::context::{Context, caption, group_name, parts, percent};
use super::thresholds::{Threshold, threshold};
use crate::sheet::NamedFigure;

/// The most panels of a figure.
pub(super) const MOST_PANELS: usize = 12;
/// The most figures.
pub(super) const MOST_FIGURES: usize = 4;
/// Space below and above the shares of correct answers.
const AIR: f64 = 0.03;

pub(super) fn figures(document: &Document<Psychometric>, context: &Context) -> Vec<NamedFigure> {
    let fitted = |group: &&Group<Psychometric>| group.result.drawn.is_some();
    let groups: Vec<&Group<Psychometric>> = document.groups.iter().filter(fitted).collect();
    let (parts, left) = parts(&groups, MOST_PANELS, MOST_FIGURES, "groups with a fit");
    let y = y_axis(&groups);
    let figure = |part: &[&Group<Psychometric>]| {
        let panels: Vec<LineChart> = part.iter().map(|group| panel(group, &y, context)).collect();
        let text = text(part, context, &left);
        context.figure("functions", "", (text, panel_figure(panels, 3)))
    };
    parts.into_iter().map(figure).collect()
}

/// Panels side by side, or one chart. Up to four panels are in two columns.
pub(super) fn panel_figure(mut panels: Vec<LineChart>, columns: usize) -> Figure {
    match panels.len() {
        0 => Figure::Line(LineChart::default()),
        1 => Figure::Line(panels.remove(0)),
        2..=4 => Figure::Panels(PanelChart { title: None, panels, columns: 2 }),
        _ => Figure::Panels(PanelChart { title: None, panels, columns }),
    }
}

/// The vertical axis, the same in all panels. It begins below the lowest share.
fn y_axis(groups: &[&Group<Psychometric>]) -> Axis {
    let shares = groups.iter().flat_map(|group| {
        let levels = group.result.levels.iter().map(|level| share(level.correct, level.trials));
        let points = group.result.drawn.iter().flat_map(|drawn| &drawn.points);
        levels.chain(points.map(|point| point.interval.map_or(point.performance, |[low, _]| low)))
    });
    let lowest = shares.filter(|share| share.is_finite()).fold(1.0, f64::min);
    let low = (10.0 * lowest + 1e-9).floor() / 10.0;
    let (min, max) = (Some(low.min(0.9) - AIR), Some(1.0 + AIR));
    Axis { min, max, ..Axis::new("Share of correct answers") }
}

fn share(correct: u64, trials: u64) -> f64 {
    correct as f64 / trials as f64
}

fn text(part: &[&Group<Psychometric>], context: &Context, left: &str) -> String {
    let drawn = || part.iter().filter_map(|group| group.result.drawn.as_ref());
    let has_band = drawn().any(|drawn| drawn.points.iter().any(|point| point.interval.is_some()));
    let modes = drawn().filter(|drawn| drawn.is_mode).count();
    let what = match modes {
        0 => "fitted by maximum likelihood",
        count if count == part.len() => {
            "at the mode of the posterior, because the answers do not determine the maximum-likelihood fit"
        }
        _ => {
            "fitted by maximum likelihood, or without a band at the mode of the posterior where the \
             answers do not determine that"
        }
    };
    let thresholds = || part.iter().filter_map(|group| threshold(&group.result, 0));
    let performance = thresholds().map(|threshold| threshold.performance).next();
    let dashed = performance.map(|performance| {
        let has_interval = thresholds().any(|threshold| threshold.dot.interval.is_some());
        let shaded = if has_interval {
            format!(", with its {} interval shaded", context.coverage())
        } else {
            String::new()
        };
        // The median need not be on the curve of the mode.
        let median = match thresholds().filter(|threshold| threshold.is_median).count() {
            0 => "",
            count if count == thresholds().count() => ", the median of the posterior",
            _ => ", of some panels the median of the posterior",
        };
        format!("dashed: threshold of {}{median}{shaded}", percent(performance))
    });
    caption(&[
        &format!("Psychometric functions {what}"),
        "dots: shares of correct answers at each level, whatever the number of trials",
        &if has_band {
            format!("bands: {} parametric bootstrap intervals of the function", context.coverage())
        } else {
            String::new()
        },
        dashed.as_deref().unwrap_or_default(),
        left,
    ])
}

fn panel(group: &Group<Psychometric>, y: &Axis, context: &Context) -> LineChart {
    let result = &group.result;
    let none = DrawnCurve { points: Vec::new(), is_logarithmic: false, is_mode: false };
    let drawn = result.drawn.as_ref().unwrap_or(&none);
    let look = Look::new(0);
    let threshold = threshold(result, 0);
    let (first, last) = (drawn.points.first(), drawn.points.last());
    let ends = first.zip(last).map(|(first, last)| (first.level, last.level));
    let mut series = Vec::new();
    series.extend(threshold.as_ref().zip(ends).map(|(t, ends)| dashed(t, ends, y)));
    series.push(LineSeries {
        name: "fitted function".to_owned(),
        look,
        smooth: true,
        unmarked: true,
        points: drawn.points.iter().map(|point| (point.level, Some(point.performance))).collect(),
        ..LineSeries::default()
    });
    let levels = result.levels.iter();
    series.push(LineSeries {
        name: "answers".to_owned(),
        look,
        scatter: true,
        points: levels.map(|l| (l.level, Some(share(l.correct, l.trials)))).collect(),
        ..LineSeries::default()
    });
    let band = drawn
        .points
        .iter()
        .filter_map(|point| point.interval.map(|[low, high]| (point.level, low, high)));
    let band: Vec<(f64, f64, f64)> = band.collect();
    let name = |of: &str| format!("{} interval {of}", context.coverage());
    let fill = Fill { name: name("of the function"), kind: FillKind::Band(look), points: band };
    let title = group_name(&group.by);
    LineChart {
        title: (!title.is_empty()).then_some(title),
        x: Axis { log: drawn.is_logarithmic, ..Axis::new("Level") },
        y: y.clone(),
        series,
        spans: span(threshold.as_ref(), ends, name("of the threshold")).into_iter().collect(),
        fills: if fill.points.is_empty() { Vec::new() } else { vec![fill] },
        ..LineChart::default()
    }
}

/// From the left at the performance to the threshold, and down to the axis.
fn dashed(threshold: &Threshold, (first, last): (f64, f64), y: &Axis) -> LineSeries {
    let level = threshold.dot.value.filter(|level| (first..=last).contains(level));
    let mut points = vec![(first, Some(threshold.performance))];
    points.push((level.unwrap_or(last), Some(threshold.performance)));
    points.extend(level.map(|level| (level, y.min)));
    LineSeries { name: "threshold".to_owned(), reference: true, points, ..LineSeries::default() }
}

/// The interval of a threshold. An end without a limit is at the end of the axis.
fn span(threshold: Option<&Threshold>, ends: Option<(f64, f64)>, name: String) -> Option<Span> {
    let ([low, high], (first, last)) = threshold?.dot.interval.zip(ends)?;
    Some(Span { name, from: low.max(first), to: high.min(last) })
        .filter(|span| span.from <= span.to)
}

//! Lines with very many points, such as a metric over thousands of frames. The picture shows only as many points
//! as it has room for; the data beside the picture keeps all of them.

use std::borrow::Cow;

use fovqa_plot::{Figure, LineChart, LineSeries};

/// The most points of a line in a picture: about two for each pixel of its plot area.
const MOST_POINTS: usize = 800;

type Point = (f64, Option<f64>);

/// The figure as its picture shows it. A long line is divided into stretches, and each stretch is shown by its
/// lowest and its highest value, so that no extreme is lost.
pub(crate) fn for_picture(figure: &Figure) -> Cow<'_, Figure> {
    let Figure::Line(chart) = figure else { return Cow::Borrowed(figure) };
    if !is_of_values(chart) || !chart.series.iter().any(is_long) {
        return Cow::Borrowed(figure);
    }
    let series = chart.series.iter().map(|series| LineSeries {
        name: series.name.clone(),
        look: series.look,
        reference: series.reference,
        smooth: series.smooth,
        errors: if is_long(series) { Vec::new() } else { series.errors.clone() },
        intervals: if is_long(series) { Vec::new() } else { series.intervals.clone() },
        dots: series.dots,
        scatter: series.scatter,
        unmarked: series.unmarked,
        rings: series.rings,
        unlisted: series.unlisted,
        points: if is_long(series) { shortened(&series.points) } else { series.points.clone() },
    });
    Cow::Owned(Figure::Line(LineChart {
        title: chart.title.clone(),
        x: chart.x.clone(),
        y: chart.y.clone(),
        series: series.collect(),
        x_ticks: chart.x_ticks.clone(),
        y_from_zero: chart.y_from_zero,
        spans: chart.spans.clone(),
        fills: chart.fills.clone(),
    }))
}

/// Whether the points are measured values. Sampled functions are drawn as they are.
fn is_of_values(chart: &LineChart) -> bool {
    chart.series.iter().all(|series| !series.smooth)
        && chart.series.iter().any(|series| !series.reference)
}

fn is_long(series: &LineSeries) -> bool {
    series.points.len() > MOST_POINTS
}

/// The lowest and the highest point of each stretch, in the order of the line. Gaps remain.
fn shortened(points: &[Point]) -> Vec<Point> {
    let stretch = points.len().div_ceil(MOST_POINTS / 2);
    let ends = |points: &[Point]| -> Vec<Point> {
        let values = || points.iter().enumerate().filter_map(|(at, point)| Some((at, point.1?)));
        let lowest = values().min_by(|a, b| a.1.total_cmp(&b.1));
        let highest = values().max_by(|a, b| a.1.total_cmp(&b.1));
        let gap = points.iter().position(|point| point.1.is_none());
        let mut kept: Vec<usize> =
            [lowest.map(|of| of.0), highest.map(|of| of.0), gap].into_iter().flatten().collect();
        kept.sort_unstable();
        kept.dedup();
        kept.into_iter().map(|at| points[at]).collect()
    };
    points.chunks(stretch).flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(count: usize, value: impl Fn(usize) -> Option<f64>) -> LineSeries {
        let points = (0..count).map(|at| (at as f64, value(at))).collect();
        LineSeries { name: "a".to_owned(), points, ..LineSeries::default() }
    }

    fn figure(series: Vec<LineSeries>) -> Figure {
        Figure::Line(LineChart { series, ..LineChart::default() })
    }

    fn drawn(figure: &Figure) -> Vec<Vec<Point>> {
        match for_picture(figure).into_owned() {
            Figure::Line(chart) => chart.series.into_iter().map(|series| series.points).collect(),
            _ => unreachable!("it is a chart of lines"),
        }
    }

    #[test]
    fn a_long_line_keeps_its_extremes_and_gaps_in_order() {
        let value = |at: usize| match at {
            5000 => Some(9.0),
            5001 => Some(-9.0),
            7000 => None,
            at => Some((at % 7) as f64 * 0.1),
        };
        let (long, short) = (line(10_000, value), line(800, value));
        let points = drawn(&figure(vec![long.clone(), short.clone()]));
        assert!(points[0].len() <= 801, "{}", points[0].len());
        assert!(points[0].is_sorted_by(|a, b| a.0 < b.0));
        for at in [5000, 5001, 7000] {
            assert!(points[0].contains(&(at as f64, value(at))), "{at}");
        }
        assert_eq!(points[1], short.points, "it has room");
    }

    #[test]
    fn sampled_functions_and_short_lines_are_drawn_as_they_are() {
        let value = |at: usize| Some(at as f64);
        let smooth = LineSeries { smooth: true, ..line(2000, value) };
        let reference = LineSeries { reference: true, ..line(2000, value) };
        for series in [vec![line(800, value)], vec![smooth, line(2000, value)], vec![reference]] {
            let figure = figure(series);
            assert!(matches!(for_picture(&figure), Cow::Borrowed(_)));
        }
    }
}

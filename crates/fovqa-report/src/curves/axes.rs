//! The axes of panels that are compared: the same in all of them.

use fovqa_plot::LineChart;

/// Space above the highest value, as a share of it.
const AIR: f64 = 0.06;

/// Gives all charts the same ends of both axes, so that heights and slopes can be compared.
pub(super) fn share(charts: &mut [LineChart]) {
    let all = charts.iter().flat_map(|chart| &chart.series).flat_map(|series| &series.points);
    let seen = all.filter(|(_, y)| y.is_some_and(f64::is_finite));
    let (first, last) = ends(seen.map(|(x, _)| *x));
    // Methods without a rate at the gaze begin a step beside it.
    let first = first.min(0.0);
    if first < last {
        for chart in &mut *charts {
            (chart.x.min, chart.x.max) = (chart.x.min.or(Some(first)), chart.x.max.or(Some(last)));
        }
    }
    let wanted: Vec<(f64, f64)> = charts.iter().map(vertical).collect();
    let low = wanted.iter().map(|ends| ends.0).fold(f64::INFINITY, f64::min);
    let high = wanted.iter().map(|ends| ends.1).fold(f64::NEG_INFINITY, f64::max);
    if low < high {
        for chart in charts {
            (chart.y.min, chart.y.max) = (Some(low), Some(high));
        }
    }
}

/// The ends of the vertical axis that a chart needs: those that it has, or those of its values.
fn vertical(chart: &LineChart) -> (f64, f64) {
    let points = chart.series.iter().flat_map(|series| &series.points);
    let seen = |y: &f64| y.is_finite() && (!chart.y.log || *y > 0.0);
    let (low, high) = ends(points.filter_map(|(_, y)| *y).filter(seen));
    let (low, high) = if chart.y.log {
        (low / (1.0 + AIR), high * (1.0 + AIR))
    } else {
        let low = low.min(0.0);
        (low, high + AIR * (high - low))
    };
    (chart.y.min.unwrap_or(low), chart.y.max.unwrap_or(high))
}

/// The smallest and the largest value; in reverse order if there is none.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "ends are taken as they are")]
mod tests {
    use fovqa_plot::{Axis, LineSeries};

    use super::*;

    fn chart(points: &[(f64, f64)], max: Option<f64>, log: bool) -> LineChart {
        let points = points.iter().map(|(x, y)| (*x, Some(*y))).collect();
        LineChart {
            y: Axis { max, log, ..Axis::default() },
            series: vec![LineSeries { points, ..LineSeries::default() }],
            ..LineChart::default()
        }
    }

    #[test]
    fn all_panels_have_the_same_ends() {
        let mut charts = [
            chart(&[(0.1, 3.0), (40.0, 50.0)], None, false),
            chart(&[(0.2, 900.0), (60.0, 1.0), (70.0, f64::INFINITY)], Some(20.0), false),
        ];
        share(&mut charts);
        for chart in &charts {
            assert_eq!((chart.x.min, chart.x.max), (Some(0.0), Some(60.0)));
            assert_eq!((chart.y.min, chart.y.max), (Some(0.0), Some(53.0)));
        }
        let mut log =
            [chart(&[(0.0, 1.06), (9.0, 0.0)], None, true), chart(&[(0.0, 100.0)], None, true)];
        share(&mut log);
        assert_eq!((log[0].y.min, log[1].y.max), (Some(1.0), Some(106.0)));
        let mut none = [LineChart::default(), LineChart::default()];
        share(&mut none);
        assert_eq!((none[0].x.min, none[0].y.max), (None, None));
    }
}

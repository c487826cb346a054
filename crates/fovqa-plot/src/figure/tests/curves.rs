//! Areas between curves, limits of the vertical axis and curves that are functions.

use super::*;
use crate::canvas::colour::{DEFICIT, SURPLUS};

/// A straight curve from 0 to 10 along the axis.
fn straight(from: f64, to: f64) -> LineSeries {
    let at = |i: u32| (f64::from(i), Some(from + (to - from) * f64::from(i) / 10.0));
    LineSeries { points: (0..=10).map(at).collect(), ..LineSeries::default() }
}

/// A falling curve and a constant one: the falling curve is above the other at first and below it
/// at the end.
fn crossing() -> LineChart {
    let fill = |name: &str, kind, points: [(f64, f64, f64); 2]| Fill {
        name: name.to_owned(),
        kind,
        points: points.to_vec(),
    };
    LineChart {
        series: vec![straight(30.0, 10.0), LineSeries { reference: true, ..straight(20.0, 20.0) }],
        fills: vec![
            fill("more", FillKind::Surplus, [(0.0, 20.0, 30.0), (10.0, 20.0, 10.0)]),
            fill("less", FillKind::Deficit, [(0.0, 30.0, 20.0), (10.0, 10.0, 20.0)]),
        ],
        ..LineChart::default()
    }
}

/// The areas of a colour, starting with the key in the legend.
fn filled(drawing: &Drawing, colour: Colour) -> Vec<Vec<(f64, f64)>> {
    let area = |mark: &Mark| match mark {
        Mark::Area(points, c) if *c == colour => Some(points.clone()),
        _ => None,
    };
    drawing.marks.iter().filter_map(area).collect()
}

fn bounds(points: &[(f64, f64)]) -> Rect {
    let least = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).fold(f64::INFINITY, f64::min);
    let most = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).fold(-f64::INFINITY, f64::max);
    Rect { left: least(|p| p.0), right: most(|p| p.0), top: least(|p| p.1), bottom: most(|p| p.1) }
}

/// The lines of a look within the plot area, without the key in the legend.
fn curve(drawing: &Drawing, look: usize) -> Vec<Vec<(f64, f64)>> {
    let colour = Look::new(look).colour();
    let line = |mark: &Mark| match mark {
        Mark::Line(points, stroke) if stroke.colour == colour => Some(points.clone()),
        _ => None,
    };
    let key = usize::from(!drawing.texts()[0].line.starts_with(|c: char| c.is_ascii_digit()));
    drawing.marks.iter().filter_map(line).skip(key).collect()
}

fn discs(drawing: &Drawing, look: usize) -> Vec<(f64, f64)> {
    let colour = Look::new(look).colour();
    let disc = |mark: &Mark| match mark {
        Mark::Disc(at, _, c) if *c == colour => Some(*at),
        _ => None,
    };
    drawing.marks.iter().filter_map(disc).collect()
}

#[test]
fn areas_meet_where_the_curves_cross() {
    let chart = crossing();
    check(&Figure::Line(chart.clone()));
    let drawing = chart.draw(&Paper::wide());
    let (more, less) = (filled(&drawing, SURPLUS), filled(&drawing, DEFICIT));
    assert_eq!((more.len(), less.len()), (2, 2), "each with its key");
    let (more, less) = (bounds(&more[1]), bounds(&less[1]));
    let plot = plots(&drawing)[0];
    assert!((more.right - plot.centre().0).abs() < 1e-6 && (less.left - more.right).abs() < 1e-6);
    assert!((more.bottom - plot.centre().1).abs() < 1e-6 && (less.top - more.bottom).abs() < 1e-6);
}

#[test]
fn areas_are_over_the_grid_and_behind_the_curves() {
    let drawing = crossing().draw(&Paper::wide());
    let at = |found: &dyn Fn(&Mark) -> bool| {
        let all: Vec<usize> =
            (0..drawing.marks.len()).filter(|i| found(&drawing.marks[*i])).collect();
        (all[0], all[all.len() - 1])
    };
    let line = |colour| at(&move |mark| matches!(mark, Mark::Line(_, s) if s.colour == colour));
    let big = |mark: &Mark| {
        let Mark::Area(points, SURPLUS | DEFICIT) = mark else { return false };
        bounds(points).height() > 30.0
    };
    let (first, last) = at(&big);
    assert!(line(GRID).1 < first, "over the grid");
    assert!(line(REFERENCE).1 > last, "behind the curves");
    let curves = drawing.marks[last..].iter();
    let own = Look::new(0).colour();
    assert!(curves.filter(|m| matches!(m, Mark::Line(_, s) if s.colour == own)).count() == 1);
}

#[test]
fn areas_have_a_key_each_once_after_the_series() {
    let mut chart = crossing();
    for (series, name) in chart.series.iter_mut().zip(["rate", "acuity"]) {
        series.name = name.to_owned();
    }
    chart.fills.push(chart.fills[0].clone());
    chart.spans = vec![span(1.0, 2.0)];
    let names = ["rate", "acuity", "more", "less", "saccade"];
    assert_eq!(texts(&Figure::Line(chart.clone()))[..5], names);
    let panels = PanelChart { panels: vec![chart.clone(), chart.clone()], columns: 2, title: None };
    let figure = Figure::Panels(panels);
    check(&figure);
    assert_eq!(texts(&figure)[..5], names);
    assert!(names.iter().all(|name| count(&figure, name) == 1));
    // An area that is not visible has no key.
    chart.fills[1].points = vec![(0.0, 20.0, 10.0), (10.0, 20.0, 10.0)];
    assert_eq!(count(&Figure::Line(chart), "less"), 0);
}

#[test]
fn areas_widen_no_axis_and_end_at_the_border() {
    let mut chart = crossing();
    let bare = LineChart { fills: Vec::new(), ..chart.clone() };
    chart.fills[0].points = vec![(-90.0, 20.0, f64::INFINITY), (90.0, 20.0, 1e12)];
    let drawing = chart.draw(&Paper::wide());
    check(&Figure::Line(chart.clone()));
    let plot = plots(&drawing)[0];
    assert_eq!((chart.x_scale(), chart.y_scale()), (bare.x_scale(), bare.y_scale()));
    let area = bounds(&filled(&drawing, SURPLUS)[1]);
    assert!((area.left - plot.left).abs() < 1e-6 && (area.right - plot.right).abs() < 1e-6);
    assert!((area.top - plot.top).abs() < 1e-6 && (area.bottom - plot.centre().1).abs() < 1e-3);
    assert_eq!(Figure::Line(chart).csv(), Figure::Line(bare).csv());
}

/// An axis with these ends.
fn ends(low: f64, high: f64) -> Axis {
    Axis { min: Some(low), max: Some(high), ..Axis::default() }
}

#[test]
fn curves_are_cut_at_the_ends_of_the_horizontal_axis() {
    let series = vec![straight(0.0, 100.0)];
    let chart = LineChart { series, x: ends(2.5, 8.0), ..LineChart::default() };
    check(&Figure::Line(chart.clone()));
    let drawing = chart.draw(&Paper::wide());
    let plot = plots(&drawing)[0];
    let lines = curve(&drawing, 0);
    let (first, last) = (lines[0][0], lines[0][lines[0].len() - 1]);
    let at_borders = (first.0 - plot.left).abs() < 1e-6 && (last.0 - plot.right).abs() < 1e-6;
    assert!(at_borders, "{lines:?} {plot:?}");
    assert_eq!(discs(&drawing, 0).len(), 6, "at 3, 4, 5, 6, 7 and 8");
    let scale = chart.y_scale().unwrap();
    assert!(scale.low > 20.0 && scale.low < 30.0, "what is not seen widens no axis");
}

#[test]
fn equal_ratios_are_equal_widths_on_a_logarithmic_axis() {
    let points = [0.0, 1.0, 10.0, 100.0].map(|x| (x, Some(x + 1.0))).to_vec();
    let series = vec![LineSeries { points, ..LineSeries::default() }];
    let chart =
        LineChart { series, x: Axis { log: true, ..Axis::default() }, ..LineChart::default() };
    check(&Figure::Line(chart.clone()));
    let line = &curve(&chart.draw(&Paper::wide()), 0)[0];
    assert_eq!(line.len(), 3, "0 has no logarithm");
    let right: Vec<f64> = line.windows(2).map(|p| p[1].0 - p[0].0).collect();
    assert!((right[0] - right[1]).abs() < 1e-6 && right[0] > 50.0);
}

#[test]
fn one_end_can_be_set_even_beyond_the_data() {
    let chart = LineChart { series: vec![straight(40.0, 60.0)], ..LineChart::default() };
    for (min, max) in [(Some(80.0), None), (None, Some(10.0)), (Some(50.0), None)] {
        let chart = LineChart { y: Axis { min, max, ..Axis::default() }, ..chart.clone() };
        check(&Figure::Line(chart.clone()));
        let scale = chart.y_scale().unwrap();
        assert!(min.is_none_or(|min| scale.low == min) && max.is_none_or(|max| scale.high == max));
        assert!(scale.low < scale.high);
    }
}

#[test]
fn curves_are_cut_where_they_cross_the_limits() {
    // The curve rises from 0 to 100 along 10; the part from 20 to 70 is visible, between 2 and 7.
    let series = vec![straight(0.0, 100.0)];
    let mut chart = LineChart { series, y: ends(25.0, 75.0), ..LineChart::default() };
    chart.fills =
        vec![Fill { points: vec![(0.0, -50.0, 0.0), (10.0, 50.0, 100.0)], ..Fill::default() }];
    check(&Figure::Line(chart.clone()));
    let drawing = chart.draw(&Paper::wide());
    let plot = plots(&drawing)[0];
    let lines = curve(&drawing, 0);
    assert_eq!(lines.len(), 1);
    let unit = plot.width() / (10.0 * 1.04);
    let x = |value: f64| plot.left + (0.2 + value) * unit;
    let (first, last) = (lines[0][0], lines[0][lines[0].len() - 1]);
    assert!((first.0 - x(2.5)).abs() < 1e-6 && (first.1 - plot.bottom).abs() < 1e-6);
    assert!((last.0 - x(7.5)).abs() < 1e-6 && (last.1 - plot.top).abs() < 1e-6);
    let places = discs(&drawing, 0);
    assert_eq!(places.len(), 5, "at 3, 4, 5, 6 and 7");
    assert!((places[0].0 - x(3.0)).abs() < 1e-6 && (places[4].0 - x(7.0)).abs() < 1e-6);
    let area = bounds(&filled(&drawing, SURPLUS)[0]);
    assert!(area.top >= plot.top - 1e-6 && area.bottom <= plot.bottom + 1e-6);
    assert!((area.left - x(2.5)).abs() < 1e-6, "cut, not pressed to the border");
}

#[test]
fn the_limits_are_the_ends_of_the_axis() {
    let mut chart = LineChart { series: vec![straight(40.0, 60.0)], ..LineChart::default() };
    let free = chart.y_scale();
    for (low, high) in [(5.0, 5.0), (9.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        chart.y = ends(low, high);
        assert_eq!(chart.y_scale(), free, "{low} to {high}");
        check(&Figure::Line(chart.clone()));
    }
    for y_from_zero in [true, false] {
        chart = LineChart { y: ends(-20.0, 80.0), y_from_zero, ..chart };
        let scale = chart.y_scale().unwrap();
        assert_eq!((scale.low, scale.high), (-20.0, 80.0));
    }
    for (low, high) in [(0.0, 1e-270), (-1e300, 1e300), (1e299, 1e300), (-5e-324, 1e-5)] {
        chart.y = ends(low, high);
        check(&Figure::Line(chart.clone()));
        let panels = vec![chart.clone(); 3];
        check(&Figure::Panels(PanelChart { panels, columns: 2, title: None }));
    }
}

#[test]
fn a_point_on_a_limit_is_seen_and_one_beyond_is_not() {
    let points =
        vec![(0.0, Some(1.0)), (1.0, None), (2.0, Some(5.0)), (3.0, None), (4.0, Some(6.0))];
    let series = vec![LineSeries { points, ..LineSeries::default() }];
    let chart = LineChart { series, y: ends(1.0, 5.0), ..LineChart::default() };
    let drawing = chart.draw(&Paper::wide());
    let plot = plots(&drawing)[0];
    let ys: Vec<f64> = discs(&drawing, 0).iter().map(|p| p.1).collect();
    assert_eq!(ys, [plot.bottom, plot.top]);
}

#[test]
fn a_function_has_few_markers_and_not_those_of_another() {
    let dense = |look: usize, smooth: bool| LineSeries {
        look: Look::new(7 * look),
        smooth,
        points: (0..=1000).map(|i| (f64::from(i), Some(f64::from(i)))).collect(),
        ..LineSeries::default()
    };
    let count = |smooth| {
        let series = vec![dense(0, smooth)];
        let drawing = LineChart { series, ..LineChart::default() }.draw(&Paper::wide());
        assert_eq!(curve(&drawing, 0)[0].len(), 1001, "the curve is the same");
        discs(&drawing, 0).len()
    };
    assert!((5..=9).contains(&count(true)) && count(false) > 30);
    let reference = LineSeries { reference: true, ..dense(0, true) };
    let drawing =
        LineChart { series: vec![reference], ..LineChart::default() }.draw(&Paper::wide());
    assert!(!drawing.marks.iter().any(|mark| matches!(mark, Mark::Disc(..))));
    // Looks 0 and 7 are both circles of one colour.
    let series = vec![dense(0, true), dense(1, true)];
    let both = discs(&LineChart { series, ..LineChart::default() }.draw(&Paper::wide()), 0);
    for (i, a) in both.iter().enumerate() {
        assert!(both[..i].iter().all(|b| (a.0 - b.0).hypot(a.1 - b.1) > 3.0));
    }
}

/// A logarithmic chart of values at 0, 1, 2 and so on.
fn log(values: &[f64]) -> LineChart {
    let series = vec![LineSeries { points: points(values), ..LineSeries::default() }];
    LineChart { series, y: Axis { log: true, ..Axis::default() }, ..LineChart::default() }
}

#[test]
fn equal_ratios_are_equal_heights_on_a_logarithmic_axis() {
    let chart = log(&[0.1, 1.0, 10.0, 100.0]);
    check(&Figure::Line(chart.clone()));
    let line = &curve(&chart.draw(&Paper::wide()), 0)[0];
    let up: Vec<f64> = line.windows(2).map(|p| p[0].1 - p[1].1).collect();
    assert!(up[0] > 30.0 && up.iter().all(|step| (step - up[0]).abs() < 1e-6), "{up:?}");
    let labels = texts(&Figure::Line(chart.clone()));
    for label in ["0.1", "1", "10", "100"] {
        assert!(labels.iter().any(|text| text == label), "{label}");
    }
    let from_zero = LineChart { y_from_zero: true, ..chart.clone() };
    assert_eq!(from_zero.y_scale(), chart.y_scale());
}

#[test]
fn values_without_a_logarithm_are_gaps() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    let chart = log(&[1.0, 2.0, 0.0, 4.0, 5.0, -3.0, 6.0, 7.0, -inf, nan, 8.0, 9.0, inf]);
    let figure = Figure::Line(chart.clone());
    check(&figure);
    assert_eq!(curve(&chart.draw(&Paper::wide()), 0).len(), 4);
    assert_eq!((count(&figure, "∞"), count(&figure, "−∞")), (1, 0));
    let none = Figure::Line(log(&[0.0, -1.0]));
    check(&none);
    assert_eq!(count(&none, "no data"), 1);
}

#[test]
fn limits_and_areas_of_a_logarithmic_axis() {
    let mut chart = log(&[1e-3, 1.0, 1e3]);
    chart.y = Axis { log: true, ..ends(0.01, 100.0) };
    chart.fills = vec![Fill { points: vec![(0.0, 0.0, 1.0), (2.0, -5.0, 1.0)], ..Fill::default() }];
    check(&Figure::Line(chart.clone()));
    let drawing = chart.draw(&Paper::wide());
    let (plot, line) = (plots(&drawing)[0], &curve(&drawing, 0)[0]);
    assert_eq!((line[0].1, line[line.len() - 1].1), (plot.bottom, plot.top));
    // A third of the distance from 0.001 to 1.
    let unit = plot.width() / (2.0 * 1.04);
    assert!((line[0].0 - (plot.left + (0.04 + 1.0 / 3.0) * unit)).abs() < 1e-6);
    let area = bounds(&filled(&drawing, SURPLUS)[0]);
    assert!((area.top - plot.centre().1).abs() < 1e-6 && (area.bottom - plot.bottom).abs() < 1e-6);
    let logarithmic = |axis: Axis| LineChart { y: Axis { log: true, ..axis }, ..chart.clone() };
    let free = logarithmic(Axis::default()).y_scale();
    for low in [0.0, -1.0] {
        assert_eq!(logarithmic(ends(low, 100.0)).y_scale(), free);
    }
    let panels = vec![chart.clone(), log(&[3.0, 4.0]), log(&[1e-280, 1e300])];
    check(&Figure::Panels(PanelChart { panels, columns: 3, title: None }));
}

/// A ring lies around the marker of the point that it points out, behind its curve.
#[test]
fn a_ring_is_around_a_point_of_the_curve() {
    let curve = straight(0.0, 10.0);
    let ring =
        LineSeries { rings: true, unlisted: true, points: vec![curve.points[4]], ..curve.clone() };
    let chart = |series: Vec<LineSeries>| LineChart { series, ..LineChart::default() };
    let alone = discs(&chart(vec![curve.clone()]).draw(&Paper::wide()), 0);
    let ringed = discs(&chart(vec![ring, curve]).draw(&Paper::wide()), 0);
    assert_eq!(ringed.len(), alone.len() + 1);
    let twice = |at: &&(f64, f64)| ringed.iter().filter(|other| other == at).count() == 2;
    let around: Vec<_> = ringed.iter().filter(twice).collect();
    assert_eq!(around.len(), 2, "{ringed:?}");
    assert!(alone.contains(around[0]));
}

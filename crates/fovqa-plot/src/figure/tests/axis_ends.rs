//! Axes whose ends were set: their ticks, and figures of which they show nothing; and error bars of
//! several curves.

use super::*;

/// Curves over the centres of bands of 10°, whose edges are the ticks.
fn profile(curves: usize) -> LineChart {
    let series = (0..curves).map(|i| LineSeries {
        look: Look::new(i),
        points: (0..6)
            .map(|band| (f64::from(10 * band + 5), Some(30.0 - f64::from(band))))
            .collect(),
        errors: vec![Some(1.0); 6],
        ..LineSeries::default()
    });
    let x_ticks = Some((0..=6).map(|edge| f64::from(10 * edge)).collect());
    LineChart { series: series.collect(), x_ticks, ..LineChart::default() }
}

#[test]
fn ticks_are_round_numbers_where_few_edges_remain() {
    let ticks = |min: f64, max: f64| {
        let x = Axis { min: Some(min), max: Some(max), ..Axis::default() };
        let chart = LineChart { x, y: Axis::default(), ..profile(1) };
        chart.x_ticks().map(<[f64]>::len)
    };
    assert_eq!(ticks(0.0, 30.0), Some(7), "the edges from 0 to 30");
    assert_eq!((ticks(1.0, 25.0), ticks(12.0, 18.0)), (None, None));
    let x = Axis { min: Some(12.0), max: Some(18.0), ..Axis::default() };
    let labels = texts(&Figure::Line(LineChart { x, ..profile(1) }));
    assert!(labels.contains(&"14".to_owned()) && labels.contains(&"16".to_owned()), "{labels:?}");
}

#[test]
fn a_figure_says_if_its_axes_show_none_of_its_values() {
    let ends = |min: f64, max: f64| Axis { min: Some(min), max: Some(max), ..Axis::default() };
    let unseen = |chart: &LineChart| Figure::Line(chart.clone()).unseen();
    for (x, y, is_empty) in [
        (Axis::default(), Axis::default(), false),
        (ends(80.0, 90.0), Axis::default(), true),
        (Axis::default(), ends(80.0, 90.0), true),
        (Axis { min: Some(70.0), ..Axis::default() }, Axis::default(), true),
        (ends(6.0, 7.0), Axis::default(), false), // a line between two points
        (ends(20.0, 30.0), ends(27.0, 29.0), false),
        (ends(20.0, 30.0), ends(29.0, 31.0), true),
    ] {
        let chart = LineChart { x: x.clone(), y: y.clone(), ..profile(2) };
        assert_eq!(!unseen(&chart).is_empty(), is_empty, "{x:?} {y:?}");
    }
    let chart = LineChart { title: Some("a".to_owned()), x: ends(80.0, 90.0), ..profile(2) };
    let found = &unseen(&chart)[0];
    assert_eq!((found.x, found.y), (Some((5.0, 55.0)), Some((25.0, 30.0))));
    assert_eq!((found.x_ends, found.y_ends), ([Some(80.0), Some(90.0)], [None, None]));
    let panels = vec![profile(1), chart];
    let panels = Figure::Panels(PanelChart { title: None, panels, columns: 2 }).unseen();
    assert_eq!(panels.iter().map(|of| of.panel.as_deref()).collect::<Vec<_>>(), [Some("a")]);
    assert!(unseen(&LineChart { x: ends(1.0, 2.0), ..LineChart::default() }).is_empty(), "no data");

    let with_y = |figure: Figure, y: Axis| match figure {
        Figure::Bar(chart) => Figure::Bar(BarChart { y, ..chart }),
        Figure::Spread(chart) => Figure::Spread(SpreadChart { y, ..chart }),
        other => other,
    };
    let bar = || bars(vec![vec![Some(30.0), None]], true);
    let boxes = || spread(vec![vec![(0..20).map(f64::from).collect()]]);
    for (figure, y, is_empty) in [
        (bar(), ends(0.0, 10.0), false), // a bar is cut off
        (bar(), ends(10.0, 20.0), true), // a marker is not
        (bar(), ends(20.0, 40.0), false),
        (boxes(), ends(30.0, 40.0), true),
        (boxes(), ends(3.2, 3.8), false),
        (boxes(), Axis::default(), false),
    ] {
        assert_eq!(!with_y(figure, y.clone()).unseen().is_empty(), is_empty, "{y:?}");
    }
}

#[test]
fn error_bars_at_one_position_stand_side_by_side() {
    let upright = |curves: usize| {
        let drawing = profile(curves).draw(&Paper::wide());
        let mut places: Vec<i64> = Vec::new();
        for mark in &drawing.marks {
            if let Mark::Line(points, stroke) = mark
                && (0..curves).any(|i| stroke.colour == Look::new(i).colour())
                && points.len() == 2
                && (points[0].0 - points[1].0).abs() < 1e-9
            {
                places.push((points[0].0 * 10.0).round() as i64);
            }
        }
        places.sort_unstable();
        places
    };
    let (one, three) = (upright(1), upright(3));
    assert_eq!((one.len(), three.len()), (6, 18));
    for (at, bars) in one.iter().zip(three.chunks(3)) {
        assert_eq!(bars, [at - 70, *at, at + 70]);
    }
    check(&Figure::Line(profile(3)));
    check(&Figure::Line(profile(20)));
}

#[test]
fn characters_that_the_font_lacks_are_found() {
    let missing = |title: &str| {
        let chart = LineChart { title: Some(title.to_owned()), ..LineChart::default() };
        let printed = Figure::Line(chart).print(&Style::default()).unwrap();
        printed.missing_characters().into_iter().collect::<String>()
    };
    assert_eq!(missing("視点 of Ünsal, σ² ≤ 4°"), "点視");
    assert_eq!(missing("עברית العربية Ελληνικά"), "");
}

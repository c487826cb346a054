//! Marks and labels: bars, boxes, gaps, and infinite or missing values.

use super::*;
use crate::{Bracket, ReferenceLine};

#[test]
fn infinite_and_missing_values_are_shown() {
    let (inf, sub) = (Some(f64::INFINITY), Some(f64::NEG_INFINITY));
    let curves =
        vec![vec![(0.0, inf), (9.0, Some(1.0)), (20.0, sub)], vec![(0.0, inf), (9.0, inf)]];
    let figure = line(curves);
    check(&figure);
    assert_eq!((count(&figure, "∞"), count(&figure, "−∞")), (2, 1), "once a place");

    for from_zero in [true, false] {
        let figure =
            bars(vec![vec![Some(30.0), None, inf], vec![Some(20.0), sub, None]], from_zero);
        check(&figure);
        assert_eq!((count(&figure, "∞"), count(&figure, "−∞")), (1, 1));
        assert_eq!(count(&figure, "n/a"), 2);
        assert_eq!((count(&figure, "30.0"), count(&figure, "20.0")), (1, 1), "values");
    }
    let all = bars(vec![vec![inf, inf]], true);
    check(&all);
    assert_eq!((count(&all, "∞"), count(&all, "no data")), (2, 0));

    let values = vec![f64::INFINITY, 1.0, f64::INFINITY, 2.0, f64::NEG_INFINITY];
    let figure = spread(vec![vec![values.clone()]]);
    check(&figure);
    assert_eq!((count(&figure, "2 × ∞"), count(&figure, "1 × −∞")), (1, 1));
    let narrow = spread(vec![vec![values; 60]; 3]);
    check(&narrow);
    assert_eq!(count(&narrow, "360 × ∞ left out"), 1);
}

/// The upper and lower ends of the areas of a look, without the key in the legend.
fn areas(figure: &Figure, look: usize) -> Vec<(f64, f64)> {
    let colour = Look::new(look).colour();
    let ends = |mark: &Mark| match mark {
        Mark::Area(points, c) if *c == colour => {
            let ys = || points.iter().map(|p| p.1);
            Some((ys().fold(f64::INFINITY, f64::min), ys().fold(0.0, f64::max)))
        }
        _ => None,
    };
    figure.draw(&Paper::wide()).unwrap().marks.iter().filter_map(ends).skip(1).collect()
}

#[test]
fn bars_are_as_long_as_their_values() {
    let figure = bars(vec![vec![Some(10.0), Some(30.0), Some(-5.0)]], true);
    let bars = areas(&figure, 0);
    let length = |i: usize| bars[i].1 - bars[i].0;
    assert!((length(1) / length(0) - 3.0).abs() < 1e-9);
    assert!((length(0) / length(2) - 2.0).abs() < 1e-9);
    assert!((bars[0].1 - bars[2].0).abs() < 1e-9, "one base line, a negative bar below it");
}

/// The lines and discs of a colour.
fn lines_and_discs(figure: &Figure, colour: Colour) -> (Vec<Vec<(f64, f64)>>, usize) {
    let drawing = figure.draw(&Paper::wide()).unwrap();
    let line = |mark: &Mark| match mark {
        Mark::Line(points, stroke) if stroke.colour == colour => Some(points.clone()),
        _ => None,
    };
    let disc = |mark: &&Mark| matches!(mark, Mark::Disc(_, _, c) if *c == colour);
    (drawing.marks.iter().filter_map(line).collect(), drawing.marks.iter().filter(disc).count())
}

#[test]
fn a_gap_is_not_bridged() {
    let y = [Some(1.0), Some(2.0), None, Some(3.0), Some(1.0)];
    let figure = line(vec![y.iter().enumerate().map(|(x, y)| (x as f64, *y)).collect()]);
    let (lines, discs) = lines_and_discs(&figure, Look::new(0).colour());
    // Both counts include the key in the legend.
    assert_eq!((lines.len(), discs), (3, 5));
    assert!(lines.iter().all(|line| line.len() == 2));
}

#[test]
fn a_point_between_gaps_is_seen_on_a_reference_too() {
    let points = vec![(0.0, Some(1.0)), (1.0, None), (2.0, Some(3.0))];
    let series = vec![LineSeries { reference: true, points, ..LineSeries::default() }];
    let figure = Figure::Line(LineChart { series, ..LineChart::default() });
    assert_eq!(lines_and_discs(&figure, REFERENCE).1, 2);
}

#[test]
fn ten_values_make_a_box() {
    let tint = Look::new(0).colour().tint(crate::marks::swatch::TINT);
    let boxes = |count: u32| {
        let figure = spread(vec![vec![(0..count).map(f64::from).collect()], vec![vec![]]]);
        let drawing = figure.draw(&Paper::wide()).unwrap();
        let area = |mark: &Mark| match mark {
            Mark::Area(points, colour) if *colour == tint => Some((points[0].1, points[2].1)),
            _ => None,
        };
        // Only the line of a median is drawn in ink.
        (drawing.marks.iter().filter_map(area).collect::<Vec<_>>(), lines_and_discs(&figure, INK).0)
    };
    let (none, strip_median) = boxes(9);
    assert!(none.is_empty() && strip_median.len() == 1);
    let (found, medians) = boxes(10);
    // The key and the box, which extends from 2.25 to 6.75 on an axis of 9 plus its space.
    let (top, bottom) = found[1];
    let height = Paper::wide().plot_height_px * 4.5 / (9.0 * 1.12);
    assert!(found.len() == 2 && (bottom - top - height).abs() < 1e-6, "{found:?}");
    let middle = top.midpoint(bottom);
    assert!((medians[0][0].1 - middle).abs() < 1e-6);
    assert!((strip_median[0][0].1 - middle).abs() < 1e-6, "of 0 to 8, in the middle as well");
}

#[test]
fn a_zero_over_negative_bars_has_room_for_its_label() {
    check(&bars(vec![vec![Some(0.0), Some(-0.0013)]], true));
    check(&bars(vec![vec![Some(-0.0), Some(-2.0), None]; 4], true));
}

#[test]
fn infinite_values_stand_at_their_border() {
    let figure = line(vec![vec![
        (0.0, Some(f64::INFINITY)),
        (1.0, Some(0.0)),
        (2.0, Some(1.0)),
        (3.0, Some(f64::NEG_INFINITY)),
    ]]);
    let colour = Look::new(0).colour();
    let disc = |mark: &Mark| match mark {
        Mark::Disc((_, y), _, c) if *c == colour => Some(*y),
        _ => None,
    };
    let ys: Vec<f64> = figure.draw(&Paper::wide()).unwrap().marks.iter().filter_map(disc).collect();
    // The key, the two points on the axis, then the one above and the one below.
    let [_, zero, one, above, below] = ys[..] else { panic!("{ys:?}") };
    assert!(above < one && one < zero && zero < below, "{ys:?}");
    assert!((below - above - Paper::wide().plot_height_px).abs() < 1e-6);
}

#[test]
fn labels_of_infinite_values_keep_off_the_axis() {
    let (sub, inf) = (f64::NEG_INFINITY, f64::INFINITY);
    for values in [[sub, 5.0, 7.0, sub], [inf, -5.0, -7.0, inf]] {
        let Figure::Line(chart) = line(vec![points(&values)]) else { unreachable!() };
        for x_ticks in [vec![0.0, 3.0], vec![-9.0, 2.999_999, 3.0], vec![0.0, 1e-9, 3.0]] {
            let x_ticks = Some(x_ticks);
            let chart = LineChart { x_ticks, y_from_zero: true, ..chart.clone() };
            check(&Figure::Line(chart.clone()));
            let panels = vec![chart; 3];
            check(&Figure::Panels(PanelChart { panels, columns: 3, ..PanelChart::default() }));
        }
    }
}

/// The upright lines of a colour that have no other colour's length: error bars.
fn upright(drawing: &Drawing, colour: Colour) -> Vec<(f64, f64)> {
    let line = |mark: &Mark| match mark {
        Mark::Line(points, stroke)
            if stroke.colour == colour
                && points.len() == 2
                && points[0].0 == points[1].0
                && stroke.width_px == 1.0 =>
        {
            Some((points[0].1, points[1].1))
        }
        _ => None,
    };
    drawing.marks.iter().filter_map(line).collect()
}

#[test]
fn error_bars_of_curves_have_their_length_and_widen_the_axis() {
    let points = vec![(0.0, Some(10.0)), (1.0, Some(20.0)), (2.0, None), (3.0, Some(15.0))];
    let errors = vec![Some(2.0), Some(8.0), Some(3.0), None];
    let series = vec![LineSeries { errors, points, ..LineSeries::default() }];
    let chart = LineChart { series, ..LineChart::default() };
    check(&Figure::Line(chart.clone()));
    let scale = chart.y_scale().unwrap();
    assert!(scale.low < 8.0 && scale.high > 28.0);
    let drawing = chart.draw(&Paper::wide());
    let bars = upright(&drawing, Look::new(0).colour());
    assert_eq!(bars.len(), 2, "a gap and a point without one have none");
    let unit = Paper::wide().plot_height_px / (scale.high - scale.low);
    for ((from, to), error) in bars.iter().zip([2.0, 8.0]) {
        assert!(((from - to).abs() - 2.0 * error * unit).abs() < 1e-6, "{from} {to}");
    }
    assert!(Figure::Line(chart).csv().starts_with("series,x,y,error\n,0.0,10.0,2.0\n"));
}

#[test]
fn intervals_need_not_be_even_and_may_be_open() {
    let points = vec![(0.0, Some(10.0)), (1.0, Some(20.0)), (2.0, Some(15.0))];
    let intervals = vec![Some([9.0, 14.0]), None, Some([12.0, f64::INFINITY])];
    let series = vec![LineSeries { intervals, points, ..LineSeries::default() }];
    let chart = LineChart { series, ..LineChart::default() };
    check(&Figure::Line(chart.clone()));
    let scale = chart.y_scale().unwrap();
    assert!(scale.low < 9.0 && scale.high < 30.0, "an open end does not widen the axis");
    let drawing = chart.draw(&Paper::wide());
    let bars = upright(&drawing, Look::new(0).colour());
    let unit = Paper::wide().plot_height_px / (scale.high - scale.low);
    assert_eq!(bars.len(), 2);
    assert!(((bars[0].0 - bars[0].1).abs() - 5.0 * unit).abs() < 1e-6);
    let csv = Figure::Line(chart).csv();
    assert!(csv.starts_with("series,x,y,low,high\n,0.0,10.0,9.0,14.0\n,1.0,20.0,,\n"), "{csv}");
}

#[test]
fn bars_have_intervals_stars_and_brackets() {
    let Figure::Bar(mut chart) = bars(vec![vec![Some(0.6), Some(0.8)]; 2], true) else {
        unreachable!()
    };
    let before = chart.draw(&Paper::wide()).unwrap();
    chart.series[0].intervals = vec![Some([0.5, 0.75]), Some([0.7, 0.95])];
    chart.series[0].notes = vec![String::new(), "**".to_owned()];
    let bracket = |label: &str, ends| Bracket { ends, label: label.to_owned() };
    chart.brackets = vec![bracket("*", [[0, 0], [0, 1]]), bracket("***", [[0, 1], [1, 1]])];
    check(&Figure::Bar(chart.clone()));
    let drawing = chart.draw(&Paper::wide()).unwrap();
    let texts = drawing.texts();
    let at = |line: &str| texts.iter().find(|text| text.line == line).unwrap().at;
    let is_noted = |line: &str| line.starts_with("0.8") && line.ends_with(" **");
    assert_eq!(texts.iter().filter(|text| is_noted(&text.line)).count(), 1);
    assert!(at("***").1 < at("*").1, "they meet at a bar, and the longer one is above");
    assert_eq!(upright(&drawing, INK).len(), 2);
    assert!(drawing.height_px > before.height_px, "brackets have room of their own");
    assert!(Figure::Bar(chart).csv().starts_with("group,series,value,low,high\n"));
}

#[test]
fn error_bars_of_bars_are_below_their_labels() {
    let Figure::Bar(mut chart) = bars(vec![vec![Some(10.0), Some(12.0)]], true) else {
        unreachable!()
    };
    chart.series[0].errors = vec![Some(5.0), None];
    check(&Figure::Bar(chart.clone()));
    let drawing = chart.draw(&Paper::wide()).unwrap();
    let bars = upright(&drawing, INK);
    assert_eq!(bars.len(), 1);
    let label = drawing.texts().into_iter().find(|text| text.line == "10.0").unwrap();
    assert!(label.at.1 < bars[0].0.min(bars[0].1));
    assert!(Figure::Bar(chart.clone()).csv().contains("group,series,value,error\n"));
    chart.series[0].errors = vec![None];
    assert!(matches!(chart.draw(&Paper::wide()), Err(PlotError::Groups { found: 1, .. })));
}

#[test]
fn violins_are_as_wide_as_their_density() {
    let values: Vec<f64> = (0..40).map(|i| f64::from(i * i) / 10.0).collect();
    let Figure::Spread(mut chart) = spread(vec![vec![values.clone(), vec![5.0; 20], vec![1.0]]])
    else {
        unreachable!()
    };
    chart.violins = true;
    check(&Figure::Spread(chart.clone()));
    let drawing = chart.draw(&Paper::wide()).unwrap();
    let areas: Vec<&Vec<(f64, f64)>> = drawing
        .marks
        .iter()
        .filter_map(|mark| if let Mark::Area(points, _) = mark { Some(points) } else { None })
        .filter(|points| points.len() > 100)
        .collect();
    assert_eq!(areas.len(), 1, "equal values have a box, and single ones points");
    let width = |i: usize| areas[0][i].0 - areas[0][129 - i].0;
    assert!((0..65).all(|i| width(i) > 0.0) && width(5) > 2.0 * width(60), "most are small");
}

#[test]
fn labels_have_room_above_an_end_that_was_set() {
    let Figure::Bar(mut chart) = bars(vec![vec![Some(0.99); 9]; 3], true) else { unreachable!() };
    chart.y.max = Some(1.0);
    check(&Figure::Bar(chart));
}

#[test]
fn markers_beyond_the_ends_of_the_axis_are_not_drawn() {
    let Figure::Bar(mut chart) = bars(vec![vec![Some(19.8), Some(35.0)]], true) else {
        unreachable!()
    };
    (chart.y.min, chart.y.max) = (Some(30.0), Some(40.0));
    let figure = Figure::Bar(chart);
    check(&figure);
    assert_eq!((count(&figure, "19.8"), count(&figure, "35.0")), (0, 1));
}

#[test]
fn points_without_a_line_and_lines_without_markers() {
    let points: Vec<_> = (0..5).map(|i| (f64::from(i), Some(f64::from(i * i)))).collect();
    let drawn = |series: LineSeries| {
        let series = vec![LineSeries { points: points.clone(), ..series }];
        let figure = Figure::Line(LineChart { series, ..LineChart::default() });
        check(&figure);
        let (lines, discs) = lines_and_discs(&figure, Look::new(0).colour());
        (lines.len(), discs)
    };
    let named = || LineSeries { name: "A".to_owned(), ..LineSeries::default() };
    // Each count includes the key in the legend.
    assert_eq!(drawn(LineSeries { scatter: true, ..named() }), (0, 6));
    assert_eq!(drawn(LineSeries { unmarked: true, ..named() }), (2, 0));
    assert_eq!(drawn(LineSeries { dots: true, ..named() }), (0, 6));
    assert_eq!(drawn(LineSeries { rings: true, ..named() }), (0, 6));
    assert_eq!(drawn(LineSeries { rings: true, dots: true, ..named() }), (0, 6));
    assert_eq!(drawn(LineSeries { unmarked: true, smooth: true, ..named() }), (2, 0));
}

/// Dots with a reference line at a value.
fn compared_with(value: f64, y: Axis) -> Figure {
    let series = vec![BarSeries {
        values: vec![Some(60.0), Some(80.0)],
        intervals: vec![Some([55.0, 65.0]), Some([f64::NEG_INFINITY, f64::INFINITY])],
        notes: vec![String::new(), "*".to_owned()],
        ..BarSeries::default()
    }];
    Figure::Bar(BarChart {
        y,
        groups: vec!["A".to_owned(), "B".to_owned()],
        series,
        from_zero: false,
        references: vec![ReferenceLine { name: "chance".to_owned(), value }],
        labels: false,
        ..BarChart::default()
    })
}

#[test]
fn values_are_compared_with_a_reference_line() {
    // Dashes, of which some are the key in the legend.
    let dashes = |value: f64, y: Axis| lines_and_discs(&compared_with(value, y), REFERENCE).0;
    let key = dashes(f64::NAN, Axis::default()).len();
    let lines = dashes(50.0, Axis::new("Share (%)"));
    assert!(lines.len() > key + 10, "the axis includes it");
    let height = |line: &Vec<(f64, f64)>| line[0].1;
    assert!(lines[key..].iter().all(|line| height(line).total_cmp(&line[1].1).is_eq()));
    check(&compared_with(50.0, Axis::new("Share (%)")));
    let from_55 = Axis { min: Some(55.0), ..Axis::new("Share (%)") };
    assert_eq!(dashes(50.0, from_55).len(), key);
}

#[test]
fn notes_are_written_without_the_values() {
    let figure = compared_with(50.0, Axis::new("Share (%)"));
    assert_eq!((count(&figure, "*"), count(&figure, "60.0")), (1, 0));
}

#[test]
fn an_interval_without_ends_is_drawn_to_the_borders() {
    let figure = compared_with(50.0, Axis { min: Some(0.0), max: Some(90.0), ..Axis::default() });
    let (lines, _) = lines_and_discs(&figure, INK);
    let height = |line: &Vec<(f64, f64)>| (line[0].1 - line[1].1).abs();
    let longest = lines.iter().map(height).fold(0.0, f64::max);
    assert!((longest - Paper::wide().plot_height_px).abs() < 1e-6, "{longest}");
}

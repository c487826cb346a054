//! Every kind of figure with usual, odd and hostile data. All marks must be inside the picture,
//! texts must not overlap, and the output must be the same each time.

use super::*;
use crate::canvas::colour::{AXIS, Colour, GRID, INK, REFERENCE, SPAN};
use crate::canvas::drawing::{Mark, Rect, Text};
use crate::canvas::png;
use crate::{Axis, BarSeries, Fill, FillKind, LineSeries, Look, Span, SpreadSeries};

mod axis_ends;
mod curves;
mod marks;
mod montages;
mod panels;
mod random_values;
mod rasters;
mod sizes;
mod spans;

/// Names that are difficult for a layout.
const HOSTILE: [&str; 8] = [
    "RMFR",
    "A & B <x> \"quoted\" 'too'",
    "",
    "a_name_without_a_single_space_that_is_longer_than_any_sensible_name_of_a_method_could_ever_be",
    "注視点レンダリングの手法その一",
    "many many words, one after the other, until the row is full and over-full, and then some more",
    "tab\tand\nline\u{0}\u{1b}[31m",
    "עברית",
];

/// Values that are difficult for axes.
const ODD: [f64; 14] = [
    0.0,
    -0.0,
    5e-324,
    1e-5,
    3.3e-5,
    0.999_999_9,
    1.0,
    -37.5,
    12_345.678,
    1e9,
    1e9 + 1.0,
    1e300,
    f64::MAX,
    f64::MIN,
];

fn name(i: usize) -> String {
    HOSTILE[i % HOSTILE.len()].to_owned()
}

fn line(series: Vec<Vec<(f64, Option<f64>)>>) -> Figure {
    let series = series.into_iter().enumerate().map(|(i, points)| LineSeries {
        name: name(i),
        look: Look::new(i),
        reference: i % 5 == 4,
        points,
        ..LineSeries::default()
    });
    let (x, y) = (Axis::new("Eccentricity (°)"), Axis::new("PSNR (dB)"));
    Figure::Line(LineChart { x, y, series: series.collect(), ..LineChart::default() })
}

/// A bar chart of `values[series][group]`. The values are markers if the axis does not begin at 0.
fn bars(values: Vec<Vec<Option<f64>>>, from_zero: bool) -> Figure {
    let groups = (0..values.first().map_or(0, Vec::len)).map(name).collect();
    let series = values.into_iter().enumerate().map(|(i, values)| BarSeries {
        name: name(i),
        look: Look::new(i),
        values,
        ..BarSeries::default()
    });
    let y = Axis::new("SSIM");
    Figure::Bar(BarChart {
        title: Some(name(1)),
        y,
        groups,
        series: series.collect(),
        from_zero,
        ..BarChart::default()
    })
}

fn spread(values: Vec<Vec<Vec<f64>>>) -> Figure {
    let groups = (0..values.first().map_or(0, Vec::len)).map(name).collect();
    let series = values.into_iter().enumerate().map(|(i, values)| SpreadSeries {
        name: name(i),
        look: Look::new(i),
        values,
    });
    let y = Axis::new("a title that is far too long for the height of this axis, whoever wrote it");
    Figure::Spread(SpreadChart { y, groups, series: series.collect(), ..SpreadChart::default() })
}

/// A figure of `count` panels with the same curves, with a span and hostile titles.
fn panels(series: &[Vec<(f64, Option<f64>)>], count: usize, columns: usize) -> Figure {
    let Figure::Line(chart) = line(series.to_vec()) else { unreachable!() };
    let panel = |i: usize| LineChart {
        title: (i % 4 != 3).then(|| name(i)),
        y: Axis::new(if i % 7 == 6 { "another measure" } else { "Error energy" }),
        series: chart.series.iter().skip(i % 2).cloned().collect(),
        y_from_zero: i.is_multiple_of(3),
        spans: vec![span(-1.0, 1.0)],
        ..chart.clone()
    };
    let panels = (0..count).map(panel).collect();
    Figure::Panels(PanelChart { title: Some(name(5)), panels, columns })
}

fn span(from: f64, to: f64) -> Span {
    Span { name: "saccade".to_owned(), from, to }
}

/// Points at 0, 1, 2 and so on.
fn points(values: &[f64]) -> Vec<(f64, Option<f64>)> {
    values.iter().enumerate().map(|(x, y)| (x as f64, Some(*y))).collect()
}

fn texts(figure: &Figure) -> Vec<String> {
    figure.draw(&Paper::wide()).unwrap().texts().iter().map(|text| text.line.clone()).collect()
}

fn count(figure: &Figure, text: &str) -> usize {
    texts(figure).iter().filter(|line| *line == text).count()
}

/// The SVG of a figure on wide paper, with 96 of its pixels per inch.
fn svg(figure: &Figure) -> String {
    let drawing = figure.draw(&Paper::wide()).unwrap();
    Printed::new(drawing, 0.75).svg().unwrap()
}

/// Checks that no mark is outside the picture and that texts do not overlap, on wide paper and on
/// that of a column.
fn check(figure: &Figure) {
    check_drawing(&figure.draw(&Paper::wide()).unwrap());
    check_drawing(&figure.draw(&Paper::new(&Style::default())).unwrap());
}

fn check_drawing(drawing: &Drawing) {
    let (width, height) = (drawing.width_px, drawing.height_px);
    let inside = |r: Rect| r.left >= 0.0 && r.top >= 0.0 && r.right <= width && r.bottom <= height;
    for mark in &drawing.marks {
        let (points, reach): (&[_], f64) = match mark {
            Mark::Line(points, _) | Mark::Area(points, _) => (points, 0.0),
            Mark::Disc(centre, radius, _) => (std::slice::from_ref(centre), *radius),
            Mark::Text(_) => (&[], 0.0),
            Mark::Picture(rect, _) | Mark::Photo(rect, _) => {
                assert!(inside(*rect), "{rect:?} leaves {width} x {height}");
                (&[], 0.0)
            }
        };
        for (x, y) in points {
            let rect =
                Rect { left: x - reach, top: y - reach, right: x + reach, bottom: y + reach };
            assert!(inside(rect), "{mark:?} leaves {width} x {height}");
        }
    }
    let texts: Vec<&Text> = drawing.texts();
    for (i, a) in texts.iter().enumerate() {
        assert!(inside(a.bounds()), "{a:?} leaves {width} x {height}");
        assert!(a.size_px >= 11.0 && !a.line.chars().any(char::is_control), "{a:?}");
        for b in &texts[..i] {
            assert!(!a.bounds().overlaps(b.bounds()), "{a:?} covers {b:?}");
        }
    }
}

#[test]
fn hostile_figures_stay_inside_the_picture() {
    for series in [0, 1, 2, 12, 40] {
        let points = |s: usize| {
            ODD.iter()
                .enumerate()
                .map(|(i, v)| (i as f64, (i % 5 != s % 5).then_some(*v)))
                .collect()
        };
        check(&line((0..series).map(points).collect()));
        for groups in [0, 1, 3, 40, 150] {
            let value = |s: usize, g: usize| ODD[(3 * s + g) % 11] * 0.7;
            let row = |s: usize| (0..groups).map(|g| (g % 6 != 5).then_some(value(s, g))).collect();
            for from_zero in [true, false] {
                check(&bars((0..series).map(row).collect(), from_zero));
            }
            let values = |s: usize, g: usize| (0..g + s).map(|i| value(s, i)).collect();
            let row = |s: usize| (0..groups.min(40)).map(|g| values(s, g)).collect();
            check(&spread((0..series).map(row).collect()));
        }
    }
}

#[test]
fn odd_ranges_stay_inside_the_picture() {
    for a in ODD {
        for b in ODD {
            check(&line(vec![vec![(a, Some(b)), (b, Some(a))], vec![(a, None)]]));
            check(&bars(vec![vec![Some(a)], vec![Some(b)]], a < b));
            check(&spread(vec![vec![vec![a, b]], vec![vec![b; 11]]]));
        }
    }
}

#[test]
fn given_ticks_that_stand_close_do_not_overlap() {
    let Figure::Line(mut chart) = line(vec![vec![(3.0, Some(1.0)), (50.0, Some(2.0))]]) else {
        unreachable!()
    };
    chart.x_ticks = Some((0..=130).map(f64::from).collect());
    check(&Figure::Line(chart.clone()));
    chart.x_ticks = Some(vec![0.0, 5.0, 10.0, 60.0]);
    let figure = Figure::Line(chart);
    check(&figure);
    assert_eq!(
        texts(&figure).iter().filter(|t| ["0", "5", "10", "60"].contains(&t.as_str())).count(),
        4
    );
}

#[test]
fn empty_figures_say_so() {
    for figure in [
        Figure::Line(LineChart::default()),
        Figure::Bar(BarChart::default()),
        Figure::Spread(SpreadChart::default()),
        line(vec![vec![(1.0, None), (f64::NAN, Some(2.0)), (2.0, Some(f64::NAN))]]),
        bars(vec![vec![None, Some(f64::NAN)]], true),
        spread(vec![vec![vec![], vec![f64::NAN]]]),
    ] {
        check(&figure);
        assert_eq!(count(&figure, "no data"), 1, "{figure:?}");
    }
    assert_eq!(count(&line(vec![vec![(1.0, Some(2.0))]]), "no data"), 0);
}

#[test]
fn names_survive_escaped() {
    let svg = svg(&bars(vec![vec![Some(1.0)]; 8], true));
    for name in ["A &amp; B &lt;x&gt; &quot;quoted&quot; &apos;too&apos;", "עברית"] {
        assert!(svg.contains(name), "{name}");
    }
    assert!(svg.contains("tab and line[31m") && !svg.contains('\u{1b}'));
}

#[test]
fn the_same_figure_is_the_same_bytes_on_any_thread() {
    let render = || {
        let figure = spread(vec![vec![vec![1.0, 2.5, 3.0]; 3], vec![vec![0.1; 12]; 3]]);
        let svg = svg(&figure);
        let png = png::render(&svg, 96.0 * 1.5).unwrap();
        (svg, png)
    };
    let first = render();
    let threads: Vec<_> = (0..4).map(|_| std::thread::spawn(render)).collect();
    assert!(threads.into_iter().all(|thread| thread.join().unwrap() == first));
}

#[test]
fn a_usual_figure_is_half_a_page_wide() {
    let drawing =
        line(vec![vec![(0.0, Some(20.0)), (60.0, Some(40.0))]]).draw(&Paper::wide()).unwrap();
    assert!((474.0..=486.0).contains(&drawing.width_px), "{}", drawing.width_px);
    assert!((280.0..=340.0).contains(&drawing.height_px), "{}", drawing.height_px);
}

#[test]
fn series_must_fit_their_groups() {
    let Figure::Bar(mut chart) = bars(vec![vec![Some(1.0), None]], true) else { unreachable!() };
    chart.groups.pop();
    let error = Figure::Bar(chart).print(&Style::default()).unwrap_err();
    assert!(matches!(error, PlotError::Groups { found: 2, expected: 1, .. }), "{error}");
}

#[test]
fn data_are_tidy() {
    let csv = line(vec![vec![(1.0, Some(f64::INFINITY)), (2.5, None), (3.0, Some(1e-7))]]).csv();
    assert_eq!(csv, "series,x,y\nRMFR,1.0,inf\nRMFR,2.5,\nRMFR,3.0,1e-7\n");
    let csv = bars(vec![vec![Some(1.0), Some(-f64::INFINITY)]; 2], true).csv();
    let quoted = "\"A & B <x> \"\"quoted\"\" 'too'\"";
    assert!(!quoted.contains(','));
    let rows: Vec<&str> = csv.lines().collect();
    assert_eq!(rows[..2], ["group,series,value", "RMFR,RMFR,1.0"]);
    assert_eq!(rows[4], format!("{quoted},{quoted},-inf"));
    let csv = bars(vec![vec![Some(1.0)]; 7], true).csv();
    assert!(csv.contains("RMFR,\"many many words, one") && csv.contains("RMFR,\"tab\tand\nline"));
    let csv = spread(vec![vec![vec![1.0, f64::NAN]]]).csv();
    assert_eq!(csv, "group,series,value\nRMFR,RMFR,1.0\nRMFR,RMFR,\n");
}

/// A chart over 0 to 3 with these spans.
fn with_spans(spans: Vec<Span>) -> LineChart {
    let series = LineSeries { points: points(&[1.0, 3.0, 2.0, 4.0]), ..LineSeries::default() };
    LineChart { series: vec![series], spans, ..LineChart::default() }
}

/// The plot areas of a drawing from their axis lines, which meet in the lower left corner.
fn plots(drawing: &Drawing) -> Vec<Rect> {
    let mut plots = Vec::new();
    let mut axis: Option<[(f64, f64); 2]> = None;
    for mark in &drawing.marks {
        let Mark::Line(points, stroke) = mark else { continue };
        let [from, to] = points[..] else { continue };
        if stroke.colour != AXIS {
            continue;
        }
        match axis {
            Some([top, bottom]) if from == bottom && to.1 == bottom.1 => {
                plots.push(Rect { left: top.0, top: top.1, right: to.0, bottom: bottom.1 });
            }
            _ if from.0 == to.0 && to.1 - from.1 > 100.0 => axis = Some([from, to]),
            _ => {}
        }
    }
    plots
}

#[test]
fn an_axis_from_zero_begins_there() {
    let ends = |values: &[f64], y_from_zero: bool| {
        let Figure::Line(chart) = line(vec![points(values)]) else { unreachable!() };
        let chart = LineChart { y_from_zero, ..chart };
        check(&Figure::Line(chart.clone()));
        let scale = chart.y_scale().unwrap();
        (scale.low, scale.high)
    };
    let near = |(a, b): (f64, f64), (c, d): (f64, f64)| (a - c).hypot(b - d) < 1e-9;
    assert!(near(ends(&[20.0, 30.0], true), (0.0, 31.8)));
    assert!(near(ends(&[-20.0, -30.0], true), (-31.8, 0.0)));
    assert!(near(ends(&[-20.0, 30.0], true), (-23.0, 33.0)), "air to both sides");
    assert!(near(ends(&[20.0, 30.0], false), (19.4, 30.6)));
    assert!(ends(&[0.0, 0.0], true).0.abs() < 1e-12);
    assert!(ends(&[3e-5, f64::INFINITY], true).0.abs() < 1e-12);
}

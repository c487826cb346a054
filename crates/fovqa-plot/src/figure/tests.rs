//! Every kind of figure with usual, odd and hostile data. All marks must be inside the picture,
//! texts must not overlap, and the output must be the same each time.

use super::*;
use crate::canvas::drawing::{Mark, Rect, Text};
use crate::canvas::look::{AXIS, Colour, GRID, INK, REFERENCE, SPAN};
use crate::{Axis, BarSeries, Fill, FillKind, LineSeries, Look, Span, SpreadSeries, png};

mod curves;
mod random_values;
mod rasters;
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
    });
    let y = Axis::new("SSIM");
    Figure::Bar(BarChart { title: Some(name(1)), y, groups, series: series.collect(), from_zero })
}

fn spread(values: Vec<Vec<Vec<f64>>>) -> Figure {
    let groups = (0..values.first().map_or(0, Vec::len)).map(name).collect();
    let series = values.into_iter().enumerate().map(|(i, values)| SpreadSeries {
        name: name(i),
        look: Look::new(i),
        values,
    });
    let y = Axis::new("a title that is far too long for the height of this axis, whoever wrote it");
    Figure::Spread(SpreadChart { title: None, y, groups, series: series.collect() })
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
    figure.draw().unwrap().texts().iter().map(|text| text.line.clone()).collect()
}

fn count(figure: &Figure, text: &str) -> usize {
    texts(figure).iter().filter(|line| *line == text).count()
}

/// Checks that no mark is outside the picture and that texts do not overlap.
fn check(figure: &Figure) {
    let drawing = figure.draw().unwrap();
    let (width, height) = (drawing.width_px, drawing.height_px);
    let inside = |r: Rect| r.left >= 0.0 && r.top >= 0.0 && r.right <= width && r.bottom <= height;
    for mark in &drawing.marks {
        let (points, reach): (&[_], f64) = match mark {
            Mark::Line(points, _) | Mark::Area(points, _) => (points, 0.0),
            Mark::Disc(centre, radius, _) => (std::slice::from_ref(centre), *radius),
            Mark::Text(_) => (&[], 0.0),
            Mark::Picture(rect, _) => {
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
    let svg = figure.svg().unwrap();
    // The characters of an encoded picture are arbitrary.
    let mut lines = svg.lines().filter(|line| !line.starts_with("<image "));
    assert!(lines.all(|line| !line.contains("NaN") && !line.contains("inf")), "{svg}");
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
    figure.draw().unwrap().marks.iter().filter_map(ends).skip(1).collect()
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
    let drawing = figure.draw().unwrap();
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
        let drawing = figure.draw().unwrap();
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
    let height = crate::page::layout::PLOT_HEIGHT_PX * 4.5 / (9.0 * 1.12);
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
fn names_survive_escaped() {
    let svg = bars(vec![vec![Some(1.0)]; 8], true).svg().unwrap();
    for name in ["A &amp; B &lt;x&gt; &quot;quoted&quot; &apos;too&apos;", "עברית"] {
        assert!(svg.contains(name), "{name}");
    }
    assert!(svg.contains("tab and line[31m") && !svg.contains('\u{1b}'));
}

#[test]
fn the_same_figure_is_the_same_bytes_on_any_thread() {
    let render = || {
        let figure = spread(vec![vec![vec![1.0, 2.5, 3.0]; 3], vec![vec![0.1; 12]; 3]]);
        let svg = figure.svg().unwrap();
        let png = png(&svg, 1.5).unwrap();
        (svg, png)
    };
    let first = render();
    let threads: Vec<_> = (0..4).map(|_| std::thread::spawn(render)).collect();
    assert!(threads.into_iter().all(|thread| thread.join().unwrap() == first));
}

#[test]
fn a_usual_figure_is_half_a_page_wide() {
    let drawing = line(vec![vec![(0.0, Some(20.0)), (60.0, Some(40.0))]]).draw().unwrap();
    assert!((474.0..=486.0).contains(&drawing.width_px), "{}", drawing.width_px);
    assert!((280.0..=340.0).contains(&drawing.height_px), "{}", drawing.height_px);
}

#[test]
fn series_must_fit_their_groups() {
    let Figure::Bar(mut chart) = bars(vec![vec![Some(1.0), None]], true) else { unreachable!() };
    chart.groups.pop();
    let error = Figure::Bar(chart).svg().unwrap_err();
    assert!(matches!(error, PlotError::Groups { found: 2, expected: 1, .. }), "{error}");
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
    let ys: Vec<f64> = figure.draw().unwrap().marks.iter().filter_map(disc).collect();
    // The key, the two points on the axis, then the one above and the one below.
    let [_, zero, one, above, below] = ys[..] else { panic!("{ys:?}") };
    assert!(above < one && one < zero && zero < below, "{ys:?}");
    assert!((below - above - crate::page::layout::PLOT_HEIGHT_PX).abs() < 1e-6);
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

#[test]
fn panels_stay_inside_the_picture() {
    for (count, columns) in (1..9).flat_map(|count| (1..5).map(move |c| (count, c))) {
        let curves: Vec<_> = (0..5).map(|s| points(&ODD[s..][..5])).collect();
        check(&panels(&curves, count, columns));
        let infinite = points(&[f64::INFINITY, 1e-5, 3e-5, f64::NEG_INFINITY]);
        check(&panels(&[infinite.clone(), infinite], count, columns));
    }
    for (i, a) in ODD.into_iter().enumerate() {
        for b in ODD {
            let xy = vec![(a, Some(b)), (b, Some(a))];
            check(&panels(&[xy, vec![(a, None)]], 4, 2 + i % 3));
        }
    }
}

#[test]
fn plot_areas_of_panels_are_aligned() {
    for columns in 1..5 {
        let mut figure = panels(&[points(&[3e-5, 1e-6]), points(&[1.0, -2.0])], 8, columns);
        let Figure::Panels(chart) = &mut figure else { unreachable!() };
        chart.panels[1].series[0].points = points(&[f64::INFINITY, 123_456.7, f64::NEG_INFINITY]);
        chart.panels[2].series.clear();
        let plots = plots(&figure.draw().unwrap());
        assert_eq!(plots.len(), 8);
        for (i, a) in plots.iter().enumerate() {
            for (j, b) in plots[..i].iter().enumerate() {
                let rows = (a.top, a.bottom) == (b.top, b.bottom);
                assert_eq!(rows, i / columns == j / columns, "{i} and {j} of {columns}");
                let lined_up = (a.left, a.right) == (b.left, b.right);
                assert_eq!(lined_up, i % columns == j % columns, "{i} and {j} of {columns}");
                assert!(!a.overlaps(*b) && (a.width() - b.width()).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn panels_share_a_legend() {
    let mut figure = panels(&[points(&[1.0, 2.0]), points(&[2.0, 3.0])], 5, 3);
    let Figure::Panels(chart) = &mut figure else { unreachable!() };
    chart.title = None;
    let names = [["KFR", "RMFR"], ["RMFR", "VaFR"], ["Hyper3", "KFR"]];
    for (panel, names) in chart.panels.iter_mut().zip(names.iter().cycle()) {
        panel.title = None;
        let series = |name: &&str| LineSeries {
            name: (*name).to_owned(),
            points: points(&[1.0, 2.0]),
            ..LineSeries::default()
        };
        panel.series = names.iter().map(series).collect();
    }
    check(&figure);
    let names = ["KFR", "RMFR", "VaFR", "Hyper3", "saccade"];
    assert_eq!(texts(&figure)[..5], names);
    assert!(names.iter().all(|name| count(&figure, name) == 1));

    // Reference curves come last in the legend, wherever they first occur.
    let Figure::Panels(chart) = &mut figure else { unreachable!() };
    chart.panels[0].series[1].reference = true;
    chart.panels[1].series[0].reference = true;
    assert_eq!(texts(&figure)[..4], ["KFR", "VaFR", "Hyper3", "RMFR"]);
}

#[test]
fn a_row_of_one_measure_has_its_title_once() {
    let figure = panels(&[points(&[1.0, 2.0])], 8, 3);
    // The last row has two different axes.
    assert_eq!((count(&figure, "Error energy"), count(&figure, "another measure")), (3, 1));
    let two = panels(&[points(&[1.0, 2.0])], 8, 4);
    assert_eq!((count(&two, "Error energy"), count(&two, "another measure")), (4, 1));
    assert_eq!(count(&two, "Eccentricity (°)"), 8);
}

#[test]
fn panels_have_the_width_of_a_column_or_a_page() {
    let curves = [points(&[3e-3, 1e-6])];
    let width = |count, columns| panels(&curves, count, columns).draw().unwrap().width_px;
    let Figure::Panels(chart) = panels(&curves, 1, 1) else { unreachable!() };
    assert_eq!(width(1, 1), chart.panels[0].draw().width_px);
    assert_eq!((width(5, 1), width(5, 0), width(1, 3)), (width(1, 1), width(1, 1), width(1, 1)));
    for columns in 2..5 {
        assert!((940.0..=961.0).contains(&width(8, columns)), "{columns}");
    }
}

#[test]
fn panels_without_data_say_so() {
    for columns in [0, 1, 3, usize::MAX] {
        let figure = Figure::Panels(PanelChart { columns, ..PanelChart::default() });
        check(&figure);
        assert_eq!((count(&figure, "no data"), figure.csv().as_str()), (1, "panel,series,x,y\n"));
        let mut some = panels(&[points(&[1.0, 2.0]), points(&[2.0])], 4, columns);
        let Figure::Panels(chart) = &mut some else { unreachable!() };
        chart.panels[1].series.clear();
        chart.panels[2] = LineChart::default();
        check(&some);
        assert_eq!(count(&some, "no data"), 2);
    }
}

#[test]
fn data_of_panels_and_spans_are_tidy() {
    let mut chart = with_spans(vec![span(0.5, f64::INFINITY), span(2.0, f64::NAN)]);
    chart.series[0].points.truncate(1);
    chart.series.push(LineSeries {
        name: "b".to_owned(),
        points: vec![(2.0, None)],
        ..LineSeries::default()
    });
    let rows = [",0.0,1.0", "b,2.0,", "saccade,0.5,", "saccade,inf,", "saccade,2.0,", "saccade,,"];
    let csv = |head: &str, panel: &str| {
        rows.iter().fold(format!("{head}\n"), |csv, row| format!("{csv}{panel}{row}\n"))
    };
    assert_eq!(Figure::Line(chart.clone()).csv(), csv("series,x,y", ""));
    chart.title = Some("Sponza, 2".to_owned());
    let untitled = with_spans(Vec::new());
    let panels = PanelChart { panels: vec![chart, untitled], columns: 2, ..PanelChart::default() };
    let all = Figure::Panels(panels).csv();
    let first = csv("panel,series,x,y", "\"Sponza, 2\",");
    assert_eq!(
        all.strip_prefix(first.as_str()),
        Some(",,0.0,1.0\n,,1.0,3.0\n,,2.0,2.0\n,,3.0,4.0\n")
    );
}

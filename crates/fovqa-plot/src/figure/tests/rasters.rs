//! Pictures of a quantity over a plane.

use resvg::tiny_skia::Pixmap;

use super::*;
use crate::canvas::colour::WHITE;
use crate::canvas::colour_map::{NO_VALUE, palette};
use crate::{RasterLine, RasterPanel};

/// A panel from −20 to 20 across and from −10 to 10 down.
fn panel(columns: usize, values: &[f64]) -> RasterPanel {
    RasterPanel {
        title: Some("RMFR".to_owned()),
        x: Axis::new("Horizontal angle (°)"),
        y: Axis::new("Vertical angle (°)"),
        x_range: (-20.0, 20.0),
        y_range: (-10.0, 10.0),
        columns,
        rows: values.len() / columns,
        values: values.to_vec(),
        ..RasterPanel::default()
    }
}

fn chart(panels: Vec<RasterPanel>, columns: usize) -> RasterChart {
    let colour = Axis::new("Samples per square degree");
    RasterChart { panels, columns, colour, ..RasterChart::default() }
}

/// The pictures of a drawing; the last one is that of the colour bar.
fn pictures(drawing: &Drawing) -> Vec<(Rect, Vec<u8>)> {
    let picture = |mark: &Mark| match mark {
        Mark::Picture(rect, bitmap) => Some((*rect, bitmap.levels.clone())),
        _ => None,
    };
    drawing.marks.iter().filter_map(picture).collect()
}

fn levels(chart: &RasterChart) -> Vec<u8> {
    pictures(&chart.draw(&Paper::wide()).unwrap())[0].1.clone()
}

#[test]
fn values_have_the_colours_of_their_range() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    let mut figure = chart(vec![panel(3, &[2.0, 4.0, 10.0, nan, inf, -inf])], 1);
    assert_eq!(levels(&figure), [0, 64, 254, 255, 254, 0]);
    figure.range = Some((4.0, 6.0));
    assert_eq!(levels(&figure), [0, 0, 254, 255, 254, 0], "those beyond have the end's");
    for range in [(6.0, 4.0), (4.0, inf), (nan, 4.0)] {
        figure.range = Some(range);
        assert_eq!(levels(&figure)[1], 64, "{range:?}");
    }
    let mut ratios = chart(vec![panel(5, &[1.0, 10.0, 100.0, 0.0, -3.0])], 1);
    ratios.log = true;
    assert_eq!(levels(&ratios), [0, 127, 254, 0, 0]);
    ratios.range = Some((0.0, 100.0));
    assert_eq!(levels(&ratios), [0, 127, 254, 0, 0], "0 is no end of it");
}

#[test]
fn all_panels_have_one_scale_and_one_bar() {
    let figure = chart(vec![panel(2, &[0.0, 1.0]), panel(2, &[1.0, 2.0])], 2);
    let drawing = figure.draw(&Paper::wide()).unwrap();
    let pictures = pictures(&drawing);
    assert_eq!(pictures.len(), 3);
    assert_eq!((&pictures[0].1, &pictures[1].1), (&vec![0, 127], &vec![127, 254]));
    let bar = &pictures[2];
    assert!(bar.1.is_sorted_by(|a, b| a > b) && bar.1.len() == 255, "the most on top");
    assert!(bar.0.left > pictures[1].0.right);
    let labels: Vec<&Text> =
        drawing.texts().into_iter().filter(|t| t.at.0 > bar.0.right && !t.upwards).collect();
    let at = |label: &str| labels.iter().find(|t| t.line == label).map(|t| t.at.1).unwrap();
    assert!(at("2.0") < at("1.0") && at("1.0") < at("0.0"));
    assert_eq!(count(&Figure::Raster(figure.clone()), "Samples per square degree"), 1);
    assert_eq!(count(&Figure::Raster(figure), "Vertical angle (°)"), 1, "once a row");
}

#[test]
fn units_are_equal_on_both_axes() {
    let tall = RasterPanel { y_range: (30.0, -30.0), ..panel(1, &[1.0]) };
    for columns in 1..4 {
        let figure = chart(vec![panel(2, &[0.0, 1.0]), tall.clone(), panel(1, &[1.0])], columns);
        check(&Figure::Raster(figure.clone()));
        let pictures = pictures(&figure.draw(&Paper::wide()).unwrap());
        for (picture, ratio) in pictures.iter().zip([0.5, 1.5, 0.5]) {
            assert!((picture.0.height() / picture.0.width() - ratio).abs() < 1e-9);
        }
    }
}

#[test]
fn y_runs_from_the_first_value_at_the_top() {
    let label_at = |y_range, label: &str| {
        let figure = chart(vec![RasterPanel { y_range, ..panel(1, &[1.0]) }], 1);
        let drawing = figure.draw(&Paper::wide()).unwrap();
        let left = pictures(&drawing)[0].0.left;
        let texts = drawing.texts();
        let found = texts.iter().find(|t| t.line == label && t.at.0 < left);
        found.map(|t| t.at.1).unwrap()
    };
    assert!(label_at((-10.0, 10.0), "−5") < label_at((-10.0, 10.0), "5"), "down");
    assert!(label_at((10.0, -10.0), "−5") > label_at((10.0, -10.0), "5"), "up");
}

/// The pixels of a figure at the centre of each cell of its first picture.
fn pixels(figure: &RasterChart) -> Vec<Colour> {
    const SCALE: f64 = 1.5;
    let svg = svg(&Figure::Raster(figure.clone()));
    let pixmap = Pixmap::decode_png(&png::render(&svg, 96.0 * SCALE as f32).unwrap()).unwrap();
    let rect = pictures(&figure.draw(&Paper::wide()).unwrap())[0].0;
    let RasterPanel { columns, rows, .. } = figure.panels[0];
    let cell = |i: usize| {
        let x = rect.left + (0.5 + (i % columns) as f64) / columns as f64 * rect.width();
        let y = rect.top + (0.5 + (i / columns) as f64) / rows as f64 * rect.height();
        let pixel = pixmap.pixel((x * SCALE) as u32, (y * SCALE) as u32).unwrap();
        Colour(pixel.red(), pixel.green(), pixel.blue())
    };
    (0..columns * rows).map(cell).collect()
}

#[test]
fn a_png_shows_every_cell_unsmeared() {
    let values: Vec<f64> = (0..40 * 20).map(|i| f64::from(i * 37 % 101)).collect();
    let mut figure = chart(vec![panel(40, &values)], 1);
    figure.panels[0].values[7] = f64::NAN;
    let palette = palette();
    let want: Vec<Colour> = levels(&figure).iter().map(|l| palette[usize::from(*l)]).collect();
    assert_eq!(pixels(&figure), want);
    assert_eq!(want[7], NO_VALUE);
    let one = chart(vec![panel(1, &[3.0])], 1);
    assert_eq!(pixels(&one), [palette[127]], "a single value is in the middle");
}

#[test]
fn lines_and_cross_are_seen_and_end_at_the_picture() {
    let mut figure = chart(vec![panel(2, &[0.0, 1.0])], 1);
    let points = vec![(-90.0, 0.0), (0.0, 0.0), (0.0, f64::NAN), (0.0, 5.0), (0.0, 90.0)];
    figure.panels[0].lines = vec![RasterLine { name: "10°".to_owned(), points }];
    figure.panels[0].cross = Some((19.99, -5.0));
    check(&Figure::Raster(figure.clone()));
    let drawing = figure.draw(&Paper::wide()).unwrap();
    let rect = pictures(&drawing)[0].0;
    let lines = |colour: Colour, width: f64| -> Vec<Vec<(f64, f64)>> {
        let line = |mark: &Mark| match mark {
            Mark::Line(points, stroke) if stroke.colour == colour && stroke.width_px > width => {
                Some(points.clone())
            }
            _ => None,
        };
        drawing.marks.iter().filter_map(line).collect()
    };
    let (core, edge) = (lines(WHITE, 1.0), lines(INK, 3.0));
    assert_eq!((core.len(), &core), (4, &edge), "a white core on a dark edge");
    let near = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).hypot(a.1 - b.1) < 1e-6;
    let (x, y) = rect.centre();
    assert!(near(core[0][0], (rect.left, y)) && near(core[0][1], (x, y)));
    let quarter = rect.height() / 4.0;
    assert!(near(core[1][0], (x, y + quarter)) && near(core[1][1], (x, rect.bottom)));
    assert!(core[2].iter().all(|p| p.0 <= rect.right && (p.1 - (y - quarter)).abs() < 1e-6));
    assert_eq!(count(&Figure::Raster(figure.clone()), "10°"), 1);
    figure.panels[0].lines[0].points = vec![(30.0, 0.0), (40.0, 0.0)];
    figure.panels[0].cross = Some((0.0, 11.0));
    let drawing = figure.draw(&Paper::wide()).unwrap();
    let white = |mark: &&Mark| matches!(mark, Mark::Line(_, stroke) if stroke.colour == WHITE);
    assert_eq!(drawing.marks.iter().filter(white).count(), 0);
    assert_eq!(count(&Figure::Raster(figure), "10°"), 0);
}

#[test]
fn a_line_along_the_border_does_not_stand_out() {
    let mut figure = chart(vec![panel(2, &[0.0, 1.0])], 1);
    let points = vec![(-20.0, -10.0), (20.0, -10.0), (20.0, 10.0), (-20.0, 10.0), (-20.0, -10.0)];
    figure.panels[0].lines = vec![RasterLine { name: String::new(), points }];
    let rect = pictures(&figure.draw(&Paper::wide()).unwrap())[0].0;
    let svg = svg(&Figure::Raster(figure));
    let pixmap = Pixmap::decode_png(&png::render(&svg, 96.0 * 2.0).unwrap()).unwrap();
    // The pixels are between two ticks, starting just outside the frame.
    let (x, y) = (rect.left + 0.27 * rect.width(), rect.top + 0.1 * rect.height());
    for out in [1.2, 1.7, 2.2, 2.7] {
        for (x, y) in [(x, rect.top - out), (x, rect.bottom + out), (rect.left - out, y)] {
            let pixel = pixmap.pixel((x * 2.0) as u32, (y * 2.0) as u32).unwrap();
            assert_eq!((pixel.red(), pixel.blue()), (255, 255), "{x} {y}");
        }
    }
}

#[test]
fn labels_keep_off_each_other_and_the_cross() {
    let mut figure = chart(vec![panel(2, &[0.0, 1.0])], 1);
    let ring = |i: u32| {
        let at = |k: u32| {
            let turn = f64::from(k) * std::f64::consts::TAU / 90.0;
            (f64::from(i) * turn.cos(), f64::from(i) * turn.sin())
        };
        RasterLine { name: format!("{i}°"), points: (0..=90).map(at).collect() }
    };
    figure.panels[0].cross = Some((0.0, 0.0));
    figure.panels[0].lines = (1..8).map(ring).collect();
    check(&Figure::Raster(figure.clone()));
    assert_eq!(count(&Figure::Raster(figure.clone()), "1°"), 1, "beside a small ring");
    assert_eq!(count(&Figure::Raster(figure.clone()), "7°"), 1);
    let drawing = figure.draw(&Paper::wide()).unwrap();
    let centre = pictures(&drawing)[0].0.centre();
    let cross = Rect {
        left: centre.0 - 8.0,
        right: centre.0 + 8.0,
        top: centre.1 - 8.0,
        bottom: centre.1 + 8.0,
    };
    let label = |text: &&&Text| text.line.ends_with('°');
    assert!(drawing.texts().iter().filter(label).all(|text| !text.bounds().overlaps(cross)));
    figure.panels[0].lines = vec![ring(5); 400];
    check(&Figure::Raster(figure));
}

#[test]
fn cells_and_ranges_must_fit() {
    let error = |panel: RasterPanel| {
        Figure::Raster(chart(vec![panel], 1)).print(&Style::default()).unwrap_err()
    };
    let missing = RasterPanel { rows: 2, ..panel(2, &[1.0, 2.0]) };
    let found = error(missing);
    assert!(
        matches!(&found, PlotError::Cells { panel, found: 2, columns: 2, rows: 2 } if panel == "RMFR"),
        "{found}"
    );
    let (columns, rows) = (usize::MAX, 2);
    assert!(matches!(
        error(RasterPanel { columns, rows, ..panel(1, &[1.0]) }),
        PlotError::Cells { .. }
    ));
    for ends in [(1.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (1.0, -1.0)] {
        let across = RasterPanel { x_range: ends, ..panel(1, &[1.0]) };
        assert!(matches!(error(across), PlotError::Extent { .. }), "{ends:?}");
        let down = RasterPanel { y_range: ends, ..panel(1, &[1.0]) };
        let drawn = Figure::Raster(chart(vec![down], 1)).print(&Style::default());
        assert_eq!(drawn.is_ok(), ends == (1.0, -1.0), "{ends:?}");
    }
}

#[test]
fn pictures_without_values_say_so() {
    let nan = panel(2, &[f64::NAN, f64::NAN]);
    for (figure, said) in [
        (RasterChart::default(), 1),
        (chart(vec![RasterPanel::default(), nan.clone(), panel(1, &[1.0])], 2), 2),
        (chart(vec![panel(1, &[f64::INFINITY])], 1), 0),
    ] {
        let figure = Figure::Raster(figure);
        check(&figure);
        assert_eq!(count(&figure, "no data"), said, "{figure:?}");
    }
    let gray = |mark: &Mark| matches!(mark, Mark::Area(_, NO_VALUE));
    assert!(chart(Vec::new(), 1).draw(&Paper::wide()).unwrap().marks.iter().any(gray));
}

#[test]
fn hostile_pictures_stay_inside() {
    for (i, a) in ODD.into_iter().enumerate() {
        for (j, b) in ODD.into_iter().enumerate() {
            let line = RasterLine { name: name(i), points: vec![(a, b), (b, a), (0.0, 0.0)] };
            let panel = |k: usize| RasterPanel {
                title: Some(name(i + k)),
                y: Axis::new(name(j)),
                y_range: (if a == b { a - 1.0 } else { a }.clamp(-9e9, 9e9), b.clamp(-8e9, 8e9)),
                lines: vec![line.clone(); k],
                cross: Some((b, a)),
                ..panel(2, &[a, b])
            };
            let panels = (0..=j % 3).map(panel).collect();
            let mut figure = chart(panels, 1 + i % 3);
            figure.title = Some(name(j));
            figure.log = (i + j) % 2 == 0;
            figure.range = (j % 3 == 0).then_some((a, b));
            if figure.draw(&Paper::wide()).is_ok() {
                check(&Figure::Raster(figure));
            }
        }
    }
}

#[test]
fn pictures_have_the_width_of_a_column_or_a_page() {
    let width = |count, columns| {
        let panels = vec![panel(2, &[0.0, 1.0]); count];
        chart(panels, columns).draw(&Paper::wide()).unwrap().width_px
    };
    assert!((465.0..=495.0).contains(&width(1, 1)), "{}", width(1, 1));
    assert_eq!((width(3, 1), width(3, 0), width(1, 4)), (width(1, 1), width(1, 1), width(1, 1)));
    for columns in 2..5 {
        assert!((935.0..=970.0).contains(&width(8, columns)), "{columns}");
    }
}

#[test]
fn data_of_pictures_are_tidy() {
    let mut figure = chart(vec![panel(2, &[1.0, f64::NAN, 3.0, f64::INFINITY])], 1);
    figure.panels[0].lines = vec![RasterLine { name: "10°".to_owned(), points: vec![(0.0, 0.0)] }];
    let csv = Figure::Raster(figure).csv();
    let rows =
        ["RMFR,-10.0,-5.0,1.0", "RMFR,10.0,-5.0,", "RMFR,-10.0,5.0,3.0", "RMFR,10.0,5.0,inf"];
    assert_eq!(csv, format!("panel,x,y,value\n{}\n", rows.join("\n")));
}

#[test]
fn the_same_picture_is_the_same_bytes_on_any_thread() {
    let render = || {
        let values: Vec<f64> = (0..60 * 30).map(|i| f64::from(i * 37 % 101)).collect();
        let figure = RasterChart { log: true, ..chart(vec![panel(60, &values); 2], 2) };
        svg(&Figure::Raster(figure))
    };
    let first = render();
    let threads: Vec<_> = (0..4).map(|_| std::thread::spawn(render)).collect();
    assert!(threads.into_iter().all(|thread| thread.join().unwrap() == first));
    assert_eq!(first.matches("<image ").count(), 3);
    assert_eq!(first.matches("<svg").count(), 1, "one document");
    assert_eq!(first.matches("</svg>").count(), 1);
}

/// Of a map over two parameters, the rows are those of the largest value at the top, whatever the order
/// of the values, and each cell extends half the way to its neighbours.
#[test]
fn a_map_has_each_value_where_its_parameters_are() {
    let (x, y) = ([4.0, 1.0, 2.0], [10.0, 20.0]);
    let value = |column: usize, row: usize| Some(x[column] * 100.0 + y[row]);
    let axis = |log| Axis { log, ..Axis::new("a") };
    for (log, ends, edge) in
        [(false, (0.5, 5.0), 2.0 / 9.0), (true, (0.5f64.sqrt(), 32f64.sqrt()), 1.0 / 3.0)]
    {
        let panel = RasterPanel::map((axis(log), &x), (axis(false), &y), value);
        assert!((panel.x_range.0 - ends.0).abs() < 1e-9 && (panel.x_range.1 - ends.1).abs() < 1e-9);
        assert_eq!(panel.y_range, (25.0, 5.0));
        assert_eq!(panel.values, [120.0, 220.0, 420.0, 110.0, 210.0, 410.0]);
        let levels = levels(&chart(vec![panel.clone()], 1));
        let side = (levels.len() as f64).sqrt() as usize;
        let first = levels[0];
        let wide = levels.iter().take_while(|level| **level == first).count();
        assert!((wide as f64 / side as f64 - edge).abs() < 2.0 / side as f64, "{log}: {wide}");
        assert_eq!(levels[side * side - 1], levels[side * (side / 2 + 1) + side - 1]);
        assert!(levels[0] > levels[side * (side - 1)], "the larger value is above");
        let csv = Figure::Raster(chart(vec![panel], 1)).csv();
        assert!(csv.starts_with("panel,x,y,value\n,1.0,20.0,120.0\n,2.0,20.0,220.0\n"), "{csv}");
    }
}

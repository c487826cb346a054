//! Sizes in print, and how series are told apart.

use super::*;
use crate::{Height, Palette, RasterPanel};

fn usual() -> Figure {
    line(vec![vec![(0.0, Some(20.0)), (60.0, Some(40.0))]; 4])
}

/// Every kind of figure.
fn kinds() -> Vec<Figure> {
    let curves = vec![points(&[20.0, 30.0, 25.0]); 3];
    let values = vec![vec![Some(1.0), Some(2.0)]; 3];
    let picture =
        RasterPanel { columns: 2, rows: 1, values: vec![0.0, 1.0], ..RasterPanel::default() };
    vec![
        usual(),
        bars(values, true),
        spread(vec![vec![vec![1.0, 2.5, 3.0]; 3]; 2]),
        panels(&curves, 4, 2),
        Figure::Raster(RasterChart {
            panels: vec![picture; 2],
            columns: 2,
            ..RasterChart::default()
        }),
    ]
}

#[test]
fn figures_have_the_width_of_a_column_or_a_page() {
    for (figure, width_in) in kinds().iter().zip([3.3, 3.3, 3.3, 7.0, 7.0]) {
        let printed = figure.print(&Style::default()).unwrap();
        let (found, height_in) = printed.size_in();
        assert!((found - width_in).abs() < 1e-9, "{found} for {width_in}");
        assert!((1.5..5.0).contains(&height_in), "{height_in}");
    }
}

#[test]
fn a_width_that_was_asked_for_is_exact() {
    for figure in kinds() {
        for width_in in [3.3, 5.0, 7.0, 12.5] {
            let printed = figure.print(&Style { width_in: Some(width_in), ..Style::default() });
            let printed = printed.unwrap();
            assert!((printed.size_in().0 - width_in).abs() < 1e-9, "{width_in}");
            assert!(printed.svg().unwrap().starts_with(&format!("<svg width=\"{width_in}in\"")));
            check_drawing(&printed.drawing);
            let least = printed.drawing.texts().iter().map(|t| t.size_px).fold(99.0, f64::min);
            assert!(least * printed.pt_per_px > 6.0 - 1e-6, "{least}");
        }
    }
}

#[test]
fn text_has_the_size_that_was_asked_for() {
    for font_pt in [6.0, 7.0, 9.5] {
        let printed = usual().print(&Style { font_pt, ..Style::default() }).unwrap();
        assert!((printed.pt_per_px * 11.0 / font_pt - 1.0).abs() < 0.01);
    }
}

#[test]
fn a_height_that_was_asked_for_is_met() {
    for figure in &kinds()[..4] {
        for height_in in [2.7, 3.5, 6.0] {
            let style = Style { height: Height::Inches(height_in), ..Style::default() };
            let printed = figure.print(&style).unwrap();
            assert!((printed.size_in().1 - height_in).abs() < 0.03, "{:?}", printed.size_in());
            check_drawing(&printed.drawing);
        }
        let style = Style { width_in: Some(7.0), height: Height::Aspect(2.0), ..Style::default() };
        let (width, height) = figure.print(&style).unwrap().size_in();
        assert!((width - 7.0).abs() < 1e-9 && (height - 3.5).abs() < 0.03, "{width} {height}");
    }
}

#[test]
fn impossible_sizes_are_errors_that_say_what_is_possible() {
    let style = |width_in, height| Style { width_in, height, ..Style::default() };
    let names: Vec<String> = (0..4).map(|i| format!("a_name_of_a_scene_{i}")).collect();
    let series = vec![BarSeries {
        name: "RMFR".to_owned(),
        look: Look::new(0),
        values: vec![Some(1e9); 4],
        ..BarSeries::default()
    }];
    let figure = Figure::Bar(BarChart { groups: names, series, ..BarChart::default() });
    let Err(PlotError::Narrow { least_in, .. }) = figure.print(&style(Some(0.5), Height::Suited))
    else {
        panic!("half an inch is too narrow")
    };
    assert!((0.6..3.0).contains(&least_in), "{least_in}");
    let Err(PlotError::Low { least_in, .. }) = figure.print(&style(None, Height::Inches(0.4)))
    else {
        panic!("0.4 inches are too low")
    };
    let printed = figure.print(&style(None, Height::Inches(least_in + 0.05)));
    assert!(printed.is_ok(), "{least_in} {:?}", printed.err());
    let error = kinds()[4].print(&style(None, Height::Inches(3.0))).unwrap_err();
    assert!(error.to_string().contains("a height of 3.00 in is not possible"), "{error}");
}

#[test]
fn titles_markers_and_dashes_can_be_left_out() {
    let Figure::Line(mut chart) = usual() else { unreachable!() };
    chart.title = Some("A title".to_owned());
    let figure = Figure::Line(chart);
    let plain = Style { title: false, markers: false, line_styles: false, ..Style::default() };
    let (with, without) = (figure.print(&Style::default()).unwrap(), figure.print(&plain).unwrap());
    let discs = |printed: &Printed| {
        printed.drawing.marks.iter().filter(|m| matches!(m, Mark::Disc(..))).count()
    };
    assert!(discs(&with) > 0 && discs(&without) == 0);
    let titles = |printed: &Printed| {
        printed.drawing.texts().iter().filter(|text| text.line == "A title").count()
    };
    assert_eq!((titles(&with), titles(&without)), (1, 0));
    // A dashed curve is many short lines.
    assert!(without.drawing.marks.len() * 2 < with.drawing.marks.len());
    let gray = Style { palette: Palette::GRAY, ..Style::default() };
    let colours = |printed: &Printed| -> Vec<Colour> {
        let colour = |mark: &Mark| match mark {
            Mark::Line(_, stroke) => Some(stroke.colour),
            Mark::Area(_, colour) | Mark::Disc(_, _, colour) => Some(*colour),
            Mark::Picture(..) | Mark::Photo(..) | Mark::Text(_) => None,
        };
        printed.drawing.marks.iter().filter_map(colour).collect()
    };
    let all_gray = |colours: Vec<Colour>| colours.iter().all(|c| c.0 == c.1 && c.1 == c.2);
    assert!(all_gray(colours(&figure.print(&gray).unwrap())));
    assert!(!all_gray(colours(&with)));
}

#[test]
fn a_pdf_has_its_size_and_its_text() {
    for figure in kinds() {
        let printed = figure.print(&Style::default()).unwrap();
        let pdf = printed.pdf("RMFR & friends").unwrap();
        assert_eq!(pdf, printed.pdf("RMFR & friends").unwrap());
        assert!(pdf.starts_with(b"%PDF-1.7"));
        let text = String::from_utf8_lossy(&pdf);
        let (width, height) = printed.size_in();
        let sides = text.split("/MediaBox [").nth(1).unwrap().split(']').next().unwrap();
        let sides: Vec<f64> = sides.split(' ').map(|side| side.parse().unwrap()).collect();
        assert!((sides[2] - width * 72.0).abs() < 1e-3 && (sides[3] - height * 72.0).abs() < 1e-3);
        assert!(text.contains("+DejaVuSans") && text.contains("/FontFile2"));
        assert!(text.contains("/Title (RMFR & friends)") && !text.contains("Date"));
    }
}

//! Pictures side by side.

use super::*;
use crate::canvas::colour::WHITE;
use crate::{MontageRow, Photo};

fn photo(width: usize, height: usize) -> Photo {
    Photo { width, rgb: (0..width * height).map(|i| [i as u8, 0, 255]).collect() }
}

fn montage(columns: usize, pictures: &[Option<Photo>]) -> MontageChart {
    let row = MontageRow {
        label: format!("door, 21.3°, {}", MontageRow::MAGNIFICATION),
        frame_width: 400,
        pictures: pictures.to_vec(),
        cross: Some((4.0, 2.0)),
    };
    MontageChart {
        title: None,
        columns: (0..columns).map(name).collect(),
        rows: vec![row.clone(), MontageRow { cross: Some((-3.0, 2.0)), ..row }],
    }
}

fn photos(drawing: &Drawing) -> Vec<Rect> {
    let rect = |mark: &Mark| if let Mark::Photo(rect, _) = mark { Some(*rect) } else { None };
    drawing.marks.iter().filter_map(rect).collect()
}

#[test]
fn pictures_keep_their_shape_and_stand_in_rows() {
    for columns in [1, 3, 9] {
        let chart = montage(columns, &vec![Some(photo(8, 4)); columns]);
        check(&Figure::Montage(chart.clone()));
        let drawing = chart.draw(&Paper::wide());
        let rects = photos(&drawing);
        assert_eq!(rects.len(), 2 * columns);
        assert!(rects.iter().all(|r| (r.width() / r.height() - 2.0).abs() < 1e-9));
        assert!(rects[columns - 1].right <= 960.0 && rects[columns].top > rects[0].bottom);
    }
}

#[test]
fn the_magnification_is_that_of_print() {
    // Three pictures of 8 pixels are each a third as wide as the figure, less two gaps of 4 px;
    // the frame of 400 pixels would be as wide as the figure.
    let figure = Figure::Montage(montage(3, &vec![Some(photo(8, 4)); 3]));
    let inner = 960.0 - 16.0;
    let want = (inner - 8.0) / 3.0 / 8.0 * 400.0 / inner;
    let labels = texts(&figure);
    assert!(labels.contains(&format!("door, 21.3°, ×{want:.1}")), "{labels:?}");
}

#[test]
fn a_missing_picture_says_so_and_a_cross_outside_is_not_drawn() {
    let chart = montage(2, &[None, Some(photo(8, 4))]);
    let figure = Figure::Montage(chart.clone());
    check(&figure);
    assert_eq!(count(&figure, "n/a"), 2);
    let crosses = |chart: &MontageChart| {
        let white = |mark: &&Mark| matches!(mark, Mark::Line(_, s) if s.colour == WHITE);
        chart.draw(&Paper::wide()).marks.iter().filter(white).count()
    };
    assert_eq!(crosses(&chart), 2, "one cross of two lines, in the first row");
    assert!(figure.csv().starts_with("row,column\n\"door"));
    let empty = Figure::Montage(MontageChart::default());
    check(&empty);
    assert_eq!(count(&empty, "no data"), 1);
}

#[test]
fn as_many_columns_fit_as_have_readable_headings() {
    let most = |names: &[&str], width_in: Option<f64>| {
        let headings: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        MontageChart::most_columns(&headings, &Style { width_in, ..Style::default() })
    };
    let short = vec!["RMFR"; 40];
    // At 7 in and 7 pt, the page has 792 pixels of 11 for the smallest text.
    assert_eq!((most(&short, None), most(&short, Some(3.3))), (8, 4));
    assert_eq!(most(&short[..3], None), 3, "no more than there are");
    let mut long = short.clone();
    long[7] = "Foveated-super-resolution, no temporal filter";
    let fewer = most(&long, None);
    assert!((4..8).contains(&fewer), "{fewer}");
    assert_eq!(most(&["w".repeat(200).as_str(), "b", "c", "d", "e"], None), 4, "it is cut then");
    assert_eq!(most(&short, Some(0.5)), 2);
}

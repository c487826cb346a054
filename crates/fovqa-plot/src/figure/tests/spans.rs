//! Shaded spans of the horizontal axis.

use super::*;

/// The shaded spans in the plot areas, without those in the legend.
fn shaded(drawing: &Drawing) -> Vec<Rect> {
    let area = |mark: &Mark| match mark {
        Mark::Area(points, SPAN) => {
            let ((left, top), (right, bottom)) = (points[0], points[2]);
            Some(Rect { left, top, right, bottom })
        }
        _ => None,
    };
    let areas = drawing.marks.iter().filter_map(area);
    areas.filter(|area| area.height() > 100.0).collect()
}

#[test]
fn spans_are_behind_all_else_and_as_high_as_the_plot_area() {
    let drawing = with_spans(vec![span(1.0, 2.0)]).draw(&Paper::wide());
    let (plot, area) = (plots(&drawing)[0], shaded(&drawing)[0]);
    assert_eq!((area.top, area.bottom), (plot.top, plot.bottom));
    // The axis runs from 0 to 3 plus its space.
    let unit = plot.width() / (3.0 * 1.04);
    assert!((area.left - (plot.left + 1.06 * unit)).abs() < 1e-6);
    assert!((area.width() - unit).abs() < 1e-6);
    let high = |mark: &&Mark| matches!(mark, Mark::Area(p, SPAN) if p[2].1 - p[0].1 > 100.0);
    let at = drawing.marks.iter().position(|mark| high(&mark)).unwrap();
    let over = |mark: &Mark| match mark {
        Mark::Line(_, stroke) => [GRID, AXIS, Look::new(0).colour()].contains(&stroke.colour),
        _ => false,
    };
    assert_eq!(drawing.marks.iter().position(over), Some(at + 1), "no line is before it");
}

#[test]
fn spans_end_at_the_plot_area() {
    let beyond = [span(-1e9, 0.5), span(2.5, 1e300), span(9.0, 2.9), span(0.0, 0.0)];
    let mut chart = with_spans(beyond.to_vec());
    for ticks in [None, Some(vec![0.0, 3.0])] {
        chart.x_ticks = ticks;
        let drawing = chart.draw(&Paper::wide());
        let (plot, areas) = (plots(&drawing)[0], shaded(&drawing));
        let bare = with_spans(Vec::new());
        assert_eq!(
            plots(&LineChart { x_ticks: chart.x_ticks.clone(), ..bare }.draw(&Paper::wide()))[0]
                .width(),
            plot.width()
        );
        assert_eq!(areas.len(), 4);
        assert!(areas.iter().all(|a| a.left >= plot.left && a.right <= plot.right));
        assert!(
            (areas[0].left, areas[1].right, areas[2].right) == (plot.left, plot.right, plot.right)
        );
        assert!(areas.iter().all(|a| a.width() > 1.4), "wide enough to be seen");
        check(&Figure::Line(chart.clone()));
    }
}

#[test]
fn spans_that_cannot_be_seen_are_not_drawn() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    for (from, to) in [(1.0, inf), (-inf, 1.0), (nan, 1.0), (1.0, nan), (4.0, 9.0), (-9.0, -1.0)] {
        let figure = Figure::Line(with_spans(vec![span(from, to)]));
        check(&figure);
        assert!(shaded(&figure.draw(&Paper::wide()).unwrap()).is_empty(), "{from} to {to}");
        assert_eq!(count(&figure, "saccade"), 0, "nor have they a key");
    }
    let empty = LineChart { spans: vec![span(0.0, 1.0)], ..LineChart::default() };
    assert!(shaded(&empty.draw(&Paper::wide())).is_empty());
}

#[test]
fn spans_of_one_name_have_one_key() {
    let blink = Span { name: "blink".to_owned(), from: 0.0, to: 0.5 };
    let figure = Figure::Line(with_spans(vec![span(0.5, 1.0), span(2.0, 2.5), blink]));
    check(&figure);
    assert_eq!((count(&figure, "saccade"), count(&figure, "blink")), (1, 1));
    assert_eq!(shaded(&figure.draw(&Paper::wide()).unwrap()).len(), 3);
}

//! Figures of several panels.

use super::*;

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
        let plots = plots(&figure.draw(&Paper::wide()).unwrap());
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
    let width =
        |count, columns| panels(&curves, count, columns).draw(&Paper::wide()).unwrap().width_px;
    let Figure::Panels(chart) = panels(&curves, 1, 1) else { unreachable!() };
    assert_eq!(width(1, 1), chart.panels[0].draw(&Paper::wide()).width_px);
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

//! Psychometric functions, staircases and ratings.

use super::*;

fn of_levels(csv: &str, by: &[&str]) -> Analysis {
    let options = psychometric::Options::default();
    analysed(csv, by, |data, settings| {
        psychometric::psychometric(data, &options, settings).map(Analysis::Psychometric)
    })
}

/// Blocks of 40 trials at five levels for each name.
fn blocks(columns: &str, names: &[&str]) -> String {
    let mut csv = format!("{columns},level,correct,trials\n");
    for name in names {
        for (level, correct) in [(1, 21), (2, 25), (3, 31), (4, 37), (5, 39)] {
            let _ = writeln!(csv, "{name},{level},{correct},40");
        }
    }
    csv
}

#[test]
fn functions_show_the_answers_the_band_and_the_threshold() {
    let analysis = of_levels(&blocks("scene", &["s"]), &[]);
    let Analysis::Psychometric(document) = &analysis else { unreachable!() };
    let result = &document.groups[0].result;
    let figures = drawn(&analysis);
    assert_eq!(names(&figures), ["study-functions", "study-thresholds"]);
    let (caption, chart) = line(&figures, "study-functions");
    let answers = series(chart, "answers");
    assert!(answers.scatter && answers.points[2] == (3.0, Some(31.0 / 40.0)));
    let function = series(chart, "fitted function");
    for ((level, low, high), (x, y)) in chart.fills[0].points.iter().zip(&function.points) {
        assert!(level.total_cmp(x).is_eq() && *low <= y.unwrap() && y.unwrap() <= *high);
    }
    let at = &result.ml.as_ref().unwrap().thresholds[0];
    let dashed = series(chart, "threshold");
    assert_eq!(dashed.points[1], (at.level.unwrap(), Some(0.75)));
    let [low, high] = at.ci.unwrap().map(Option::unwrap);
    assert_eq!((chart.spans[0].from, chart.spans[0].to.min(high)), (low, chart.spans[0].to));
    assert!(caption.contains("maximum likelihood") && caption.contains("threshold of 75 %"));
    let (_, dots) = bar(&figures, "study-thresholds");
    assert_eq!(dots.series[0].values, [at.level]);
    assert_eq!(dots.series[0].intervals, [Some([low, high])]);
    assert_eq!(dots.series[1].name, "70.7 % correct");
}

#[test]
fn undetermined_functions_show_the_mode_and_one_level_nothing() {
    let step = of_levels("level,correct,trials\n1,10,20\n2,10,20\n3,20,20\n4,20,20\n", &[]);
    let figures = drawn(&step);
    let (caption, chart) = line(&figures, "study-functions");
    assert!(chart.fills.is_empty() && caption.contains("mode of the posterior"), "{caption}");
    let (caption, _) = bar(&figures, "study-thresholds");
    assert!(caption.contains("medians of the posterior"), "{caption}");
    let chance = of_levels("level,correct,trials\n1,11,20\n2,9,20\n3,10,20\n4,10,20\n", &[]);
    let figures = drawn(&chance);
    let (caption, chart) = bar(&figures, "study-thresholds");
    assert_eq!(chart.series[0].intervals[0].map(|[_, high]| high), Some(f64::INFINITY));
    assert!(caption.contains("has no limit there"), "{caption}");
    assert!(drawn(&of_levels("level,correct,trials\n1,15,20\n", &[])).is_empty());
}

#[test]
fn thresholds_of_two_columns_are_groups_and_series() {
    let rows = ["P1,a", "P1,b", "P2,a", "P2,b"];
    let analysis = of_levels(&blocks("participant,method", &rows), &["participant", "method"]);
    let figures = drawn(&analysis);
    let (caption, chart) = bar(&figures, "study-thresholds");
    assert_eq!(chart.groups, ["P1", "P2"]);
    let series: Vec<&str> = chart.series.iter().map(|series| series.name.as_str()).collect();
    assert_eq!(series, ["a", "b"]);
    assert!(chart.series.iter().all(|series| series.values.iter().all(Option::is_some)));
    assert!(caption.contains("75 %"), "{caption}");
    let Figure::Panels(panels) = &figures[0].figure else { unreachable!() };
    assert_eq!(panels.panels[3].title.as_deref(), Some("P2, b"));
}

#[test]
fn more_groups_than_a_figure_has_panels_make_more_figures() {
    let names: Vec<String> = (0..14).map(|i| format!("s{i}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let figures = drawn(&of_levels(&blocks("scene", &names), &["scene"]));
    let found: Vec<&str> = figures.iter().map(|figure| figure.name.as_str()).collect();
    assert_eq!(found, ["study-functions", "study-functions-2", "study-thresholds"]);
}

fn of_staircases(csv: &str) -> Analysis {
    let options = staircase::Options { drop_reversals: 1, mean: LevelMean::Arithmetic };
    analysed(csv, &[], |data, settings| {
        staircase::staircase(data, &options, settings).map(Analysis::Staircase)
    })
}

fn tracks(participants: usize) -> String {
    let mut csv = "participant,trial,level,correct\n".to_owned();
    for p in 0..participants {
        for (trial, level) in [4, 3, 4, 3, 5, 4].into_iter().enumerate() {
            let _ = writeln!(csv, "P{p},{},{level},{}", trial + 1, i32::from(level == 4));
        }
    }
    csv
}

#[test]
fn tracks_show_answers_and_the_reversals_that_count() {
    let figures = drawn(&of_staircases(&tracks(1)));
    assert_eq!(names(&figures), ["study-tracks"], "one threshold without an interval is no figure");
    let (caption, chart) = line(&figures, "study-tracks");
    assert_eq!(chart.title.as_deref(), Some("P0"));
    // Reversals at the trials 2 to 5: the first is left out, and one more of the odd rest.
    let rings = series(chart, "reversal that counts");
    assert!(rings.rings && rings.points == [(4.0, Some(3.0)), (5.0, Some(5.0))]);
    assert_eq!(series(chart, "threshold").points, [(1.0, Some(4.0)), (6.0, Some(4.0))]);
    let right: Vec<f64> = series(chart, "right answer").points.iter().map(|p| p.0).collect();
    let wrong: Vec<f64> = series(chart, "wrong answer").points.iter().map(|p| p.0).collect();
    assert_eq!((right, wrong), (vec![1.0, 3.0, 6.0], vec![2.0, 4.0, 5.0]));
    assert!(caption.contains("rings: reversals that enter the threshold"));
}

#[test]
fn very_many_staircases_are_left_out_and_counted() {
    let figures = drawn(&of_staircases(&tracks(60)));
    let found = names(&figures);
    assert_eq!(
        found,
        ["study-tracks", "study-tracks-2", "study-tracks-3", "study-tracks-4", "study-methods"]
    );
    assert!(figures[0].caption.contains("only the first 48 of 60 staircases"));
    let (caption, chart) = bar(&figures, "study-methods");
    assert_eq!(chart.series[0].values, [Some(4.0)]);
    assert!(caption.contains("95 % t intervals"), "{caption}");
}

fn of_ratings(csv: &str, by: &[&str], grid: Option<[&str; 2]>) -> Vec<NamedFigure> {
    let options = ratings::Options {
        threshold: Some(2.0),
        grid: grid.map(|columns| columns.map(str::to_owned)),
        smoothing: Smoothing::None,
        validation: None,
    };
    drawn(&analysed(csv, by, |data, settings| {
        ratings::ratings(data, &options, settings).map(Analysis::Ratings)
    }))
}

#[test]
fn scores_by_level_cross_the_threshold() {
    let mut csv = "participant,scene,level,value\n".to_owned();
    for p in 0..5 {
        for (level, value) in [(1.0, 3.0), (2.0, 2.5), (3.0, 1.5)] {
            let _ = writeln!(csv, "P{p},s,{level},{}", value + 0.1 * f64::from(p - 2));
            let _ = writeln!(csv, "P{p},t,{level},{}", value - 0.2);
        }
    }
    let figures = of_ratings(&csv, &["scene"], None);
    let (caption, chart) = line(&figures, "study-levels");
    assert_eq!(series(chart, "threshold, 2").points, [(1.0, Some(2.0)), (3.0, Some(2.0))]);
    let rings: Vec<_> = chart.series.iter().filter(|series| series.rings).collect();
    assert!((rings[0].points[0].0 - 2.5).abs() < 1e-12 && rings[1].look == Look::new(1));
    assert!(chart.spans.is_empty() && caption.contains("s 2.500 ["), "{caption}");
    let [low, high] = series(chart, "s").intervals[0].unwrap();
    // A t interval of 2.8, 2.9, 3, 3.1, 3.2: 3 ∓ 2.776 · 0.0707.
    assert!((low - 2.803_676).abs() < 1e-5 && (high - 3.196_324).abs() < 1e-5);
    let one = of_ratings(&csv, &[], None);
    let (_, chart) = line(&one, "study-levels");
    assert!(chart.spans.len() == 1 && chart.spans[0].from <= chart.spans[0].to);
}

#[test]
fn many_groups_have_panels_with_the_same_axes() {
    let mut csv = "participant,scene,level,value\n".to_owned();
    for scene in ["s", "t", "u", "v"] {
        for p in 0..5 {
            for (level, value) in [(1.0, 3.0), (2.0, 2.5), (3.0, 1.5)] {
                let _ = writeln!(csv, "P{p},{scene},{level},{}", value + 0.1 * f64::from(p - 2));
            }
        }
    }
    let figures = of_ratings(&csv, &["scene"], None);
    let Figure::Panels(chart) = &figures[0].figure else { unreachable!() };
    let titles: Vec<_> = chart.panels.iter().filter_map(|panel| panel.title.as_deref()).collect();
    assert_eq!(titles, ["s", "t", "u", "v"]);
    for panel in &chart.panels {
        assert!(panel.spans.len() == 1 && panel.y == chart.panels[0].y);
        let ends =
            panel.series.iter().flat_map(|series| series.intervals.iter().flatten()).flatten();
        let (low, high) = (panel.y.min.unwrap(), panel.y.max.unwrap());
        assert!(ends.into_iter().all(|end| low < *end && *end < high) && low < 2.0);
    }
}

#[test]
fn a_threshold_that_is_never_crossed_has_no_ring() {
    let figures = of_ratings("participant,level,value\nP,1,3\nP,2,3\nQ,1,3\nQ,2,3\n", &[], None);
    let (caption, chart) = line(&figures, "study-levels");
    assert!(chart.spans.is_empty() && chart.series.iter().all(|series| !series.rings));
    assert!(!caption.contains("rings"), "{caption}");
}

#[test]
fn grids_are_maps_with_a_cross_at_the_best() {
    let csv = "participant,fx,fy,value\nP,1,5,1\nP,1,6,2\nP,2,5,4\nP,3,6,3\n";
    let figures = of_ratings(csv, &[], Some(["fx", "fy"]));
    let Figure::Raster(chart) = &figures[0].figure else { unreachable!() };
    let panel = &chart.panels[0];
    assert_eq!((panel.columns, panel.rows, panel.cross), (3, 2, Some((2.0, 5.0))));
    // The first row is that of the largest fy.
    assert_eq!(panel.values[0], 2.0);
    assert!(panel.values[1].is_nan() && panel.values[2].total_cmp(&3.0).is_eq());
    assert_eq!(panel.values[4], 4.0);
    assert!(
        of_ratings("participant,fx,fy,value\nP,1,5,1\nP,1,6,2\n", &[], Some(["fx", "fy"]))
            .is_empty()
    );
}

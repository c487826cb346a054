//! The figures of small tables: they show the numbers of the analysis, and no more than fits.
#![allow(clippy::float_cmp, reason = "what is exact is compared exactly")]

use std::fmt::Write as _;

use fovqa_plot::{BarChart, Figure, LineChart, LineSeries, Look, Style};
use fovqa_study::adjust::stars;
use fovqa_study::input::{Data, Selection, Table};
use fovqa_study::options::{Alternative, LevelMean, Smoothing, Ties};
use fovqa_study::{
    Settings, StudyError, anova, metrics, pairs, plan, psychometric, ranks, ratings, staircase,
};

use super::*;

fn settings() -> Settings {
    Settings { bootstrap: 50, ..Settings::default() }
}

/// The analysis of the rows of a table, in groups of these columns.
fn analysed(
    csv: &str,
    by: &[&str],
    run: impl Fn(&Data, &Settings) -> Result<Analysis, StudyError>,
) -> Analysis {
    let table = Table::read("t.csv", csv.as_bytes()).unwrap();
    let by = by.iter().map(|&column| column.to_owned()).collect();
    let selection = Selection { by, ..Selection::default() };
    run(&Data::new(&table, &selection).unwrap(), &settings()).unwrap()
}

fn drawn(analysis: &Analysis) -> Vec<NamedFigure> {
    let figures = figures(analysis, "study", &settings());
    for figure in &figures {
        figure.figure.print(&Style::default()).unwrap();
        assert!(figure.name.len() < 250, "{}", figure.name);
    }
    figures
}

fn names(figures: &[NamedFigure]) -> Vec<&str> {
    figures.iter().map(|figure| figure.name.as_str()).collect()
}

fn bar<'a>(figures: &'a [NamedFigure], name: &str) -> (&'a str, &'a BarChart) {
    let figure = figures.iter().find(|figure| figure.name == name).unwrap();
    let Figure::Bar(chart) = &figure.figure else { unreachable!() };
    (&figure.caption, chart)
}

fn line<'a>(figures: &'a [NamedFigure], name: &str) -> (&'a str, &'a LineChart) {
    let figure = figures.iter().find(|figure| figure.name == name).unwrap();
    let Figure::Line(chart) = &figure.figure else { unreachable!() };
    (&figure.caption, chart)
}

fn series<'a>(chart: &'a LineChart, name: &str) -> &'a LineSeries {
    chart.series.iter().find(|series| series.name == name).unwrap()
}

fn of_pairs(csv: &str, by: &[&str], ties: Ties) -> Analysis {
    let options = pairs::Options { ties, ..pairs::Options::default() };
    analysed(csv, by, |data, settings| pairs::pairs(data, &options, settings).map(Analysis::Pairs))
}

/// Votes of 4 participants for A over B in two scenes, the second of which names B first.
fn two_scenes() -> String {
    let mut csv = "participant,scene,method_a,method_b,answer,n\n".to_owned();
    for p in 0..4 {
        let _ = writeln!(csv, "P{p},s,A,B,a,9\nP{p},s,A,B,b,1");
        let _ = writeln!(csv, "P{p},t,B,A,a,6\nP{p},t,B,A,b,4");
    }
    csv
}

#[test]
fn shares_have_the_intervals_and_stars_of_the_analysis() {
    let analysis = of_pairs(&two_scenes(), &["scene"], Ties::Error);
    let Analysis::Pairs(document) = &analysis else { unreachable!() };
    let figures = drawn(&analysis);
    let (caption, chart) = bar(&figures, "study-shares");
    assert_eq!(chart.groups, ["A – B"]);
    assert_eq!(
        (chart.references[0].value, chart.y.min, chart.y.max),
        (50.0, Some(0.0), Some(100.0))
    );
    let percent = |interval: [f64; 2]| interval.map(|share| 100.0 * share);
    let [first, second] = [0, 1].map(|group| &document.groups[group].result.pairs[0]);
    let [s, t] = [&chart.series[0], &chart.series[1]];
    assert_eq!((s.values[0], s.intervals[0]), (Some(90.0), first.clopper_pearson.map(percent)));
    assert_eq!(s.notes, [stars(first.p_adjusted)]);
    assert_eq!(s.notes, ["***"]);
    // In the second scene, the analysis counts the wins of B.
    assert_eq!((second.method.as_str(), t.values[0]), ("B", Some(40.0)));
    let [low, high] = second.clopper_pearson.unwrap();
    assert_eq!(t.intervals[0], Some(percent([1.0 - high, 1.0 - low])));
    assert_eq!((t.name.as_str(), t.look, t.notes[0].as_str()), ("t", Look::new(1), ""));
    assert!(caption.contains("95 % Clopper-Pearson") && caption.contains("Holm"), "{caption}");
}

#[test]
fn votes_that_count_half_have_bootstrap_intervals() {
    let csv =
        "participant,method_a,method_b,answer\nP,A,B,a\nP,A,B,b\nP,A,B,tie\nQ,A,B,a\nQ,A,B,b\n";
    let figures = drawn(&of_pairs(csv, &[], Ties::Half));
    let (caption, chart) = bar(&figures, "study-shares");
    assert_eq!(chart.series[0].intervals, [Some([50.0, 50.0])]);
    assert!(
        caption.contains("participants resampled") && !caption.contains("Clopper"),
        "{caption}"
    );
    assert!(!caption.contains("stars"), "such votes have no binomial test: {caption}");
}

#[test]
fn scores_are_series_of_models_or_of_groups() {
    let csv = two_scenes();
    let figures = drawn(&of_pairs(&csv, &[], Ties::Error));
    let (_, both) = bar(&figures, "study-scores");
    assert_eq!(both.groups, ["A", "B"]);
    let of = |chart: &BarChart| chart.series.iter().map(|s| s.name.clone()).collect::<Vec<_>>();
    assert_eq!(of(both), ["Bradley-Terry", "Thurstone V"]);
    let analysis = of_pairs(&csv, &["scene"], Ties::Error);
    let Analysis::Pairs(document) = &analysis else { unreachable!() };
    let figures = drawn(&analysis);
    let (caption, chart) = bar(&figures, "study-scores");
    assert_eq!(of(chart), ["s", "t"]);
    // The methods of the second group are in another order.
    let scores = document.groups[1].result.scaling.bradley_terry.scores.as_ref().unwrap();
    assert_eq!(scores[1].method, "A");
    assert_eq!(chart.series[1].values[0], Some(scores[1].jod));
    let limits = scores[1].lo.zip(scores[1].hi).map(|(low, high)| [low, high]);
    assert_eq!(chart.series[1].intervals[0], limits);
    assert!(caption.contains("Bradley-Terry model"), "{caption}");
}

#[test]
fn scores_that_would_be_infinite_have_no_figure() {
    let csv = "participant,method_a,method_b,answer,n\nP,A,B,a,4\nQ,A,B,a,4\n";
    assert_eq!(names(&drawn(&of_pairs(csv, &[], Ties::Error))), ["study-shares"]);
}

fn of_ranks(csv: &str, by: &[&str]) -> Analysis {
    let options = ranks::Options::default();
    analysed(csv, by, |data, settings| ranks::ranks(data, &options, settings).map(Analysis::Ranks))
}

/// Values of methods for 12 participants; neighbours differ by `step`.
fn values(methods: usize, step: f64) -> String {
    let mut csv = "participant,method,value\n".to_owned();
    for p in 0..12 {
        for m in 0..methods {
            let _ = writeln!(csv, "P{p},m{m},{}", step * m as f64 + 0.1 * f64::from(p * p % 5));
        }
    }
    csv
}

#[test]
fn means_have_standard_errors_and_significant_pairs_brackets() {
    let analysis = of_ranks(&values(3, 0.3), &[]);
    let Analysis::Ranks(document) = &analysis else { unreachable!() };
    let result = &document.groups[0].result;
    let figures = drawn(&analysis);
    let (caption, chart) = bar(&figures, "study-means");
    assert_eq!(chart.groups, ["m0", "m1", "m2"]);
    for (i, method) in result.methods.iter().enumerate() {
        assert_eq!(chart.series[0].values[i], method.mean);
        assert_eq!(chart.series[0].errors[i], method.se);
    }
    // The values of each method are 0, 4 · 0.1, 0.1, … around the same mean.
    let n = 12.0_f64;
    let squares: f64 = (0..12).map(|p: i32| f64::from(p * p % 5) * 0.1).map(|v| v * v).sum();
    let mean = result.methods[0].mean.unwrap();
    let se = ((squares - n * mean * mean) / (n - 1.0) / n).sqrt();
    assert!((chart.series[0].errors[0].unwrap() - se).abs() < 1e-12);
    let significant = result.pairwise.iter().filter(|test| !stars(test.p_adjusted).is_empty());
    let significant: Vec<_> = significant.collect();
    assert!(!significant.is_empty());
    assert_eq!(chart.brackets.len(), significant.len());
    for bracket in &chart.brackets {
        let [a, b] = bracket.ends.map(|[group, _]| chart.groups[group].as_str());
        let test = significant
            .iter()
            .find(|test| (test.method.as_str(), test.opponent.as_str()) == (a, b));
        assert_eq!(bracket.label, stars(test.unwrap().p_adjusted));
    }
    assert!(caption.contains("standard error") && caption.contains("Kruskal-Wallis"), "{caption}");
    let none = drawn(&of_ranks(&values(3, 0.0), &[]));
    assert!(bar(&none, "study-means").1.brackets.is_empty());
}

#[test]
fn the_smallest_p_values_have_the_brackets() {
    let analysis = of_ranks(&values(7, 1.0), &[]);
    let figures = drawn(&analysis);
    let (caption, chart) = bar(&figures, "study-means");
    let Analysis::Ranks(document) = &analysis else { unreachable!() };
    let tests = &document.groups[0].result.pairwise;
    let significant = tests.iter().filter(|test| !stars(test.p_adjusted).is_empty()).count();
    assert!(significant > 10);
    assert_eq!(chart.brackets.len(), 10);
    assert!(caption.contains(&format!("{} more pairs", significant - 10)), "{caption}");
}

fn of_anova(csv: &str, within: &[&str]) -> Vec<NamedFigure> {
    let within: Vec<String> = within.iter().map(|&name| name.to_owned()).collect();
    drawn(&analysed(csv, &[], |data, settings| {
        anova::anova(data, &within, settings).map(Analysis::Anova)
    }))
}

#[test]
fn cells_are_bars_of_two_factors_and_brackets_are_of_levels() {
    let mut csv = "participant,method,eye,value\n".to_owned();
    for p in 0..6 {
        for (m, method) in ["2L", "4L"].iter().enumerate() {
            for (e, eye) in ["left", "right"].iter().enumerate() {
                let noise = f64::from((p * (3 + m as i32) + e as i32) % 5) * 0.1;
                let _ = writeln!(csv, "P{p},{method},{eye},{}", 1.0 + 2.0 * m as f64 + noise);
            }
        }
    }
    let figures = of_anova(&csv, &["method", "eye"]);
    assert_eq!(names(&figures), ["study-cells", "study-factor-method"]);
    let (_, cells) = bar(&figures, "study-cells");
    assert_eq!((cells.groups.len(), cells.series[1].name.as_str()), (2, "right"));
    assert!(cells.series.iter().all(|eye| eye.values[1].unwrap() > eye.values[0].unwrap() + 1.0));
    assert!(cells.brackets.is_empty());
    let (caption, levels) = bar(&figures, "study-factor-method");
    let mean = |group: usize| levels.series[0].values[group].unwrap();
    let of_cells =
        |group: usize| cells.series.iter().map(|eye| eye.values[group].unwrap()).sum::<f64>() / 2.0;
    assert!((mean(0) - of_cells(0)).abs() < 1e-12 && (mean(1) - of_cells(1)).abs() < 1e-12);
    assert_eq!(
        (levels.brackets[0].ends, levels.brackets[0].label.as_str()),
        ([[0, 0], [1, 0]], "***")
    );
    assert!(caption.contains("paired t test of two levels, averaged over the other factor"));
    let one = of_anova(&csv, &["method"]);
    let (caption, chart) = bar(&one, "study-factor-method");
    assert!(chart.brackets.len() == 1 && !caption.contains("averaged"), "{caption}");
}

#[test]
fn one_participant_has_bars_without_errors_or_brackets() {
    let figures = of_anova("participant,m,value\nP,a,1\nP,b,2\n", &["m"]);
    let (caption, chart) = bar(&figures, "study-factor-m");
    assert_eq!(chart.series[0].errors, [None, None]);
    assert!(chart.brackets.is_empty() && !caption.contains("error bars"), "{caption}");
}

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

#[test]
fn metrics_are_shown_in_their_own_scores() {
    let (mut csv, mut results) =
        ("scene,method,value,se\n".to_owned(), "scene,method,metric,value\n".to_owned());
    for (i, mse) in [0.9, 0.7, 0.6, 0.3, 0.25, 0.1].into_iter().enumerate() {
        let method = ["A", "B"][i % 2];
        let _ = writeln!(csv, "s{i},{method},{},0.2", 1 + i);
        let _ = writeln!(results, "s{i},{method},mse,{mse}");
    }
    let scores = Table::read("r.csv", results.as_bytes()).unwrap();
    let options = metrics::Options { metrics: Vec::new(), lower_is_better: vec!["mse".to_owned()] };
    let analysis = analysed(&csv, &[], |data, settings| {
        metrics::metrics(data, &scores, &options, settings).map(Analysis::Metrics)
    });
    let figures = drawn(&analysis);
    assert_eq!(names(&figures), ["study-scores", "study-correlations"]);
    let (caption, chart) = line(&figures, "study-scores");
    assert_eq!(series(chart, "A").points, [(0.9, Some(1.0)), (0.6, Some(3.0)), (0.25, Some(5.0))]);
    assert_eq!((series(chart, "B").look, series(chart, "B").errors[0]), (Look::new(1), Some(0.2)));
    let fit = series(chart, "logistic fit");
    let [first, last] = [fit.points.first(), fit.points.last()].map(|point| *point.unwrap());
    assert!(first.0 < last.0 && first.1 > last.1, "it falls with the error");
    assert!(chart.x.title.contains("lower is better") && caption.contains("standard error"));
    let Analysis::Metrics(document) = &analysis else { unreachable!() };
    let metric = &document.groups[0].result.metrics[0];
    let (_, dots) = bar(&figures, "study-correlations");
    assert_eq!(dots.series[0].values, [metric.pearson]);
    let [low, high] = metric.pearson_bootstrap.unwrap().map(Option::unwrap);
    assert_eq!(dots.series[0].intervals, [Some([low, high])]);
}

#[test]
fn negative_correlations_stay_negative() {
    let (mut csv, mut results) =
        ("scene,method,value\n".to_owned(), "scene,method,metric,value\n".to_owned());
    for (i, mse) in [0.9, 0.7, 0.8, 0.3, 0.25, 0.1].into_iter().enumerate() {
        let _ = writeln!(csv, "s{i},A,{}", 1 + i);
        let _ = writeln!(results, "s{i},A,mse,{mse}");
    }
    let scores = Table::read("r.csv", results.as_bytes()).unwrap();
    let analysis = analysed(&csv, &[], |data, settings| {
        metrics::metrics(data, &scores, &metrics::Options::default(), settings)
            .map(Analysis::Metrics)
    });
    let Analysis::Metrics(document) = &analysis else { unreachable!() };
    let metric = &document.groups[0].result.metrics[0];
    let figures = drawn(&analysis);
    let (_, dots) = bar(&figures, "study-correlations");
    let [low, high] = metric.pearson_bootstrap.unwrap().map(Option::unwrap);
    assert!(metric.pearson.unwrap() < 0.0);
    assert_eq!(dots.series[0].values, [metric.pearson]);
    assert_eq!(dots.series[0].intervals, [Some([low, high])]);
}

#[test]
fn plans_show_the_power_and_a_staircase() {
    let options = plan::PairsOptions {
        share: 0.7,
        alpha: 0.05,
        power: 0.8,
        alternative: Alternative::TwoSided,
        trials: Some(30),
        width: None,
    };
    let plan = plan::plan_pairs(&options, &settings());
    let (trials, power) = (plan.result.trials.unwrap(), plan.result.power);
    let figures = drawn(&Analysis::PlanPairs(plan));
    let (caption, chart) = line(&figures, "study-power");
    assert_eq!(series(chart, "required power, 0.8").points[0].1, Some(0.8));
    let rings = chart.series.iter().find(|series| series.rings).unwrap();
    assert_eq!(rings.points[0], (trials as f64, power));
    assert!(caption.contains(&format!("{trials} trials")), "{caption}");
    let options = plan::StaircaseOptions {
        participants: 1,
        trials: 20,
        threshold: 1.0,
        width: 1.0,
        lapse: 0.0,
        between_sd: 0.0,
        model: psychometric::Model::default(),
        start: 3.0,
        steps: vec![0.5],
        lowest: None,
        highest: None,
        down: 2,
        studies: 3,
        reversals: staircase::Options::default(),
    };
    let plan = plan::plan_staircase(&options, &settings()).unwrap();
    let first = plan.result.first.clone();
    let figures = drawn(&Analysis::PlanStaircase(plan));
    let (_, chart) = line(&figures, "study-track");
    let levels: Vec<f64> = series(chart, "level").points.iter().filter_map(|p| p.1).collect();
    assert_eq!(levels, first.levels);
    let right = first.correct.iter().map(|&correct| usize::from(correct)).sum::<usize>();
    assert_eq!(series(chart, "right answer").points.len(), right);
}

#[test]
fn very_many_methods_and_long_names_stay_below_the_limits() {
    let long = "a method with a very long name, 注視点レンダリング ".repeat(9);
    let mut csv = "participant,method_a,method_b,answer\n".to_owned();
    for i in 0..200 {
        for j in i + 1..200 {
            let _ = writeln!(csv, "P{},\"{i} {long}\",\"{j} {long}\",a", (i + j) % 3);
        }
    }
    let table = Table::read("t.csv", csv.as_bytes()).unwrap();
    let selection = Selection::default();
    let data = Data::new(&table, &selection).unwrap();
    let settings = Settings { bootstrap: 0, ..Settings::default() };
    let options = pairs::Options::default();
    let figures = drawn(&pairs::pairs(&data, &options, &settings).map(Analysis::Pairs).unwrap());
    let (caption, chart) = bar(&figures, "study-shares");
    assert!(figures.len() == 1 && chart.groups.len() == 48);
    assert!(caption.contains("only the first 48 of 19900 pairs"), "{caption}");
    let options = ranks::Options::default();
    let figures = drawn(&ranks::ranks(&data, &options, &settings).map(Analysis::Ranks).unwrap());
    let (caption, chart) = bar(&figures, "study-means");
    assert!(chart.groups.len() == 48 && chart.brackets.len() <= 10);
    assert!(caption.contains("only the first 48 of 200 methods"), "{caption}");
}

#[test]
fn captions_have_the_beginning_of_long_names() {
    let long = "x".repeat(500);
    let csv = format!("participant,set,m,value\nP,{long},a,1\nP,{long},b,2\nP,y,a,1\nP,y,b,2\n");
    let figures = drawn(&analysed(&csv, &["set"], |data, settings| {
        anova::anova(data, &["m".to_owned()], settings).map(Analysis::Anova)
    }));
    assert!(figures.len() == 2 && figures.iter().all(|figure| figure.caption.len() < 500));
    assert!(figures[0].caption.contains("set = xxx") && figures[0].caption.contains('…'));
}

//! Metrics against opinions, and plans.

use super::*;

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

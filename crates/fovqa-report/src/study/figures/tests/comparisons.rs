//! Pairwise comparisons, ranks and analyses of variance, also very large ones.

use super::*;

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

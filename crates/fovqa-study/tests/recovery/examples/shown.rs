//! The tables of `configs/studies/data` show what the files in `configs/studies` say.

use fovqa_study::Settings;
use fovqa_study::anova::anova;
use fovqa_study::input::{Data, Selection, Table, Validation};
use fovqa_study::metrics::{self, metrics};
use fovqa_study::options::Smoothing;
use fovqa_study::pairs::{self, pairs};
use fovqa_study::ratings::{self, Ratings, ratings};

use super::folder;

const SIGNIFICANT: f64 = 0.05;

fn read(name: &str) -> Table {
    Table::read(name, &std::fs::read(folder().join(name)).unwrap()).unwrap()
}

fn by(column: &str) -> Selection {
    Selection { by: vec![column.to_owned()], ..Selection::default() }
}

#[test]
fn votes_and_sliders_have_significant_differences_and_others() {
    let (votes, scene) = (read("votes.csv"), by("scene"));
    let data = Data::new(&votes, &scene).unwrap();
    let result = pairs(&data, &pairs::Options::default(), &Settings::default()).unwrap();
    assert_eq!(result.groups.len(), 2);
    for group in result.groups {
        let p: Vec<f64> = group.result.pairs.iter().filter_map(|pair| pair.p_adjusted).collect();
        assert!(p.len() == 10 && p.iter().any(|&p| p < SIGNIFICANT));
        assert!(p.iter().any(|&p| p > SIGNIFICANT));
        let scores = group.result.scaling.bradley_terry.scores.unwrap();
        assert!(scores.iter().all(|score| score.lo.is_some() && score.hi.is_some()));
    }
    let (slider, all) = (read("slider.csv"), Selection::default());
    let data = Data::new(&slider, &all).unwrap();
    let within = ["method".to_owned(), "eye".to_owned()];
    let result = anova(&data, &within, &Settings::default()).unwrap().groups.remove(0).result;
    assert!(result.effects.unwrap().iter().all(|effect| effect.p.unwrap() < SIGNIFICANT));
    let tests = result.posthoc.unwrap();
    let of_a = |b: &str| tests.iter().find(|test| test.a == "A" && test.b == b).unwrap();
    assert!(of_a("B").p_adjusted > Some(SIGNIFICANT) && of_a("C").p_adjusted < Some(0.001));
}

#[test]
fn scores_leave_the_careless_participant_out_and_grids_find_the_best_cell() {
    let (scores, all) = (read("scores.csv"), Selection::default());
    let validation = Some(Validation { expected: 3.0, max_errors: 2 });
    let options =
        ratings::Options { threshold: Some(2.0), validation, ..ratings::Options::default() };
    let data = Data::new(&scores, &all).unwrap();
    let document = ratings(&data, &options, &Settings::default()).unwrap();
    assert_eq!(document.excluded, ["P07"]);
    let Ratings::Levels(levels) = &document.groups[0].result else { panic!("no levels") };
    let [low, high] = levels.acceptable.as_ref().unwrap().crossing_ci.unwrap();
    assert!(low.unwrap() < 2.33 && 2.33 < high.unwrap());
    let options = ratings::Options {
        grid: Some(["fx".to_owned(), "fy".to_owned()]),
        smoothing: Smoothing::Binomial,
        ..ratings::Options::default()
    };
    let table = read("grid.csv");
    let data = Data::new(&table, &all).unwrap();
    let document = ratings(&data, &options, &Settings::default()).unwrap();
    let Ratings::Grid(grid) = &document.groups[0].result else { panic!("no grid") };
    assert_eq!(grid.best.map(|best| [best.fx, best.fy]), Some([0.35, 0.35]));
}

#[test]
fn metrics_have_a_best_one_and_a_condition_without_scores() {
    let (opinions, scores) = (read("mos.csv"), read("results.csv"));
    let all = Selection::default();
    let options =
        metrics::Options { lower_is_better: vec!["mse".to_owned()], ..metrics::Options::default() };
    let data = Data::new(&opinions, &all).unwrap();
    let document = metrics(&data, &scores, &options, &Settings::default()).unwrap();
    let result = &document.groups[0].result;
    assert_eq!((result.n, &result.unmatched[..]), (17, &["street/F".to_owned()][..]));
    let best = result.metrics.iter().max_by(|a, b| a.pearson.partial_cmp(&b.pearson).unwrap());
    assert_eq!(best.unwrap().metric, "fvvdp");
    let p = |a, b| {
        let mut all = result.comparisons.iter();
        all.find(|of| of.metric == a && of.other == b).unwrap().meng_p_adjusted.unwrap()
    };
    assert!(p("psnr", "fvvdp") < SIGNIFICANT && p("psnr", "ssim") > SIGNIFICANT);
}

#[test]
fn votes_of_rmfr_are_the_published_ones() {
    let (table, all) = (read("rmfr-table-2.csv"), Selection::default());
    let data = Data::new(&table, &all).unwrap();
    let result = pairs(&data, &pairs::Options::default(), &Settings::default()).unwrap();
    let found = &result.groups[0].result.pairs;
    // Votes, percent, and the printed bounds of p: below, or above for the last.
    let printed = [
        ("Hyperbolic", 49.0, 68.1, 0.01, true),
        ("Linear", 47.0, 65.3, 0.01, false),
        ("Log-polar", 50.0, 69.4, 0.001, false),
        ("Full-res", 35.0, 48.6, 0.05, false),
    ];
    assert_eq!(found.len(), printed.len());
    for (pair, (opponent, wins, percent, bound, is_below)) in found.iter().zip(printed) {
        assert_eq!((pair.method.as_str(), pair.opponent.as_str()), ("RMFR", opponent));
        assert!((pair.wins - wins).abs() < 1e-12 && (pair.trials - 72.0).abs() < 1e-12);
        assert!((100.0 * pair.share - percent).abs() < 0.05);
        assert_eq!(pair.p_two_sided.unwrap() < bound, is_below, "{opponent}");
        assert_eq!(pair.p_greater.unwrap() < bound, opponent != "Full-res", "{opponent}");
    }
}

#[test]
fn constructed_data_have_the_printed_f() {
    for (file, factor, df) in
        [("deamp-f1-12.csv", "test", [1, 12]), ("deamp-f2-30.csv", "method", [2, 30])]
    {
        let (table, sets) = (read(file), by("set"));
        let data = Data::new(&table, &sets).unwrap();
        let document = anova(&data, &[factor.to_owned()], &Settings::default()).unwrap();
        for group in document.groups {
            let effect = &group.result.effects.unwrap()[0];
            let f: f64 = group.by.0[0].1.split_once('=').unwrap().1.parse().unwrap();
            assert!((effect.f.unwrap() - f).abs() < 1e-9);
            assert_eq!([effect.df, effect.df_error], df);
        }
    }
}

//! Sweeps: what they score, divide and draw.

use std::collections::BTreeMap;

use super::{HEAD, METRICS, RMFR, SCENE, folder, number, table};
use crate::runs::experiment_folder::{bytes, json, rows};
use crate::runs::interrupted_runs::{assert_same, journal, results};
use crate::runs::resume::{cuts, goes_on};
use crate::runs::shards::put_together;

const GRID: &str = "[sweep]\n\"R.fx\" = [0.2, 0.4, 0.8]\n\"R.fy\" = [0.3, 0.6]\n";

/// The values of a metric by the parameters of the points.
fn values(rows: &[BTreeMap<String, String>], metric: &str) -> BTreeMap<String, String> {
    let of = rows.iter().filter(|row| row["metric"] == metric && row["band"].is_empty());
    of.map(|row| (row["parameters"].clone(), row["value"].clone())).collect()
}

fn whole(folder: &crate::fovqa::Folder, out: &str) -> Vec<BTreeMap<String, String>> {
    let mut rows = rows(folder, out);
    for row in &mut rows {
        row.insert("band".to_owned(), row["from_deg"].clone());
    }
    rows
}

#[test]
fn a_point_has_the_values_of_the_method_alone() {
    let folder = folder(&format!("{HEAD}{SCENE}{RMFR}{METRICS}{GRID}"));
    folder.run(&["run", "e.toml", "--output", "swept"]).ok();
    let swept = whole(&folder, "swept");
    assert!(swept.iter().all(|row| row["method"] == "R" && !row["parameters"].is_empty()));
    let mut alone = format!("{HEAD}{SCENE}{METRICS}");
    for (index, (fx, fy)) in [(0.2, 0.3), (0.4, 0.6), (0.8, 0.6)].into_iter().enumerate() {
        let emulate = format!("{{ model = \"rmfr\", fx = {fx}, fy = {fy} }}");
        let head = format!("[[method]]\nname = \"R{index}\"\nemulate = ");
        alone.extend([head, emulate, "\n".to_owned()]);
    }
    folder.write("alone.toml", alone);
    folder.run(&["run", "alone.toml", "--output", "alone"]).ok();
    for metric in ["psnr", "ssim", "samples"] {
        let points = values(&swept, metric);
        assert_eq!(points.len(), 6, "{metric}");
        for (index, parameters) in
            ["fx=0.2;fy=0.3", "fx=0.4;fy=0.6", "fx=0.8;fy=0.6"].into_iter().enumerate()
        {
            let of = whole(&folder, "alone").into_iter();
            let mut of = of.filter(|row| row["method"] == format!("R{index}"));
            let of = of.find(|row| row["metric"] == metric && row["band"].is_empty()).unwrap();
            assert_eq!(points[parameters], of["value"], "{metric} {parameters}");
        }
    }
    let summary = json(&folder, "swept/summary.json");
    let first = &summary["comparisons"][0];
    assert_eq!(
        (first["method"].as_str(), first["parameters"].as_str()),
        (Some("R"), Some("fx=0.2;fy=0.3"))
    );
}

#[test]
fn keys_may_be_written_without_quotes_and_as_ranges() {
    let folder = folder(&format!("{HEAD}{SCENE}{RMFR}{METRICS}{GRID}"));
    folder.run(&["run", "e.toml", "--output", "quoted"]).ok();
    let ranges = "[sweep]\nR.fx = { from = 0.2, to = 0.8, steps = 3, scale = \"log\" }\n\
                  R.fy = { from = 0.3, to = 0.6, steps = 2 }\n";
    folder.write("e.toml", format!("{HEAD}{SCENE}{RMFR}{METRICS}{ranges}"));
    folder.run(&["run", "e.toml", "--output", "ranges"]).ok();
    assert_eq!(
        values(&whole(&folder, "quoted"), "psnr"),
        values(&whole(&folder, "ranges"), "psnr")
    );
    folder.run(&["check", "e.toml"]).ok().says(&[]);
    let checked = folder.run(&["check", "e.toml"]).ok().stdout;
    assert!(checked.contains("rmfr, swept: 6 points, fx (3 values: 0.2, 0.4, 0.8)"), "{checked}");
}

#[test]
fn the_best_point_is_found_and_drawn() {
    let folder = folder(&format!("{HEAD}{SCENE}{RMFR}{METRICS}{GRID}"));
    let run = folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let psnr = values(&whole(&folder, "out"), "psnr");
    let value = |(_, value): &(&String, &String)| value.parse::<f64>().unwrap();
    let best = psnr.iter().max_by(|a, b| value(a).total_cmp(&value(b))).unwrap();
    let optima = table(&folder, "out/table-optima.csv");
    let row = optima.iter().find(|row| row["metric"] == "psnr").unwrap();
    assert_eq!(&row["parameters"], best.0);
    assert_eq!(number(row, "best").to_bits(), value(&best).to_bits());
    assert!(number(row, "worst") < number(row, "best"));
    assert!(run.stdout.starts_with("Best point of each sweep"), "{}", run.stdout);
    // The map has every point once, at its values.
    let map = table(&folder, "out/plots/sweep-psnr.csv");
    assert_eq!(map.len(), 6);
    for row in &map {
        let parameters = format!("fx={};fy={}", number(row, "x"), number(row, "y"));
        assert_eq!(
            row["value"].parse::<f64>().unwrap().to_bits(),
            psnr[&parameters].parse::<f64>().unwrap().to_bits()
        );
    }
    let before = bytes(&folder.path("out"));
    folder.run(&["report", "out"]).ok();
    assert!(before == bytes(&folder.path("out")), "drawn again, it is the same");
}

#[test]
fn one_parameter_is_a_curve_and_words_are_bars() {
    let methods = format!("{RMFR}[[method]]\nname = \"K\"\nemulate = {{ model = \"kfr\" }}\n");
    let curve = "[sweep]\n\"R.sigma\" = [1.5, 2, 4]\n\"K.filter\" = [\"none\", \"buffer\"]\n";
    let folder = folder(&format!("{HEAD}{SCENE}{methods}{METRICS}{curve}"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let curve = table(&folder, "out/plots/sweep-psnr-sigma.csv");
    let of = curve.iter().filter(|row| row["series"] == "R");
    let at: Vec<f64> = of.map(|row| number(row, "x")).collect();
    assert_eq!(at, [1.5, 2.0, 4.0]);
    let bars = table(&folder, "out/plots/sweep-psnr-filter.csv");
    let groups: Vec<&str> = bars.iter().map(|row| row["group"].as_str()).collect();
    assert_eq!(groups, ["none", "buffer"]);
}

#[test]
fn plots_and_rules_may_name_the_swept_method() {
    let rest = "[[plot]]\nkind = \"sweep\"\nmetric = \"psnr\"\nmethods = [\"R\"]\n\
                [[gate]]\nmetric = \"psnr\"\nmethod = \"R\"\nat_least = 1\n";
    let folder = folder(&format!("{HEAD}{SCENE}{RMFR}{METRICS}{GRID}{rest}"));
    let verdict = folder.run(&["gate", "e.toml", "--output", "out"]).ok().stdout;
    assert_eq!(verdict.matches("  passed\n").count(), 6, "{verdict}");
    assert!(folder.path("out/plots/sweep-psnr.svg").exists());
    assert!(!folder.path("out/plots/sweep-ssim.svg").exists());
}

#[test]
fn scenes_have_a_figure_each_and_one_of_their_average() {
    let scenes = format!("{SCENE}[[scene]]\nname = \"t\"\nreference = \"other.png\"\n");
    let folder = folder(&format!("{HEAD}{scenes}{RMFR}{METRICS}{GRID}"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let cells = |place: &str| -> Vec<f64> {
        let rows = table(&folder, &format!("out/plots/sweep-psnr-{place}.csv"));
        rows.iter().map(|row| number(row, "value")).collect()
    };
    let (s, t, average) = (cells("s"), cells("t"), cells("average"));
    for ((s, t), average) in s.iter().zip(&t).zip(&average) {
        assert!((s / 2.0 + t / 2.0 - average).abs() < 1e-9);
    }
    let optima = table(&folder, "out/table-optima.csv");
    let places: Vec<&str> = optima.iter().map(|row| row["scene"].as_str()).collect();
    assert_eq!(places, ["s", "s", "t", "t", "average", "average"]);
    // A figure of one of them says which.
    let one = "[[plot]]\nkind = \"sweep\"\nmetric = \"psnr\"\nscenes = [\"t\"]\n";
    folder.write("e.toml", format!("{HEAD}{scenes}{RMFR}{METRICS}{GRID}{one}"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    assert!(folder.path("out/plots/sweep-psnr-t.svg").exists());
    assert!(!folder.path("out/plots/sweep-psnr-average.svg").exists());
}

/// The points are divided, broken off and gone on with as other methods.
#[test]
fn a_sweep_is_the_same_wherever_it_is_divided() {
    let rest = "[[plot]]\nkind = \"optima\"\n[[plot]]\nkind = \"table\"\n";
    let folder = folder(&format!("{HEAD}{SCENE}{RMFR}{METRICS}{GRID}{rest}"));
    for of in [2, 5] {
        let (codes, merged, said) = put_together(&folder, of, 0);
        assert_eq!(codes, vec![0; of]);
        // Which point is the best, and so which the report shows, no shard knows. The frames are needed.
        assert!(said.contains("pictures of some frames for the report are missing"), "{said}");
        folder.run(&["run", "e.toml", "--resume", "--output", &merged]).ok();
        assert_same(&results(&folder.path(&merged)), &results(&folder.path("whole")), &merged);
    }
    goes_on(&folder, 0, &cuts(&journal(&folder, "whole"), "swept"), "2");
    for threads in ["1", "3"] {
        let out = format!("threads-{threads}");
        folder.run(&["run", "e.toml", "--threads", threads, "--output", &out]).ok();
        assert!(
            bytes(&folder.path(&out)).get("results.csv")
                == bytes(&folder.path("whole")).get("results.csv")
        );
    }
}

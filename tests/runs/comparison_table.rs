//! The comparison table: marks, averages and notes.

use std::fs;

use crate::runs::experiment_folder::{experiment, json, rows, two_scenes};

#[test]
fn identical_pictures_are_infinite_everywhere() {
    let folder = two_scenes();
    for scene in ["room", "hall"] {
        for frame in 0..3 {
            let from = folder.path(&format!("{scene}/gt/{frame:04}.png"));
            fs::copy(from, folder.path(&format!("{scene}/a/{frame:04}.png"))).unwrap();
        }
    }
    folder.run(&["run", "e.toml"]).ok();
    let rows = rows(&folder, "reports/e");
    let psnr = rows.iter().find(|row| row["method"] == "A" && row["metric"] == "psnr").unwrap();
    assert_eq!(psnr["value"], "inf");
    let summary = json(&folder, "reports/e/summary.json");
    assert_eq!(summary["comparisons"][0]["metrics"]["psnr"]["mean"], "inf");
    let table = fs::read_to_string(folder.path("reports/e/table.md")).unwrap();
    assert!(table.contains("**inf**"), "{table}");
    let svg = fs::read_to_string(folder.path("reports/e/plots/bars-psnr.svg")).unwrap();
    assert!(svg.contains('∞'), "{svg}");
}

/// The best of each row, and the averages, are those of the values.
#[test]
fn the_table_marks_the_best() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml"]).ok();
    let summary = json(&folder, "reports/e/summary.json");
    let mean = |scene: &str, method: &str, metric: &str| {
        let comparisons = summary["comparisons"].as_array().unwrap();
        let c = comparisons.iter().find(|c| c["scene"] == scene && c["method"] == method).unwrap();
        c["metrics"][metric]["mean"].as_f64().unwrap()
    };
    let path = folder.path("reports/e/table.csv");
    let mut reader = csv::Reader::from_path(path).unwrap();
    let headers = reader.headers().unwrap().clone();
    let records: Vec<csv::StringRecord> = reader.records().map(|r| r.unwrap()).collect();
    assert_eq!(
        records.iter().map(|r| r[0].to_owned()).collect::<Vec<_>>(),
        ["room", "hall", "Average"]
    );
    for (metric, best) in [("mse", "A"), ("psnr", "A"), ("ssim", "A")] {
        let column =
            |name: &str| headers.iter().position(|h| h == format!("{metric} {name}")).unwrap();
        for record in &records {
            let value: f64 = record[column("B")].parse().unwrap();
            let want = match &record[0] {
                "Average" => f64::midpoint(mean("room", "B", metric), mean("hall", "B", metric)),
                scene => mean(scene, "B", metric),
            };
            assert!((value - want).abs() <= 1e-12 * want.abs(), "{record:?}");
            assert_eq!(&record[column("best")], best, "less noise is better: {record:?}");
        }
    }
    let text = fs::read_to_string(folder.path("reports/e/table.md")).unwrap();
    let latex = fs::read_to_string(folder.path("reports/e/table.tex")).unwrap();
    // One section per scene in the order of the file, one row per method, one column per metric.
    let titles = ["room", "hall", "Average over 2 scenes"];
    let places =
        titles.map(|title| latex.find(&format!("\\emph{{{title}}}}} \\\\\nA & ")).unwrap());
    assert!(places.is_sorted(), "{latex}");
    let row = latex.lines().find(|line| line.starts_with("A & ")).unwrap();
    let best = format!("{:.2}", mean("room", "A", "psnr"));
    let (whole, decimals) = best.split_once('.').unwrap();
    assert!(row.contains(&format!(" & \\fovqabest{{{whole}}}{{.{decimals}}} & ")), "{row}");
    assert_eq!(row.split(" & ").count(), 1 + 4, "four metrics: {row}");
    let room = text.lines().skip_while(|line| !line.starts_with("| **room**")).nth(1).unwrap();
    let bold = format!("**{best}**");
    assert!(room.starts_with("| A |") && room.contains(&bold), "{room}");
    assert_eq!(room.matches("**").count(), 8, "{room}");
    assert!(!text.contains("second best"), "of two methods");
}

/// What cannot be beaten in one scene must not lose by it in the average.
#[test]
fn an_infinite_value_makes_its_average_infinite() {
    let folder = two_scenes();
    for frame in 0..3 {
        let file = format!("room/gt/{frame:04}.png");
        fs::copy(folder.path(&file), folder.path(&file.replace("gt", "a"))).unwrap();
    }
    fs::copy(folder.path("hall/gt/0000.png"), folder.path("hall/b/0000.png")).unwrap();
    folder.run(&["run", "e.toml"]).ok();
    let table = fs::read_to_string(folder.path("reports/e/table.csv")).unwrap();
    let average = table.lines().find(|line| line.starts_with("Average")).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let cell = |name: &str| {
        let column = header.iter().position(|h| *h == name).unwrap();
        average.split(',').nth(column).unwrap()
    };
    assert_eq!((cell("psnr A"), cell("psnr best")), ("inf", "A"));
    let text = fs::read_to_string(folder.path("reports/e/table.md")).unwrap();
    assert!(text.contains("identical to the reference (hall, B: 1 of 3)"), "{text}");
}

#[test]
fn methods_scored_on_fewer_frames_are_said_beside_the_table() {
    let folder = two_scenes();
    fs::remove_file(folder.path("room/a/0001.png")).unwrap();
    folder.write(
        "e.toml",
        experiment("").replace("\"room/gt\"", "\"room/gt\"\nallow_missing = true"),
    );
    folder.run(&["run", "e.toml"]).ok();
    for file in ["table.md", "report.html"] {
        let text = fs::read_to_string(folder.path(&format!("reports/e/{file}"))).unwrap();
        assert!(
            text.contains("not scored on the same frames") || text.contains("Not all methods"),
            "{file}"
        );
        assert!(text.contains("(room: A 2 of 3)"), "{file}: {text}");
    }
}

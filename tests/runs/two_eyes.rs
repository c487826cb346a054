//! Tables of scenes with two eyes: left, right and both.

use std::fmt::Write as _;
use std::fs;

use fovqa_testkit::synthetic::{codes, disturbed};

use crate::fovqa::Folder;
use crate::runs::experiment_folder::json;

/// Two scenes with two eyes, and two methods.
fn stereo(rest: &str) -> Folder {
    let folder = Folder::new();
    let mut text = "name = \"e\"\n[view]\nfov_vertical_deg = 60\n".to_owned();
    for (nth, scene) in ["hall", "room"].into_iter().enumerate() {
        for (eye, noise) in [("left", 20.0), ("right", 45.0)] {
            let reference = codes(48, 40, 3, nth as u64);
            folder.png(&format!("{scene}/{eye}/gt/0.png"), 48, 40, &reference);
            for (method, more) in [("a", 0.0), ("b", 15.0)] {
                let test = disturbed(&reference, noise + more + nth as f64, 3);
                folder.png(&format!("{scene}/{eye}/{method}/0.png"), 48, 40, &test);
            }
        }
        let _ = writeln!(
            text,
            "[[scene]]\nname = \"{scene}\"\n\
             reference = {{ left = \"{{scene}}/left/gt\", right = \"{{scene}}/right/gt\" }}"
        );
    }
    for method in ["a", "b"] {
        let test = format!("{{scene}}/{{eye}}/{method}");
        let _ = writeln!(text, "[[method]]\nname = \"{method}\"\ntest = \"{test}\"");
    }
    folder.write("e.toml", text + rest);
    folder
}

fn read(folder: &Folder, name: &str) -> String {
    fs::read_to_string(folder.path(&format!("reports/e/{name}"))).unwrap()
}

/// The rows of table.csv: scene, values, and the eye at the end.
fn csv(folder: &Folder) -> Vec<Vec<String>> {
    let text = read(folder, "table.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    assert_eq!(header.first().map(String::as_str), Some("scene"));
    assert_eq!(header.last().map(String::as_str), Some("eye"));
    let rows = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect());
    rows.collect()
}

#[test]
fn every_table_names_the_left_eye_the_right_eye_and_both() {
    let folder = stereo(
        "[metrics]\nmse = {}\n[[plot]]\nkind = \"table\"\nmetrics = [\"mse\"]\nlayout = \"scenes\"\n",
    );
    let printed = folder.run(&["run", "e.toml"]).ok().stdout;
    let names = ["hall, left eye", "hall, right eye", "hall, both eyes", "room, left eye"];
    let page = read(&folder, "report.html");
    let [markdown, latex] = ["table.md", "table.tex"].map(|name| read(&folder, name));
    for name in names {
        assert!(printed.contains(&format!("\n{name} ")), "{name}: {printed}");
        assert!(markdown.contains(&format!("\n| {name} |")), "{name}: {markdown}");
        assert!(latex.contains(&format!("\n{name} &")), "{name}: {latex}");
        assert!(page.contains(&format!("<th scope=\"row\">{name}</th>")), "{name}");
    }
    for text in [&markdown, &page] {
        assert!(text.contains("Both eyes: the values of the left and the right eye"), "{text}");
    }
    // Each eye has its own values, and programs find a scene by its name as before.
    let rows = csv(&folder);
    let eyes: Vec<&str> = rows.iter().map(|row| row.last().unwrap().as_str()).collect();
    assert_eq!(eyes, ["left", "right", "both", "left", "right", "both", ""]);
    let scenes: Vec<&str> = rows.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(scenes[..3], ["hall, left eye", "hall, right eye", "hall"]);
    let summary = json(&folder, "reports/e/summary.json");
    for comparison in summary["comparisons"].as_array().unwrap() {
        let named = |key: &str| comparison[key].as_str().unwrap();
        let of = |row: &&Vec<String>| {
            row[0].starts_with(named("scene")) && row.last().unwrap() == named("eye")
        };
        let column = if named("method") == "a" { 1 } else { 2 };
        let value: f64 = rows.iter().find(of).unwrap()[column].parse().unwrap();
        assert_eq!(Some(value), comparison["metrics"]["mse"]["mean"].as_f64());
    }
}

#[test]
fn averages_over_scenes_are_of_both_eyes() {
    let folder =
        stereo("[metrics]\nmse = {}\npsnr = {}\n[[plot]]\nkind = \"table\"\nspread = \"frames\"\n");
    folder.run(&["run", "e.toml"]).ok();
    let rows = csv(&folder);
    let value = |row: &Vec<String>| row[1].parse::<f64>().unwrap();
    let both: Vec<f64> = rows.iter().filter(|r| r.last().unwrap() == "both").map(value).collect();
    let average = rows.iter().find(|row| row[0] == "Average").map(value).unwrap();
    assert_eq!(both.len(), 2);
    assert!((average - f64::midpoint(both[0], both[1])).abs() < 1e-15, "{rows:?}");
    assert!(read(&folder, "table.md").contains("Average over 2 scenes"));
    assert!(read(&folder, "table.md").contains("Averages over scenes are of both eyes."));
}

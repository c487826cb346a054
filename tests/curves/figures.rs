//! Figures of curve files show what they say.

use std::fs;

use super::files::json;
use super::mistakes::GOOD;
use crate::fovqa::Folder;

const FIGURES: &str = r#"
name = "f"
[view]
resolutions = ["1600x1600"]
fov_vertical_deg = 90
[[curve]]
name = "Full"
method = { model = "full" }
[[curve]]
name = "Sparse"
method = { model = "guenter" }
[[curve]]
name = "Dense"
method = { model = "vafr", factor = 2 }
[[curve]]
name = "2L"
method = { model = "deamp", sigmas = [2.6], bounds_deg = [45] }
gazes = [[400, 1200]]
directions_deg = [90]
[[curve]]
name = "Angle"
method = { model = "full" }
tangential = "angle"
[[plot]]
kind = "rates"
name = "angle"
rate = "tangential"
unit = "per_pixel"
curves = ["Angle"]
[[plot]]
kind = "rates"
name = "pixels"
unit = "per_pixel"
panels = "one"
display = true
[[plot]]
kind = "rates"
name = "across"
rate = "tangential"
panels = "one"
beyond_display = true
curves = ["Full", "2L"]
[[plot]]
kind = "rates"
name = "shown"
panels = "one"
rate = "tangential"
curves = ["Full", "2L"]
[[plot]]
kind = "rates"
name = "sparse"
curves = ["Sparse"]
[[plot]]
kind = "rates"
name = "dense"
beyond_display = true
curves = ["Dense"]
[[plot]]
kind = "density"
curves = ["2L"]
[[plot]]
kind = "accumulated"
[[plot]]
kind = "half_axis"
f = [2]
"#;

/// What stands in the figures, from their data.
#[test]
fn figures_show_what_they_say() {
    let folder = Folder::new();
    folder.write("f.toml", FIGURES);
    folder.run(&["curves", "f.toml"]).ok();
    let plot = |name: &str| fs::read_to_string(folder.path("reports/f/plots").join(name)).unwrap();
    // Rows of a series: where, and what.
    let series = |name: &str, wanted: &str| -> Vec<(f64, f64)> {
        let text = plot(&format!("{name}.csv"));
        let mut csv = csv::Reader::from_reader(text.as_bytes());
        let rows = csv.records().map(Result::unwrap).filter(|row| &row[0] == wanted);
        let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        rows.map(|row| (number(&row[1]), number(&row[2]))).collect()
    };
    let near = |found: f64, want: f64| assert!((found / want - 1.0).abs() < 1e-9, "{found} {want}");
    let at =
        |rows: &[(f64, f64)], x: f64| rows.iter().find(|row| (row.0 - x).abs() < 1e-9).unwrap().1;

    // Over the display's own rate: 1, and 1/2 between 10° and 20°.
    let full = series("pixels", "Full, gaze at centre, direction 0°");
    assert!(full.len() > 200 && full.iter().all(|row| (row.1 - 1.0).abs() < 1e-12));
    near(at(&series("pixels", "Sparse, gaze at centre, direction 0°"), 15.0), 0.5);
    assert!(plot("pixels.svg").contains("Radial rate over the"));

    // Across the line a degree of angle has other pixels, and the display's own rate is 1 again.
    let angle = series("angle", "Angle");
    assert!(angle.len() > 200 && angle.iter().all(|row| (row.1 - 1.0).abs() < 1e-12));

    // Across, 15° below the gaze: along x, where t = 0, f (f + A) / (f² σ), A the 1200 px to the
    // right, f = 608; a degree of the paper's convention has (π/180) 800 / cos² 15° pixels.
    let across = series("across", "2L, gaze (400, 1200), direction 90°");
    let pixels = 800.0 * 1f64.to_radians() / 15f64.to_radians().cos().powi(2);
    near(at(&across, 15.0), (608.0 + 1200.0) / (608.0 * 2.6) * pixels / 2.0);
    assert!(plot("across.svg").contains("Tangential rate"));
    // The display shows at most its own rate, one sample per pixel.
    let shown = series("shown", "2L, gaze (400, 1200), direction 90°");
    near(at(&shown, 15.0), pixels / 2.0);
    near(at(&series("shown", "Display 1600 × 1600"), 15.0), pixels / 2.0);
    let page = fs::read_to_string(folder.path("reports/f/index.html")).unwrap();
    assert_eq!(page.matches("the rate is that of the display").count(), 2, "shown and pixels");

    // Areas are named after the side they lie on.
    let areas =
        |name: &str| ["Under-sampled", "Over-sampled"].map(|area| plot(name).contains(area));
    assert_eq!((areas("sparse.svg"), areas("dense.svg")), ([true, false], [false, true]));
    assert_eq!(areas("pixels.svg"), [false, false], "of several curves none");

    // The picture is the right way up: densest at the gaze, and there f (f + A) / (f² σ) each way.
    let text = plot("density.csv");
    let mut csv = csv::Reader::from_reader(text.as_bytes());
    let cells: Vec<[f64; 3]> = csv
        .records()
        .map(|row| [1, 2, 3].map(|i| row.as_ref().unwrap()[i].parse().unwrap()))
        .collect();
    let densest = cells.iter().max_by(|a, b| a[2].total_cmp(&b[2])).unwrap();
    assert!((densest[0] - 400.0).abs() < 7.0 && (densest[1] - 1200.0).abs() < 7.0, "{densest:?}");
    let [x, y, density] = densest;
    let axis = |t: f64, side: f64| 608.0 * (608.0 + side) / ((t.abs() + 608.0).powi(2) * 2.6);
    let sides = [if *x < 400.0 { 400.0 } else { 1200.0 }, if *y < 1200.0 { 1200.0 } else { 400.0 }];
    let want = axis(x - 400.0, sides[0]) * axis(y - 1200.0, sides[1]);
    assert!((density / want - 1.0).abs() < 1e-4, "{density} {want}");

    // To the full angle of the whole frame.
    let accumulated = series("accumulated", "2L");
    assert!((accumulated[accumulated.len() - 1].0 - 90.0).abs() < 1e-9);
    // d / (2 - d), normalised.
    near(at(&series("half-axis", "f = 2"), 0.5), 1.0 / 3.0);
    near(at(&series("half-axis", "f = 2"), 1.0), 1.0);
}

/// Rings and cross stand where the method takes the gaze.
#[test]
fn a_gaze_outside_is_drawn_at_the_border() {
    let folder = Folder::new();
    let picture = |gaze: &str| {
        let text = GOOD
            .replace("kind = \"rates\"", "kind = \"density\"")
            .replace("[view]", &format!("[view]\ngazes = [{gaze}]"));
        folder.write("e.toml", text);
        folder.run(&["curves", "e.toml"]).ok();
        fs::read_to_string(folder.path("reports/good/plots/density.svg")).unwrap()
    };
    assert!(picture("[3000, 400]") == picture("[1440, 400]"));
}

/// A curve whose budget is out of reach is left out, and so is what shows nothing else.
#[test]
fn what_cannot_reach_its_budget_is_left_out() {
    let folder = Folder::new();
    let sparse = "name = \"A\"\nmethod = { model = \"guenter\" }\nbudget = 0.9";
    let text = GOOD.replace("name = \"A\"\nmethod = { model = \"rmfr\" }", sparse);
    let of_a = "\n[[plot]]\nkind = \"density\"\ncurves = [\"A\"]\n[[table]]\nkind = \"acuity\"\ncurves = [\"A\"]\n";
    folder.write("e.toml", format!("{text}{of_a}"));
    let reason = "curve \"A\" at 1440x1600 is left out: guenter cannot reach a budget of 0.9";
    let mend = "or change bounds_deg, or the inner scales";
    let also = ["the plot density is left out", "the table acuity is left out"];
    folder.run(&["check", "e.toml"]).ok().says(&[reason, mend, also[0], also[1]]);
    folder.run(&["curves", "e.toml"]).ok().says(&[reason, "1 figure"]);
    let record = json(&folder, "reports/good/curves.json");
    assert_eq!(record["curves"].as_array().unwrap().len(), 1);
    assert!(record["left_out"][0].as_str().unwrap().starts_with(reason), "{record}");
    let page = fs::read_to_string(folder.path("reports/good/index.html")).unwrap();
    assert!(page.contains("cannot reach a budget of 0.9"), "{page}");
    // Nothing is left if it was the only one.
    let alone = text.replace(
        "name = \"B\"\nacuity = { model = \"piecewise\" }",
        "name = \"B\"\nmethod = { model = \"guenter\" }\nbudget = 0.8",
    );
    folder.write("e.toml", alone);
    folder.run(&["check", "e.toml"]).fails(2, &["budget of 0.9", "budget of 0.8"]);
}

/// Many curves with several settings have a panel per setting, with the same axes, and a method has
/// one look in all of them.
#[test]
fn panels_of_settings_are_compared() {
    let folder = Folder::new();
    let three = GOOD.replace("[view]", "[view]\ngazes = [\"center\", [0, 0], [100, 0]]").replace(
        "name = \"B\"\nacuity = { model = \"piecewise\" }",
        "name = \"B\"\nmethod = { model = \"full\" }",
    );
    folder.write(
        "e.toml",
        format!("{three}\n[[plot]]\nkind = \"rates\"\nname = \"b\"\ncurves = [\"B\"]\n"),
    );
    folder.run(&["curves", "e.toml"]).ok();
    let csv = |name: &str| {
        let text =
            fs::read_to_string(folder.path(&format!("reports/good/plots/{name}.csv"))).unwrap();
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let rows = reader.records().map(|row| {
            let row = row.unwrap();
            (row[0].to_owned(), row[1].to_owned())
        });
        rows.collect::<std::collections::BTreeSet<_>>()
    };
    let panels = csv("rates");
    for gaze in ["gaze at centre", "gaze (0, 0)", "gaze (100, 0)"] {
        for name in ["A", "B", "Display 1440 × 1600"] {
            assert!(
                panels.contains(&(gaze.to_owned(), name.to_owned())),
                "{gaze} {name}: {panels:?}"
            );
        }
    }
    assert_eq!(panels.len(), 3 * 4, "with acuity");
    // B is the second method of the file, in its own figure too: vermilion.
    let svg = |name: &str| {
        fs::read_to_string(folder.path(&format!("reports/good/plots/{name}.svg"))).unwrap()
    };
    assert!(svg("rates").contains("#D55E00") && svg("b").contains("#D55E00"));
    assert!(svg("rates").contains("#0072B2") && !svg("b").contains("#0072B2"));
}

#[test]
fn what_differs_decides_what_is_drawn_and_how_often() {
    let folder = Folder::new();
    let many = |gazes: usize| {
        let gazes: Vec<String> = (0..gazes).map(|i| format!("[{i}, 0]")).collect();
        GOOD.replace(
            "[[curve]]\nname = \"A\"",
            &format!("gazes = [{}]\n[[curve]]\nname = \"A\"", gazes.join(", ")),
        )
    };
    folder.write("e.toml", many(49));
    folder.run(&["check", "e.toml"]).ok();
    let each = "kind = \"rates\"\npanels = \"curve\"";
    folder.write("e.toml", many(49).replace("kind = \"rates\"", each));
    folder
        .run(&["check", "e.toml"])
        .fails(2, &["the figure has 49 panels, but at most 48", "panels = \"one\""]);
    folder.write(
        "e.toml",
        many(49).replace("kind = \"rates\"", "kind = \"rates\"\npanels = \"one\""),
    );
    folder.run(&["check", "e.toml"]).ok();
    let density = "kind = \"density\"";
    folder.write("e.toml", many(49).replace("kind = \"rates\"", density));
    let run = folder.run(&["check", "e.toml"]).fails(2, &["49 panels", "curves = […]"]);
    assert!(!run.stderr.contains("panels = "), "{}", run.stderr);
    // A file that names no plot has those that fit.
    folder.write("e.toml", many(49).replace("[[plot]]\nkind = \"rates\"", ""));
    let said = ["the plot density is left out: it would have 49 panels", density];
    let run = folder.run(&["check", "e.toml"]).ok().says(&said);
    assert!(run.stdout.contains("1 figure, 3 tables"), "{}", run.stdout);
    folder.write("e.toml", many(101));
    folder.run(&["check", "e.toml"]).fails(2, &["a list of 1 to 100 values"]);

    // A direction is no other picture, and what is written twice no other curve.
    let twice = GOOD
        .replace(
            "resolutions = [\"1440x1600\"]",
            "resolutions = [\"1440x1600\", \"1440x1600\"]\ndirections_deg = [0, 90, 90]",
        )
        .replace("kind = \"rates\"", "kind = \"density\"\n[[table]]\nkind = \"acuity\"")
        .replace(
            "name = \"good\"",
            "name = \"good\"\nacuity = { model = \"piecewise\", cap_cpd = 18 }",
        )
        .replace(
            "name = \"A\"\nmethod = { model = \"rmfr\" }",
            "name = \"<b>VP\"\nmethod = { model = \"visual-polar\" }",
        );
    folder.write("e.toml", twice);
    folder.run(&["curves", "e.toml"]).ok();
    let record = json(&folder, "reports/good/curves.json");
    assert_eq!(record["curves"].as_array().unwrap().len(), 3);
    assert_eq!(record["acuity_parameters"], "cap_cpd=18");
    assert!(record["text"].as_str().unwrap().contains("[[curve]]"));
    let density = fs::read_to_string(folder.path("reports/good/plots/density.csv")).unwrap();
    assert_eq!(density.lines().count(), 1 + 240 * 216);
    let table = fs::read_to_string(folder.path("reports/good/table-acuity.md")).unwrap();
    assert!(table.contains("cap_cpd=18") || table.contains("cap\\_cpd=18"), "{table}");
    let row = table.lines().find(|line| line.contains("VP")).unwrap();
    assert!(row.contains("\\<b\\>VP (reconstruction)"), "{row}");
}

/// A budget is of all that a frame costs, and so are share and speed-up.
#[test]
fn a_wide_frame_costs_what_lies_beyond_too() {
    let folder = Folder::new();
    let text = "name = \"w\"\n[view]\nfov_vertical_deg = 110\nresolutions = [\"2560x1440\"]\n[[curve]]\nname = \"VaFR\"\nmethod = { model = \"vafr\" }\nbudget = 0.15\n[[table]]\nkind = \"speed_up\"\n";
    folder.write("w.toml", text);
    folder.run(&["curves", "w.toml"]).ok();
    let shading = &json(&folder, "reports/w/curves.json")["curves"][0]["shading"];
    let of = |key: &str| shading[key].as_f64().unwrap();
    assert!(of("samples_beyond") > 1e4);
    let pixels = 2560.0 * 1440.0;
    assert!(((of("samples") + of("samples_beyond")) / pixels - 0.15).abs() < 1e-9);
    assert!((of("share") - 0.15).abs() < 1e-9 && (of("speed_up") - 1.0 / 0.15).abs() < 1e-6);
    assert!(of("samples_on_screen") < of("samples") + of("samples_beyond"));
    let table = fs::read_to_string(folder.path("reports/w/table-speed-up.md")).unwrap();
    assert!(table.contains("| 15.0 % | 6.67 |") && table.contains("Beyond"), "{table}");
}

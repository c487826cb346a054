//! The keys of tables: layout, average, spread, metrics, caption, label and name.

use std::fs;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{experiment, json, rows, two_scenes};

const METRICS: &str = "[metrics]\nssim = {}\nmse = {}\npsnr = {}\n";

/// Runs two scenes with a table that has these keys.
fn run(keys: &str) -> Folder {
    let folder = two_scenes();
    folder.write("e.toml", experiment(&format!("{METRICS}[[plot]]\nkind = \"table\"\n{keys}\n")));
    folder.run(&["run", "e.toml"]).ok();
    folder
}

fn read(folder: &Folder, name: &str) -> String {
    fs::read_to_string(folder.path(&format!("reports/e/{name}"))).unwrap()
}

/// The first cells of the rows of a Markdown table, and its first line.
fn rows_of(text: &str) -> (String, Vec<String>) {
    let lines: Vec<&str> = text.lines().take_while(|line| line.starts_with('|')).collect();
    let first = |line: &&str| line.split('|').nth(1).unwrap().trim().to_owned();
    (lines[0].to_owned(), lines[2..].iter().map(first).collect())
}

#[test]
fn methods_are_rows_and_metrics_have_the_order_of_the_file() {
    let folder = run("");
    let (header, rows) = rows_of(&read(&folder, "table.md"));
    assert_eq!(header, "| method | SSIM ↑ | MSE ↓ | PSNR (dB) ↑ |");
    let sections = ["**room**", "**hall**", "**Average over 2 scenes**"];
    assert_eq!(rows, sections.map(|title| [title, "A", "B"]).concat());
    let csv = read(&folder, "table.csv");
    let names = "scene,ssim A,ssim B,ssim best,mse A,mse B,mse best,psnr A,psnr B,psnr best";
    assert_eq!(csv.lines().next(), Some(names));
    // The page and the terminal show the same.
    let page = read(&folder, "report.html");
    let buttons =
        page.split("<button").skip(1).filter_map(|button| button.split(['<', '>']).nth(1));
    let heads = ["method", "SSIM ↑", "MSE ↓", "PSNR (dB) ↑"];
    assert_eq!(buttons.take(4).collect::<Vec<_>>(), heads);
    let section = "<th scope=\"rowgroup\" colspan=\"4\"><span>hall</span></th></tr>\n<tr><th scope=\"row\">A</th>";
    assert!(page.contains(section), "{page}");
    assert!(page.contains("<a href=\"table.tex\">LaTeX</a>"));
    let printed = folder.run(&["report", "reports/e"]).ok().stdout;
    let names: Vec<&str> = printed.lines().filter_map(|l| l.split_whitespace().next()).collect();
    let wanted = ["method", "room", "A", "B", "hall", "A", "B", "Average", "A", "B", "Best:"];
    assert_eq!(names, wanted, "{printed}");
    assert_eq!(json(&folder, "reports/e/run.json")["resolved"]["metric_order"][0], "ssim");
    // Figures have this order too.
    let at = |name: &str| page.find(&format!("plots/{name}.svg"));
    assert_eq!(at("bars-ssim"), None, "tables alone were asked for");
}

#[test]
fn figures_have_the_order_of_the_file() {
    let folder = two_scenes();
    folder.write("e.toml", experiment("[metrics]\nssim = {}\npsnr = {}\n"));
    folder.run(&["run", "e.toml"]).ok();
    let page = read(&folder, "report.html");
    let at = |name: &str| page.find(&format!("plots/{name}.svg")).unwrap();
    assert!(at("bars-ssim") < at("bars-psnr") && at("profile-ssim") < at("profile-psnr"));
}

#[test]
fn scenes_may_be_the_rows() {
    let folder = run("layout = \"scenes\"");
    let (header, rows) = rows_of(&read(&folder, "table.md"));
    assert_eq!(header, "| scene | SSIM ↑ | | MSE ↓ | | PSNR (dB) ↑ | |");
    assert_eq!(rows, ["", "room", "hall", "Average"]);
    let latex = read(&folder, "table.tex");
    let heads = "& \\multicolumn{2}{c}{SSIM $\\uparrow$} & ";
    assert!(latex.contains(heads) && latex.contains("\\begin{tabular}{l rr rr rr}"), "{latex}");
    assert!(latex.contains("\n\\midrule\nAverage & "), "{latex}");
}

#[test]
fn metrics_may_be_the_rows() {
    let folder = run("layout = \"transposed\"\nmethods = [\"B\", \"A\"]");
    let (header, rows) = rows_of(&read(&folder, "table.md"));
    assert_eq!(header, "| metric | B | A |", "methods have the order of the list");
    let metrics = ["SSIM ↑", "MSE ↓", "PSNR (dB) ↑"];
    assert_eq!(rows[..4], ["**room**", metrics[0], metrics[1], metrics[2]]);
    let latex = read(&folder, "table.tex");
    // Points are aligned in columns of several metrics.
    assert!(latex.contains("\nMSE (10$^{-4}$) $\\downarrow$ & "), "{latex}");
    let psnr = latex.lines().find(|line| line.starts_with("PSNR (dB)")).unwrap();
    assert_eq!(psnr.matches("\\phantom{00}").count(), 2, "{psnr}");
}

#[test]
fn one_metric_has_a_column_per_scene() {
    let folder = run("metric = \"psnr\"");
    let (header, rows) = rows_of(&read(&folder, "table.md"));
    assert_eq!(header, "| method | PSNR (dB) ↑ | | |");
    assert_eq!(rows, ["", "A", "B"]);
    let latex = read(&folder, "table.tex");
    assert!(latex.contains("Method & room & hall & Average \\\\"), "{latex}");
}

#[test]
fn averages_stand_where_they_are_wanted() {
    for (place, wanted) in [
        ("first", &["Average", "room", "hall"][..]),
        ("last", &["room", "hall", "Average"]),
        ("none", &["room", "hall"]),
        ("only", &["Average"]),
    ] {
        let folder = run(&format!("average = \"{place}\""));
        let csv = read(&folder, "table.csv");
        let names: Vec<&str> = csv.lines().skip(1).filter_map(|l| l.split(',').next()).collect();
        assert_eq!(names, wanted, "{place}");
        let latex = read(&folder, "table.tex");
        assert_eq!(latex.matches("\nA & ").count(), wanted.len(), "{place}: {latex}");
    }
    let latex = read(&run("average = \"only\""), "table.tex");
    assert!(
        latex.contains(
            "\\caption{Comparison, average over 2 scenes. Means over frames, averaged over scenes."
        ),
        "{latex}"
    );
}

/// The deviation of a sample, from all values of results.csv.
#[test]
fn spreads_are_those_of_the_values() {
    fn deviation(values: &[f64]) -> f64 {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        (squares / (values.len() - 1) as f64).sqrt()
    }
    let folder = run("metrics = [\"psnr\"]\nspread = \"frames\"");
    let all = rows(&folder, "reports/e");
    let frames = |scene: &str, method: &str| -> Vec<f64> {
        let of = all.iter().filter(|row| {
            row["scene"] == scene
                && row["method"] == method
                && row["metric"] == "psnr"
                && row["from_deg"].is_empty()
                && !row["frame"].is_empty()
        });
        of.map(|row| row["value"].parse().unwrap()).collect()
    };
    let table = |folder: &Folder| -> Vec<Vec<String>> {
        let text = read(folder, "table.csv");
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let csv = table(&folder);
    assert_eq!(csv[0], ["scene", "psnr A", "psnr B", "psnr best", "psnr A sd", "psnr B sd"]);
    let mut means = Vec::new();
    for (row, scene) in [(1, "room"), (2, "hall")] {
        for (column, method) in [(4, "A"), (5, "B")] {
            let values = frames(scene, method);
            assert_eq!(values.len(), 3);
            let found: f64 = csv[row][column].parse().unwrap();
            assert!((found - deviation(&values)).abs() < 1e-12, "{scene} {method}");
        }
        means.push(csv[row][1].parse::<f64>().unwrap());
    }
    assert_eq!(csv[3][4..], ["", ""], "averages have no frames");
    let shown = format!("{:.2} ± {:.2}", means[0], deviation(&frames("room", "A")));
    assert!(read(&folder, "table.md").contains(&shown), "{shown}");
    let latex = read(&folder, "table.tex");
    let spread = format!("{{\\scriptsize$\\pm${:.2}}}", deviation(&frames("room", "A")));
    assert!(latex.contains(&spread), "{latex}");
    assert!(latex.contains("$\\pm$ standard deviation over frames"), "{latex}");

    // The method has the errors of the other one in one of the scenes.
    for frame in 0..3 {
        let file = |method: &str| folder.path(&format!("hall/{method}/{frame:04}.png"));
        fs::copy(file("b"), file("a")).unwrap();
    }
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    folder.write("e.toml", text.replace("\"frames\"", "\"scenes\""));
    folder.run(&["run", "e.toml"]).ok();
    let csv = table(&folder);
    let means = [1, 2].map(|row| csv[row][1].parse::<f64>().unwrap());
    assert!(means[0] > means[1] + 1.0, "{means:?}");
    assert_eq!([&csv[1][4], &csv[2][4]], ["", ""], "one scene has none");
    let found: f64 = csv[3][4].parse().unwrap();
    assert!((found - deviation(&means)).abs() < 1e-12);
}

#[test]
fn captions_labels_and_names_are_the_authors() {
    let keys = "caption = \"50 % of_all \\\\ {x}\"\nlabel = \"tab:main_1\"\nname = \"Main result\"\n\
                [[plot]]\nkind = \"table\"\n[[plot]]\nkind = \"bars\"\nmetric = \"psnr\"\ncaption = \"Bars <of> mine\"\n\
                [[plot]]\nkind = \"ratios\"\nmetrics = [\"atd\", \"rms_contrast\"]\nlabel = \"tab:r\"\nname = \"n\"\nscenes = [\"hall\"]\n\
                [metrics.rms_contrast]\n[metrics.atd]";
    let folder = two_scenes();
    let text = experiment(&format!("[[plot]]\nkind = \"table\"\n{keys}\n[metrics.psnr]\n"));
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml"]).ok();
    let latex = read(&folder, "table-main-result.tex");
    let wanted = "\\caption{50 \\% of\\_all \\textbackslash{} \\{x\\}}\\label{tab:main_1}\n";
    assert!(latex.contains(wanted), "{latex}");
    assert!(read(&folder, "table.tex").contains("\\label{tab:e-table}"));
    let page = read(&folder, "report.html");
    assert!(page.contains(">50 % of_all \\ {x}</h2>") && page.contains(">Comparison</h2>"));
    assert!(page.contains("<figcaption>Bars &#60;of&#62; mine ("), "{page}");
    assert!(read(&folder, "ratios-n-atd.tex").contains("\\label{tab:r}"));
    assert!(read(&folder, "ratios-n-rms-contrast.tex").contains("\\label{tab:r-2}"));
    // They are listed, so that the next drawing removes them.
    folder.write("e.toml", experiment("[metrics.psnr]\n[[plot]]\nkind = \"table\"\n"));
    folder.run(&["run", "e.toml"]).ok();
    assert!(!folder.path("reports/e/table-main-result.tex").exists());
}

#[test]
fn what_does_not_apply_is_an_error() {
    let folder = two_scenes();
    for (plot, wanted) in [
        ("kind = \"bars\"\nlayout = \"methods\"", "layout does not apply to kind = \"bars\""),
        ("kind = \"ratios\"\nspread = \"frames\"", "spread does not apply to kind = \"ratios\""),
        ("kind = \"table\"\nmetric = \"psnr\"\nmetrics = [\"psnr\"]", "either metric or metrics"),
        ("kind = \"table\"\nmetrics = [\"gmsd\"]", "the plot's metric gmsd is not scored"),
        ("kind = \"table\"\nmetrics = [\"psnrr\"]", "psnrr"),
        ("kind = \"bars\"\nmetrics = [\"samples\"]", "only a comparison table shows samples"),
        ("kind = \"bars\"\nmetrics = [\"quads\"]", "only a comparison table shows quads"),
        ("kind = \"table\"\nlabel = \"a}b\"", "a label in LaTeX cannot contain '}'"),
        ("kind = \"table\"\nscenes = [\"hall\"]\nspread = \"scenes\"", "needs at least two"),
        ("kind = \"table\"\nscenes = [\"hall\"]\naverage = \"only\"", "it has one scene"),
        ("kind = \"table\"\naverage = \"none\"\nspread = \"scenes\"", "average is \"none\""),
        ("kind = \"table\"\naverage = \"only\"\nspread = \"frames\"", "average is \"only\""),
        ("kind = \"table\"\nlayout = \"wide\"", "transposed"),
    ] {
        folder.write("e.toml", experiment(&format!("[metrics.psnr]\n[[plot]]\n{plot}\n")));
        folder.run(&["check", "e.toml"]).fails(2, &[wanted]);
    }
}

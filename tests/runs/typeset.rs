//! Tables in LaTeX are typeset as they are, with booktabs alone, and none is too wide.

use std::fmt::Write;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use fovqa_testkit::synthetic::{codes, disturbed};

use crate::fovqa::{Folder, root};

/// Set to 1, the tests need a TeX installation.
const REQUIRE_TEX: &str = "FOVQA_REQUIRE_TEX";

/// Whether pdflatex can be run; otherwise a line says so.
fn has_latex() -> bool {
    let found = Command::new("pdflatex").arg("--version").stdout(Stdio::null()).status().is_ok();
    if !found {
        let is_required = std::env::var_os(REQUIRE_TEX).is_some_and(|value| value == "1");
        assert!(!is_required, "{REQUIRE_TEX}=1, and pdflatex is not there");
        // Not `eprintln!`, which the test runner keeps to itself.
        let _ = writeln!(std::io::stderr(), "skipped: pdflatex is not there");
    }
    found
}

/// Typesets files in a document with lines of this width.
#[track_caller]
fn typeset(folder: &Folder, files: &[String], width: &str) {
    let mut text = format!(
        "\\documentclass{{article}}\n\\usepackage{{booktabs}}\n\
         \\usepackage[textwidth={width},textheight=9in]{{geometry}}\n\\begin{{document}}\n"
    );
    for file in files {
        let _ = writeln!(text, "\\input{{{file}}}\n\\clearpage");
    }
    text.push_str("\\end{document}\n");
    folder.write("d.tex", text);
    pdflatex(folder, "d");
}

/// Typesets a document of the folder, and refuses what an author would have to mend.
#[track_caller]
fn pdflatex(folder: &Folder, name: &str) {
    let run = Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "-halt-on-error", &format!("{name}.tex")])
        .current_dir(folder.path(""))
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let log = fs::read(folder.path(&format!("{name}.log"))).unwrap_or_default();
    let log = String::from_utf8_lossy(&log);
    let bad = |line: &&str| {
        ["Overfull", "! ", "Float too large", "multiply-defined", "Missing character"]
            .iter()
            .any(|word| line.contains(word))
    };
    let found: Vec<&str> = log.lines().filter(bad).collect();
    assert!(run.status.success() && found.is_empty(), "{name}: {found:#?}");
}

/// The LaTeX files below a folder, relative to it.
fn latex_files(folder: &Folder, results: &str) -> Vec<String> {
    let names = fs::read_dir(folder.path(results)).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut files: Vec<String> = names
        .filter(|name| Path::new(name).extension().is_some_and(|ending| ending == "tex"))
        .map(|name| format!("{results}/{name}"))
        .collect();
    files.sort_unstable();
    files
}

/// Names with every character that has a meaning in LaTeX, long ones, and ones that begin a cell in
/// the way of an argument.
const NAMES: [&str; 9] = [
    "[1] a_b % & # ~ ^ { } $ < > | \\\" --- ,, ?`",
    "*Zürich, Łódź, é à ñ ç ø ß",
    "σ = 2.6 × α ≤ 5° ± ∞ µ²",
    "WWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWW",
    "a name of many words that is not short, with eighty characters in all, limit",
    "an_identifier_without_spaces_that_somebody_has_taken_from_a_script_01234567_abc",
    "(brackets)",
    "–",
    "7",
];

const ALL: &str = "[metrics]\nmse = {}\npsnr = {}\nssim = {}\nms_ssim = {}\nfpsnr = {}\nfssim = {}\ngmsd = {}\n\
                   fvvdp = {}\npu_psnr = {}\nrms_contrast = {}\nhaar = {}\natd = {}\n";

/// Twenty methods and two scenes with such names, all metrics, and tables of every kind.
fn many() -> Folder {
    const SIDE: usize = 176;
    let folder = Folder::new();
    let mut text = String::from(
        "name = \"e\"\n[view]\nfov_vertical_deg = 60\nluminance = \"htc-vive-pro\"\nbands_deg = [0, 5, 10, 20, 30]\n",
    );
    for (scene, name) in NAMES[..2].iter().enumerate() {
        for frame in 0..2 {
            let gt = codes(SIDE, SIDE, 3, (10 * scene + frame) as u64);
            folder.png(&format!("s{scene}/gt/{frame}.png"), SIDE, SIDE, &gt);
            for method in 0..20 {
                let test = disturbed(&gt, 2.0 + 3.0 * method as f64, 2);
                folder.png(&format!("s{scene}/m{method}/{frame}.png"), SIDE, SIDE, &test);
            }
        }
        let _ = write!(
            text,
            "[[scene]]\nname = \"{name}\"\nfolder = \"s{scene}\"\nreference = \"{{folder}}/gt\"\nfps = 90\n"
        );
    }
    for method in 0..20 {
        let name =
            NAMES.get(method).map_or_else(|| format!("m{method}"), |name| (*name).to_owned());
        let _ = write!(text, "[[method]]\nname = \"{name}\"\ntest = \"{{folder}}/m{method}\"\n");
    }
    text.push_str(ALL);
    for layout in ["methods", "scenes", "transposed"] {
        for spread in ["", "spread = \"scenes\"\n", "spread = \"frames\"\naverage = \"first\"\n"] {
            let _ = write!(text, "[[plot]]\nkind = \"table\"\nlayout = \"{layout}\"\n{spread}");
        }
        let _ =
            write!(text, "[[plot]]\nkind = \"table\"\nlayout = \"{layout}\"\nmetric = \"ssim\"\n");
        let _ = write!(text, "[[plot]]\nkind = \"ratios\"\nlayout = \"{layout}\"\n");
    }
    let word = "W".repeat(80);
    let _ = write!(
        text,
        "[[plot]]\nkind = \"table\"\nmethods = [\"7\"]\nmetric = \"mse\"\ncaption = \"\\\\input{{x}} 100 % {word}\"\n"
    );
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml"]).ok();
    folder
}

/// Studies with such names, and those of the repository.
#[test]
fn tables_of_studies_fit_on_a_page() {
    if !has_latex() {
        return;
    }
    let folder = Folder::new();
    let cell = |name: &str| format!("\"{}\"", name.replace('"', "\"\""));
    let mut votes = String::from("participant,scene,method_a,method_b,answer\n");
    let mut values = String::from("participant,method,value\n");
    for (a, first) in NAMES.iter().enumerate() {
        for participant in 0..3 {
            let value = (a * 7 + participant * 5) % 11;
            let _ = writeln!(values, "P{participant},{},{value}", cell(first));
        }
        for (b, second) in NAMES.iter().enumerate().skip(a + 1) {
            for participant in 0..3 {
                let answer = if (a + b + participant) % 3 == 0 { "a" } else { "b" };
                let (first, second) = (cell(first), cell(second));
                let scene = cell(NAMES[participant % 2]);
                let _ = writeln!(votes, "P{participant},{scene},{first},{second},{answer}");
            }
        }
    }
    folder.write("votes.csv", votes);
    folder.write("values.csv", values);
    folder.write(
        "s.toml",
        "name = \"names\"\n[[analysis]]\nkind = \"pairs\"\nfile = \"votes.csv\"\nby = [\"scene\"]\n\
         bootstrap = 20\n[[analysis]]\nkind = \"ranks\"\nfile = \"values.csv\"\n\
         pairwise = \"signed-rank\"\n[[analysis]]\nkind = \"anova\"\nfile = \"values.csv\"\n\
         within = \"method\"\n",
    );
    folder.run(&["study", "s.toml", "--output", "names"]).ok();
    let mut files = latex_files(&folder, "names");
    for name in ["metrics", "rmfr-table-2", "slider", "thresholds", "votes"] {
        let path = root().join(format!("configs/studies/{name}.toml"));
        folder.run(&["study", path.to_str().unwrap(), "--output", name]).ok();
        files.extend(latex_files(&folder, name));
    }
    assert!(files.len() > 35, "{files:?}");
    typeset(&folder, &files, "7in");
}

#[test]
fn tables_of_many_methods_and_metrics_fit_on_a_page() {
    if !has_latex() {
        return;
    }
    let folder = many();
    let files = latex_files(&folder, "reports/e");
    assert!(files.len() > 30, "{files:?}");
    typeset(&folder, &files, "7in");
}

#[test]
fn small_tables_fit_into_a_column() {
    if !has_latex() {
        return;
    }
    let folder = Folder::new();
    let config = root().join("configs/renders.toml");
    let config = config.to_str().unwrap();
    folder.run(&["run", config, "--output", "renders"]).ok();
    // Without a view, with one method in one scene.
    folder.png_pair("a.png", "b.png", 48, 40);
    folder.write(
        "one.toml",
        "name = \"one\"\n[[scene]]\nname = \"s\"\nreference = \"a.png\"\n[[method]]\nname = \"m\"\ntest = \"b.png\"\n",
    );
    folder.run(&["run", "one.toml", "--output", "one"]).ok();
    let files = ["renders/table.tex".to_owned(), "one/table.tex".to_owned()];
    for file in &files {
        let text = fs::read_to_string(folder.path(file)).unwrap();
        assert!(text.contains("\\begin{table}\n"), "{file} is for one column: {text}");
    }
    typeset(&folder, &files, "3.3in");
}

#[test]
fn tables_of_curves_fit_on_a_page() {
    if !has_latex() {
        return;
    }
    let folder = Folder::new();
    let configs = ["papers/vafr-table-1.toml", "curves/headset.toml", "curves/gaze.toml"];
    let configs = configs.map(|file| root().join("configs").join(file));
    let configs = configs.each_ref().map(|path| path.to_str().unwrap());
    folder.run(&[&["curves"], &configs[..], &["--output", "out"]].concat()).ok();
    folder.write("all.toml", CURVES);
    folder.run(&["curves", "all.toml", "--output", "all"]).ok();
    let mut files = latex_files(&folder, "all");
    assert_eq!(files.len(), 3, "{files:?}");
    for config in ["vafr-table-1", "headset", "gaze"] {
        files.extend(latex_files(&folder, &format!("out/{config}")));
    }
    assert!(files.len() > 5, "{files:?}");
    typeset(&folder, &files, "7in");
    let text = fs::read_to_string(folder.path("all/table-speed-up.tex")).unwrap();
    assert!(text.contains("\\label{tab:all-table-speed-up}"), "{text}");
    assert!(
        text.contains(" & (\\%)") && !text.contains(" \\%\\\\\n"),
        "units are in the head: {text}"
    );
    let samples = fs::read_to_string(folder.path("all/table-samples.tex")).unwrap();
    assert!(samples.contains("\\multicolumn{2}{c}{2560 $\\times$ 1440}"), "{samples}");
}

/// Every table, with names as above.
const CURVES: &str = r#"
name = "all"
[view]
fov_vertical_deg = 100
resolutions = ["1920x1080", "2560x1440", "3840x2160"]
[[curve]]
name = "RMFR_1 & 50 %"
method = { model = "rmfr", sigma = 2.6 }
[[curve]]
name = "VaFR, a curve whose name has many words and does not fit into a column"
method = { model = "vafr" }
[[curve]]
name = "Guenter"
method = { model = "guenter" }
[[table]]
kind = "samples"
[[table]]
kind = "speed_up"
[[table]]
kind = "acuity"
"#;

/// The sample paper in docs/paper, from its own runs.
#[test]
fn the_sample_paper_has_nothing_overfull() {
    if !has_latex() {
        return;
    }
    let folder = Folder::new();
    for file in ["experiment.toml", "curves.toml", "paper.tex"] {
        fs::copy(root().join("docs/paper").join(file), folder.path(file)).unwrap();
    }
    folder.run(&["run", "experiment.toml"]).ok();
    folder.run(&["curves", "curves.toml"]).ok();
    for _ in 0..2 {
        pdflatex(&folder, "paper");
    }
    let paper = fs::read_to_string(folder.path("paper.tex")).unwrap();
    let figures = paper.matches("\n\\figwide{").count() + paper.matches("\n\\figcolumn{").count();
    let tables = paper.matches("\n\\input{").count();
    assert_eq!((figures, tables), (6, 4));
}

//! Every way to end, command by command: 0 done, 1 a gate fails, 2 the command line, an experiment or a
//! rule is wrong, 3 an input or an output. Nothing that was not scored looks like a result.

use std::fs;
use std::path::Path;

use fovqa_testkit::exr_files::{File, Part};

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{experiment, two_scenes};

const RULES: &str = "[metrics]\npsnr = {}\n[[gate]]\nmetric = \"psnr\"\nat_least = 1\n";
const CURVES: &str = "name = \"c\"\n[view]\nfov_vertical_deg = 100\nresolutions = [\"64x48\"]\n\
    [[curve]]\nname = \"K\"\nmethod = { model = \"kfr\" }\n";

/// Pictures, an experiment that has been run, its baseline, and everything that can be wrong.
fn folder() -> Folder {
    let folder = two_scenes();
    folder.png_pair("a.png", "b.png", 48, 40);
    folder.png_pair("large.png", "large2.png", 50, 40);
    folder.write("text.png", "no picture");
    let whole = fs::read(folder.path("a.png")).unwrap();
    folder.write("cut.png", &whole[..whole.len() / 2]);
    folder.write("file", "in the way");
    folder.write("gaze.csv", "frame,x_px,y_px\n0,1,1\n");
    folder.write("time.csv", "time_s,x_px,y_px\n0.0,1,1\n");
    folder.write("columns.csv", "a,b\n1,2\n");
    fs::create_dir(folder.path("empty")).unwrap();
    File::new(vec![Part::rgb((4, 4), |_, _| 0.5)]).write(&folder.path("half.exr"));
    File::new(vec![Part::rgb((4, 4), |_, _| f32::NAN)]).write(&folder.path("nan.exr"));
    let good = experiment(RULES);
    folder.write("e.toml", &good);
    folder.write("fails.toml", good.replace("at_least = 1", "at_least = 90"));
    folder.write("drop.toml", good.replace("at_least = 1", "max_drop = 1"));
    folder.write("tight.toml", good.replace("at_least = 1", "max_drop = 1"));
    folder.write("ungated.toml", good.split("[[gate]]").next().unwrap());
    folder.write("rule.toml", good.replace("at_least = 1", "at_most = 1"));
    folder.write("band.toml", good.replace("at_least = 1", "at_least = 1\nband_deg = [0, 80]"));
    folder.write(
        "bandgone.toml",
        fs::read_to_string(folder.path("band.toml")).unwrap().replace("{scene}/b", "gone"),
    );
    folder.write("other.toml", good.replace("fov_vertical_deg = 60", "fov_vertical_deg = 50"));
    folder.write("gone.toml", good.replace("{scene}/b", "gone"));
    folder.write(
        "failsgone.toml",
        good.replace("{scene}/b", "gone").replace("at_least = 1", "at_least = 90"),
    );
    folder.write("onebad.toml", good.replace("{scene}/b", "{scene}/bad"));
    for scene in ["hall", "room"] {
        for frame in 0..3 {
            let [from, to] =
                ["b", "bad"].map(|of| folder.path(&format!("{scene}/{of}/{frame:04}.png")));
            fs::copy(from, to).unwrap();
        }
    }
    folder.write("room/bad/0001.png", "no picture");
    folder.write("key.toml", good.replace("[view]", "[vieww]"));
    folder.write("pattern.toml", good.replace("{scene}/b", "x.%d.%d.png"));
    folder.write("rate.toml", good.replace("[view]", "[view]\ngaze = { trace = \"time.csv\" }"));
    folder.write("trace.toml", good.replace("[view]", "[view]\ngaze = { trace = \"no.csv\" }"));
    folder.write("small.toml", format!("{}fvvdp = {{}}\n", good.split("[[gate]]").next().unwrap()));
    folder.write("broken.toml", "name = \"x");
    folder.write("c.toml", CURVES);
    folder.write("model.toml", CURVES.replace("kfr", "kfrr"));
    folder.write("param.toml", CURVES.replace("\"kfr\"", "\"kfr\", sgma = 1"));
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["baseline", "save", "reports/e", "b.json"]).ok();
    let baseline = fs::read_to_string(folder.path("b.json")).unwrap();
    folder.write("cut.json", &baseline[..baseline.len() / 2]);
    folder.write("schema.json", baseline.replace("fovqa.baseline/1", "fovqa.run/1"));
    folder
        .write("nan.json", baseline.replacen("\"psnr mean\": ", "\"psnr mean\": NaN, \"x\": ", 1));
    folder.write(
        "huge.json",
        baseline.replacen("\"psnr mean\": ", "\"psnr mean\": 1e999, \"x\": ", 1),
    );
    folder.write(
        "type.json",
        baseline.replacen("\"psnr mean\": ", "\"psnr mean\": true, \"x\": ", 1),
    );
    folder.write("version.json", baseline.replacen("\"version\": 1", "\"version\": 9", 1));
    folder.write("high.json", baseline.replace("\"psnr mean\": ", "\"psnr mean\": 99.0, \"x\": "));
    for damaged in ["cut", "csv"] {
        let results = folder.path(&format!("{damaged}/run.json"));
        fs::copy(folder.path("reports/e/run.json"), results).unwrap();
    }
    let summary = fs::read_to_string(folder.path("reports/e/summary.json")).unwrap();
    folder.write("cut/summary.json", &summary[..summary.len() / 2]);
    folder.write("csv/summary.json", &summary);
    folder.write("csv/results.csv", "scene,method\n");
    folder
}

/// The arguments, the exit code, and words that are said.
type Case = (&'static str, i32, &'static str);

const SCORE: &[Case] = &[
    ("score a.png b.png", 0, ""),
    ("score", 2, "REFERENCE"),
    ("score a.png", 2, "TEST"),
    ("score a.png b.png --colour", 2, "--colour"),
    ("score a.png b.png --metrics pnsr", 2, "did you mean psnr?"),
    ("score a.png b.png --metrics fpsnr", 2, "needs a view"),
    ("score a.png b.png --metrics fvvdp", 2, "needs a view"),
    ("score a.png b.png --metrics ms-ssim --maps m", 2, "--maps"),
    ("score a.png b.png --set ssim.sigma=0", 2, "cannot be 0"),
    ("score a.png b.png --fov-vertical 180", 2, "180"),
    ("score a.png b.png --gaze 1", 2, "X,Y"),
    ("score a.png b.png --threads 0", 2, "--threads"),
    ("score a.png b.png --frames x", 2, "A..B"),
    ("score a.png b.png --format xml", 2, "xml"),
    ("score room/gt room/a --metrics fvvdp --display htc-vive-pro", 2, "--fps"),
    ("score a.png b.png --metrics fvvdp --display htc-vive-pro --transfer pq", 2, "PQ"),
    ("score room/gt room/a --fov-vertical 60 --gaze time.csv", 2, "--fps"),
    ("score x.%d.%d.png b.png", 2, "it is not a pattern"),
    ("score a.png no.png", 3, "no.png"),
    ("score no no", 3, "no"),
    ("score empty empty", 3, "empty"),
    ("score room/*.jpg b.png", 3, "room/*.jpg"),
    ("score a.png text.png", 3, "text.png: this is not a PNG"),
    ("score a.png cut.png", 3, "cut.png"),
    ("score a.png large.png", 3, "48x40"),
    ("score nan.exr half.exr", 3, "NaN"),
    ("score a.png b.png --mask no.png", 3, "no.png"),
    ("score a.png b.png --crop 0,0,100,100", 3, "crop"),
    ("score a.png b.png --fov-vertical 60 --gaze no.csv", 3, "no.csv"),
    ("score a.png b.png --fov-vertical 60 --gaze columns.csv", 3, "columns.csv"),
    ("score room/gt room/a --fov-vertical 60 --gaze gaze.csv", 3, "gaze.csv"),
    ("score a.png b.png --metrics ms-ssim", 3, "176"),
    ("score room/gt room/a --frames 7..9", 3, ""),
    ("score room/gt hall/gt/0000.png", 3, ""),
    ("score a.png b.png --metrics fvvdp --display htc-vive-pro --maps file", 3, "file"),
];

const RUN: &[Case] = &[
    ("run e.toml --output r", 0, ""),
    ("run", 2, "EXPERIMENT"),
    ("run no.toml", 2, "no.toml"),
    ("run room", 2, "not a regular file"),
    ("run a.png", 2, "not UTF-8"),
    ("run broken.toml", 2, "not TOML"),
    ("run key.toml", 2, "did you mean view?"),
    ("run rule.toml", 2, "points the wrong way"),
    ("run pattern.toml", 2, "it is not a pattern"),
    ("run rate.toml", 2, "fps"),
    ("run small.toml", 2, "photometry"),
    ("run c.toml", 2, "curve"),
    ("run e.toml --frames x", 2, "A..B"),
    ("run e.toml --threads 300", 2, "300"),
    ("run e.toml --output r --maps file", 3, "file"),
    ("run gone.toml --output r", 3, "gone"),
    ("run trace.toml --output r", 3, "no.csv"),
    ("run onebad.toml --output r", 3, "but 11 frames were scored"),
    ("run e.toml --output file", 3, "file"),
    ("check e.toml", 0, ""),
    ("check", 2, "EXPERIMENT"),
    ("check no.toml", 2, "no.toml"),
    ("check broken.toml", 2, "not TOML"),
    ("check key.toml", 2, "did you mean view?"),
    ("check rule.toml", 2, "points the wrong way"),
    ("check pattern.toml", 2, "it is not a pattern"),
    ("check rate.toml", 2, "fps"),
    ("check gone.toml", 3, "gone"),
    ("check trace.toml", 3, "no.csv"),
    ("report reports/e", 0, ""),
    ("report", 2, "RESULTS"),
    ("report no", 3, "no"),
    ("report room", 3, "room"),
    ("report cut", 3, "summary.json"),
    ("report csv", 3, "results.csv"),
    ("report file", 3, "file"),
];

const OTHERS: &[Case] = &[
    ("curves c.toml --output r", 0, ""),
    ("curves --method kfr --fov-vertical 100 --resolution 64x48", 0, ""),
    ("curves", 2, ""),
    ("curves no.toml", 2, "no.toml"),
    ("curves broken.toml", 2, "not TOML"),
    ("curves model.toml", 2, "did you mean \"kfr\"?"),
    ("curves param.toml", 2, "sgma"),
    ("curves e.toml", 2, "e.toml"),
    ("curves --method kfrr --fov-vertical 100 --resolution 64x48", 2, "did you mean kfr?"),
    ("curves --method kfr --set x=1 --fov-vertical 100 --resolution 64x48", 2, "x"),
    ("curves --method kfr --resolution 64x48", 2, "view"),
    ("curves c.toml --output file", 3, "file"),
    ("", 2, "Usage"),
    ("scores a.png b.png", 2, "scores"),
    ("list metric", 2, "metric"),
    ("list metrics", 0, ""),
    ("schema", 0, ""),
    ("baseline", 2, "Usage"),
    ("baseline save reports/e", 2, "BASELINE"),
    ("baseline save reports/e b.json", 3, "the file already exists"),
    ("baseline save reports/e no/b.json", 3, "it cannot be written"),
    ("baseline save room c.json", 3, "no finished run"),
    ("baseline save cut c.json", 3, "summary.json"),
    ("baseline save csv c.json", 3, "it has no column"),
    ("baseline save reports/e c.json", 0, ""),
    ("baseline show b.json", 0, ""),
    ("baseline show no.json", 3, "no.json"),
    ("baseline show e.toml", 3, "it is not a baseline"),
    ("baseline show cut.json", 3, "it is not a baseline"),
    ("baseline show schema.json", 3, "its schema is fovqa.run/1"),
    ("baseline show nan.json", 3, "it is not a baseline"),
    ("baseline show huge.json", 3, "out of range"),
    ("baseline show type.json", 3, "a number, \"inf\""),
    ("baseline accept reports/e b.json", 0, ""),
    ("baseline accept reports/e cut.json", 3, "it is not a baseline"),
    ("baseline accept reports/e no.json", 3, "no.json"),
    ("baseline accept room b.json", 3, "no finished run"),
    ("baseline accept reports/e b.json --scene cellar", 3, "the run has no scene cellar"),
];

/// With 0 and 1, and where frames were scored, there is a verdict.
const GATE: &[Case] = &[
    ("gate e.toml", 0, ""),
    ("gate reports/e", 0, ""),
    ("gate drop.toml --baseline b.json", 0, ""),
    ("gate e.toml --calibrate reports/e reports/e", 0, "identical to the last digit"),
    ("gate fails.toml", 1, ""),
    ("gate tight.toml --baseline high.json", 1, ""),
    ("gate", 2, "TARGET"),
    ("gate no.toml", 2, "no.toml"),
    ("gate broken.toml", 2, "not TOML"),
    ("gate key.toml", 2, "did you mean view?"),
    ("gate rule.toml", 2, "points the wrong way"),
    ("gate pattern.toml", 2, "it is not a pattern"),
    ("gate rate.toml", 2, "fps"),
    ("gate ungated.toml", 2, "no [[gate]]"),
    ("gate drop.toml", 2, "--baseline"),
    ("gate e.toml --annotations jenkins", 2, "jenkins"),
    ("gate e.toml --format json --annotations github", 2, "--annotations"),
    ("gate e.toml --calibrate reports/e", 2, "a single run"),
    ("gate e.toml --calibrate", 2, "--calibrate"),
    ("gate ungated.toml --calibrate reports/e reports/e", 2, "no [[gate]]"),
    ("gate reports/e --frames 0..2", 2, "has already been scored"),
    ("gate e.toml --baseline no.json", 3, "no.json"),
    ("gate e.toml --baseline cut.json", 3, "it is not a baseline"),
    ("gate e.toml --baseline version.json", 3, "version 9 of psnr"),
    ("gate e.toml --baseline nan.json", 3, "it is not a baseline"),
    ("gate other.toml --baseline b.json", 3, "view.fov_vertical_deg"),
    ("gate room", 3, "no finished run"),
    ("gate cut", 3, "summary.json"),
    ("gate csv", 3, "results.csv"),
    ("gate e.toml --output file", 3, "file"),
    ("gate e.toml --calibrate reports/e cut", 3, "summary.json"),
    ("gate e.toml --calibrate reports/e no", 3, "no finished run"),
    // Several at once: 2 before 3 before 1.
    ("gate rule.toml --baseline no.json", 2, "points the wrong way"),
    ("gate pattern.toml --baseline no.json", 2, "it is not a pattern"),
    ("gate rate.toml --baseline version.json", 2, "fps"),
    ("gate no.toml --baseline no.json", 2, "no.toml"),
    ("gate ungated.toml --baseline no.json", 2, "no [[gate]]"),
    ("gate other.toml --baseline b.json --output file", 3, ""),
];

/// Gates that are no pass although there is a verdict, with a word of it.
const VERDICTS: &[Case] = &[
    ("gate band.toml", 2, "a rule is wrong"),
    ("gate bandgone.toml", 2, "a rule is wrong"),
    ("gate gone.toml", 3, "not everything could be scored"),
    ("gate onebad.toml", 3, "not everything could be scored"),
    ("gate trace.toml", 3, "not everything could be scored"),
    ("gate failsgone.toml", 3, "not everything could be scored"),
    ("gate fails.toml --junit no/x.xml", 3, "the gate fails"),
    ("gate e.toml --markdown no/x.md", 3, "the gate holds"),
    ("gate band.toml --markdown no/x.md", 2, "a rule is wrong"),
];

fn copied(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copied(&path, &target);
        } else {
            fs::copy(path, target).unwrap();
        }
    }
}

/// What looks like a result: values, tables, verdicts.
fn ends_as_it_should(cases: &[Case]) {
    let whole = folder();
    for (line, code, words) in cases {
        let folder = Folder::new();
        copied(&whole.path(""), &folder.path(""));
        let arguments: Vec<&str> = line.split_whitespace().collect();
        let run = folder.run(&arguments);
        let said = format!("{}{}", run.stdout, run.stderr);
        assert_eq!(run.code, *code, "fovqa {line}\n{said}");
        assert!(said.contains(words), "fovqa {line}: {words:?} is not in\n{said}");
        match code {
            0 => {}
            1 => assert!(run.stdout.contains("the gate fails"), "fovqa {line}\n{said}"),
            _ => {
                let error =
                    ["error:", "  × ", "Usage:"].iter().any(|word| run.stderr.contains(word));
                assert!(error, "fovqa {line}\n{said}");
                let scored = said.contains("frames were scored");
                // A plan is no result.
                let plan = line.starts_with("check ");
                assert!(run.stdout.is_empty() || scored || plan, "fovqa {line}\n{said}");
            }
        }
        let results = folder.path("r").join("results.csv").exists();
        assert!(*code != 2 || !results, "fovqa {line} left results");
    }
}

#[test]
fn score_ends_as_it_should() {
    ends_as_it_should(SCORE);
}

#[test]
fn experiments_end_as_they_should() {
    ends_as_it_should(RUN);
}

#[test]
fn curves_baselines_and_lists_end_as_they_should() {
    ends_as_it_should(OTHERS);
}

#[test]
fn gates_end_as_they_should() {
    ends_as_it_should(GATE);
}

#[test]
fn verdicts_that_are_no_pass_say_so() {
    let whole = folder();
    for (line, code, words) in VERDICTS {
        let folder = Folder::new();
        copied(&whole.path(""), &folder.path(""));
        let run = folder.run(&line.split_whitespace().collect::<Vec<_>>());
        assert_eq!(run.code, *code, "fovqa {line}\n{}{}", run.stdout, run.stderr);
        assert!(run.stdout.contains(words), "fovqa {line}\n{}", run.stdout);
        // The same of its results, where it could be written.
        let of_folder = folder.run(&["gate", "reports/e"]);
        let same = if line.contains("no/x") && *code == 3 {
            of_folder.code < 2
        } else {
            of_folder.code == *code
        };
        assert!(same, "fovqa {line}: {}", of_folder.code);
    }
}

//! Mistakes in the rules of a gate: each with its words and its place, and the schema agrees.

use crate::fovqa::{Folder, Run};
use crate::runs::experiment_files::schema_allows;

/// Two scenes, one of them of two eyes, and a rule on line 27.
const GOOD: &str = r#"name = "good"
[view]
fov_vertical_deg = 60
bands_deg = [0, 5, 10, 20]
[[scene]]
name = "room"
reference = { left = "gt", right = "gt" }
[[scene]]
name = "hall"
reference = "gt"
[[method]]
name = "A"
test = { left = "a", right = "a" }
scenes = ["room"]
[[method]]
name = "B"
test = "b"
scenes = ["hall"]
[metrics]
psnr = {}
ssim = {}
fpsnr = {}
mse = {}
rms_contrast = {}
haar = { levels = 3 }
atd = {}
[[gate]]
"#;

fn folder() -> Folder {
    let folder = Folder::new();
    for method in ["a", "b"] {
        folder.png_pair("gt/0000.png", &format!("{method}/0000.png"), 48, 40);
    }
    folder
}

fn check(folder: &Folder, text: &str) -> Run {
    folder.write("e.toml", text);
    folder.run(&["check", "e.toml"])
}

const HAAR: &str = "metric = \"haar\"\nstatistic = \"energy\"\nimage = \"ratio\"\n";

#[test]
fn rules_of_every_kind_are_right() {
    let folder = folder();
    for rule in [
        "metric = \"psnr\"\nat_least = 28",
        "metric = \"psnr\"\nname = \"quality <&> \\\"best\\\"\"\nmax_drop = 0.5\nat_least = -1e12",
        "metric = \"mse\"\nscene = \"hall\"\nmethod = \"B\"\nmax_rise = \"2%\"",
        "metric = \"ssim\"\nscene = \"room\"\neye = \"left\"\nband_deg = [0, 10]\nmax_drop = \" 0.5 % \"",
        "metric = \"fpsnr\"\nstatistic = \"pooled\"\nat_least = 1",
        "metric = \"psnr\"\nstatistic = \"pooled\"\nband_deg = [5, 20]\nat_least = 1",
        "metric = \"atd\"\nimage = \"ratio\"\naggregate = \"p99\"\nat_most = 1",
        "metric = \"rms_contrast\"\nimage = \"test\"\nband_deg = [0, 5]\nat_least = 0\nat_most = 1",
        &format!("{HAAR}level = 3\nband_deg = [0, 20]\naggregate = \"p01\"\nat_most = 1"),
    ] {
        let text = format!("{GOOD}{rule}\n");
        check(&folder, &text).ok();
        assert!(schema_allows(&text), "{rule}");
    }
}

/// The keys of a rule, the words of its mistake, its place behind the rule's head, and whether a schema
/// can tell.
type Mistake = (&'static str, &'static [&'static str], (usize, usize), bool);

const MISTAKES: &[Mistake] = &[
    ("at_least = 1", &["gate has no metric"], (0, 1), true),
    ("metric = \"pnsr\"\nat_least = 1", &["did you mean \"psnr\"?"], (1, 10), true),
    (
        "metric = \"ms_ssim\"\nat_least = 1",
        &["the gate's metric ms_ssim is not scored", "psnr"],
        (1, 10),
        false,
    ),
    ("metric = \"psnr\"", &["the gate on psnr has no limit", "max_drop"], (0, 1), false),
    (
        "metric = \"psnr\"\nat_most = 30",
        &["at_most points the wrong way", "higher is better", "use at_least or max_drop"],
        (2, 11),
        false,
    ),
    (
        "metric = \"psnr\"\nmax_rise = 1",
        &["max_rise points the wrong way", "higher is better"],
        (2, 12),
        false,
    ),
    (
        "metric = \"mse\"\nat_least = 0",
        &["at_least points the wrong way", "lower is better", "use at_most or max_rise"],
        (2, 12),
        false,
    ),
    (
        "metric = \"mse\"\nmax_drop = \"2%\"",
        &["max_drop points the wrong way", "lower is better"],
        (2, 12),
        false,
    ),
    (
        "metric = \"atd\"\nat_least = 0",
        &["at_least points the wrong way", "lower is better"],
        (2, 12),
        false,
    ),
    (
        "metric = \"haar\"\nstatistic = \"energy\"\nimage = \"test\"\nlevel = 1\nband_deg = [0, 5]\nmax_drop = 1",
        &[
            "max_drop points the wrong way",
            "neither higher nor lower is better",
            "at_least and at_most",
        ],
        (6, 12),
        false,
    ),
    (
        "metric = \"atd\"\nimage = \"reference\"\nmax_rise = 1",
        &["max_rise points the wrong way", "neither"],
        (3, 12),
        false,
    ),
    (
        "metric = \"rms_contrast\"\nimage = \"ratio\"\nband_deg = [0, 5]\nat_least = 2\nat_most = 1",
        &["no value can be at least 2 and at most 1"],
        (5, 11),
        false,
    ),
    ("metric = \"psnr\"\nat_least = \"30\"", &["at_least cannot be text"], (2, 12), true),
    ("metric = \"psnr\"\nat_least = nan", &["at_least cannot be nan"], (2, 12), false),
    ("metric = \"psnr\"\nat_least = inf", &["at_least cannot be inf"], (2, 12), false),
    ("metric = \"psnr\"\nat_least = 1e13", &["at_least cannot be"], (2, 12), true),
    ("metric = \"psnr\"\nmax_drop = -1", &["max_drop", "-1"], (2, 12), true),
    (
        "metric = \"psnr\"\nmax_drop = \"2\"",
        &["max_drop cannot be \"2\"", "\"2%\""],
        (2, 12),
        false,
    ),
    ("metric = \"psnr\"\nmax_drop = \"-2%\"", &["max_drop cannot be \"-2%\""], (2, 12), false),
    ("metric = \"psnr\"\nmax_drop = \"nan%\"", &["max_drop cannot be \"nan%\""], (2, 12), false),
    ("metric = \"psnr\"\nmax_drop = true", &["max_drop cannot be true or false"], (2, 12), true),
    ("metric = \"psnr\"\nat_last = 1", &["did you mean at_least?"], (2, 1), true),
    (
        "metric = \"psnr\"\nscene = \"rom\"\nat_least = 1",
        &["there is no scene \"rom\"", "did you mean \"room\"?", "the scenes are"],
        (2, 9),
        false,
    ),
    (
        "metric = \"psnr\"\nmethod = \"C\"\nat_least = 1",
        &["there is no method \"C\"", "the methods are"],
        (2, 10),
        false,
    ),
    (
        "metric = \"psnr\"\nscene = \"hall\"\neye = \"left\"\nat_least = 1",
        &["the rule names an eye, but none of its scenes has two eyes"],
        (3, 7),
        false,
    ),
    (
        "metric = \"psnr\"\neye = \"third\"\nat_least = 1",
        &["eye cannot be \"third\""],
        (2, 7),
        true,
    ),
    (
        "metric = \"psnr\"\naggregate = \"median\"\nat_least = 1",
        &["aggregate cannot be \"median\"", "\"p01\" to \"p99\""],
        (2, 13),
        false,
    ),
    (
        "metric = \"psnr\"\naggregate = \"p100\"\nat_least = 1",
        &["aggregate cannot be \"p100\""],
        (2, 13),
        false,
    ),
    (
        "metric = \"psnr\"\naggregate = \"p00\"\nat_least = 1",
        &["aggregate cannot be \"p00\""],
        (2, 13),
        false,
    ),
    (
        "metric = \"psnr\"\naggregate = \"p+5\"\nat_least = 1",
        &["aggregate cannot be \"p+5\""],
        (2, 13),
        false,
    ),
    (
        "metric = \"psnr\"\nstatistic = \"pooled\"\naggregate = \"min\"\nat_least = 1",
        &["pooled describes the whole sequence", "leave out aggregate"],
        (3, 13),
        false,
    ),
    (
        "metric = \"ssim\"\nstatistic = \"pooled\"\nat_least = 1",
        &["ssim has no statistic \"pooled\"", "leave out statistic"],
        (2, 13),
        false,
    ),
    (
        "metric = \"psnr\"\nstatistic = \"poled\"\nat_least = 1",
        &["psnr has no statistic \"poled\"", "choose one of \"pooled\""],
        (2, 13),
        false,
    ),
    (
        "metric = \"haar\"\nimage = \"test\"\nlevel = 1\nband_deg = [0, 5]\nat_least = 1",
        &["a gate on haar needs a statistic", "energy"],
        (1, 10),
        false,
    ),
    (
        "metric = \"haar\"\nstatistic = \"energy\"\nlevel = 1\nband_deg = [0, 5]\nat_least = 1",
        &["a gate on haar needs an image"],
        (1, 10),
        false,
    ),
    (
        "metric = \"haar\"\nstatistic = \"energy\"\nimage = \"test\"\nband_deg = [0, 5]\nat_least = 1",
        &["needs a level"],
        (1, 10),
        false,
    ),
    (
        "metric = \"haar\"\nstatistic = \"energy\"\nimage = \"test\"\nlevel = 1\nat_least = 1",
        &["a gate on haar needs a band"],
        (1, 10),
        false,
    ),
    (
        "metric = \"haar\"\nstatistic = \"energy\"\nimage = \"test\"\nlevel = 4\nband_deg = [0, 5]\nat_least = 1",
        &["haar has 3 levels, so it has no level 4"],
        (4, 9),
        false,
    ),
    (
        "metric = \"haar\"\nstatistic = \"energy_lh\"\nimage = \"test\"\nlevel = 1\nband_deg = [0, 5]\nat_least = 1",
        &["haar has no statistic \"energy_lh\"", "orientations"],
        (2, 13),
        false,
    ),
    ("metric = \"psnr\"\nlevel = 1\nat_least = 1", &["psnr has no levels"], (2, 9), false),
    ("metric = \"psnr\"\nlevel = 0\nat_least = 1", &["psnr has no level 0"], (2, 9), false),
    ("metric = \"psnr\"\nlevel = 101\nat_least = 1", &["level", "-100 to 100"], (2, 9), true),
    (
        "metric = \"psnr\"\nimage = \"test\"\nat_least = 1",
        &["psnr has one value per pair of images, and so no test"],
        (2, 9),
        false,
    ),
    (
        "metric = \"atd\"\nimage = \"pair\"\nat_most = 1",
        &["atd has values for each image, not for the pair"],
        (2, 9),
        false,
    ),
    (
        "metric = \"fpsnr\"\nband_deg = [0, 5]\nat_least = 1",
        &["fpsnr has no value per band"],
        (2, 12),
        false,
    ),
    (
        "metric = \"psnr\"\nband_deg = [0, 7]\nat_least = 1",
        &["must begin and end at edges of scored bands", "0 to 5, 5 to 10, 10 to 20"],
        (2, 12),
        false,
    ),
    (
        "metric = \"psnr\"\nband_deg = [0, 30]\nat_least = 1",
        &["must begin and end"],
        (2, 12),
        false,
    ),
    ("metric = \"psnr\"\nband_deg = [5, 5]\nat_least = 1", &["is empty"], (2, 12), false),
    ("metric = \"psnr\"\nband_deg = [10, 0]\nat_least = 1", &["is empty"], (2, 12), false),
    ("metric = \"psnr\"\nband_deg = [0, 5, 10]\nat_least = 1", &["a list of 3"], (2, 12), true),
    (
        "metric = \"atd\"\nband_deg = [0, 10]\nat_most = 1",
        &["atd of several bands cannot be combined"],
        (2, 12),
        false,
    ),
    (
        "metric = \"rms_contrast\"\nimage = \"test\"\nband_deg = [0, 20]\nat_most = 1",
        &["rms_contrast of several bands cannot be combined", "name one band"],
        (3, 12),
        false,
    ),
    ("metric = \"psnr\"\nname = \"a/b\"\nat_least = 1", &["cannot have /"], (2, 8), true),
];

#[test]
fn every_mistake_is_shown_in_its_place_and_the_schema_agrees() {
    let folder = folder();
    let head = GOOD.lines().count();
    for (rule, words, (line, column), structural) in MISTAKES {
        let text = format!("{GOOD}{rule}\n");
        let place = format!("e.toml:{}:{column}", head + line);
        let words = [words, &[place.as_str()][..]].concat();
        check(&folder, &text).fails(2, &words);
        if !rule.contains("nan") && !rule.contains("inf") {
            assert_eq!(schema_allows(&text), !structural, "{rule}");
        }
        if line % 2 == 0 {
            folder.run(&["gate", "e.toml"]).fails(2, &words);
        }
    }
    assert!(!folder.path("reports/good").exists(), "nothing was scored");
}

#[test]
fn visible_difference_has_statistics_of_its_own() {
    let folder = folder();
    let good = GOOD
        .replace("fov_vertical_deg = 60", "display = \"htc_vive_pro\"")
        .replace("atd = {}", "fvvdp = {}");
    for (rule, words) in [
        (
            "aggregate = \"min\"\nat_least = 9",
            &["jod describes the whole sequence", "frame_jod"][..],
        ),
        ("at_most = 9", &["at_most points the wrong way: for fvvdp jod, higher is better"]),
        ("statistic = \"q\"\nat_least = 1", &["at_least points the wrong way: for fvvdp q, lower"]),
        ("statistic = \"share\"\nat_most = 1", &["a gate on fvvdp needs a band"]),
        ("statistic = \"share\"\nband_deg = [0, 5]\nmax_rise = 1", &["neither higher nor lower"]),
        ("statistic = \"q_sustained\"\nat_most = 1", &["q_sustained needs a level"]),
        ("statistic = \"jod\"\nlevel = 1\nat_least = 1", &["fvvdp has no levels"]),
        ("band_deg = [0, 5]\nat_least = 1", &["fvvdp jod has no value per band", "share"]),
        ("statistic = \"pooled\"\nat_least = 1", &["fvvdp has no statistic \"pooled\""]),
    ] {
        check(&folder, &format!("{good}metric = \"fvvdp\"\n{rule}\n")).fails(2, words);
    }
    check(&folder, &format!("{good}metric = \"fvvdp\"\nat_least = 9\n")).ok();
}

#[test]
fn a_band_needs_a_view_in_every_scene_of_the_rule() {
    let folder = folder();
    let text = "name = \"e\"\n[[scene]]\nname = \"room\"\nreference = \"gt\"\nfov_vertical_deg = 60\n\
        [[scene]]\nname = \"flat\"\nreference = \"gt\"\n[[method]]\nname = \"A\"\ntest = \"a\"\n\
        [metrics]\npsnr = {}\n[[gate]]\nmetric = \"psnr\"\nband_deg = [0, 5]\nat_least = 1\n";
    check(&folder, text).fails(2, &["bands need a view, but a scene of the rule has none"]);
    check(&folder, &format!("{text}scene = \"flat\"\n")).fails(2, &["bands need a view"]);
    check(&folder, &format!("{text}scene = \"room\"\n")).ok();
}

#[test]
fn all_mistakes_of_all_rules_are_said_at_once() {
    let rules = "metric = \"psnr\"\nat_most = 1\nband_deg = [0, 7]\n[[gate]]\nmetric = \"mse\"\n";
    check(&folder(), &format!("{GOOD}{rules}"))
        .fails(2, &["must begin and end", "the gate on mse has no limit", "2 mistakes"]);
}

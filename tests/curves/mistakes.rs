//! Mistakes in curve files are shown in their place.

use super::files::{RICH, schema_allows};
use crate::fovqa::Folder;

/// A mistake: the line it replaces, the line itself, the words of the message, whether a schema can
/// tell.
type Mistake = (&'static str, &'static str, &'static [&'static str], bool);

pub(super) const GOOD: &str = r#"
name = "good"
[view]
fov_vertical_deg = 110
resolutions = ["1440x1600"]
[[curve]]
name = "A"
method = { model = "rmfr" }
[[curve]]
name = "B"
acuity = { model = "piecewise" }
[[plot]]
kind = "rates"
"#;

const MISTAKES: &[Mistake] = &[
    (
        "kind = \"rates\"",
        "kind = \"density\"\nfigure = { x = { min = 1 }, y = { label = \"rows\" } }",
        &["x.min has no effect on density"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"samples_bars\"\nfigure = { x = { label = \"a\" } }",
        &["x has no effect on samples_bars"],
        false,
    ),
    ("name = \"good\"", "nam = \"good\"", &["did you mean name?"], true),
    (
        "name = \"good\"",
        "name = \"good\"\nstep_deg = 0",
        &["step_deg cannot be 0", "from 0.001 to 60"],
        true,
    ),
    ("name = \"good\"", "name = \"good\"\nacuity = {}", &["acuity has no model"], true),
    ("fov_vertical_deg = 110", "fov_vertical_deg = 180", &["cannot be 180"], true),
    ("fov_vertical_deg = 110", "", &["no view is given", "fov_vertical_deg = 110"], false),
    ("resolutions = [\"1440x1600\"]", "", &["needs a resolution"], false),
    (
        "resolutions = [\"1440x1600\"]",
        "resolutions = [\"0x1600\"]",
        &["cannot be \"0x1600\"", "1 to 100000"],
        true,
    ),
    (
        "resolutions = [\"1440x1600\"]",
        "resolutions = [\"1440x1600\"]\ngazes = [[1]]",
        &["a list of 1"],
        true,
    ),
    (
        "resolutions = [\"1440x1600\"]",
        "resolutions = [\"1440x1600\"]\ntangential = \"round\"",
        &["cannot be \"round\""],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmf\" }",
        &["no method \"rmf\"", "did you mean \"rmfr\"?"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { sigma = 2 }",
        &["has no model", "\"deamp\""],
        true,
    ),
    ("method = { model = \"rmfr\" }", "method = { model = 3 }", &["text in quotes"], true),
    ("method = { model = \"rmfr\" }", "method = \"rmfr\"", &["a table such as"], true),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\", sigma = 0 }",
        &["sigma cannot be 0", "0.1 to 1000"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\", sgma = 2 }",
        &["no parameter `sgma`", "did you mean sigma?"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"vafr\", ratio = [1, 2] }",
        &["ratio"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"vafr\", knots_deg = [0, 9, 5, 30, 60] }",
        &["must start at 0° and increase"],
        false,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"deamp\", sigmas = [2] }",
        &["one of each per layer"],
        false,
    ),
    ("method = { model = \"rmfr\" }", "", &["neither a method nor an acuity model"], false),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\" }\nacuity = { model = \"piecewise\" }",
        &["both a method and an acuity model"],
        false,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\" }\nbudget = 0",
        &["budget cannot be 0"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\" }\nbudget_of = \"buffer\"",
        &["none is given"],
        false,
    ),
    (
        "acuity = { model = \"piecewise\" }",
        "acuity = { model = \"piecewise\", knots_cpd = [40, 5] }",
        &["5 eccentricities and 2 frequencies"],
        false,
    ),
    (
        "acuity = { model = \"piecewise\" }",
        "acuity = { model = \"piecewise\", cap_cpd = \"high\" }",
        &["cap_cpd"],
        true,
    ),
    (
        "acuity = { model = \"piecewise\" }",
        "acuity = { model = \"piecewise\" }\nbudget = 0.1",
        &["budget needs a method"],
        false,
    ),
    ("name = \"B\"", "name = \"A\"", &["\"A\""], false),
    ("kind = \"rates\"", "kind = \"rate\"", &["did you mean \"rates\"?"], true),
    ("kind = \"rates\"", "kind = \"rates\"\ncurves = [\"C\"]", &["there is no curve \"C\""], false),
    (
        "kind = \"rates\"",
        "kind = \"density\"\ncurves = [\"A\"]\nband = true",
        &["band does not apply to a plot of kind"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\ndots = true",
        &["dots does not apply to a plot of kind"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\nstyle = \"contours\"",
        &["style does not apply to a plot of kind"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\nband = true\nareas = true",
        &["either bands or areas"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"density\"\nstyle = \"contours\"\nrings_deg = [10]",
        &["either rings or contours"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\nacuity_scale = \"own\"",
        &["only in samples per pixel"],
        false,
    ),
    ("kind = \"rates\"", "kind = \"outline\"", &["needs a curve of vafr"], false),
    ("kind = \"rates\"", "kind = \"steps\"", &["needs a curve of deamp or guenter"], false),
    (
        "kind = \"rates\"",
        "kind = \"samples\"\ncurves = [\"B\"]",
        &["needs a method with a buffer"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\nf = [2]",
        &["f does not apply to a plot of kind \"rates\""],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\nunit = \"per_pixel\"\nmarks = [{ name = \"a\", at = [1, 2] }]",
        &["marks are in cycles per degree"],
        false,
    ),
    ("kind = \"rates\"", "kind = \"rates\"\nmarks = [{ at = [1, 2] }]", &["has no name"], true),
    ("kind = \"rates\"", "kind = \"half_axis\"", &["needs values of f"], false),
    ("kind = \"rates\"", "kind = \"half_axis\"\nf = [0.5]", &["cannot be 0.5"], true),
    ("kind = \"rates\"", "kind = \"accumulated\"", &["needs a curve of deamp"], false),
    ("kind = \"rates\"", "kind = \"density\"\ncurves = [\"B\"]", &["nothing to show"], false),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\ny_limits = [5, 5]",
        &["is not above its lower end"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\ny_limits = [0, 5]\nlog = true",
        &["cannot include 0"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\n[[table]]\nkind = \"samples\"\ncurves = [\"B\"]",
        &["nothing to show"],
        false,
    ),
    ("kind = \"rates\"", "kind = \"rates\"\n[[scene]]\nname = \"x\"", &["no key `scene`"], true),
    (
        "kind = \"rates\"",
        "kind = \"response\"",
        &["needs eccentricities", "eccentricities_deg = [20, 30]"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"response\"\neccentricities_deg = []",
        &["a list of 0", "1 to 12"],
        true,
    ),
    (
        "kind = \"rates\"",
        "kind = \"response\"\neccentricities_deg = [90]",
        &["cannot be 90", "from 0 to 89"],
        true,
    ),
    (
        "kind = \"rates\"",
        "kind = \"response\"\neccentricities_deg = [30, 80]",
        &["no pixel is 80° from the gaze", "the last one is at 62.5°"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"response\"\neccentricities_deg = [30]\ncurves = [\"A\"]",
        &["curves does not apply to a plot of kind \"response\""],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\nf_max = 1",
        &["f_max does not apply to a plot of kind \"rates\""],
        false,
    ),
    (
        "resolutions = [\"1440x1600\"]",
        "resolutions = [\"1440x1600\", \"720x800\"]\n[[plot]]\nkind = \"response\"\neccentricities_deg = [30]",
        &["shows one screen and gaze"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"",
        &["needs quantity", "needs groups", "needs values"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = []\nvalues = []",
        &["groups cannot be a list of 0"],
        true,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = [\"X\"]\nvalues = []",
        &["needs values"],
        true,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = [\"X\", \"Y\"]\nvalues = [{ name = \"a\", at = [1] }]",
        &["\"a\" has 1 values, but there are 2 groups"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = [\"X\"]\nvalues = [{ name = \"a\", at = [1], error = [1, 2] }]",
        &["\"a\" has 2 errors, but there are 1 groups"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = [\"X\"]\nvalues = [{ name = \"a\", at = [1], error = [-1] }]",
        &["error cannot be -1"],
        true,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = [\"X\", \"X\"]\nvalues = [{ name = \"a\", at = [1, 2] }]",
        &["two groups named \"X\""],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = [\"X\"]\nvalues = [{ name = \"a\", at = [1] }, { name = \"a\", at = [2] }]",
        &["two bars named \"a\""],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = [\"X\"]\nvalues = [{ name = \"a\", at = [1] }]\nsum = true",
        &["a sum needs at least two series"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"values\"\nquantity = \"ms\"\ngroups = [\"X\"]\nvalues = [{ name = \"a\", at = [1] }, { name = \"b\", at = [2] }]\nsum = \"A\"",
        &["the sum and a series are both named \"A\""],
        false,
    ),
];

#[test]
fn every_mistake_is_shown_in_its_place_and_the_schema_agrees() {
    let folder = Folder::new();
    folder.write("e.toml", GOOD);
    folder.run(&["check", "e.toml"]).ok();
    assert!(schema_allows(GOOD) && schema_allows(RICH));
    for (line, instead, words, structural) in MISTAKES {
        assert_eq!(GOOD.matches(line).count(), 1, "{line}");
        let text = GOOD.replace(line, instead);
        folder.write("e.toml", &text);
        let run = folder.run(&["curves", "e.toml"]).fails(2, words);
        assert!(run.stderr.contains("e.toml"), "{}", run.stderr);
        assert_eq!(schema_allows(&text), !structural, "{instead}");
    }
    assert!(!folder.path("reports/good/curves.csv").exists());
}

#[test]
fn sizes_that_figures_cannot_have_are_found_by_check() {
    let folder = Folder::new();
    folder.write("e.toml", GOOD.replace("[[plot]]", "[figures]\nheight_in = 0.5\n[[plot]]"));
    for command in ["check", "curves"] {
        let run = folder.run(&[command, "e.toml"]);
        run.fails(2, &["rates: a height of 0.5 in is too low", "[figures]"]);
    }
    // Pictures keep their own height; a setting that no figure has is named.
    let text = GOOD.replace("[[plot]]", "[figures]\nheight_in = 2.5\n[[plot]]");
    folder.write("e.toml", text.replace("kind = \"rates\"", "kind = \"density\""));
    for command in ["check", "curves"] {
        let run = folder.run(&[command, "e.toml"]).ok();
        run.says(&["height_in in [figures] has no effect on density"]);
    }
}

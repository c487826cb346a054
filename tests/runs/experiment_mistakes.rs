//! Mistakes in experiment files are shown in their place, and the JSON Schema agrees with the parser.

use super::experiment_files::{GOOD, check, folder, schema_allows};

/// A mistake: the line it replaces (or, empty, is put in front of), the line itself, the words of the
/// message, and whether a schema can tell.
type Mistake = (&'static str, &'static str, &'static [&'static str], bool);

const MISTAKES: &[Mistake] = &[
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"ratio_profile\"\nerror_bars = \"se\"",
        &["error_bars does not apply to kind = \"ratio_profile\""],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"crops\"",
        &["the plot has no regions to show"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"crops\"\nregions = [{ name = \"a\", at = [9, 9], size = [4, 4], scene = \"hall\" }]",
        &["there is no scene \"hall\"", "\"room\""],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"crops\"\nregions = [{ name = \"a\", at = [9, 9], size = [4, 4] }, { name = \"a\", at = [8, 8], size = [4, 4] }]",
        &["two different regions are named \"a\""],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"frames\"\nerror_bars = \"sd\"",
        &["error_bars does not apply to kind = \"frames\"", "\"bars\""],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"bars\"\nshape = \"violin\"",
        &["shape does not apply to kind = \"bars\""],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[figures]\nwidth_in = 0",
        &["figures.width_in cannot be 0", "a number from 0.5 to 100"],
        true,
    ),
    ("fpsnr = {}", "fpsnr = {}\n[figures]\nfont_pt = 5", &["a number from 6 to 40"], true),
    ("fpsnr = {}", "fpsnr = {}\n[figures]\npalette = \"okabe\"", &["\"okabe-ito\""], true),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[figures]\npalette = [\"#0072b2\", \"blue\"]",
        &["\"blue\" is not a colour", "red, green and blue"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[figures]\nformats = [\"eps\"]",
        &["\"svg\", \"pdf\", \"png\""],
        true,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[figures]\nheight_in = 2\naspect = 1.5",
        &["height_in and aspect both set the height"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"profile\"\nfigure = { x = { scale = \"log\", min = 0 } }",
        &["a logarithmic axis has no place for 0", "min must be above 0"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[figures]\ny = { min = 40 }\n[[plot]]\nkind = \"profile\"\nfigure = { y = { max = 20 } }",
        &["the y axis would end at 20, before it begins at 40"],
        false,
    ),
    ("", "colour = \"rgb\"", &["no key `colour`", "e.toml:1:1"], true),
    ("", "metric = { psnr = {} }", &["no key `metric`", "did you mean metrics?"], true),
    ("name = \"good\"", "nam = \"good\"", &["did you mean name?", "has no name"], true),
    ("name = \"good\"", "name = 5", &["name cannot be a whole number", "a name in quotes"], true),
    ("name = \"good\"", "name = \"../good\"", &["cannot have /"], true),
    ("name = \"good\"", "schema = 2\nname = \"good\"", &["schema cannot be 2"], true),
    ("fov_vertical_deg = 60", "fov_vertical_deg = 180", &["cannot be 180", "above 0"], true),
    ("fov_vertical_deg = 60", "fov_vertical_deg = \"wide\"", &["cannot be text"], true),
    ("fov_vertical_deg = 60", "fov_vertical_deg = nan", &["cannot be nan"], false),
    (
        "fov_vertical_deg = 60",
        "display = \"vive-pro-ey\"",
        &["did you mean \"vive_pro_eye\"?"],
        true,
    ),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\ndisplay = \"vive-pro-eye\"",
        &["more than one way: display, fov_vertical_deg"],
        false,
    ),
    (
        "fov_vertical_deg = 60",
        "distance_m = 0.5",
        &["distance_m alone does not define a view"],
        false,
    ),
    (
        "fov_vertical_deg = 60",
        "frustum = { left = -1, right = -1, up = 1, down = 1 }",
        &["the frustum tangents must be positive"],
        false,
    ),
    ("fov_vertical_deg = 60", "bands_deg = [0, 10]", &["eccentricity bands needs a view"], false),
    ("fov_vertical_deg = 60", "gaze = [1, 2]", &["a gaze needs a view"], false),
    ("fov_vertical_deg = 60", "", &["fpsnr needs a view, but scene \"room\" has none"], false),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\nbands_deg = [0, 10, 5]",
        &["5 is not above the edge before it, 10"],
        false,
    ),
    ("fov_vertical_deg = 60", "fov_vertical_deg = 60\nbands_deg = [0]", &["a list of 1"], true),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\ngaze = \"centre\"",
        &["did you mean \"center\"?"],
        true,
    ),
    ("fov_vertical_deg = 60", "fov_vertical_deg = 60\ngaze = [1, 2, 3]", &["a list of 3"], true),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\ngaze = {}",
        &["a table without a trace"],
        false,
    ),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\ngaze = { left = [1, 2], right = [1, 2] }",
        &["the scene has one reference"],
        false,
    ),
    ("reference = \"gt\"", "", &["scene \"room\" has neither reference nor builtin"], false),
    ("reference = \"gt\"", "reference = \"gt\"\nfps = 0", &["cannot be 0"], true),
    ("reference = \"gt\"", "reference = \"gt\"\nframes = \"5\"", &["not a range of frames"], true),
    (
        "reference = \"gt\"",
        "reference = \"{scen}\"",
        &["{scen}, which is not a known placeholder"],
        false,
    ),
    ("reference = \"gt\"", "reference = \"{scene\"", &["opens a brace"], false),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\ncrop = [0, 0, 0, 5]",
        &["crop contains no pixels"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nleft = { gaze = [1, 2] }",
        &["no left eye of its own"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = { left = \"gt\", right = \"gt\" }",
        &["two eyes, but method \"A\" has one test", "{eye}"],
        false,
    ),
    ("reference = \"gt\"", "reference = { left = \"gt\" }", &["has no right"], true),
    (
        "test = \"a\"",
        "test = \"{eye}\"",
        &["a test for each eye, but scene \"room\" has one"],
        false,
    ),
    (
        "test = \"a\"",
        "test = \"a\"\nscenes = [\"rom\"]",
        &["no scene \"rom\"", "did you mean \"room\"?"],
        false,
    ),
    ("test = \"a\"", "test = \"a\"\nscenes = []", &["a list of 0"], true),
    ("name = \"B\"", "name = \"A\"", &["two methods named \"A\"", "the second"], false),
    ("name = \"B\"", "name = \"a\"", &["two methods named \"a\""], false),
    ("psnr = {}", "pnsr = {}", &["no metric `pnsr`", "did you mean psnr?"], true),
    ("psnr = {}", "psnr = true", &["metrics.psnr is true or false"], true),
    (
        "psnr = {}",
        "psnr = { peak = 255 }",
        &["psnr has no parameter `peak`", "no parameters"],
        true,
    ),
    ("sigma = 2.0", "sgma = 2.0", &["did you mean sigma?"], true),
    ("sigma = 2.0", "sigma = 0", &["metrics.ssim.sigma cannot be 0", "from 0.1 to 64"], true),
    ("sigma = 2.0", "radius = 2.5", &["metrics.ssim.radius"], true),
    ("fpsnr = {}", "fpsnr = { weight = \"lee2003\" }", &["did you mean \"lee2002\"?"], true),
    (
        "fpsnr = {}",
        "fpsnr = { weight = \"acuity\", knots_cpd = [1] }",
        &["knots_cpd cannot be"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"profiel\"",
        &["did you mean \"profile\"?"],
        true,
    ),
    ("fpsnr = {}", "fpsnr = {}\n[[plot]]\nmetric = \"psnr\"", &["plot has no kind"], true),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"profile\"\nmetric = \"fpsnr\"",
        &["fpsnr has no values per band"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"bars\"\nmetric = \"mse\"",
        &["mse is not scored"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"bars\"\nmethods = [\"C\"]",
        &["no method \"C\""],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[scene]]\nname = \"room\"\nreference = \"gt\"",
        &["two scenes named \"room\""],
        false,
    ),
    ("name = \"B\"", "name = \"Best\"", &["a method cannot be named \"Best\""], false),
    ("name = \"room\"", "name = \"average\"", &["a scene cannot be named"], false),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\nleft = { gaze = [1, 2] }",
        &["no scene has a left eye of its own"],
        false,
    ),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\nleft = { gaze = { left = [1, 2] } }",
        &["has no key `left`"],
        true,
    ),
    ("fov_vertical_deg = 60", "eccentricity = \"planar\"", &["eccentricity needs a view"], false),
    (
        "fpsnr = {}",
        "mse = {}\n[[scene]]\nname = \"hall\"\nreference = \"gt\"\n[[plot]]\nkind = \"bars\"\nscenes = [\"hall\"]\nmethods = [\"C\"]\n[[method]]\nname = \"C\"\ntest = \"a\"\nscenes = [\"room\"]",
        &["none of its methods is in any of its scenes"],
        false,
    ),
    ("fov_vertical_deg = 60", "display = \"VIVE-pro_eye\"", &["did you mean"], true),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\ncrop = [0, 0, 5.5, 5]",
        &["crop cannot be 5.5"],
        true,
    ),
    ("reference = \"gt\"", "reference = \"gt\"\nframes = \"+0..5\"", &["not a range"], true),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[plot]\nkind = \"bars\"",
        &["plot cannot be a table", "[[plot]]"],
        true,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"profile\"\nmetric = \"psnr\"\nlevels = [1]",
        &["levels only applies to the wavelet", "metric = \"haar\""],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"profile\"\nlevels = [1]",
        &["levels only applies to the wavelet"],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = { levels = 3 }\n[[plot]]\nkind = \"profile\"\nmetric = \"haar\"\nlevels = [1, 4]",
        &["level 4 is not scored: the number of levels is 3", "haar = { levels = 4 }"],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"ratios\"\nmetric = \"haar\"\nlevels = [9]",
        &["plot.levels", "9", "from 1 to 8"],
        true,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"table\"\nstatistic = \"energy\"",
        &["statistic only applies to the wavelet"],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"profile\"\nmetric = \"haar\"\nstatistic = \"enrgy\"",
        &["did you mean \"energy\"?"],
        true,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"bars\"\nmetric = \"haar\"",
        &["haar describes each image by eccentricity: draw it as profile or ratios", "psnr"],
        false,
    ),
    (
        "fpsnr = {}",
        "rms_contrast = {}\n[[plot]]\nkind = \"sequence\"\nmetric = \"rms_contrast\"",
        &["rms_contrast describes each image by eccentricity"],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"ratios\"\nmetric = \"ssim\"",
        &["ssim already compares test with reference, and so has no ratio", "haar"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"ratios\"",
        &["nothing to show: no metric that is scored fits its kind"],
        false,
    ),
    ("fpsnr = {}", "haar = { levels = 9 }", &["metrics.haar.levels cannot be 9"], true),
    ("fpsnr = {}", "haar = { levels = 0 }", &["metrics.haar.levels cannot be 0"], true),
    ("fpsnr = {}", "haar = { orientations = \"yes\" }", &["metrics.haar.orientations"], true),
    ("fpsnr = {}", "rms_contrast = { signal = \"lumen\" }", &["metrics.rms_contrast.signal"], true),
    ("fpsnr = {}", "atd = { depth_tolerance = -0.1 }", &["metrics.atd.depth_tolerance"], true),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { preset = \"blender\", channels = [\"u\", \"v\"] }",
        &["both channels and a preset are given", "keep one of them"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\ndepth = { preset = \"blender\", channel = \"Z\" }",
        &["both channel and a preset are given"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], sign = [1, 0.5] }",
        &["a sign must be 1 or -1", "use scale for other factors"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], sign = [1, 2] }",
        &["sign", "from -1 to 1"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], scale = 0 }",
        &["a scale of 0 removes all motion"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], scale = [1, 0.0] }",
        &["a scale of 0 removes all motion"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { sign = [1, -1] }",
        &["sign describes channels, but none are named", "add channels"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { preset = \"falcor\", unit = \"ndc\" }",
        &["unit describes channels, but none are named", "a preset has its own"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], unit = \"pixel\" }",
        &["unit cannot be \"pixel\"", "did you mean \"pixels\"?"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\"] }",
        &["channels", "a list of 1"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = \"blendr\"",
        &["motion cannot be \"blendr\"", "did you mean \"blender\"?"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\ndepth = { preset = \"renderman\" }",
        &["depth.preset cannot be \"renderman\"", "mitsuba"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { file = \"motion\" }",
        &["did you mean files?"],
        true,
    ),
];

fn with(mistake: &Mistake) -> String {
    match mistake {
        ("", line, ..) => format!("{line}{GOOD}"),
        (place, line, ..) => {
            assert!(GOOD.contains(place), "{place}");
            GOOD.replacen(place, line, 1)
        }
    }
}

#[test]
fn every_mistake_is_shown_in_its_place() {
    let folder = folder();
    check(&folder, GOOD).ok();
    for mistake in MISTAKES {
        let run = check(&folder, &with(mistake)).fails(2, mistake.2);
        assert!(run.stderr.contains("e.toml"), "{}", run.stderr);
    }
}

#[test]
fn the_schema_agrees_with_the_parser() {
    assert!(schema_allows(GOOD));
    for mistake @ (_, line, _, structural) in MISTAKES {
        let text = with(mistake);
        // JSON has no such number.
        if !line.contains("nan") {
            assert_eq!(schema_allows(&text), !structural, "{line}");
        }
    }
}

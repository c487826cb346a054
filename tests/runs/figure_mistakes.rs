//! Mistakes in plots and settings of figures are found when the file is checked.

use super::experiment_files::GOOD;
use super::experiment_files::{check, folder};

/// A region of frames, as a file has it.
const REGION: &str = "{ name = \"a\", at = [9, 9], size = [4, 4] }";

#[test]
fn what_a_plot_cannot_show_is_a_mistake() {
    let folder = folder();
    let crops = |rest: &str| format!("[[plot]]\nkind = \"crops\"\n{rest}");
    let hall = "scenes = [\"room\"]\n\
                regions = [{ name = \"a\", at = [9, 9], size = [4, 4], scene = \"hall\" }]\n\
                [[scene]]\nname = \"hall\"\nreference = \"gt\"";
    let bars = |figure: &str| format!("[[plot]]\nkind = \"bars\"\nfigure = {{ {figure} }}");
    for (plot, said) in [
        (crops("regions = []"), ["the plot has no regions to show", "add regions"]),
        (crops(hall), ["the plot does not show the scene \"hall\"", "the plot's scenes"]),
        (
            crops(&format!("metric = \"psnr\"\nregions = [{REGION}]")),
            ["psnr cannot be shown as pictures", "remove it: crops show regions"],
        ),
        (
            crops(&format!("regions = [{REGION}]\nfigure = {{ x = {{ min = 1 }} }}")),
            ["x has no effect on crops", "remove it"],
        ),
        (
            crops(&format!("regions = [{REGION}]\nfigure = {{ height_in = 2 }}")),
            ["height_in has no effect on crops", "set width_in"],
        ),
        (bars("x = { min = 1, label = \"a\" }"), ["x has no effect on bars", "remove it"]),
        (
            "[[plot]]\nkind = \"frames\"\nfigure = { markers = false }".to_owned(),
            ["markers has no effect on frames", "remove it"],
        ),
        (
            "[[plot]]\nkind = \"table\"\nfigure = { width_in = 7 }".to_owned(),
            ["figure has no effect on table, which is a table", "remove it"],
        ),
        (
            "[[plot]]\nkind = \"ratio_profile\"\nmetric = \"psnr\"".to_owned(),
            ["psnr already compares", "none of the scored metrics fits: add one"],
        ),
        (
            "[figures]\nwidth_in = 100".to_owned(),
            ["a side of 100.0 in is too long for PNG", "at most 54.6 in"],
        ),
        (
            bars("width_in = 50, aspect = 0.5"),
            ["a side of 100.0 in is too long for PNG", "formats = [\"pdf\", \"svg\"]"],
        ),
    ] {
        let text = GOOD.replace("fpsnr = {}", &format!("fpsnr = {{}}\n{plot}"));
        assert!(text != GOOD);
        check(&folder, &text).fails(2, &said);
    }
    // Without PNG, a figure may be larger.
    let plot = bars("width_in = 60, formats = [\"pdf\"]");
    check(&folder, &GOOD.replace("fpsnr = {}", &format!("fpsnr = {{}}\n{plot}"))).ok();
}

#[test]
fn help_names_each_word_once() {
    let folder = folder();
    let text = GOOD.replace("reference = \"gt\"", "builtin = \"garden\"");
    let run = check(&folder, &text);
    run.fails(2, &["\"pattern_a\"", "\"csf_chart\""]);
    let run = check(&folder, &text);
    assert!(!run.stderr.contains("pattern-a"), "{}", run.stderr);
}

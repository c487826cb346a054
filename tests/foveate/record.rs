//! What `fovqa foveate` prints.

use serde_json::{Value, json};

use super::frames::{HEIGHT, WIDTH, with_frame, with_sequence};
use crate::fovqa::Folder;

#[test]
fn the_record_names_everything() {
    let folder = with_frame();
    let record = folder.record(
        "a.png o.png --method guenter --set transition-deg=3 --fov-vertical 80 --gaze 20,10.5",
    );
    assert_eq!(record["schema"], "fovqa.foveate/1");
    assert_eq!(record["method"], "guenter");
    assert_eq!(record["parameters"]["transition_deg"], 3.0);
    assert_eq!(record["parameters"]["bounds_deg"].as_array().unwrap().len(), 2);
    let view = &record["view"];
    assert_eq!((&view["width"], &view["height"]), (&json!(WIDTH), &json!(HEIGHT)));
    let focal = HEIGHT as f64 / 2.0 / 40f64.to_radians().tan();
    assert!((view["focal_px"][0].as_f64().unwrap() - focal).abs() < 1e-9);
    assert_eq!(view["gaze_px"], json!([20.0, 10.5]));
    assert_eq!(view["eccentricity"], "planar");
    let frame = &record["frames"][0];
    assert_eq!(
        (&frame["frame"], &frame["input"], &frame["output"]),
        (&json!(0), &json!("a.png"), &json!("o.png"))
    );
    assert_eq!(frame["gaze_px"], json!([20.0, 10.5]));
    assert_eq!(frame["buffers"].as_array().unwrap().len(), 3);
    assert!(frame["samples"].is_u64(), "a whole number: {}", frame["samples"]);
    assert_eq!(frame["samples_beyond"], 0);
    assert!(frame.get("quads").is_none() && record.get("budget").is_none());
}

#[test]
fn counts_have_decimals_only_where_rates_are_continuous() {
    let folder = with_frame();
    let of = |method: &str| {
        let record = folder.record(&format!("a.png o.png --fov-vertical 100 --method {method}"));
        record["frames"][0].clone()
    };
    let cps = of("cps");
    assert!(cps["samples"].is_u64() && cps["quads"].is_u64());
    assert_eq!(cps["buffers"], json!([]));
    assert!(of("cps --set quantise=continuous")["samples"].is_f64());
    assert!(of("linear")["samples"].is_f64());
    assert!(of("visual-polar")["samples"].is_u64());
    let wide = folder.record("a.png o.png --fov-vertical 140 --method vafr")["frames"][0].clone();
    assert!(wide["samples_beyond"].as_u64().unwrap() > 0);
}

#[test]
fn without_a_view_there_is_none_in_the_record() {
    let folder = with_frame();
    let record = folder.record("a.png o.png --method full");
    assert_eq!(record["view"], Value::Null);
    let frame = &record["frames"][0];
    assert_eq!(frame["gaze_px"], json!([WIDTH as f64 / 2.0, HEIGHT as f64 / 2.0]));
    assert_eq!(frame["samples"], WIDTH * HEIGHT);
    assert_eq!(frame["samples_share"], 1.0);
}

#[test]
fn filters_and_enhancement_have_parameters_where_they_are_on() {
    let folder = with_frame();
    let parameters =
        |arguments: &str| folder.record(&format!("a.png o.png {arguments}"))["parameters"].clone();
    let plain = parameters("--method kfr");
    assert!(plain.get("filter.factor").is_none() && plain.get("taa.k").is_none());
    let all = parameters(
        "--method kfr --filter screen --set filter.factor=0.7 --temporal --set taa.alpha_max=0.5 --enhance 1 \
         --set enhance.foveal-deg=7.5 --fov-vertical 60",
    );
    assert_eq!(all["filter.factor"], 0.7);
    assert_eq!((&all["taa.k"], &all["taa.alpha_max"]), (&json!(1.0), &json!(0.5)));
    assert_eq!(all["enhance.foveal_deg"], 7.5);
    let run = folder.foveate("a.png o.png --method kfr --set filter.factor=0.7").ok();
    run.says(&["warning", "filter.factor", "--filter"]);
}

#[test]
fn names_take_either_dash() {
    let folder = with_frame();
    let method = |name: &str, options: &str| {
        let arguments = format!("a.png o.png --fov-vertical 60 --method {name} {options}");
        folder.foveate(&arguments).ok();
        std::fs::read(folder.path("o.png")).unwrap()
    };
    let wanted = method("perceptual-target", "--set rate_arcmin=9");
    assert_eq!(method("perceptual_target", "--set rate-arcmin=9"), wanted);
    let wanted = method("vafr", "--set acuity=linear-mar --budget 0.2 --budget-of on-screen");
    let other = method("vafr", "--set acuity=linear_mar --budget 0.2 --budget-of on_screen");
    assert_eq!(other, wanted);
}

#[test]
fn a_budget_is_met_and_reported() {
    let folder = with_frame();
    let record = folder.record("a.png o.png --method rmfr --budget 0.16");
    let budget = &record["budget"];
    assert_eq!(budget["share"], 0.16);
    assert_eq!((&budget["of"], &budget["parameter"]), (&json!("buffer"), &json!("sigma")));
    assert!((budget["value"].as_f64().unwrap() - 2.5).abs() < 1e-9, "{budget}");
    assert!((budget["ideal_share"].as_f64().unwrap() - 0.16).abs() < 1e-9);
    assert_eq!(record["parameters"]["sigma"], budget["value"]);
    // 48 / 2.5 and 40 / 2.5, rounded.
    let rounded = 19.0 * 16.0 / (48.0 * 40.0);
    assert!((budget["rounded_share"].as_f64().unwrap() - rounded).abs() < 1e-12);
    assert_eq!(record["frames"][0]["samples_share"], budget["rounded_share"]);

    let record = folder.record("a.png o.png --method deamp --budget 0.1");
    assert_eq!(record["budget"]["parameter"], "sigmas");
    assert_eq!(record["parameters"]["sigmas"], record["budget"]["value"]);
    assert_eq!(record["parameters"]["sigmas"].as_array().unwrap().len(), 3);

    let text = folder.foveate("a.png o.png --method rmfr --budget 0.16").ok().stdout;
    for word in ["16.00 %", "15.83 %", "sigma = 2.5"] {
        assert!(text.contains(word), "{text}");
    }
}

/// The solved parameter of each gaze.
#[test]
fn a_budget_is_solved_for_each_gaze() {
    let folder = with_sequence(2);
    folder.write("gaze.csv", "frame,x_px,y_px\n0,24,20\n1,2,3\n");
    let record = folder.record("gt out --method deamp --budget 0.1 --gaze gaze.csv");
    assert!(record["frames"][0].get("budget").is_none());
    let moved = &record["frames"][1]["budget"];
    assert_ne!(moved["value"], record["budget"]["value"]);
    assert!((moved["ideal_share"].as_f64().unwrap() - 0.1).abs() < 1e-8);
}

#[test]
fn text_has_a_row_for_each_change_only() {
    let folder = with_sequence(5);
    let text = folder.foveate("gt out --method deamp").ok().stdout;
    assert!(text.contains("0 to 4"), "{text}");
    assert_eq!(text.lines().filter(|line| line.contains('%')).count(), 1, "{text}");
    folder.write("gaze.csv", "frame,x_px,y_px\n0,24,20\n1,24,20\n2,2,3\n3,24,20\n4,24,20\n");
    let text = folder.foveate("gt out --method deamp --gaze gaze.csv").ok().stdout;
    assert!(text.contains("0 to 1") && text.contains("3 to 4"), "{text}");
    assert_eq!(text.lines().filter(|line| line.contains('%')).count(), 3, "{text}");
}

#[test]
fn list_methods_shows_what_only_emulation_has() {
    let text = Folder::new().run(&["list", "methods"]).ok().stdout;
    for words in [
        "taa (TAA)",
        "stable (",
        "aliased (",
        "perceptual-target (",
        "kfr --filter none|own|buffer|screen",
        "deamp --filter none|own|screen",
        "--set filter.sigma_px=1",
        "--set filter.span=8",
        "--set taa.alpha=0.1",
        "--set enhance.rate_arcmin=2",
    ] {
        assert!(text.contains(words), "{words}");
    }
}

/// What a method finds by itself is named, and gives the same picture when it is given.
#[test]
fn layers_that_were_found_are_named() {
    let folder = with_frame();
    for budget in ["", " --budget 0.3"] {
        let found = format!(
            "a.png found.png --method guenter --set fit=optimised --fov-vertical 90{budget}"
        );
        let record = folder.record(&found);
        let given = |name: &str| record["parameters"][name].to_string().replace(' ', "");
        let [bounds, scales] = ["bounds_deg", "scales"].map(given);
        assert_ne!(scales, "[1.0,2.0,12.35]");
        let given = format!(
            "a.png given.png --method guenter --set bounds_deg={bounds} --set scales={scales} --fov-vertical 90"
        );
        assert_eq!(folder.record(&given)["frames"][0]["samples"], record["frames"][0]["samples"]);
        assert_eq!(folder.frame("found.png"), folder.frame("given.png"));
    }
}

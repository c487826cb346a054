//! Specifications of emulations, and the errors of impossible ones.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use fovqa_emulate::{Budget, EmulationSpec, Emulator, FilterChoice, History, Picture};
use fovqa_frame::{Channels, Frame, Samples, SignalParams, SignalTables};
use fovqa_methods::BudgetSamples;
use fovqa_params::ParamValue;
use fovqa_vision::{View, ViewSpec};

const SIZE: [usize; 2] = [320, 240];
const GAZE: [f64; 2] = [110.0, 140.5];

fn view() -> View {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(90.0) };
    spec.resolve(SIZE[0], SIZE[1]).unwrap().view
}

fn said<T>(result: Result<T, impl ToString>) -> String {
    result.err().map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn errors_say_what_there_is() {
    let error = said(EmulationSpec::new("foo"));
    assert!(
        error.contains("\"foo\"") && error.contains("kfr") && error.contains("perceptual-target")
    );
    let one = ParamValue::Number(1.0);
    let mut rmfr = EmulationSpec::new("rmfr").unwrap();
    assert_eq!(
        said(rmfr.set("alpha", &one)),
        "rmfr has no parameter \"alpha\"; it has sigma, fx, fy"
    );
    assert!(said(rmfr.set("foo.bar", &one)).contains("rmfr has no parameter \"foo.bar\""));
    assert_eq!(
        said(rmfr.set("filter.factor", &one)),
        "rmfr has no parameter \"filter.factor\"; only deamp, kfr, lafr and vafr have filters"
    );
    assert_eq!(
        said(rmfr.set_filters(FilterChoice::Own)),
        "rmfr has no filters of its own; only deamp, kfr, lafr and vafr have filters"
    );
    let mut vafr = EmulationSpec::new("vafr").unwrap();
    assert_eq!(
        said(vafr.set_filters(FilterChoice::Screen)),
        "vafr has no filter `screen`; it has the filter `buffer`"
    );
    assert!(said(vafr.set("filter.factor", &one)).contains("it has span, reduce, minimum"));
    assert!(said(vafr.set("taa.k", &ParamValue::Number(-1.0))).contains("0 to 1000"));
    assert!(said(vafr.set("enhance.f-max", &one)).contains("rate_arcmin"));
    assert!(said(vafr.set_enhance(-1.0)).contains("between 0 and 100"));
    let zero = Budget { share: 0.0, of: BudgetSamples::Buffer };
    assert!(said(vafr.set_budget(zero)).contains("the share of a budget cannot be 0"));
}

#[test]
fn angles_need_a_view() {
    for info in EmulationSpec::methods() {
        let mut spec = EmulationSpec::new(info.key).unwrap();
        let without = ["full", "taa", "rmfr", "deamp", "kfr"].contains(&info.key);
        let made = Emulator::new(&spec, SIZE, None, GAZE);
        assert_eq!(made.is_ok(), without, "{}", info.key);
        spec.set_enhance(1.0).unwrap();
        assert!(said(Emulator::new(&spec, SIZE, None, GAZE)).contains("it needs a view"));
    }
    let spec = EmulationSpec::new("rmfr").unwrap();
    let error = said(Emulator::new(&spec, [100, 100], Some(&view()), GAZE));
    assert_eq!(error, "a view of 320x240 in an emulation of 100x100");
}

#[test]
fn parameters_are_listed_with_what_was_set() {
    let mut spec = EmulationSpec::new("cps").unwrap();
    spec.set("foveal-deg", &ParamValue::Number(7.5)).unwrap();
    spec.set_enhance(1.0).unwrap();
    spec.set_temporal(true);
    let parameters = spec.parameters();
    let value = |name: &str| parameters.iter().find(|(n, _)| n == name).map(|(_, value)| value);
    assert_eq!(value("foveal_deg"), Some(&ParamValue::Number(7.5)));
    assert_eq!(value("enhance.foveal_deg"), Some(&ParamValue::Number(7.5)));
    assert_eq!(value("taa.alpha"), Some(&ParamValue::Number(0.1)));
    assert_eq!(value("filter.factor"), None);
}

#[test]
fn budgets_are_met_before_rounding() {
    for (method, share) in [
        ("rmfr", 0.1),
        ("kfr", 0.07),
        ("lafr", 0.3),
        ("deamp", 0.05),
        ("vafr", 0.8),
        ("guenter", 0.2),
        ("cps", 0.25),
        ("linear", 0.2),
        ("visual-polar", 0.3),
    ] {
        let mut spec = EmulationSpec::new(method).unwrap();
        spec.set_budget(Budget { share, of: BudgetSamples::Buffer }).unwrap();
        let emulator = Emulator::new(&spec, SIZE, Some(&view()), GAZE).unwrap();
        let report = emulator.budget().unwrap();
        assert!((report.ideal_share - share).abs() <= 1e-9, "{method}: {}", report.ideal_share);
        let rounded = emulator.counts().share((SIZE[0] * SIZE[1]) as f64);
        assert!((report.rounded_share - rounded).abs() < 1e-12);
        assert!((rounded / share - 1.0).abs() < 0.06, "{method}: {rounded}");
    }
    let mut spec = EmulationSpec::new("stable").unwrap();
    spec.set_budget(Budget { share: 0.5, of: BudgetSamples::Buffer }).unwrap();
    let error = said(Emulator::new(&spec, SIZE, Some(&view()), GAZE));
    assert_eq!(error, "stable has no parameter that a budget could set");
    let mut spec = EmulationSpec::new("cps").unwrap();
    spec.set_budget(Budget { share: 0.001, of: BudgetSamples::Buffer }).unwrap();
    assert!(said(Emulator::new(&spec, SIZE, Some(&view()), GAZE)).contains("allows"));
}

#[test]
fn history_begins_with_the_first_frame() {
    let gray = |code: u8| {
        let samples = Samples::U8(vec![code; SIZE[0] * SIZE[1]].into());
        let frame = Frame::new(SIZE[0], SIZE[1], Channels::Gray, samples).unwrap();
        Picture::from_frame(&frame, &SignalTables::new(SignalParams::default()))
    };
    let taa = EmulationSpec::new("taa").unwrap();
    let emulator = Emulator::new(&taa, SIZE, None, GAZE).unwrap();
    let mut history = History::default();
    let mut next = |code: u8| emulator.emulate_next(&gray(code), None, &mut history).unwrap();
    assert_eq!(next(40), gray(40));
    // No deviation around any pixel: all of history is clamped away.
    let shown = next(200);
    assert!(
        shown.values().iter().all(|v| (v - 200.0 / 255.0).abs() < 1e-3),
        "{}",
        shown.values()[0]
    );
    let small = Frame::new(2, 2, Channels::Gray, Samples::U8(vec![0; 4].into())).unwrap();
    let small = Picture::from_frame(&small, &SignalTables::new(SignalParams::default()));
    assert_eq!(said(emulator.emulate(&small)), "a picture of 2x2 in an emulation of 320x240");
}

#[test]
fn a_spec_is_written_and_read_again() {
    let mut spec = EmulationSpec::new("kfr").unwrap();
    spec.set("sigma", &ParamValue::Number(0.1 + 2.0)).unwrap();
    spec.set("filter.factor", &ParamValue::Number(0.7)).unwrap();
    spec.set("taa.k", &ParamValue::Number(2.0)).unwrap();
    spec.set_filters(FilterChoice::Buffer).unwrap();
    spec.set_sampling(fovqa_emulate::Sampling::Area);
    spec.set_space(fovqa_emulate::Space::Linear);
    spec.set_temporal(true);
    spec.set_enhance(0.5).unwrap();
    spec.set_budget(Budget { share: 0.2, of: BudgetSamples::OnScreen }).unwrap();
    let json = serde_json::to_string(&spec).unwrap();
    assert_eq!(serde_json::from_str::<EmulationSpec>(&json).unwrap(), spec, "{json}");
    for info in EmulationSpec::methods() {
        let spec = EmulationSpec::new(info.key).unwrap();
        let json = serde_json::to_string(&spec).unwrap();
        assert_eq!(serde_json::from_str::<EmulationSpec>(&json).unwrap(), spec, "{json}");
    }
    for (from, to) in [("kfr", "foo"), ("sigma", "tau"), ("\"buffer\"", "\"none\",\"x\":1")] {
        let wrong = json.replacen(from, to, 1);
        assert!(serde_json::from_str::<EmulationSpec>(&wrong).is_err(), "{wrong}");
    }
}

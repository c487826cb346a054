//! The sandbox changes the contrast of gratings as its formulas say.

use std::f64::consts::PI;

use fovqa_emulate::{EmulationSpec, Emulator, History};
use fovqa_frame::SignalParams;
use fovqa_frame::transfer::srgb;
use fovqa_methods::sandbox::Sandbox;
use fovqa_params::ParamValue;
use fovqa_vision::{View, ViewSpec};

use crate::Light;

/// The gaze is at the left edge, so that the right one is at 35°.
const SIZE: [usize; 2] = [400, 160];
const GAZE: [f64; 2] = [0.0, 80.0];
/// Pixels per degree at the screen's centre.
const PPD: f64 = 10.0;
const CONTRAST: f64 = 0.2;
/// Pixels over which the gain is averaged: whole cells of every grid that is used here.
const CELL: usize = 8;

fn view() -> View {
    let half = (SIZE[1] as f64 / 2.0 / (PPD * 180.0 / PI)).atan().to_degrees();
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(2.0 * half) };
    spec.resolve(SIZE[0], SIZE[1]).unwrap().view
}

/// The part of a grating of level stripes that is left in a cell of a column: the complex response,
/// from a cosine and a sine, averaged over the rows of the cell.
fn gain(spec: &EmulationSpec, x: usize, cpd: f64) -> f64 {
    let emulator = Emulator::new(spec, SIZE, Some(&view()), GAZE).unwrap();
    let per_px = cpd / PPD;
    let phase = |y: f64| 2.0 * PI * per_px * (y - GAZE[1]);
    let column = |wave: fn(f64) -> f64| -> Vec<f64> {
        let scene = Light(|_, y: f64| [srgb::decode(0.5 + CONTRAST * wave(phase(y))) as f32; 3]);
        let (signal, mut history) = (SignalParams::default(), History::default());
        let shown = emulator.emulate_scene(&scene, 0, &signal, None, &mut history).unwrap();
        let value = |y: usize| f64::from(shown.values()[(y * SIZE[0] + x) * 3]);
        (0..SIZE[1]).map(|y| (value(y) - 0.5) / CONTRAST).collect()
    };
    let (cosine, sine) = (column(f64::cos), column(f64::sin));
    let middle = SIZE[1] / 2;
    let (mut real, mut imaginary) = (0.0, 0.0);
    for y in middle - CELL..middle + CELL {
        let at = phase(y as f64 + 0.5);
        real += cosine[y] * at.cos() + sine[y] * at.sin();
        imaginary += sine[y] * at.cos() - cosine[y] * at.sin();
    }
    real.hypot(imaginary) / (2 * CELL) as f64
}

/// What the stack of blurs leaves, which blends Gaussians of fixed widths linearly in their variance.
fn stacked(width_px: f64, cpd: f64) -> f64 {
    let variance = width_px * width_px;
    let below = 0.25 * (variance / 0.25).log2().floor().exp2();
    let weight = (variance - below) / below;
    let gain = |variance: f64| (-2.0 * variance * (PI * cpd / PPD).powi(2)).exp();
    (1.0 - weight) * gain(below) + weight * gain(2.0 * below)
}

/// The gains of the stack: blurred, and then enhanced.
fn of_stack(sandbox: &Sandbox, e: f64, cpd: f64) -> [f64; 2] {
    let width_px = sandbox.width_deg(e) * PPD;
    let restored = 1.0 - stacked(2.0 * width_px, cpd);
    let blurred = stacked(width_px, cpd);
    [blurred, blurred * (1.0 + sandbox.strength(e) * restored)]
}

#[test]
fn gains_of_gratings_are_those_of_the_formulas() {
    // At 27° σ is 4 pixels, a level of the stack of blurs and a grid; at 32° it is 5.67 pixels, next to
    // a level and half way between two grids; at 29.5° it is between two of either.
    let sandbox = Sandbox::default();
    for (eccentricity_deg, off) in
        [(27.0f64, [0.01, 0.01]), (32.0, [0.01, 0.01]), (29.5, [0.032, 0.064])]
    {
        let x = (PPD * 180.0 / PI * eccentricity_deg.to_radians().tan()) as usize;
        let e = ((x as f64 + 0.5) / (PPD * 180.0 / PI)).atan().to_degrees();
        assert!((e - eccentricity_deg).abs() < 0.1);
        for cpd in [0.1, 0.2, 0.35, 0.5, 0.6] {
            let near = |method: &str, want: f64, off: f64| {
                let found = gain(&EmulationSpec::new(method).unwrap(), x, cpd);
                assert!((found - want).abs() < off, "{method}, {e}°, {cpd}: {found} {want}");
            };
            near("stable", sandbox.stable_gain(e, cpd), off[0]);
            near("perceptual_target", sandbox.perceptual_target_gain(e, cpd), off[1]);
            near("aliased", sandbox.aliased_gain(e, cpd, PPD), 0.01);
            // What is left of the difference between levels is the stack.
            let [blurred, restored] = of_stack(&sandbox, e, cpd);
            near("stable", blurred, 0.005);
            near("perceptual_target", restored, 0.005);
        }
    }
    // The parameters reach both.
    let strong = Sandbox { rate_arcmin: 1.0, foveal_deg: 7.5, f_max: 3.0, transition_deg: 10.0 };
    let mut spec = EmulationSpec::new("perceptual_target").unwrap();
    let set = [("rate_arcmin", 1.0), ("foveal_deg", 7.5), ("f_max", 3.0), ("transition_deg", 10.0)];
    for (name, value) in set {
        spec.set(name, &ParamValue::Number(value)).unwrap();
    }
    let e = (341.5 / (PPD * 180.0 / PI)).atan().to_degrees();
    let (found, want) = (gain(&spec, 341, 0.3), strong.perceptual_target_gain(e, 0.3));
    assert!(want > 1.2 && (found - want).abs() < 0.02, "{found} {want}");
}

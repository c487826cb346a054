//! Compares the sensitivity tables with the closed formula behind them: spatio-chromatic
//! sensitivity (Wuerger et al. 2020, fit of 16 September 2020), spatio-velocity (Laird et al. 2006)
//! and cortical magnification (Dougherty et al. 2003), combined as in FovVideoVDP (equations 7 to
//! 11).

use std::f64::consts::PI;

use super::oracle::{NODES, Table};
use super::*;

/// The largest difference between tables and formula in log2, and a bound of the median. The tables
/// were computed in `f32`, in which a factor near 1e-3 of each luminance is the difference of two
/// numbers near 1.
const LARGEST: f64 = 6.95e-4;
const MEDIAN: f64 = 3e-5;

/// One mechanism: the parameters of its peak and bandwidth for a mean of L + M.
struct Mechanism {
    largest: f64,
    peak_cpd: f64,
    bandwidth: f64,
    gamma: f64,
    critical_area: f64,
    low_pass: bool,
}

impl Mechanism {
    fn all(lum: f64) -> [Self; 3] {
        let rising = |gain: f64, half: f64, power: f64| gain * (1.0 + half / lum).powf(-power);
        // 1 - (1 + x)^-p for a tiny p, without cancellation.
        let bright = -f64::exp_m1(-7.779_19e-5 * f64::ln_1p(895_943.0 / lum));
        [
            Self {
                largest: rising(356_404.0, 6.2726, 0.320_031) * bright,
                peak_cpd: rising(2.3021, 3317.45, 0.186_215),
                bandwidth: 1.075_16,
                gamma: 1.1107,
                critical_area: 52.9768,
                low_pass: false,
            },
            Self {
                largest: rising(423.978, 15.4032, 0.503_43),
                peak_cpd: 0.122_699,
                bandwidth: 2.706_69,
                gamma: 1.729_03,
                critical_area: 1.384_37,
                low_pass: true,
            },
            Self {
                largest: rising(11_811.9, 196.342, 0.339_396),
                peak_cpd: 7.1099e-8,
                bandwidth: 5.3416,
                gamma: 1.472_63,
                critical_area: 0.282_573,
                low_pass: true,
            },
        ]
    }

    fn sensitivity(&self, cpd: f64, area: f64) -> f64 {
        let peak = if self.low_pass && cpd < self.peak_cpd {
            self.largest
        } else {
            let decades = cpd.log10() - self.peak_cpd.log10();
            self.largest * 10f64.powf(-decades * decades / (0.5 * self.bandwidth.exp2()))
        };
        let seen = area.powf(self.gamma) * cpd * cpd;
        peak * (seen / (self.critical_area + 0.65 * area + seen)).sqrt()
    }
}

/// The sensitivity to a velocity.
fn velocity_sensitivity(cpd: f64, hz: f64) -> f64 {
    let v = (hz / cpd).max(0.1);
    let k = 6.1 + 7.3 * (0.7986 * v / 3.0).log10().abs().powi(3);
    let highest = 45.9 / (0.7986 * v + 2.0);
    let rising = (0.8404 * 2.0 * PI * cpd).powi(2);
    k * 0.6329 * 0.8404 * 0.7986 * v * rising * (-0.8404 * 4.0 * PI * cpd / highest).exp()
}

/// log2 of the sensitivity, without the calibration's correction.
fn log2_formula(channel: usize, rho_cpd: f64, luminance_cd_m2: f64, ecc_deg: f64) -> f64 {
    const TO_LMS: [[f64; 3]; 3] = [
        [0.187_596_268_556_126, 0.585_168_649_077_728, -0.026_384_263_306_304],
        [-0.133_397_430_663_221, 0.405_505_777_260_049, 0.034_502_127_690_364],
        [0.000_244_379_021_663, -0.000_542_995_890_619, 0.019_406_849_066_323],
    ];
    const WHITE: [f64; 3] = [0.9504, 1.0, 1.0888];
    const CONES: [f64; 3] = [0.698, 0.302, 0.019_613];
    const MECHANISMS: [[f64; 3]; 3] = [
        [1.0, 0.256_197, 6.424_77e-7],
        [1.0, -0.933_541, 0.003_733_04],
        [-0.001_303_19, -1.1504, 1.0],
    ];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

    let magnified = (3.67 / (ecc_deg + 3.67)).powf(0.604_562);
    let area = PI * (1.5 / rho_cpd * magnified).powi(2);
    let cpd = rho_cpd / magnified;
    let hz = [0.0, 5.0][channel];
    let temporal = velocity_sensitivity(cpd, hz) / (velocity_sensitivity(cpd, 0.0) + 1e-5);
    let lms = TO_LMS.map(|row| luminance_cd_m2 * dot(row, WHITE));
    let contrast: [f64; 3] = std::array::from_fn(|i| CONES[i] / lms[i]);
    let mechanisms = Mechanism::all(lms[0] + lms[1]);
    let seen = mechanisms
        .iter()
        .zip(MECHANISMS)
        .map(|(mechanism, row)| dot(row, contrast).abs() * mechanism.sensitivity(cpd, area));
    let threshold = seen.map(|one| one * one).sum::<f64>().sqrt();
    let spatial = threshold * 3f64.sqrt() / dot(contrast, contrast).sqrt();
    (spatial * temporal).max(1e-4).log2()
}

fn from_formula(channel: usize) -> Table {
    Table::of(|y, rho, ecc| {
        log2_formula(channel, Table::rho_cpd(rho), Table::cd_m2(y), Table::deg(ecc))
    })
}

#[test]
fn the_tables_are_the_formula_at_their_nodes() {
    let mut off: Vec<f64> = Vec::new();
    for channel in [0, 1] {
        let (table, formula) = (Table::embedded(channel), from_formula(channel));
        off.extend(table.log2.iter().zip(&formula.log2).map(|(a, b)| (a - b).abs()));
    }
    off.sort_by(f64::total_cmp);
    assert_eq!(off.len(), 2 * NODES * NODES * NODES);
    assert!(off[off.len() - 1] <= LARGEST, "{:e}", off[off.len() - 1]);
    assert!(off[off.len() / 2] <= MEDIAN, "{:e}", off[off.len() / 2]);
}

/// Points inside the tables and beyond all of their ends.
fn points() -> impl Iterator<Item = [f64; 3]> {
    let mut random = Xorshift::new(11);
    (0..3000).map(move |_| {
        let mut between = |from: f64, to: f64| from + (to - from) * random.next_unit();
        [between(-5.0, 7.0).exp2(), 10f64.powf(between(-3.5, 4.5)), between(0.0, 12.0).powi(2)]
    })
}

#[test]
fn a_table_of_the_formula_gives_the_same_sensitivities() {
    for channel in [0, 1] {
        let table = from_formula(channel);
        let correction = 16.2596 / 20.0 * 10f64.log2();
        for [rho, luminance, ecc] in points() {
            let found = sensitivity(channel, rho, luminance, ecc).log2() - correction;
            let wanted = table.interpolated(rho, luminance, ecc);
            // 1e-5 is added for coordinates in `f32`.
            let off = (found - wanted).abs();
            assert!(off <= LARGEST + 1e-5, "{channel}, {rho} cpd, {luminance}, {ecc}°: {off:e}");
        }
    }
}

#[test]
fn between_the_nodes_and_beyond_the_ends_sensitivity_is_trilinear() {
    for channel in [0, 1] {
        let table = Table::embedded(channel);
        let correction = 16.2596 / 20.0 * 10f64.log2();
        for [rho, luminance, ecc] in points() {
            let found = sensitivity(channel, rho, luminance, ecc).log2() - correction;
            let wanted = table.interpolated(rho, luminance, ecc);
            let what = format!("{channel}, {rho} cpd, {luminance} cd/m², {ecc}°");
            assert_near(&what, [found], [wanted], [0.0, 2e-5]);
        }
    }
}

//! FPSNR, the foveal PSNR (Lee, Pattichis, Bovik 2002; weights after Geisler and Perry 1998).
//!
//! FMSE = Σ f(x)² d(x)² / Σ f(x)², d² the squared error (mean over channels), FPSNR = -10 log10
//! FMSE dB. f = min(f_c(e), f_d) is the highest frequency that is both visible at eccentricity e
//! and shown by the display: f_d is its Nyquist frequency at the principal point. The papers print
//! no constants, so only their order of methods can be reproduced, not their absolute values.
//! Higher is better.

use std::ops::Range;

use fovqa_frame::{BLOCK_ROWS, map_row_blocks};
use fovqa_vision::Eccentricity;
use fovqa_vision::acuity::{GeislerPerry, LinearMar, PiecewiseMar};
use multiversion::multiversion;

use fovqa_params::{ParamError, ParamInfo, ParamValue, ParamValues};

use crate::info::{Demand, MetricInfo, Needs};
use crate::metric_params::MetricParams;
use crate::pooling::{Pooling, Statistic};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "fpsnr",
    label: "FPSNR",
    unit: "dB",
    needs: Needs { view: true, foveal_weight: Demand::Needs, ..Needs::NOTHING },
    statistics: &[Statistic::VALUE.over_eyes(Pooling::Decibels).over_frames(Pooling::Decibels)],
    about: "PSNR weighted by the square of the visible cut-off frequency; values can be compared between methods, not with papers",
    source: "Lee, Pattichis, Bovik 2002; weights after Geisler and Perry 1998",
    params: &[
        ParamInfo {
            name: "weight",
            default: "\"lee2002\"",
            values: ParamValues::Word(&["lee2002", "acuity"]),
            about: "weighting curve (also for FSSIM)",
        },
        ParamInfo {
            name: "alpha",
            default: "0.106",
            values: ParamValues::Number(1e-3, 10.0),
            about: "lee2002: decay of contrast sensitivity",
        },
        ParamInfo {
            name: "e2_deg",
            default: "2.3",
            values: ParamValues::Number(0.01, 180.0),
            about: "lee2002: half-resolution eccentricity, °",
        },
        ParamInfo {
            name: "ct0",
            default: "0.015625",
            values: ParamValues::Number(1e-6, 0.99),
            about: "lee2002: smallest contrast threshold",
        },
        ParamInfo {
            name: "acuity",
            default: "\"piecewise\"",
            values: ParamValues::Word(&["piecewise", "linear_mar"]),
            about: "acuity: the acuity model",
        },
        ParamInfo {
            name: "knots_deg",
            default: "[0, 10, 20, 30, 60]",
            values: ParamValues::Numbers,
            about: "piecewise: eccentricities, °, increasing from 0",
        },
        ParamInfo {
            name: "knots_cpd",
            default: "[40, 10, 6, 5, 4]",
            values: ParamValues::Numbers,
            about: "piecewise: acuity at these eccentricities, cpd, 0.01 to 1000",
        },
        ParamInfo {
            name: "m",
            default: "0.0275",
            values: ParamValues::Number(0.0, 10.0),
            about: "linear_mar: slope, ° per °",
        },
        ParamInfo {
            name: "omega0_deg",
            default: "0.020833333333333332",
            values: ParamValues::Number(1e-4, 10.0),
            about: "linear_mar: angle of one cycle at the fovea, °",
        },
    ],
    ..MetricInfo::FIDELITY
};

/// The curve that the weight follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Weight {
    /// The cut-off frequency of Geisler and Perry.
    #[default]
    Lee2002,
    /// An acuity model.
    Acuity,
}

/// The acuity model of the weight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AcuityModel {
    /// [`PiecewiseMar`].
    #[default]
    Piecewise,
    /// [`LinearMar`].
    LinearMar,
}

/// Parameters of the foveal weight.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// The curve that the weight follows.
    pub weight: Weight,
    /// Constants of the curve `lee2002`.
    pub lee2002: GeislerPerry,
    /// The model of the curve `acuity`.
    pub acuity: AcuityModel,
    /// Eccentricities of the piecewise model, in degrees.
    pub knots_deg: Vec<f64>,
    /// Acuity at these eccentricities, in cycles per degree.
    pub knots_cpd: Vec<f64>,
    /// Constants of the linear model.
    pub linear_mar: LinearMar,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            weight: Weight::default(),
            lee2002: GeislerPerry::default(),
            acuity: AcuityModel::default(),
            knots_deg: vec![0.0, 10.0, 20.0, 30.0, 60.0],
            knots_cpd: vec![40.0, 10.0, 6.0, 5.0, 4.0],
            linear_mar: LinearMar::default(),
        }
    }
}

impl MetricParams for Params {
    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "weight" => {
                self.weight = match value.text()? {
                    "lee2002" => Weight::Lee2002,
                    "acuity" => Weight::Acuity,
                    _ => return None,
                }
            }
            "alpha" => self.lee2002.alpha = value.number()?,
            "e2_deg" => self.lee2002.e2_deg = value.number()?,
            "ct0" => self.lee2002.ct0 = value.number()?,
            "acuity" => {
                self.acuity = match value.text()? {
                    "piecewise" => AcuityModel::Piecewise,
                    "linear_mar" => AcuityModel::LinearMar,
                    _ => return None,
                }
            }
            "knots_deg" => self.knots_deg = value.list()?,
            "knots_cpd" => self.knots_cpd = value.list()?,
            "m" => self.linear_mar.m = value.number()?,
            "omega0_deg" => self.linear_mar.omega0_deg = value.number()?,
            _ => return None,
        }
        Some(())
    }

    /// Checks that the knots are a falling curve of acuity.
    fn check(&self) -> Result<(), ParamError> {
        let wrong = |expected: String| ParamError::Value {
            owner: INFO.key,
            param: "knots_cpd",
            value: format!("{:?} at {:?}", self.knots_cpd, self.knots_deg),
            expected,
        };
        if self.knots_cpd.iter().any(|f| !(0.01..=1000.0).contains(f)) {
            return Err(wrong("acuity must be between 0.01 and 1000 cycles per degree".to_owned()));
        }
        let curve = PiecewiseMar::new(&self.knots_deg, &self.knots_cpd);
        curve.map(|_| ()).map_err(|error| wrong(error.to_string()))
    }
}

impl Params {
    /// Degrees per cycle, 1 / f_c, as a function of eccentricity.
    fn degrees_per_cycle(&self) -> impl Fn(f64) -> f64 {
        let piecewise = PiecewiseMar::new(&self.knots_deg, &self.knots_cpd).unwrap_or_default();
        let (lee2002, linear, weight, acuity) =
            (self.lee2002, self.linear_mar, self.weight, self.acuity);
        move |e| {
            1.0 / match (weight, acuity) {
                (Weight::Lee2002, _) => lee2002.cutoff_cpd(e),
                (Weight::Acuity, AcuityModel::Piecewise) => piecewise.cutoff_cpd(e),
                (Weight::Acuity, AcuityModel::LinearMar) => linear.cutoff_cpd(e),
            }
        }
    }
}

/// The weight f² of every pixel, for a view and a gaze.
#[derive(Debug, Clone)]
pub struct WeightField {
    eccentricity: Eccentricity,
    curve: Curve,
    /// The weights in blocks of rows, if they were computed in advance.
    rows: Option<Vec<Vec<f32>>>,
}

/// f² as a function of eccentricity.
#[derive(Debug, Clone)]
struct Curve {
    degrees_per_cycle: DegreesPerCycle,
    /// f_d², the largest weight.
    limit: f32,
}

/// 1/f_c as a function of eccentricity.
#[derive(Debug, Clone)]
enum DegreesPerCycle {
    /// The value at 0° and the slope.
    Line(f32, f32),
    /// The values at steps of eccentricity.
    Table(Vec<f32>),
}

const STEPS_PER_DEGREE: f32 = 32.0;
const LAST_DEGREE: usize = 180;

impl Curve {
    fn new(params: &Params, nyquist_cpd: f64) -> Self {
        let at = params.degrees_per_cycle();
        let piecewise = params.weight == Weight::Acuity && params.acuity == AcuityModel::Piecewise;
        let degrees_per_cycle = if piecewise {
            // One more step than degrees, for the interpolation that ends there.
            let steps = LAST_DEGREE * STEPS_PER_DEGREE as usize + 1;
            let step = |i: usize| at(i as f64 / f64::from(STEPS_PER_DEGREE)) as f32;
            DegreesPerCycle::Table((0..=steps).map(step).collect())
        } else {
            DegreesPerCycle::Line(at(0.0) as f32, (at(1.0) - at(0.0)) as f32)
        };
        Self { degrees_per_cycle, limit: (nyquist_cpd * nyquist_cpd) as f32 }
    }

    /// Replaces eccentricities in degrees by f².
    fn to_weights(&self, row: &mut [f32]) {
        match &self.degrees_per_cycle {
            DegreesPerCycle::Line(at_0, slope) => weigh_line(*at_0, *slope, self.limit, row),
            DegreesPerCycle::Table(table) => weigh_table(table, self.limit, row),
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn weigh_line(at_0: f32, slope: f32, limit: f32, row: &mut [f32]) {
    for value in row {
        let f = 1.0 / (at_0 + slope * *value);
        *value = (f * f).min(limit);
    }
}

fn weigh_table(table: &[f32], limit: f32, row: &mut [f32]) {
    for value in row {
        let at = *value * STEPS_PER_DEGREE;
        let index = (at as usize).min(table.len() - 2);
        let (from, to) = (table[index], table[index + 1]);
        let f = 1.0 / (from + (to - from) * (at - index as f32));
        *value = (f * f).min(limit);
    }
}

impl WeightField {
    /// The weight of every pixel, computed row by row when it is asked for. Knots that do not make
    /// a curve, which [`crate::Params::check`] refuses, are replaced by the default ones.
    pub fn new(eccentricity: Eccentricity, params: &Params) -> Self {
        let curve = Curve::new(params, eccentricity.view().nyquist_cpd());
        Self { eccentricity, curve, rows: None }
    }

    /// The memory it takes, in bytes.
    pub fn bytes(&self) -> usize {
        let rows = self.rows.iter().flatten();
        size_of::<Self>() + rows.map(|row| size_of_val(row.as_slice())).sum::<usize>()
    }

    /// Whether f is the display's Nyquist frequency in the whole frame, so that FPSNR equals PSNR.
    pub fn is_flat(&self) -> bool {
        let mut farthest = [self.eccentricity.max_deg() as f32];
        self.curve.to_weights(&mut farthest);
        farthest[0] >= self.curve.limit
    }

    /// Computes all weights in advance, for views that serve many frames. This takes four bytes per
    /// pixel.
    #[must_use]
    pub fn precomputed(self) -> Self {
        let (width, height) = (self.eccentricity.view().width, self.eccentricity.view().height);
        let rows = map_row_blocks(height, |rows| {
            let mut block = vec![0.0; rows.len() * width];
            for (y, row) in rows.zip(block.chunks_exact_mut(width)) {
                self.compute(y, 0..width, row);
            }
            block
        });
        Self { rows: Some(rows), ..self }
    }

    fn compute(&self, y: usize, xs: Range<usize>, out: &mut [f32]) {
        self.eccentricity.fill_row_deg(y, xs, out);
        self.curve.to_weights(out);
    }

    /// Writes f² of the pixels `xs` of row `y`.
    pub(crate) fn fill_row(&self, y: usize, xs: Range<usize>, out: &mut [f32]) {
        match &self.rows {
            Some(blocks) => {
                let start = y % BLOCK_ROWS * self.eccentricity.view().width;
                out.copy_from_slice(&blocks[y / BLOCK_ROWS][start + xs.start..start + xs.end]);
            }
            None => self.compute(y, xs, out),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fovqa_vision::{EccentricityKind, ViewSpec};

    #[test]
    fn weights_are_the_square_of_the_lower_frequency() {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(100.0) };
        let view = spec.resolve(200, 160).unwrap().view;
        let e = Eccentricity::new(view, [31.25, 70.5], EccentricityKind::Angular);
        let acuity = Params { weight: Weight::Acuity, ..Params::default() };
        let linear = Params { acuity: AcuityModel::LinearMar, ..acuity.clone() };
        for params in [Params::default(), acuity, linear] {
            let field = WeightField::new(e, &params);
            let cached = field.clone().precomputed();
            let cutoff = params.degrees_per_cycle();
            let (mut row, mut other) = (vec![0.0; 190], vec![0.0; 190]);
            for y in 0..160 {
                field.fill_row(y, 10..200, &mut row);
                cached.fill_row(y, 10..200, &mut other);
                assert_eq!(row, other);
                for (x, w) in (10..200).zip(&row) {
                    let f = (1.0 / cutoff(e.at_deg(x as f64 + 0.5, y as f64 + 0.5)))
                        .min(view.nyquist_cpd());
                    assert!(
                        (f64::from(*w) / (f * f) - 1.0).abs() < 3e-5,
                        "({x}, {y}): {w} for {}",
                        f * f
                    );
                }
            }
        }
    }
}

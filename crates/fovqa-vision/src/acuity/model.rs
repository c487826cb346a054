//! The registry of acuity models.

use fovqa_params::{ParamError, ParamInfo, ParamValue, ParamValues, find};

use super::{AcuityCurve, GeislerPerry, LinearMar, PiecewiseMarError, PiecewiseParams};

/// An acuity model with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum AcuityModel {
    /// A minimum angle of resolution that is piecewise linear over eccentricity.
    Piecewise(PiecewiseParams),
    /// A linear minimum angle of resolution.
    LinearMar(LinearMar),
    /// The cut-off of Geisler and Perry.
    GeislerPerry(GeislerPerry),
}

/// The description of an acuity model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AcuityInfo {
    /// The name in results and on the command line, where `-` may replace `_`.
    pub key: &'static str,
    /// The name in tables and figures.
    pub label: &'static str,
    /// A description in one line.
    pub about: &'static str,
    /// The publication that defines it.
    pub source: &'static str,
    /// Its parameters.
    pub params: &'static [ParamInfo],
}

impl Default for AcuityModel {
    fn default() -> Self {
        Self::Piecewise(PiecewiseParams::default())
    }
}

impl AcuityModel {
    /// All models, with their default parameters.
    pub fn all() -> [AcuityModel; 3] {
        [
            Self::Piecewise(PiecewiseParams::default()),
            Self::LinearMar(LinearMar::default()),
            Self::GeislerPerry(GeislerPerry::default()),
        ]
    }

    /// The model of a name, with its default parameters; `-` and `_` are alike.
    pub fn find(name: &str) -> Option<AcuityModel> {
        let name = name.replace('-', "_").to_lowercase();
        Self::all().into_iter().find(|model| model.info().key == name)
    }

    /// The description of this model.
    pub fn info(&self) -> &'static AcuityInfo {
        match self {
            Self::Piecewise(_) => &PIECEWISE,
            Self::LinearMar(_) => &LINEAR_MAR,
            Self::GeislerPerry(_) => &GEISLER_PERRY,
        }
    }

    /// Sets one parameter.
    ///
    /// # Errors
    /// When the model has no such parameter, or the parameter does not accept the value.
    pub fn set(&mut self, param: &str, value: &ParamValue) -> Result<(), ParamError> {
        let info = self.info();
        let (known, value) = find(info.key, info.params, param, value)?;
        let set = match self {
            Self::Piecewise(params) => params.set(known.name, &value),
            Self::LinearMar(model) => model.set(known.name, &value),
            Self::GeislerPerry(model) => model.set(known.name, &value),
        };
        set.ok_or_else(|| known.value_error(info.key, &value))
    }

    /// The acuity curve of the model.
    ///
    /// # Errors
    /// When the knots do not make a curve.
    pub fn curve(&self) -> Result<AcuityCurve, PiecewiseMarError> {
        match self {
            Self::Piecewise(params) => params.curve(),
            Self::LinearMar(model) => Ok(AcuityCurve::through(&[(0.0, model.omega0_deg)], model.m)),
            Self::GeislerPerry(model) => {
                let numerator = model.numerator();
                Ok(AcuityCurve::through(&[(0.0, model.e2_deg / numerator)], 1.0 / numerator))
            }
        }
    }
}

/// Frequencies of any eye and device, in cycles per degree.
pub(super) const CPD: std::ops::RangeInclusive<f64> = 0.01..=1000.0;

const PIECEWISE: AcuityInfo = AcuityInfo {
    key: "piecewise",
    label: "Piecewise MAR",
    about: "1/f is linear between knots and continues with the last slope",
    source: "VaFR (Zhang, Gai, Li), Eq. 12",
    params: &[
        ParamInfo {
            name: "knots_deg",
            default: "[0, 10, 20, 30, 60]",
            values: ParamValues::Numbers,
            about: "eccentricities of the knots, °, increasing from 0",
        },
        ParamInfo {
            name: "knots_cpd",
            default: "[40, 10, 6, 5, 4]",
            values: ParamValues::Numbers,
            about: "acuity at the knots, cycles per degree, 0.01 to 1000",
        },
        ParamInfo {
            name: "cap_cpd",
            default: "\"none\"",
            values: ParamValues::NumberOr(*CPD.start(), *CPD.end(), "none"),
            about: "highest frequency that a device shows, cycles per degree (9: Vive Pro Eye)",
        },
    ],
};

const LINEAR_MAR: AcuityInfo = AcuityInfo {
    key: "linear_mar",
    label: "Linear MAR",
    about: "1/f = m e + ω₀",
    source: "Guenter et al. 2012; VaFR, Eq. 2",
    params: &[
        ParamInfo {
            name: "m",
            default: "0.0275",
            values: ParamValues::Number(0.0, 1.0),
            about: "slope, ° per ° (conservative: 0.022)",
        },
        ParamInfo {
            name: "omega0_deg",
            default: "0.020833333333333332",
            values: ParamValues::Number(1e-3, 10.0),
            about: "angle of one cycle at the gaze, ° (1/48)",
        },
    ],
};

const GEISLER_PERRY: AcuityInfo = AcuityInfo {
    key: "geisler_perry",
    label: "Geisler-Perry cut-off",
    about: "f_c = e₂ ln(1/CT₀) / (α (e + e₂))",
    source: "Geisler and Perry 1998; Lee, Pattichis, Bovik 2002",
    params: &[
        ParamInfo {
            name: "alpha",
            default: "0.106",
            values: ParamValues::Number(1e-3, 10.0),
            about: "spatial-frequency decay constant",
        },
        ParamInfo {
            name: "e2_deg",
            default: "2.3",
            values: ParamValues::Number(1e-2, 100.0),
            about: "half-resolution eccentricity, °",
        },
        ParamInfo {
            name: "ct0",
            default: "0.015625",
            values: ParamValues::Number(1e-6, 0.999),
            about: "smallest contrast threshold (1/64)",
        },
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_default_is_the_default() {
        for model in AcuityModel::all() {
            for info in model.info().params {
                let mut set = model.clone();
                set.set(info.name, &info.default_value()).unwrap();
                assert_eq!(set, model, "{}.{}", model.info().key, info.name);
            }
        }
    }

    #[test]
    fn curves_are_their_models() {
        let (linear, cut_off) = (LinearMar::default(), GeislerPerry::default());
        let curve = |model: AcuityModel| model.curve().unwrap();
        for e in [0.0, 0.3, 7.0, 33.0, 80.0] {
            let pairs = [
                (curve(AcuityModel::LinearMar(linear)).cutoff_cpd(e), linear.cutoff_cpd(e)),
                (curve(AcuityModel::GeislerPerry(cut_off)).cutoff_cpd(e), cut_off.cutoff_cpd(e)),
                (
                    curve(AcuityModel::default()).cutoff_cpd(e),
                    super::super::PiecewiseMar::default().cutoff_cpd(e),
                ),
            ];
            for (found, want) in pairs {
                assert!((found / want - 1.0).abs() < 1e-12, "{e}: {found} for {want}");
            }
        }
    }

    /// Parameters are set by name, and the curve agrees with the printed formulas.
    #[test]
    fn parameters_make_the_curve() {
        let with = |name: &str, params: &[(&str, f64)]| {
            let mut model = AcuityModel::find(name).unwrap();
            for (param, value) in params {
                model.set(param, &ParamValue::Number(*value)).unwrap();
            }
            model
        };
        for e in [0.0, 0.3, 7.0, 33.0, 80.0] {
            let linear = with("linear-mar", &[("m", 0.022), ("omega0_deg", 0.03)]);
            let cut_off = with("Geisler_Perry", &[("alpha", 0.12), ("e2_deg", 3.1), ("ct0", 0.02)]);
            let capped = with("piecewise", &[("cap_cpd", 9.0)]);
            for (model, want) in [
                (&linear, 1.0 / (0.022 * e + 0.03)),
                (&cut_off, 3.1 * 50f64.ln() / (0.12 * (e + 3.1))),
                (&capped, super::super::PiecewiseMar::default().cutoff_cpd(e).min(9.0)),
            ] {
                let found = model.curve().unwrap().cutoff_cpd(e);
                assert!((found / want - 1.0).abs() < 1e-12, "{e}: {found} for {want}");
                let own = match model {
                    AcuityModel::LinearMar(model) => model.cutoff_cpd(e),
                    AcuityModel::GeislerPerry(model) => model.cutoff_cpd(e),
                    AcuityModel::Piecewise(_) => want,
                };
                assert!((own / want - 1.0).abs() < 1e-12, "{e}: {own} for {want}");
            }
        }
        assert_eq!(AcuityModel::find("linear"), None);
    }

    #[test]
    fn frequencies_are_those_of_eyes_and_devices() {
        let knots = |cpd: [f64; 2]| PiecewiseParams {
            knots_deg: vec![0.0, 60.0],
            knots_cpd: cpd.to_vec(),
            cap_cpd: None,
        };
        assert!(knots([1000.0, 0.01]).curve().is_ok());
        for cpd in [[1001.0, 4.0], [40.0, 0.0099]] {
            let error = knots(cpd).curve().unwrap_err();
            assert!(matches!(error, PiecewiseMarError::Frequency { .. }), "{error}");
        }
        let mut model = AcuityModel::default();
        for cap in [0.0099, 1001.0] {
            assert!(model.set("cap_cpd", &ParamValue::Number(cap)).is_err(), "{cap}");
        }
    }
}

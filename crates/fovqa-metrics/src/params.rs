//! Parameters of all metrics, set by name.

use thiserror::Error;

use crate::fidelity::{fpsnr, ssim};
use crate::profile::{haar, rms_contrast};
use crate::registry::{Metric, ParamValues};
use crate::temporal::atd;

/// A value as a user writes it.
#[derive(Debug, Clone, PartialEq)]
pub enum ParamValue {
    /// A number.
    Number(f64),
    /// A word.
    Text(String),
    /// A list of numbers.
    List(Vec<f64>),
    /// `true` or `false`.
    Flag(bool),
}

/// Parameters of all metrics.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Params {
    /// SSIM's window and constants; MS-SSIM and FSSIM use them too.
    pub ssim: ssim::Params,
    /// The foveal weight of FPSNR and FSSIM.
    pub fpsnr: fpsnr::Params,
    /// RMS contrast.
    pub rms_contrast: rms_contrast::Params,
    /// The Haar wavelet.
    pub haar: haar::Params,
    /// Average temporal difference.
    pub atd: atd::Params,
}

/// A parameter that is not there, or a value it cannot take.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ParamError {
    /// No such parameter.
    #[error("{metric} has no parameter {param:?}; {known}")]
    Unknown {
        /// The metric.
        metric: &'static str,
        /// What was given.
        param: String,
        /// What there is.
        known: String,
    },
    /// A value out of its range or of another type.
    #[error("{metric}.{param} cannot be {value}: {expected}")]
    Value {
        /// The metric.
        metric: &'static str,
        /// The parameter.
        param: &'static str,
        /// What was given.
        value: String,
        /// What it may be.
        expected: String,
    },
}

impl Params {
    /// Sets one parameter.
    ///
    /// # Errors
    /// When the metric has no such parameter, or the value is not one of its values.
    pub fn set(
        &mut self,
        metric: Metric,
        param: &str,
        value: &ParamValue,
    ) -> Result<(), ParamError> {
        let info = metric.info();
        let name = param.replace('-', "_");
        let Some(known) = info.params.iter().find(|p| p.name == name) else {
            let names: Vec<_> = info.params.iter().map(|p| p.name).collect();
            let known = if names.is_empty() {
                "it has none".to_owned()
            } else {
                format!("it has {}", names.join(", "))
            };
            return Err(ParamError::Unknown { metric: info.key, param: param.to_owned(), known });
        };
        // Words may be written with `-` for `_`, as all names may.
        let value = match value {
            ParamValue::Text(text) => &ParamValue::Text(text.replace('-', "_")),
            value => value,
        };
        let set = known.values.accept(value).then(|| match metric {
            Metric::Ssim => self.ssim.set(known.name, value),
            Metric::Fpsnr => self.fpsnr.set(known.name, value),
            Metric::RmsContrast => self.rms_contrast.set(known.name, value),
            Metric::Haar => self.haar.set(known.name, value),
            Metric::Atd => self.atd.set(known.name, value),
            Metric::Mse | Metric::Psnr | Metric::MsSsim | Metric::Fssim => None,
        });
        set.flatten().ok_or_else(|| ParamError::Value {
            metric: info.key,
            param: known.name,
            value: value.in_words(),
            expected: format!("{}; {}", known.about, known.values),
        })
    }

    /// Checks what only all parameters together can tell.
    ///
    /// # Errors
    /// When the acuity knots are not a curve.
    pub fn check(&self) -> Result<(), ParamError> {
        self.fpsnr.check().map_err(|expected| ParamError::Value {
            metric: Metric::Fpsnr.key(),
            param: "knots_cpd",
            value: format!("{:?} at {:?}", self.fpsnr.knots_cpd, self.fpsnr.knots_deg),
            expected,
        })
    }
}

impl ParamValues {
    /// Whether a value is one of these.
    pub fn accept(&self, value: &ParamValue) -> bool {
        match (self, value) {
            (Self::Number(min, max) | Self::NumberOrOff(min, max), ParamValue::Number(n)) => {
                (*min..=*max).contains(n)
            }
            (Self::Whole(min, max) | Self::WholeOrAuto(min, max), ParamValue::Number(n)) => {
                n.fract() == 0.0 && (f64::from(*min)..=f64::from(*max)).contains(n)
            }
            (Self::WholeOrAuto(..), ParamValue::Text(text)) => text == "auto",
            (Self::NumberOrOff(..), ParamValue::Text(text)) => text == "off",
            (Self::Flag, ParamValue::Flag(_)) => true,
            (Self::Word(words), ParamValue::Text(text)) => words.contains(&text.as_str()),
            (Self::Numbers, ParamValue::List(list)) => list.iter().all(|n| n.is_finite()),
            _ => false,
        }
    }
}

impl ParamValue {
    fn in_words(&self) -> String {
        match self {
            ParamValue::Number(n) => n.to_string(),
            ParamValue::Text(t) => format!("{t:?}"),
            ParamValue::List(l) => format!("{l:?}"),
            ParamValue::Flag(flag) => flag.to_string(),
        }
    }

    /// The number.
    pub(crate) fn number(&self) -> Option<f64> {
        match self {
            ParamValue::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Whether it is `true`.
    pub(crate) fn flag(&self) -> Option<bool> {
        match self {
            ParamValue::Flag(flag) => Some(*flag),
            _ => None,
        }
    }

    /// The list.
    pub(crate) fn list(&self) -> Option<Vec<f64>> {
        match self {
            ParamValue::List(list) => Some(list.clone()),
            _ => None,
        }
    }

    /// The word.
    pub(crate) fn text(&self) -> Option<&str> {
        match self {
            ParamValue::Text(text) => Some(text),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_parameter_can_be_set_to_its_default() {
        for metric in Metric::ALL {
            for info in metric.info().params {
                let default = info.default;
                let value = if let Ok(flag) = default.parse::<bool>() {
                    ParamValue::Flag(flag)
                } else if let Ok(number) = default.parse::<f64>() {
                    ParamValue::Number(number)
                } else if let Some(list) = default.strip_prefix('[') {
                    let list = list.trim_end_matches(']').split(',');
                    ParamValue::List(list.map(|n| n.trim().parse().unwrap()).collect())
                } else {
                    ParamValue::Text(default.trim_matches('"').to_owned())
                };
                let mut params = Params::default();
                params.set(metric, info.name, &value).unwrap();
                assert_eq!(params, Params::default(), "{}.{}", metric.key(), info.name);
            }
        }
    }

    #[test]
    fn refuses_what_is_not_there_or_out_of_range() {
        let mut params = Params::default();
        let number = ParamValue::Number;
        assert!(matches!(
            params.set(Metric::Psnr, "sigma", &number(1.0)),
            Err(ParamError::Unknown { .. })
        ));
        for (name, value) in [
            ("sigma", 0.0),
            ("sigma", f64::NAN),
            ("radius", 225.0),
            ("sigma", 65.0),
            ("k2", 1e160),
            ("radius", 2.5),
            ("k1", -1.0),
        ] {
            assert!(
                matches!(
                    params.set(Metric::Ssim, name, &number(value)),
                    Err(ParamError::Value { .. })
                ),
                "{name}"
            );
        }
        params.set(Metric::Fpsnr, "knots-cpd", &ParamValue::List(vec![1.0])).unwrap();
        assert!(params.check().is_err());
    }
}

//! Options of psychometric fits.

use super::model::Model;
use crate::StudyError;

/// Options of the fits.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The kind of function.
    pub model: Model,
    /// λ, if it is fixed: from 0 up to but not 1 - γ.
    pub lapse: Option<f64>,
    /// The largest λ of the maximum-likelihood fit.
    pub lapse_max: f64,
    /// The performances ψ whose levels are reported.
    pub performance: Vec<f64>,
    /// True if the posterior has overdispersion η.
    pub overdispersion: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            model: Model::default(),
            lapse: None,
            lapse_max: 0.06,
            performance: vec![0.75, std::f64::consts::FRAC_1_SQRT_2],
            overdispersion: true,
        }
    }
}

impl Options {
    /// Whether the rates leave a range for the function.
    ///
    /// # Errors
    ///
    /// If they do not.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        let guess = self.model.guess;
        let (option, lapse) = match self.lapse {
            Some(lapse) => ("--lapse", lapse),
            None => ("--lapse-max", self.lapse_max),
        };
        if guess + lapse < 1.0 {
            return Ok(());
        }
        Err(StudyError::Options {
            message: format!("--guess {guess} and {option} {lapse} add up to 1 or more"),
            help: "the function needs a range between them: choose smaller rates".to_owned(),
        })
    }
}

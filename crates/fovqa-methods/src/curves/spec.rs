//! The content of a curve: an acuity model, or a method on a screen with its budget solved.

use fovqa_vision::acuity::AcuityModel;

use super::setting::CurveSetting;
use crate::budget::{BudgetError, BudgetSamples};
use crate::registry::Method;

/// The specification of one curve.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveSpec {
    /// The name in its file, which is the same for every setting.
    pub name: String,
    /// The model or method of the curve.
    pub source: CurveSource,
    /// Parameters that differ from their defaults, as `name=value` separated by `;`.
    pub parameters: String,
}

impl CurveSpec {
    /// The specification of a method's curve; a budget is solved.
    ///
    /// # Errors
    /// When the method cannot be applied or cannot reach the budget.
    pub fn of_method(
        name: String,
        method: Method,
        parameters: String,
        setting: CurveSetting,
        budget: Option<CurveBudget>,
    ) -> Result<Self, BudgetError> {
        let over = setting.setting()?;
        let (mut method, mut parameters) = (method, parameters);
        if let Some(CurveBudget { share, samples }) = budget {
            let found = method.at_budget(&over, share, samples)?;
            method = found.method;
            // The solved value replaces a given one.
            let given = parameters.split(';').filter(|given| {
                !given.is_empty() && given.split('=').next() != Some(found.parameter)
            });
            let solved = format!("{}={}", found.parameter, found.value.in_words());
            parameters = given.chain([solved.as_str()]).collect::<Vec<_>>().join(";");
        }
        method.apply(&over)?;
        Ok(Self { name, source: CurveSource::Method { method, setting }, parameters })
    }
}

/// The model or method that a curve shows.
#[derive(Debug, Clone, PartialEq)]
pub enum CurveSource {
    /// An acuity model, which needs no screen.
    Acuity(AcuityModel),
    /// A method applied to a screen.
    Method {
        /// The method, after its budget was solved.
        method: Method,
        /// The screen.
        setting: CurveSetting,
    },
}

/// The budget for which a method is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveBudget {
    /// The number of samples divided by the number of the frame's pixels.
    pub share: f64,
    /// The samples that count.
    pub samples: BudgetSamples,
}

//! What a curve shows: an acuity model, or a method on a screen, its budget solved.

use fovqa_vision::acuity::AcuityModel;

use super::setting::CurveSetting;
use crate::budget::BudgetOf;
use crate::registry::Method;

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveSpec {
    /// The name its file gives it: the same for every setting.
    pub name: String,
    /// What is drawn.
    pub source: CurveSource,
    /// Parameters that are not at their defaults, `name=value` with `;` between them.
    pub parameters: String,
}

impl CurveSpec {
    /// A curve of a method, its budget solved.
    ///
    /// # Errors
    /// When the method cannot be applied there, or does not reach the budget; in words.
    pub fn of_method(
        name: String,
        method: Method,
        parameters: String,
        setting: CurveSetting,
        budget: Option<CurveBudget>,
    ) -> Result<Self, String> {
        let over = setting.setting().map_err(|error| error.to_string())?;
        let (mut method, mut parameters) = (method, parameters);
        if let Some(CurveBudget { share, of }) = budget {
            let found = method.at_budget(&over, share, of).map_err(|error| error.to_string())?;
            method = found.method;
            // What is solved stands for what was given.
            let given = parameters.split(';').filter(|given| {
                !given.is_empty() && given.split('=').next() != Some(found.parameter)
            });
            let solved = format!("{}={}", found.parameter, found.value);
            parameters = given.chain([solved.as_str()]).collect::<Vec<_>>().join(";");
        }
        method.apply(&over).map_err(|error| error.to_string())?;
        Ok(Self { name, source: CurveSource::Method { method, setting }, parameters })
    }
}

/// What a curve shows.
#[derive(Debug, Clone, PartialEq)]
pub enum CurveSource {
    /// An acuity model, which needs no screen.
    Acuity(AcuityModel),
    /// A method on a screen.
    Method {
        /// The method, its budget solved.
        method: Method,
        /// The screen.
        setting: CurveSetting,
    },
}

/// A budget that a method is solved for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveBudget {
    /// Samples over the frame's pixels.
    pub share: f64,
    /// Which samples.
    pub of: BudgetOf,
}

//! A method's free parameter, solved for a share of samples; and what became of it in whole samples.

use fovqa_methods::guenter::{Fit, Guenter};
use fovqa_methods::{BudgetError, BudgetSamples, Method, Setting};
use fovqa_params::ParamValue;

use crate::counts::Counts;
use crate::error::EmulateError;
use crate::method::Emulated;
use crate::spec::{Budget, EmulationSpec};

/// A budget, and how it was met.
#[derive(Debug, Clone, PartialEq)]
pub struct BudgetReport {
    /// What was asked for.
    pub budget: Budget,
    /// The parameter that was solved.
    pub parameter: &'static str,
    /// Its value.
    pub value: ParamValue,
    /// The share of the ideal buffer, before its size is rounded.
    pub ideal_share: f64,
    /// The share of the buffer that is emulated.
    pub rounded_share: f64,
}

/// A solved budget, before the buffer is known.
#[derive(Debug)]
pub(crate) struct Solution {
    budget: Budget,
    parameter: &'static str,
    value: ParamValue,
    ideal_share: f64,
}

impl EmulationSpec {
    /// The name of the parameter that a budget solves; `None` if the method has none.
    pub fn free_parameter(&self) -> Option<&'static str> {
        match &self.method {
            Emulated::Foveation(method) => method.free_parameter(),
            _ => None,
        }
    }

    /// Checks that a budget, if there is one, has a parameter to solve, and that the parameter is not
    /// given. Of a list, such as the densities of layers, a budget changes the scale alone.
    ///
    /// # Errors
    /// If the method has no such parameter, or it is given.
    pub fn check_budget(&self) -> Result<(), EmulateError> {
        if self.budget.is_none() {
            return Ok(());
        }
        let Some(parameter) = self.free_parameter() else {
            return Err(BudgetError::NotFree { method: self.key() }.into());
        };
        match self.set_by_name().get(parameter) {
            Some(ParamValue::Number(_)) => {
                Err(EmulateError::BudgetAndParameter { method: self.key(), parameter })
            }
            _ => Ok(()),
        }
    }

    /// The spec with its budget's parameter solved for a setting, on ideal sizes.
    pub(crate) fn solved(
        &self,
        setting: &Setting,
    ) -> Result<(Self, Option<Solution>), EmulateError> {
        let found = self.written_out(setting)?;
        let Some(budget) = self.budget else { return Ok((found, None)) };
        self.check_budget()?;
        let Emulated::Foveation(method) = &found.method else {
            return Err(BudgetError::NotFree { method: self.key() }.into());
        };
        let solved = method.at_budget(setting, budget.share, budget.of)?;
        let ideal = solved.method.apply(setting)?.counts();
        let samples = match budget.of {
            BudgetSamples::Buffer => ideal.whole(),
            BudgetSamples::OnScreen => ideal.samples_on_screen,
        };
        let (parameter, value) = (solved.parameter, solved.value);
        let ideal_share = samples / setting.pixels();
        let mut spec = found.clone();
        spec.method = Emulated::Foveation(solved.method);
        spec.follow_cps();
        Ok((spec, Some(Solution { budget, parameter, value, ideal_share })))
    }

    /// The spec with what its method finds for a setting by itself: the layers of Guenter et al. with the
    /// fewest samples.
    fn written_out(&self, setting: &Setting) -> Result<Self, EmulateError> {
        let mut spec = self.clone();
        if let Emulated::Foveation(Method::Guenter(params)) = &self.method
            && params.fit == Fit::Optimised
        {
            let found = Guenter::new(params, setting)?;
            spec.method = Emulated::Foveation(Method::Guenter(found.fixed(params)));
            let mut say = |name: &str, values: &[f64]| {
                spec.set.insert(name.to_owned(), ParamValue::List(values.to_vec()));
            };
            say("bounds_deg", &found.bounds_deg());
            say("scales", &found.scales());
        }
        Ok(spec)
    }
}

impl Solution {
    pub(crate) fn report(self, counts: &Counts, setting: &Setting) -> BudgetReport {
        let Self { budget, parameter, value, ideal_share } = self;
        let samples = match budget.of {
            BudgetSamples::Buffer => counts.samples + counts.samples_beyond,
            BudgetSamples::OnScreen => counts.samples_on_screen,
        };
        let rounded_share = samples / setting.pixels();
        BudgetReport { budget, parameter, value, ideal_share, rounded_share }
    }
}

//! What is to be emulated, as plain data: a method with its parameters, and everything around it.

use std::collections::BTreeMap;

use fovqa_methods::sandbox::{MOST_F_MAX, Sandbox};
use fovqa_methods::{BudgetSamples, Method, MethodInfo};
use fovqa_params::{ParamValue, Words, find};

use crate::error::EmulateError;
use crate::filters::{FilterChoice, FilterParams};
use crate::jitter::Jitter;
use crate::method::Emulated;
use crate::sampling::Sampling;
use crate::sandbox_params::ENHANCE;
use crate::space::Space;
use crate::temporal::TaaParams;

/// A share of the frame's pixels that a method may shade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// Samples over pixels, above 0.
    pub share: f64,
    /// Which samples.
    pub of: BudgetSamples,
}

/// What is to be emulated.
#[derive(Debug, Clone, PartialEq)]
pub struct EmulationSpec {
    pub(crate) method: Emulated,
    pub(crate) filter: FilterParams,
    pub(crate) filters: FilterChoice,
    pub(crate) sampling: Sampling,
    pub(crate) jitter: Jitter,
    pub(crate) space: Space,
    pub(crate) temporal: bool,
    pub(crate) taa: TaaParams,
    pub(crate) enhance: Option<f64>,
    pub(crate) enhancement: Sandbox,
    pub(crate) budget: Option<Budget>,
    /// What was set by name.
    pub(crate) set: BTreeMap<String, ParamValue>,
}

/// The largest share of a budget.
const MOST_SHARE: f64 = 1e4;

impl EmulationSpec {
    /// All methods that can be emulated, in the order of tables.
    pub fn methods() -> Vec<&'static MethodInfo> {
        Emulated::all().iter().map(Emulated::info).collect()
    }

    /// A method with its defaults; `-` and `_` are alike in its name.
    ///
    /// # Errors
    /// When there is no such method.
    pub fn new(method: &str) -> Result<Self, EmulateError> {
        let found = Emulated::find(method).ok_or_else(|| {
            let known: Vec<_> =
                Self::methods().iter().map(|info| info.key.replace('_', "-")).collect();
            EmulateError::UnknownMethod { name: method.to_owned(), known: known.join(", ") }
        })?;
        Ok(Self::of(found))
    }

    fn of(method: Emulated) -> Self {
        let mut enhancement = Sandbox::default();
        if let Emulated::Foveation(Method::Cps(params)) = &method {
            enhancement.foveal_deg = params.foveal_deg;
            enhancement.transition_deg = params.transition_deg;
        }
        Self {
            temporal: method == Emulated::Taa,
            method,
            filter: FilterParams::default(),
            filters: FilterChoice::None,
            sampling: Sampling::Point,
            jitter: Jitter::None,
            space: Space::Encoded,
            taa: TaaParams::default(),
            enhance: None,
            enhancement,
            budget: None,
            set: BTreeMap::new(),
        }
    }

    /// The method's entry.
    pub fn info(&self) -> &'static MethodInfo {
        self.method.info()
    }

    /// Its name in results.
    pub fn key(&self) -> &'static str {
        self.method.key()
    }

    /// Sets a parameter by name: the method's own, `filter.X` of its filters, `taa.X` of the temporal
    /// filter, `enhance.X` of enhancement. `-` and `_` are alike.
    ///
    /// # Errors
    /// When there is no such parameter, or the value is none of its values.
    pub fn set(&mut self, name: &str, value: &ParamValue) -> Result<(), EmulateError> {
        let name = name.replace('-', "_");
        match name.split_once('.') {
            None => {
                self.method.set(&name, value)?;
                self.follow_cps();
            }
            Some(("filter", param)) => self.set_filter_param(param, value)?,
            Some(("taa", param)) => {
                let (known, value) = find("taa", TaaParams::INFO, param, value)?;
                let set = self.taa.set(known.name, &value);
                set.ok_or_else(|| known.value_error("taa", &value))?;
            }
            Some(("enhance", param)) => {
                let (known, value) = find("enhance", ENHANCE, param, value)?;
                let set = self.enhancement.set(known.name, &value);
                set.ok_or_else(|| known.value_error("enhance", &value))?;
            }
            // The method says which ones there are.
            Some(_) => self.method.set(&name, value)?,
        }
        self.set.insert(name, value.clone());
        Ok(())
    }

    fn set_filter_param(&mut self, param: &str, value: &ParamValue) -> Result<(), EmulateError> {
        let filters = self.method.filters();
        if filters.params.is_empty() {
            let wanted = format!("parameter \"filter.{param}\"");
            return Err(EmulateError::NoFilter {
                method: self.key(),
                wanted,
                known: filters.known,
            });
        }
        let (known, value) = find("filter", filters.params, param, value)?;
        let set = self.filter.set(known.name, &value);
        Ok(set.ok_or_else(|| known.value_error("filter", &value))?)
    }

    /// Where nothing else was set, enhancement of coarse pixel shading rises with its own rate.
    pub(crate) fn follow_cps(&mut self) {
        if let Emulated::Foveation(Method::Cps(params)) = &self.method {
            if !self.set.contains_key("enhance.foveal_deg") {
                self.enhancement.foveal_deg = params.foveal_deg;
            }
            if !self.set.contains_key("enhance.transition_deg") {
                self.enhancement.transition_deg = params.transition_deg;
            }
        }
    }

    /// How samples read the frame.
    pub fn set_sampling(&mut self, sampling: Sampling) {
        self.sampling = sampling;
    }

    /// Where within their cells samples stand. Jitter applies to finished frames as to scenes; see
    /// [`Emulator::at_frame`](crate::Emulator::at_frame). Reading the buffer does not undo it.
    pub fn set_jitter(&mut self, jitter: Jitter) {
        self.jitter = jitter;
    }

    /// Where within their cells samples stand.
    pub fn jitter(&self) -> Jitter {
        self.jitter
    }

    /// The values the method runs on.
    pub fn set_space(&mut self, space: Space) {
        self.space = space;
    }

    /// Turns filters of the method on.
    ///
    /// # Errors
    /// When the method does not have the filter, or has none.
    pub fn set_filters(&mut self, choice: FilterChoice) -> Result<(), EmulateError> {
        let info = self.method.filters();
        if info.chosen(choice).is_none() {
            let wanted = match choice {
                FilterChoice::Own => "filters of its own".to_owned(),
                choice => format!("filter `{}`", choice.word()),
            };
            return Err(EmulateError::NoFilter { method: self.key(), wanted, known: info.known });
        }
        self.filters = choice;
        Ok(())
    }

    /// Turns the temporal filter on; the method `taa` has it on always.
    pub fn set_temporal(&mut self, on: bool) {
        self.temporal = on || self.method == Emulated::Taa;
    }

    /// How samples read the frame.
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// The values the method runs on.
    pub fn space(&self) -> Space {
        self.space
    }

    /// Which filters of the method are on.
    pub fn filters(&self) -> FilterChoice {
        self.filters
    }

    /// The strength of enhancement, if it is on.
    pub fn enhance(&self) -> Option<f64> {
        self.enhance
    }

    /// The budget, if there is one.
    pub fn budget(&self) -> Option<Budget> {
        self.budget
    }

    /// What was set by name, in the order of names.
    pub fn set_by_name(&self) -> &BTreeMap<String, ParamValue> {
        &self.set
    }

    /// Whether the temporal filter is on.
    pub fn is_temporal(&self) -> bool {
        self.temporal
    }

    /// Turns enhancement on, with its strength f_max, 0 to 100.
    ///
    /// # Errors
    /// When the strength is out of range.
    pub fn set_enhance(&mut self, f_max: f64) -> Result<(), EmulateError> {
        let (what, least, most) = ("the strength of enhancement", 0.0, MOST_F_MAX);
        if !(least..=most).contains(&f_max) {
            return Err(EmulateError::OutOfRange { what, found: f_max, least, most });
        }
        self.enhance = Some(f_max);
        Ok(())
    }

    /// Sets the method's free parameter by a budget, solved anew for each size, view and gaze.
    ///
    /// # Errors
    /// When the share is not above 0.
    pub fn set_budget(&mut self, budget: Budget) -> Result<(), EmulateError> {
        let (what, found) = ("the share of a budget", budget.share);
        if !(found > 0.0 && found <= MOST_SHARE) {
            return Err(EmulateError::OutOfRange { what, found, least: 0.0, most: MOST_SHARE });
        }
        self.budget = Some(budget);
        Ok(())
    }

    /// Takes the budget away.
    pub fn clear_budget(&mut self) {
        self.budget = None;
    }

    /// Sets the method's free parameter by a budget, also if the parameter was set by name.
    ///
    /// # Errors
    /// When the share is not above 0.
    pub fn free_budget(&mut self, budget: Budget) -> Result<(), EmulateError> {
        let solved = self.free_parameter();
        self.set.retain(|name, value| {
            Some(name.as_str()) != solved || !matches!(value, ParamValue::Number(_))
        });
        self.set_budget(budget)
    }

    /// What needs a view, if anything does: the method, or enhancement.
    pub fn needs_view(&self) -> Option<&'static str> {
        if self.method.needs_view() {
            Some(self.key())
        } else {
            self.enhance.map(|_| "enhancement")
        }
    }
}

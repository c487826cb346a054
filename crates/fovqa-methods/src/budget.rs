//! A method at a sample budget: its free parameter is solved for a given share of samples.

use fovqa_params::{ParamValue, words};
use thiserror::Error;

use crate::error::MethodError;
use crate::guenter::{Fit, Guenter};
use crate::registry::Method;
use crate::setting::Setting;

words! {
    /// The samples that a budget counts, as a share of the frame's pixels.
    #[derive(Default)]
    pub enum BudgetSamples {
        /// All samples of the buffer, including those of VaFR beyond 60°.
        #[default]
        Buffer "buffer" "All samples that are shaded";
        /// The samples that fall into the frame.
        OnScreen "on_screen" "The samples that fall into the frame";
    }
}

/// A method whose free parameter was solved for a budget.
#[derive(Debug, Clone, PartialEq)]
pub struct Budgeted {
    /// The method with the solved parameter.
    pub method: Method,
    /// Name of the parameter that was solved.
    pub parameter: &'static str,
    /// Its value.
    pub value: ParamValue,
}

/// A budget that a method cannot meet.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BudgetError {
    /// The method has no parameter that changes its number of samples.
    #[error("{method} has no parameter that a budget could set")]
    NotFree {
        /// The method's label.
        method: &'static str,
    },
    /// The budget cannot be reached.
    #[error(
        "{method} cannot reach a budget of {wanted} of the frame's pixels: {parameter} allows {} to \
         {}", written(*least, true), written(*most, false)
    )]
    OutOfReach {
        /// The method's label.
        method: &'static str,
        /// The share that was asked for.
        wanted: f64,
        /// The free parameter.
        parameter: &'static str,
        /// The smallest possible share.
        least: f64,
        /// The largest possible share.
        most: f64,
        /// The parameters that change this range; empty if none does.
        others: &'static str,
    },
    /// The method cannot be applied to the frame.
    #[error(transparent)]
    Method(#[from] MethodError),
}

/// A share with four decimal digits, rounded so that the written one can be reached.
fn written(share: f64, up: bool) -> String {
    /// Four decimals, and what is left to rounding errors.
    const UNIT: f64 = 1e4;
    const CLOSE: f64 = 1e-6;
    if !(1e-3..1e4).contains(&share) {
        return format!("{share:.3e}");
    }
    let units = share * UNIT;
    let rounded = if up { (units - CLOSE).ceil() } else { (units + CLOSE).floor() };
    format!("{:.4}", rounded / UNIT)
}

/// A free parameter with its range, from the sparsest sampling to the densest.
struct FreeParameter {
    name: &'static str,
    ends: [f64; 2],
    set: fn(&mut Method, f64),
}

impl Method {
    /// Solves the free parameter such that the method shades a share of the frame's pixels. It is σ
    /// for RMFR, KFR and LaFR; a common factor on all σ for DEAMP; the factor on f for VaFR; the
    /// outermost scale for Guenter; T for CPS; `outer_deg` for the linear fall-off; samples per
    /// pixel for Visual-Polar. Buffer sizes are ideal, not rounded.
    ///
    /// # Errors
    /// When the method has no free parameter, cannot be applied, or cannot reach the share.
    pub fn at_budget(
        &self,
        setting: &Setting,
        share: f64,
        of: BudgetSamples,
    ) -> Result<Budgeted, BudgetError> {
        if let Self::Guenter(params) = self
            && params.fit == Fit::Optimised
        {
            return Self::Guenter(Guenter::new(params, setting)?.fixed(params))
                .at_budget(setting, share, of);
        }
        let Some(free) = self.free() else {
            return Err(BudgetError::NotFree { method: self.key() });
        };
        let share_of = |value: f64| self.with(&free, value).share(setting, of);
        let [mut sparse, mut dense] = free.ends;
        let (least, most) = (share_of(sparse)?, share_of(dense)?);
        if !(least <= share && share <= most) {
            return Err(BudgetError::OutOfReach {
                method: self.key(),
                wanted: share,
                parameter: free.name,
                least,
                most,
                others: self.others(),
            });
        }
        // Shares change with powers of the parameter, so the bisection works on its logarithm.
        for _ in 0..100 {
            let middle = (sparse * dense).sqrt();
            if share_of(middle)? < share {
                sparse = middle;
            } else {
                dense = middle;
            }
        }
        let method = self.with(&free, dense);
        let (parameter, value) = match &method {
            Self::Deamp(params) => ("sigmas", ParamValue::List(params.sigmas.clone())),
            Self::Guenter(params) => ("scales", ParamValue::List(params.scales.clone())),
            _ => (free.name, ParamValue::Number(dense)),
        };
        Ok(Budgeted { method, parameter, value })
    }

    /// The smallest and the largest share of the frame's pixels that a budget can be.
    ///
    /// # Errors
    /// When the method has no free parameter, or cannot be applied.
    pub fn budget_range(
        &self,
        setting: &Setting,
        of: BudgetSamples,
    ) -> Result<[f64; 2], BudgetError> {
        if let Self::Guenter(params) = self
            && params.fit == Fit::Optimised
        {
            return Self::Guenter(Guenter::new(params, setting)?.fixed(params))
                .budget_range(setting, of);
        }
        let Some(free) = self.free() else {
            return Err(BudgetError::NotFree { method: self.key() });
        };
        let [sparse, dense] = free.ends;
        Ok([
            self.with(&free, sparse).share(setting, of)?,
            self.with(&free, dense).share(setting, of)?,
        ])
    }

    /// The method with another value of its free parameter.
    fn with(&self, free: &FreeParameter, value: f64) -> Self {
        let mut method = self.clone();
        (free.set)(&mut method, value);
        method
    }

    /// Its samples as a share of the frame's pixels, on ideal sizes.
    fn share(&self, setting: &Setting, of: BudgetSamples) -> Result<f64, BudgetError> {
        let counts = self.apply(setting)?.counts();
        let samples = match of {
            BudgetSamples::Buffer => counts.whole(),
            BudgetSamples::OnScreen => counts.samples_on_screen,
        };
        Ok(samples / setting.pixels())
    }

    /// The name of the parameter that a budget solves; `None` if it has none.
    pub fn free_parameter(&self) -> Option<&'static str> {
        match self {
            Self::Deamp(_) => Some("sigmas"),
            Self::Guenter(_) => Some("scales"),
            _ => self.free().map(|free| free.name),
        }
    }

    /// The parameters that change the range of budgets that the free parameter allows.
    fn others(&self) -> &'static str {
        match self {
            Self::Guenter(_) => "bounds_deg, or the inner scales",
            Self::Linear(_) => "inner_deg or p_min",
            Self::Cps(_) => "foveal_deg",
            Self::Deamp(_) => "bounds_deg",
            Self::Lafr(_) => "alpha or beta",
            Self::Vafr(_) => "acuity",
            _ => "",
        }
    }

    fn free(&self) -> Option<FreeParameter> {
        /// The range of σ and of factors, from the sparsest sampling to the densest.
        const WIDE: [f64; 2] = [1000.0, 0.1];
        let free = |name, ends, set| Some(FreeParameter { name, ends, set });
        match self {
            Self::Full => None,
            Self::Vafr(_) => free("factor", [1e-3, 1000.0], |method, value| {
                if let Self::Vafr(params) = method {
                    params.factor = value;
                }
            }),
            Self::Kfr(_) => free("sigma", WIDE, |method, value| {
                if let Self::Kfr(params) = method {
                    params.sigma = value;
                }
            }),
            Self::Lafr(_) => free("sigma", WIDE, |method, value| {
                if let Self::Lafr(params) = method {
                    params.sigma = value;
                }
            }),
            Self::Rmfr(_) => free("sigma", WIDE, |method, value| {
                if let Self::Rmfr(params) = method {
                    params.sigma = value;
                }
            }),
            Self::Deamp(params) => {
                let most = params.sigmas.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
                let least = params.sigmas.iter().copied().fold(f64::INFINITY, f64::min);
                let ends = [WIDE[0] / most, WIDE[1] / least];
                free("a factor on sigmas", ends, |method, value| {
                    if let Self::Deamp(params) = method {
                        for sigma in &mut params.sigmas {
                            // The limits of the factor multiplied by σ may exceed the limits of σ
                            // by a rounding error.
                            *sigma = (*sigma * value).clamp(WIDE[1], WIDE[0]);
                        }
                    }
                })
            }
            Self::Guenter(params) => {
                // The scale is at least that of the layer inside it.
                let finest = params.scales.get(1).copied().unwrap_or(1.0);
                free("the outermost of scales", [1000.0, finest], |method, value| {
                    if let Self::Guenter(params) = method
                        && let Some(scale) = params.scales.get_mut(2)
                    {
                        *scale = value;
                    }
                })
            }
            Self::Linear(params) => {
                let ends = [params.inner_deg.next_up().max(0.001), 89.9];
                free("outer_deg", ends, |method, value| {
                    if let Self::Linear(params) = method {
                        params.outer_deg = value;
                    }
                })
            }
            Self::Cps(_) => free("transition_deg", [0.001, 1000.0], |method, value| {
                if let Self::Cps(params) = method {
                    params.transition_deg = value;
                }
            }),
            Self::VisualPolar(_) => free("samples_per_pixel", [1e-4, 16.0], |method, value| {
                if let Self::VisualPolar(params) = method {
                    params.samples_per_pixel = value;
                }
            }),
        }
    }
}

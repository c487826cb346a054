//! A method at a budget: its free parameter solved for a share of samples.

use fovqa_params::words;
use thiserror::Error;

use crate::error::MethodError;
use crate::guenter::{Fit, Guenter};
use crate::registry::Method;
use crate::setting::Setting;

words! {
    /// Which samples a budget counts, over the frame's pixels.
    #[derive(Default)]
    pub enum BudgetOf {
        /// All of the buffer, with what VaFR has beyond 60°.
        #[default]
        Buffer "buffer" "All that are shaded";
        /// Those that fall into the frame.
        OnScreen "on_screen" "Those that fall into the frame";
    }
}

/// A method at a budget.
#[derive(Debug, Clone, PartialEq)]
pub struct Budgeted {
    /// The method with its free parameter solved.
    pub method: Method,
    /// The parameter that was solved.
    pub parameter: &'static str,
    /// Its value as TOML.
    pub value: String,
}

/// A budget that cannot be had.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BudgetError {
    /// A method whose samples are what they are.
    #[error("{method} has no parameter that a budget could set")]
    NotFree {
        /// The method.
        method: &'static str,
    },
    /// Out of reach.
    #[error(
        "{method} cannot shade {wanted} of the frame's pixels: with {parameter} it reaches from \
         {} to {}", written(*least), written(*most)
    )]
    OutOfReach {
        /// The method.
        method: &'static str,
        /// The share asked for.
        wanted: f64,
        /// The free parameter.
        parameter: &'static str,
        /// The least share.
        least: f64,
        /// The largest share.
        most: f64,
    },
    /// A method that cannot be applied at all.
    #[error(transparent)]
    Method(#[from] MethodError),
}

/// A share with four digits.
fn written(share: f64) -> String {
    if (1e-3..1e4).contains(&share) { format!("{share:.4}") } else { format!("{share:.3e}") }
}

/// A free parameter: from the sparsest to the densest.
struct Free {
    name: &'static str,
    ends: [f64; 2],
    set: fn(&mut Method, f64),
}

impl Method {
    /// The method with its free parameter such that it shades a share of the frame's pixels:
    /// RMFR, KFR, LaFR: σ; DEAMP: one factor on all σ; VaFR: the factor on f; Guenter: the outermost
    /// scale; CPS: T; linear: `outer_deg`; Visual-Polar: samples per pixel. Solved on ideal sizes.
    ///
    /// # Errors
    /// When the method has no free parameter, cannot be applied, or does not reach the share.
    pub fn at_budget(
        &self,
        setting: &Setting,
        share: f64,
        of: BudgetOf,
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
        let with = |value: f64| {
            let mut method = self.clone();
            (free.set)(&mut method, value);
            method
        };
        let share_of = |value: f64| -> Result<f64, BudgetError> {
            let counts = with(value).apply(setting)?.counts();
            let samples = match of {
                BudgetOf::Buffer => counts.whole(),
                BudgetOf::OnScreen => counts.samples_on_screen,
            };
            Ok(samples / setting.pixels())
        };
        let [mut sparse, mut dense] = free.ends;
        let (least, most) = (share_of(sparse)?, share_of(dense)?);
        if !(least <= share && share <= most) {
            return Err(BudgetError::OutOfReach {
                method: self.key(),
                wanted: share,
                parameter: free.name,
                least,
                most,
            });
        }
        // Shares change with powers of the parameter, so that halving works on its logarithm.
        for _ in 0..100 {
            let middle = (sparse * dense).sqrt();
            if share_of(middle)? < share {
                sparse = middle;
            } else {
                dense = middle;
            }
        }
        let method = with(dense);
        let (parameter, value) = match &method {
            Self::Deamp(params) => ("sigmas", format!("{:?}", params.sigmas)),
            Self::Guenter(params) => ("scales", format!("{:?}", params.scales)),
            _ => (free.name, dense.to_string()),
        };
        Ok(Budgeted { method, parameter, value })
    }

    fn free(&self) -> Option<Free> {
        /// σ and factors may be anything between these.
        const WIDE: [f64; 2] = [1000.0, 0.1];
        let free = |name, ends, set| Some(Free { name, ends, set });
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
                            // The ends of the factor, multiplied back, may be rounded over them.
                            *sigma = (*sigma * value).clamp(WIDE[1], WIDE[0]);
                        }
                    }
                })
            }
            Self::Guenter(params) => {
                // No finer than the layer inside it.
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

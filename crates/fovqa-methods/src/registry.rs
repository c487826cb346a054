//! The registry of methods.

use fovqa_params::{ParamError, ParamValue, find};

use crate::cps::{self, Cps};
use crate::deamp::{self, Deamp};
use crate::error::MethodError;
use crate::foveation::Foveation;
use crate::full::{self, Full};
use crate::guenter::{self, Guenter};
use crate::info::MethodInfo;
use crate::kfr::{self, Kfr};
use crate::lafr::{self, Lafr};
use crate::linear::{self, Linear};
use crate::rmfr::{self, Rmfr};
use crate::setting::Setting;
use crate::vafr::{self, Vafr};
use crate::visual_polar::{self, VisualPolar};

/// A method with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum Method {
    /// Full shading of every pixel.
    Full,
    /// Visual acuity consistent foveated rendering.
    Vafr(vafr::Params),
    /// Kernel foveated rendering.
    Kfr(kfr::Params),
    /// Log-polar foveated rendering with two kernels.
    Lafr(lafr::Params),
    /// Rectangular mapping-based foveated rendering.
    Rmfr(rmfr::Params),
    /// Nested rectangular mappings.
    Deamp(deamp::Params),
    /// Three nested layers.
    Guenter(guenter::Params),
    /// Linear fall-off.
    Linear(linear::Params),
    /// Coarse pixel shading.
    Cps(cps::Params),
    /// Visual-Polar space, reconstructed from the paper's description.
    VisualPolar(visual_polar::Params),
}

impl Method {
    /// All methods with their default parameters, in the order of tables.
    pub fn all() -> [Method; 10] {
        [
            Self::Full,
            Self::Vafr(vafr::Params::default()),
            Self::Kfr(kfr::Params::default()),
            Self::Lafr(lafr::Params::default()),
            Self::Rmfr(rmfr::Params::default()),
            Self::Deamp(deamp::Params::default()),
            Self::Guenter(guenter::Params::default()),
            Self::Linear(linear::Params::default()),
            Self::Cps(cps::Params::default()),
            Self::VisualPolar(visual_polar::Params::default()),
        ]
    }

    /// The method of a name, with its default parameters; `-` and `_` are alike.
    pub fn find(name: &str) -> Option<Method> {
        let name = name.replace('-', "_").to_lowercase();
        Self::all().into_iter().find(|method| method.info().key == name)
    }

    /// The metadata of this method.
    pub fn info(&self) -> &'static MethodInfo {
        match self {
            Self::Full => &full::INFO,
            Self::Vafr(_) => &vafr::INFO,
            Self::Kfr(_) => &kfr::INFO,
            Self::Lafr(_) => &lafr::INFO,
            Self::Rmfr(_) => &rmfr::INFO,
            Self::Deamp(_) => &deamp::INFO,
            Self::Guenter(_) => &guenter::INFO,
            Self::Linear(_) => &linear::INFO,
            Self::Cps(_) => &cps::INFO,
            Self::VisualPolar(_) => &visual_polar::INFO,
        }
    }

    /// The method's name in results.
    pub fn key(&self) -> &'static str {
        self.info().key
    }

    /// Sets one parameter.
    ///
    /// # Errors
    /// When the method has no such parameter, or the parameter does not accept the value.
    pub fn set(&mut self, param: &str, value: &ParamValue) -> Result<(), ParamError> {
        let info = self.info();
        let (known, value) = find(info.key, info.params, param, value)?;
        let set = match self {
            Self::Full => None,
            Self::Vafr(params) => params.set(known.name, &value),
            Self::Kfr(params) => params.set(known.name, &value),
            Self::Lafr(params) => params.set(known.name, &value),
            Self::Rmfr(params) => params.set(known.name, &value),
            Self::Deamp(params) => params.set(known.name, &value),
            Self::Guenter(params) => params.set(known.name, &value),
            Self::Linear(params) => params.set(known.name, &value),
            Self::Cps(params) => params.set(known.name, &value),
            Self::VisualPolar(params) => params.set(known.name, &value),
        };
        set.ok_or_else(|| known.value_error(info.key, &value))
    }

    /// Applies the method to a frame and a gaze.
    ///
    /// # Errors
    /// When the parameters contradict each other or do not fit the frame.
    pub fn apply(&self, setting: &Setting) -> Result<Box<dyn Foveation>, MethodError> {
        Ok(match self {
            Self::Full => Box::new(Full::new(setting)),
            Self::Vafr(params) => Box::new(Vafr::new(params, setting)?),
            Self::Kfr(params) => Box::new(Kfr::new(params, setting)?),
            Self::Lafr(params) => Box::new(Lafr::new(params, setting)?),
            Self::Rmfr(params) => Box::new(Rmfr::new(params, setting)),
            Self::Deamp(params) => Box::new(Deamp::new(params, setting)?),
            Self::Guenter(params) => Box::new(Guenter::new(params, setting)?),
            Self::Linear(params) => Box::new(Linear::new(params, setting)?),
            Self::Cps(params) => Box::new(Cps::new(params, setting)),
            Self::VisualPolar(params) => Box::new(VisualPolar::new(params, setting)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_default_is_the_default() {
        for method in Method::all() {
            for info in method.info().params {
                let mut set = method.clone();
                set.set(info.name, &info.default_value()).unwrap();
                assert_eq!(set, method, "{}.{}", method.key(), info.name);
            }
            assert_eq!(Method::find(&method.key().replace('_', "-")), Some(method));
        }
    }
}

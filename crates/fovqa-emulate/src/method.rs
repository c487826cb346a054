//! The list of everything that can be emulated: the methods of `fovqa-methods`, and those of emulation
//! alone.

use fovqa_methods::sandbox::Sandbox;
use fovqa_methods::{Method, MethodInfo};
use fovqa_params::{ParamError, ParamValue, find};

use crate::filters::{self, FilterInfo};
use crate::sandbox_params::{BLUR, TARGET};

/// A method with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Emulated {
    Foveation(Method),
    Taa,
    Stable(Sandbox),
    Aliased(Sandbox),
    PerceptualTarget(Sandbox),
}

const SANDBOX: &str = "Patney et al. 2016, section 3.1";

const TAA: MethodInfo = MethodInfo {
    key: "taa",
    label: "TAA",
    about: "the frame with the temporal filter and nothing else",
    source: "Patney et al. 2016, section 4.2",
    params: &[],
};

const STABLE: MethodInfo = MethodInfo {
    key: "stable",
    label: "Stable",
    about: "sandbox: the frame blurred with eccentricity",
    source: SANDBOX,
    params: BLUR,
};

const ALIASED: MethodInfo = MethodInfo {
    key: "aliased",
    label: "Aliased",
    about: "sandbox: as little detail as `stable`, by coarser and coarser samples",
    source: SANDBOX,
    params: BLUR,
};

const PERCEPTUAL_TARGET: MethodInfo = MethodInfo {
    key: "perceptual_target",
    label: "Perceptual target",
    about: "sandbox: `stable` with its contrast restored",
    source: SANDBOX,
    params: TARGET,
};

impl Emulated {
    /// All of them with their defaults, in the order of tables.
    pub(crate) fn all() -> Vec<Self> {
        let mut all: Vec<Self> = Method::all().into_iter().map(Self::Foveation).collect();
        let sandbox = Sandbox::default();
        all.extend([
            Self::Taa,
            Self::Stable(sandbox),
            Self::Aliased(sandbox),
            Self::PerceptualTarget(sandbox),
        ]);
        all
    }

    /// The one of a name, `-` and `_` alike.
    pub(crate) fn find(name: &str) -> Option<Self> {
        let name = name.replace('-', "_").to_lowercase();
        Self::all().into_iter().find(|method| method.info().key == name)
    }

    pub(crate) fn info(&self) -> &'static MethodInfo {
        match self {
            Self::Foveation(method) => method.info(),
            Self::Taa => &TAA,
            Self::Stable(_) => &STABLE,
            Self::Aliased(_) => &ALIASED,
            Self::PerceptualTarget(_) => &PERCEPTUAL_TARGET,
        }
    }

    pub(crate) fn key(&self) -> &'static str {
        self.info().key
    }

    /// Sets a parameter of the method itself.
    pub(crate) fn set(&mut self, param: &str, value: &ParamValue) -> Result<(), ParamError> {
        if let Self::Foveation(method) = self {
            return method.set(param, value);
        }
        let info = self.info();
        let (known, value) = find(info.key, info.params, param, value)?;
        let set = match self {
            Self::Foveation(_) | Self::Taa => None,
            Self::Stable(params) | Self::Aliased(params) | Self::PerceptualTarget(params) => {
                params.set(known.name, &value)
            }
        };
        set.ok_or_else(|| known.value_error(info.key, &value))
    }

    pub(crate) fn filters(&self) -> &'static FilterInfo {
        match self {
            Self::Foveation(Method::Kfr(_) | Method::Lafr(_)) => &filters::LOG_POLAR,
            Self::Foveation(Method::Deamp(_)) => &filters::DEAMP,
            Self::Foveation(Method::Vafr(_)) => &filters::VAFR,
            _ => &filters::NONE,
        }
    }

    /// Whether it uses the focal length.
    pub(crate) fn needs_view(&self) -> bool {
        let without = matches!(
            self,
            Self::Taa
                | Self::Foveation(
                    Method::Full | Method::Rmfr(_) | Method::Deamp(_) | Method::Kfr(_)
                )
        );
        !without
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_default_is_the_default() {
        for method in Emulated::all() {
            for info in method.info().params {
                let mut set = method.clone();
                set.set(info.name, &info.default_value()).unwrap();
                assert_eq!(set, method, "{}.{}", method.key(), info.name);
            }
            assert_eq!(Emulated::find(&method.key().replace('_', "-")), Some(method));
        }
    }
}

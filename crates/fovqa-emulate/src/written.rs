//! An [`EmulationSpec`] as text: what was set, from which the same spec is made again.

use std::collections::BTreeMap;

use fovqa_methods::BudgetSamples;
use fovqa_params::ParamValue;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::error::EmulateError;
use crate::filters::FilterChoice;
use crate::jitter::Jitter;
use crate::sampling::Sampling;
use crate::space::Space;
use crate::spec::{Budget, EmulationSpec};

/// The keys of a spec.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    model: String,
    /// Only the parameters that were set by name.
    parameters: BTreeMap<String, ParamValue>,
    sampling: Sampling,
    filter: FilterChoice,
    space: Space,
    /// Left out where there is none: specs are written as they were before there was jitter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    jitter: Option<Jitter>,
    temporal: bool,
    enhance: Option<f64>,
    budget: Option<f64>,
    budget_of: BudgetSamples,
}

impl Written {
    fn of(spec: &EmulationSpec) -> Self {
        Self {
            model: spec.key().to_owned(),
            parameters: spec.set_by_name().clone(),
            sampling: spec.sampling(),
            filter: spec.filters(),
            space: spec.space(),
            jitter: (spec.jitter() != Jitter::None).then_some(spec.jitter()),
            temporal: spec.is_temporal(),
            enhance: spec.enhance(),
            budget: spec.budget().map(|budget| budget.share),
            budget_of: spec.budget().map(|budget| budget.of).unwrap_or_default(),
        }
    }

    fn spec(self) -> Result<EmulationSpec, EmulateError> {
        let mut spec = EmulationSpec::new(&self.model)?;
        for (name, value) in &self.parameters {
            spec.set(name, value)?;
        }
        spec.set_sampling(self.sampling);
        spec.set_filters(self.filter)?;
        spec.set_space(self.space);
        spec.set_jitter(self.jitter.unwrap_or_default());
        spec.set_temporal(self.temporal);
        if let Some(f_max) = self.enhance {
            spec.set_enhance(f_max)?;
        }
        if let Some(share) = self.budget {
            spec.set_budget(Budget { share, of: self.budget_of })?;
        }
        Ok(spec)
    }
}

impl Serialize for EmulationSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Written::of(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for EmulationSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Written::deserialize(deserializer)?.spec().map_err(D::Error::custom)
    }
}

//! The parameters of metrics as the user has set them, which a plan stores.

use std::collections::BTreeMap;
use std::ops::Deref;

use fovqa_params::{ParamError, ParamValue};
use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{Serialize, Serializer};

use crate::metric::Metric;
use crate::registry::Params;

/// The parameters of all metrics, and which of them were set by name. The others have their
/// defaults.
///
/// It is serialised as a table of the parameters that were set, by metric:
/// `{"ssim": {"sigma": 2.0}}`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParamSet {
    params: Params,
    set: BTreeMap<(Metric, &'static str), ParamValue>,
}

impl ParamSet {
    /// Sets one parameter.
    ///
    /// # Errors
    /// When the metric has no such parameter, or the parameter does not accept the value.
    pub fn set(
        &mut self,
        metric: Metric,
        param: &str,
        value: &ParamValue,
    ) -> Result<(), ParamError> {
        self.params.set(metric, param, value)?;
        let (known, _) = fovqa_params::find(metric.info().key, metric.info().params, param, value)?;
        self.set.insert((metric, known.name), value.clone());
        Ok(())
    }

    /// The value that a parameter was set to; `None` if it has its default.
    pub fn value(&self, metric: Metric, param: &str) -> Option<&ParamValue> {
        let mut set = self.set.iter();
        set.find(|((m, name), _)| (*m, *name) == (metric, param)).map(|(_, value)| value)
    }
}

impl Deref for ParamSet {
    type Target = Params;

    fn deref(&self) -> &Params {
        &self.params
    }
}

impl Serialize for ParamSet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut metrics: BTreeMap<&str, BTreeMap<&str, &ParamValue>> = BTreeMap::new();
        for ((metric, name), value) in &self.set {
            metrics.entry(metric.key()).or_default().insert(name, value);
        }
        metrics.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for ParamSet {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let metrics: BTreeMap<String, BTreeMap<String, ParamValue>> =
            Deserialize::deserialize(deserializer)?;
        let mut set = Self::default();
        for (key, params) in metrics {
            let metric = Metric::find(&key);
            let metric = metric.ok_or_else(|| D::Error::custom(format!("no metric {key:?}")))?;
            for (name, value) in params {
                set.set(metric, &name, &value).map_err(D::Error::custom)?;
            }
        }
        Ok(set)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_that_were_set_are_written_and_read() {
        let mut set = ParamSet::default();
        set.set(Metric::Ssim, "sigma", &ParamValue::Number(0.1 + 0.2)).unwrap();
        set.set(Metric::Fvvdp, "foveated", &ParamValue::Flag(false)).unwrap();
        set.set(Metric::Fpsnr, "knots-cpd", &ParamValue::List(vec![1.0, 0.5])).unwrap();
        assert!((set.ssim.sigma - 0.3).abs() < 1e-12 && !set.fvvdp.foveated);
        let json = serde_json::to_string(&set).unwrap();
        assert_eq!(serde_json::from_str::<ParamSet>(&json).unwrap(), set);
        assert_eq!(set.value(Metric::Fpsnr, "knots_cpd"), Some(&ParamValue::List(vec![1.0, 0.5])));
        assert_eq!(set.value(Metric::Ssim, "k1"), None);
        for wrong in [r#"{"sim": {}}"#, r#"{"ssim": {"sigma": -1.0}}"#, r#"{"ssim": {"x": 1.0}}"#] {
            assert!(serde_json::from_str::<ParamSet>(wrong).is_err(), "{wrong}");
        }
    }
}

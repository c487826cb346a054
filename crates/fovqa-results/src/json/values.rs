//! Converts numbers, metrics and statistics to and from JSON.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

use fovqa_metrics::Metric;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::summary::Statistics;

/// A number that keeps all its bits. Values that JSON has no number for are the words `"inf"`,
/// `"-inf"` and `"nan"`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number(pub f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            number if number.is_finite() => serializer.serialize_f64(number),
            number if number.is_nan() => serializer.serialize_str("nan"),
            number if number > 0.0 => serializer.serialize_str("inf"),
            _ => serializer.serialize_str("-inf"),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberVisitor;
        impl Visitor<'_> for NumberVisitor {
            type Value = Number;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, \"inf\", \"-inf\" or \"nan\"")
            }
            fn visit_f64<E: Error>(self, number: f64) -> Result<Number, E> {
                Ok(Number(number))
            }
            fn visit_u64<E: Error>(self, number: u64) -> Result<Number, E> {
                Ok(Number(number as f64))
            }
            fn visit_i64<E: Error>(self, number: i64) -> Result<Number, E> {
                Ok(Number(number as f64))
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Number, E> {
                match text {
                    "inf" => Ok(Number(f64::INFINITY)),
                    "-inf" => Ok(Number(f64::NEG_INFINITY)),
                    "nan" => Ok(Number(f64::NAN)),
                    other => Err(E::custom(format!("{other:?} is not a number"))),
                }
            }
        }
        deserializer.deserialize_any(NumberVisitor)
    }
}

/// A list whose elements are produced while it is written.
pub(crate) struct Each<F>(pub(crate) F);

impl<F, I> Serialize for Each<F>
where
    F: Fn() -> I,
    I: Iterator<Item: Serialize>,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((self.0)())
    }
}

/// Values with the keys of their metrics, in the order of tables.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MetricMap<T>(pub(crate) BTreeMap<Metric, T>);

impl<T: Serialize> Serialize for MetricMap<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(metric, value)| (metric.key(), value)))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for MetricMap<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MapVisitor<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for MapVisitor<T> {
            type Value = MetricMap<T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("values under the keys of metrics")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut values = BTreeMap::new();
                while let Some(key) = map.next_key::<String>()? {
                    let metric = Metric::find(&key)
                        .ok_or_else(|| A::Error::custom(format!("there is no metric {key:?}")))?;
                    values.insert(metric, map.next_value()?);
                }
                Ok(MetricMap(values))
            }
        }
        deserializer.deserialize_map(MapVisitor(PhantomData))
    }
}

/// Statistics in which the key of the pooled value begins with the name of the metric, for example
/// `psnr_pooled`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stats {
    pub(crate) metric: Metric,
    pub(crate) statistics: Statistics,
}

impl Serialize for Stats {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("mean", &Number(self.statistics.mean))?;
        map.serialize_entry("min", &Number(self.statistics.min))?;
        map.serialize_entry("max", &Number(self.statistics.max))?;
        if let Some(identical) = self.statistics.identical_frames {
            map.serialize_entry("identical_frames", &identical)?;
        }
        if let Some(pooled) = self.statistics.pooled {
            map.serialize_entry(&format!("{}_pooled", self.metric.key()), &Number(pooled))?;
        }
        map.end()
    }
}

/// Statistics of any metric. The key of the pooled value names the metric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AnyStats(pub(crate) Statistics);

impl<'de> Deserialize<'de> for AnyStats {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let values: BTreeMap<String, Number> = BTreeMap::deserialize(deserializer)?;
        let value = |key: &str| values.get(key).map(|number| number.0);
        let needed = |key: &'static str| value(key).ok_or_else(|| D::Error::missing_field(key));
        let pooled = values.iter().find(|(key, _)| key.ends_with("_pooled"));
        Ok(Self(Statistics {
            mean: needed("mean")?,
            min: needed("min")?,
            max: needed("max")?,
            identical_frames: value("identical_frames").map(|n| n as usize),
            pooled: pooled.map(|(_, number)| number.0),
        }))
    }
}

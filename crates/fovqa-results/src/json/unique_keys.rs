//! JSON in which no key appears twice. If two values have the same name, it is not clear which one
//! is meant.

use std::collections::BTreeSet;
use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};

/// A value in which each key of an object appears once.
pub(crate) struct UniqueKeys(pub(crate) Value);

impl<'de> Deserialize<'de> for UniqueKeys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AnyValue).map(Self)
    }
}

/// The result of checking that each key of an object appears once. The values are not kept.
pub(crate) struct CheckedKeys;

impl<'de> Deserialize<'de> for CheckedKeys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Check)
    }
}

struct Check;

impl<'de> Visitor<'de> for Check {
    type Value = CheckedKeys;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_unit<E: Error>(self) -> Result<CheckedKeys, E> {
        Ok(CheckedKeys)
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<CheckedKeys, E> {
        Ok(CheckedKeys)
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<CheckedKeys, E> {
        Ok(CheckedKeys)
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<CheckedKeys, E> {
        Ok(CheckedKeys)
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<CheckedKeys, E> {
        Ok(CheckedKeys)
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<CheckedKeys, E> {
        Ok(CheckedKeys)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<CheckedKeys, A::Error> {
        while access.next_element::<CheckedKeys>()?.is_some() {}
        Ok(CheckedKeys)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<CheckedKeys, A::Error> {
        let mut keys = BTreeSet::new();
        while let Some(key) = access.next_key::<String>()? {
            access.next_value::<CheckedKeys>()?;
            if keys.contains(&key) {
                return Err(stands_twice(&key));
            }
            keys.insert(key);
        }
        Ok(CheckedKeys)
    }
}

/// The error for a key that appears twice.
pub(super) fn stands_twice<E: Error>(key: &str) -> E {
    E::custom(format!("the key {key:?} appears twice"))
}

struct AnyValue;

impl<'de> Visitor<'de> for AnyValue {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_unit<E: Error>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Value, E> {
        Ok(Number::from_f64(value).map_or(Value::Null, Value::Number))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_string<E: Error>(self, value: String) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Value, A::Error> {
        let mut values = Vec::new();
        while let Some(UniqueKeys(value)) = access.next_element()? {
            values.push(value);
        }
        Ok(Value::Array(values))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Value, A::Error> {
        let mut values = Map::new();
        while let Some(key) = access.next_key::<String>()? {
            if values.contains_key(&key) {
                return Err(stands_twice(&key));
            }
            let UniqueKeys(value) = access.next_value()?;
            values.insert(key, value);
        }
        Ok(Value::Object(values))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_json_is_what_it_was() {
        let text = r#"{"a": [1, -2, 2.5, 1e300, null, true, "x"], "b": {"a": {}}, "c": 18446744073709551615}"#;
        let UniqueKeys(value) = serde_json::from_str(text).unwrap();
        assert_eq!(value, serde_json::from_str::<Value>(text).unwrap());
        assert!(serde_json::from_str::<CheckedKeys>(text).is_ok());
    }

    #[test]
    fn a_key_that_stands_twice_is_refused_with_its_place() {
        for text in [r#"{"a": 1, "a": 1}"#, r#"[{"b": {"a": 1, "a": 2}}]"#, r#"{"a":1,"\u0061":2}"#]
        {
            let error = serde_json::from_str::<UniqueKeys>(text).err().unwrap().to_string();
            assert!(error.contains("the key \"a\" appears twice at line 1"), "{error}");
            let checked = serde_json::from_str::<CheckedKeys>(text).err().unwrap().to_string();
            assert!(checked.contains("the key \"a\" appears twice at line 1"), "{checked}");
        }
    }
}

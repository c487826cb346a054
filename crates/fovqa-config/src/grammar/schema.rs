//! Makes the JSON Schema of the grammar, for editors.

use fovqa_emulate::EmulationSpec;
use fovqa_gallery::BuiltinSpec;
use fovqa_metrics::Metric;
use fovqa_params::ParamInfo;
use fovqa_vision::displays;
use serde_json::{Map, Value, json};

use super::emulate;
use super::{CURVES, EXPERIMENT, Key, Kind, LONGEST_TEXT, Model, STUDY, SWEEP_RANGE, parameter};

/// Whole numbers from 1 on, as regular expressions.
const TO_100000: &str = "([1-9][0-9]{0,4}|100000)";
const TO_32768: &str =
    "([1-9][0-9]{0,3}|[12][0-9]{4}|3[01][0-9]{3}|32[0-6][0-9]{2}|327[0-5][0-9]|3276[0-8])";

/// The JSON Schema of an experiment file.
pub fn schema() -> Value {
    let about = "Scenes, methods and metrics of one fovqa experiment (TOML)";
    headed(table(EXPERIMENT), "fovqa experiment", about)
}

/// The JSON Schema of a curves file.
pub fn curves_schema() -> Value {
    let about =
        "Foveation methods compared with acuity: curves, figures and tables of fovqa (TOML)";
    headed(table(CURVES), "fovqa curves", about)
}

/// The JSON Schema of a study file.
pub fn study_schema() -> Value {
    let about = "Analyses of user studies of fovqa (TOML)";
    headed(table(STUDY), "fovqa study", about)
}

fn headed(mut schema: Value, title: &str, description: &str) -> Value {
    let head = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "description": description,
    });
    if let (Value::Object(schema), Value::Object(head)) = (&mut schema, head) {
        schema.extend(head);
    }
    schema
}

fn table(keys: &[Key]) -> Value {
    let properties: Map<String, Value> = keys
        .iter()
        .map(|key| {
            let mut value = kind(&key.kind);
            value["description"] = key.about.into();
            (key.name.to_owned(), value)
        })
        .collect();
    let required: Vec<&str> = keys.iter().filter(|key| key.required).map(|key| key.name).collect();
    let mut schema =
        json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        schema["required"] = required.into();
    }
    schema
}

fn kind(kind: &Kind) -> Value {
    /// A pattern for names: no slash or control character, no dot or space at the start, and no
    /// space at the end.
    const NAME: &str = r"^[^\s./\\\u0000-\u001f\u007f-\u009f]([^/\\\u0000-\u001f\u007f-\u009f]*[^\s/\\\u0000-\u001f\u007f-\u009f])?$";
    const TEXT: &str = r"^[^\u0000-\u001f\u007f-\u009f]+$";
    match kind {
        Kind::Bool => json!({ "type": "boolean" }),
        Kind::Text => json!({ "type": "string", "pattern": TEXT, "maxLength": LONGEST_TEXT }),
        Kind::Name => json!({ "type": "string", "pattern": NAME, "maxLength": 80 }),
        Kind::Number(min, max) => {
            let mut schema = json!({ "type": "number" });
            if min.is_finite() {
                schema["minimum"] = number(*min);
            }
            if max.is_finite() {
                schema["maximum"] = number(*max);
            }
            schema
        }
        Kind::Above(min, max) => {
            json!({ "type": "number", "exclusiveMinimum": number(*min), "maximum": number(*max) })
        }
        Kind::Whole(min, max) => json!({ "type": "integer", "minimum": min, "maximum": max }),
        Kind::NumberOr(min, max, word) => either(&Kind::Number(*min, *max), word),
        Kind::WholeOr(min, max, word) => either(&Kind::Whole(*min, *max), word),
        Kind::Word(_) | Kind::Words(_) => json!({ "enum": kind.words() }),
        Kind::Frames => json!({
            "type": "string",
            "pattern": r"^(-?[0-9]{1,18})?\.\.(=?-?[0-9]{1,18})?(:0{0,9}[1-9][0-9]{0,8})?$"
        }),
        Kind::Display => {
            // Users may write `-` or `_`.
            let names = displays().iter().map(|display| display.name.clone());
            let all = names.flat_map(|name| [name.replace('_', "-"), name]);
            let mut all: Vec<String> = all.collect();
            all.dedup();
            json!({ "enum": all })
        }
        Kind::Metric => json!({ "enum": Metric::ALL.map(Metric::key) }),
        Kind::Resolution(most) => {
            let side = if *most == BuiltinSpec::MOST_SIDE { TO_32768 } else { TO_100000 };
            json!({ "type": "string", "pattern": format!(r"^ *0*{side} *[x×] *0*{side} *$") })
        }
        Kind::Method | Kind::Acuity => {
            let models = kind.models().map(|(_, models)| models).unwrap_or_default();
            json!({ "anyOf": models.iter().map(|model| self::model(*model)).collect::<Vec<_>>() })
        }
        Kind::Emulation => {
            json!({ "anyOf": emulate::models().iter().map(emulation).collect::<Vec<_>>() })
        }
        Kind::List(of, min, max) => {
            json!({ "type": "array", "items": self::kind(of), "minItems": min, "maxItems": max })
        }
        Kind::Table(keys) => table(keys),
        Kind::Texts => json!({ "type": "object", "additionalProperties": { "type": "string" } }),
        Kind::Tables(keys, most) => {
            json!({ "type": "array", "items": table(keys), "minItems": 1, "maxItems": most })
        }
        Kind::Metrics => {
            let mut schema = table(&[]);
            schema["minProperties"] = 1.into();
            for metric in Metric::ALL {
                let mut params = params(metric.info().params);
                params["description"] = metric.info().about.into();
                schema["properties"][metric.key()] = params;
            }
            schema
        }
        Kind::Sweep => {
            let list = json!({ "type": "array", "minItems": 1 });
            let values = json!([list, table(SWEEP_RANGE), { "type": "object" }]);
            json!({ "type": "object", "minProperties": 1, "additionalProperties": { "anyOf": values } })
        }
        Kind::Either(kinds) => json!({ "anyOf": kinds.iter().map(self::kind).collect::<Vec<_>>() }),
    }
}

fn params(known: &[ParamInfo]) -> Value {
    let mut params = table(&[]);
    for param in known {
        let mut value = self::kind(&parameter(param.values));
        value["description"] = param.about.into();
        params["properties"][param.name] = value;
    }
    params
}

/// The table of an emulated method.
fn emulation(spec: &EmulationSpec) -> Value {
    let mut schema = table(&[]);
    for (name, info) in spec.settable() {
        let mut value = self::kind(&parameter(info.values));
        value["description"] = info.about.into();
        schema["properties"][name] = value;
    }
    for key in emulate::keys(false) {
        let mut value = self::kind(&key.kind);
        value["description"] = key.about.into();
        schema["properties"][key.name] = value;
    }
    // The same names again: the whole tables would double the schema.
    let names = spec.settable().into_iter().map(|(name, _)| name);
    let names = names.chain(emulate::keys(true).map(|key| key.name.to_owned()));
    let names = names.collect::<Vec<String>>();
    schema["properties"][emulate::OTHER_EYE] =
        json!({ "type": "object", "propertyNames": { "enum": names } });
    schema["properties"][emulate::OTHER_EYE]["description"] = emulate::OTHER_EYE_ABOUT.into();
    schema["properties"]["model"] = spellings(spec.key());
    schema["required"] = json!(["model"]);
    schema
}

/// The spellings of a model's name: users may write `-` or `_`.
fn spellings(name: &str) -> Value {
    let mut names = vec![name.to_owned(), name.replace('_', "-")];
    names.dedup();
    json!({ "enum": names })
}

fn model((name, known): Model) -> Value {
    let mut schema = params(known);
    schema["properties"]["model"] = spellings(name);
    schema["required"] = json!(["model"]);
    schema
}

fn either(kind: &Kind, word: &str) -> Value {
    json!({ "anyOf": [self::kind(kind), { "enum": [word] }] })
}

/// A number as JSON. Integers have no fraction, as people write them.
fn number(n: f64) -> Value {
    if n.fract() == 0.0 && n.abs() < 1e15 { (n as i64).into() } else { n.into() }
}

//! An experiment with all its defaults written out, as it is stored in run.json.

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_io::{DepthChannels, MotionChannels, NamedMotion};
use fovqa_metrics::Metric;
use fovqa_params::{ParamValue, Words};
use fovqa_plausibility::Plausibility;
use fovqa_vision::{Eotf, Luminance, ViewSpec};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::emulation::emulation_keys;
use crate::experiment::Experiment;
use crate::eye::Eye;
use crate::figures::FigureSettings;
use crate::gates::GateRule;
use crate::plan::{EyeView, MetricChoice, Plan};
use crate::plots::Plot;
use crate::report::ReportSettings;
use crate::settings::{Gaze, Settings};
use crate::source::SourceSpec;
use crate::study::OpinionScores;
use crate::sweep::Sweep;

/// A resolved experiment. Paths are relative to the folder of its file if they are inside it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Resolved {
    /// Name of the experiment.
    pub name: String,
    /// Description of what it shows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<String>,
    /// The scenes, in order.
    pub scenes: Vec<ResolvedScene>,
    /// The methods, in order.
    pub methods: Vec<String>,
    /// The methods that are swept, with the points of each grid among the methods.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sweeps: Vec<Sweep>,
    /// Every metric by its key, with all its parameters.
    pub metrics: BTreeMap<String, BTreeMap<String, Value>>,
    /// The keys of the metrics in the order of the file, if it is not that of [`Metric::ALL`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub metric_order: Vec<String>,
    /// Whether these are the default metrics, without those that do not fit.
    pub default_metrics: bool,
    /// The selected frames of each scene; `None` for all.
    pub frames: Option<String>,
    /// Tables and figures; if empty, all that fit are made.
    pub plots: Vec<Plot>,
    /// How figures are printed if the file requests none.
    #[serde(default, skip_serializing_if = "FigureSettings::is_default")]
    pub figures: FigureSettings,
    /// The rules of the gate.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gates: Vec<GateRule>,
    /// Mean opinion scores that the metrics are compared with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub study: Option<OpinionScores>,
    /// Whether names in CSV files are protected so that a spreadsheet does not read them as
    /// formulas.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub spreadsheet_safe: bool,
    /// What the report shows of the frames.
    #[serde(default, skip_serializing_if = "ReportSettings::is_default")]
    pub report: ReportSettings,
    /// The keys of the metrics whose maps are written for every frame.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub maps: Vec<String>,
}

/// A scene with its defaults written out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResolvedScene {
    /// Name of the scene.
    pub name: String,
    /// The selected frames; `None` for all.
    pub frames: Option<String>,
    /// Whether frames without a partner are ignored.
    pub allow_missing: bool,
    /// Frames per second.
    pub fps: Option<f64>,
    /// One view, or the views of the left and the right eye.
    pub eyes: Vec<ResolvedEye>,
}

/// What one eye sees of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResolvedEye {
    /// The eye; `None` if the scene has one image per frame.
    pub eye: Option<Eye>,
    /// The reference.
    pub reference: String,
    /// What a built-in reference is made of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub builtin: Option<Value>,
    /// The tests that are read, by the name of the method.
    pub tests: BTreeMap<String, String>,
    /// The methods that are emulated, by their names, with all their parameters.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub emulations: BTreeMap<String, Value>,
    /// The colour layer of a method's tests, by the name of the method, if it differs from that of
    /// the reference.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub test_layers: BTreeMap<String, String>,
    /// View, gaze and bands, with the keys of `[view]`.
    pub view: Value,
    /// How files are read, with the keys of `[signal]`.
    pub signal: Value,
}

impl Resolved {
    /// All metrics, those that the file names first and in its order.
    pub fn metrics_in_order(&self) -> Vec<Metric> {
        let place = |metric: &Metric| {
            let key = metric.key();
            self.metric_order.iter().position(|k| k == key).unwrap_or(usize::MAX)
        };
        let mut metrics = Metric::ALL.to_vec();
        metrics.sort_by_key(place);
        metrics
    }

    /// Describes the difference from another experiment: metrics, parameters, scenes, methods, or
    /// how scenes are seen and read. `None` if they are the same.
    pub fn differs(&self, other: &Self) -> Option<String> {
        let names = |resolved: &Self| resolved.scenes.iter().map(|s| s.name.clone()).collect();
        let scenes: [Vec<String>; 2] = [names(self), names(other)];
        let keys = |resolved: &Self| json!(resolved.metrics.keys().collect::<Vec<_>>());
        let whole = [
            ("scenes", json!(scenes[0]), json!(scenes[1])),
            ("methods", json!(self.methods), json!(other.methods)),
            ("metrics", keys(self), keys(other)),
        ];
        let whole = whole.into_iter().find(|(_, a, b)| a != b);
        let whole = whole.map(|(key, a, b)| format!("it has the {key} {a} instead of {b}"));
        let metric = |(key, parameters): (&String, &BTreeMap<String, Value>)| {
            other_parameter(key, parameters, other.metrics.get(key)?)
        };
        whole
            .or_else(|| self.metrics.iter().find_map(metric))
            .or_else(|| self.taken_otherwise(other))
    }

    /// Describes how the scenes that two experiments share are seen or read differently in the
    /// other one; `None` if they are not.
    pub fn taken_otherwise(&self, other: &Self) -> Option<String> {
        let said = |key: &str, was: &Value, place: &str, is: &Value| {
            format!("it has {key} = {was}{place} instead of {is}")
        };
        if self.frames != other.frames {
            return Some(said("--frames", &json!(self.frames), "", &json!(other.frames)));
        }
        self.scenes.iter().find_map(|scene| {
            let now = other.scenes.iter().find(|now| now.name == scene.name)?;
            let whole = [
                ("frames", json!(scene.frames), json!(now.frames)),
                ("fps", json!(scene.fps), json!(now.fps)),
                ("eyes", json!(scene.eyes.len()), json!(now.eyes.len())),
            ];
            let whole = whole.into_iter().map(|(key, was, is)| (key.to_owned(), was, is));
            let eyes = scene.eyes.iter().zip(&now.eyes);
            let keys = eyes.flat_map(|(was, is)| {
                let layers = [was, is].map(|eye| json!(eye.test_layers));
                let builtin = [was, is].map(|eye| json!({ "builtin": eye.builtin }));
                [
                    table_keys("view", &was.view, &is.view),
                    table_keys("signal", &was.signal, &is.signal),
                    table_keys("layer of method", &layers[0], &layers[1]),
                    table_keys("scene", &builtin[0], &builtin[1]),
                ]
            });
            let keys = keys.flatten();
            let (key, was, is) = whole.chain(keys).find(|(_, was, is)| !alike(was, is))?;
            Some(said(&key, &was, &format!(" in scene {}", scene.name), &is))
        })
    }
}

/// Describes the first parameter of a metric that has another value.
pub fn other_parameter(
    metric: &str,
    before: &BTreeMap<String, Value>,
    now: &BTreeMap<String, Value>,
) -> Option<String> {
    now.iter().find_map(|(name, is)| {
        let was = before.get(name).unwrap_or(&Value::Null);
        (!alike(was, is)).then(|| format!("it has {metric}.{name} = {was} instead of {is}"))
    })
}

/// The keys of a table of settings, with the old and the new value of each.
fn table_keys(table: &str, was: &Value, is: &Value) -> Vec<(String, Value, Value)> {
    let (Value::Object(was), Value::Object(is)) = (was, is) else { return Vec::new() };
    let keys = was.keys().chain(is.keys().filter(|key| !was.contains_key(*key)));
    let of = |map: &serde_json::Map<String, Value>, key: &str| {
        map.get(key).cloned().unwrap_or(Value::Null)
    };
    keys.map(|key| (format!("{table}.{key}"), of(was, key), of(is, key))).collect()
}

/// Whether two values are the same. `1` and `1.0` count as the same.
fn alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            a.as_f64().map(f64::to_bits) == b.as_f64().map(f64::to_bits)
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| alike(a, b)))
        }
        (a, b) => a == b,
    }
}

impl Experiment {
    /// The experiment with all its defaults written out.
    pub fn resolved(&self) -> Resolved {
        let plan = &self.plan;
        let scenes = plan.scenes.iter().map(|scene| ResolvedScene {
            name: scene.name.clone(),
            frames: scene.frames.map(|range| range.to_string()),
            allow_missing: scene.allow_missing,
            fps: scene.fps,
            eyes: scene.eyes.iter().map(|eye| resolved_eye(plan, eye)).collect(),
        });
        let params = |&metric: &Metric| {
            let params = metric.info().params.iter().map(|param| {
                let value = plan.params.value(metric, param.name).map(param_value);
                (param.name.to_owned(), value.unwrap_or_else(|| literal(param.default)))
            });
            (metric.key().to_owned(), params.collect())
        };
        Resolved {
            name: self.name.clone(),
            about: self.about.clone(),
            scenes: scenes.collect(),
            methods: plan.methods.clone(),
            sweeps: plan.sweeps.clone(),
            metrics: plan.metrics.metrics().iter().map(params).collect(),
            metric_order: if self.metric_order.is_sorted() {
                Vec::new()
            } else {
                self.metric_order.iter().map(|metric| metric.key().to_owned()).collect()
            },
            default_metrics: plan.metrics == MetricChoice::Default,
            frames: plan.frames.map(|range| range.to_string()),
            plots: self.plots.clone(),
            figures: self.figures.clone(),
            gates: self.gates.clone(),
            study: self.study.clone(),
            spreadsheet_safe: self.output.spreadsheet_safe,
            report: self.report.clone(),
            maps: self.output.maps.iter().map(|metric| metric.key().to_owned()).collect(),
        }
    }
}

/// Parses a default from the registry. It is written in TOML; numbers, lists and quoted words are
/// the same in JSON.
fn literal(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|_| text.into())
}

fn param_value(value: &ParamValue) -> Value {
    match value {
        ParamValue::Number(number) => json!(number),
        ParamValue::Text(text) => json!(text),
        ParamValue::List(list) => json!(list),
        ParamValue::Pairs(pairs) => json!(pairs),
        ParamValue::Flag(flag) => json!(flag),
    }
}

fn resolved_eye(plan: &Plan, eye: &EyeView) -> ResolvedEye {
    let settings = &eye.settings;
    let mut view = match &settings.view {
        None => json!({}),
        Some(spec) => view_keys(spec),
    };
    if let Some(luminance) = settings.photometry() {
        view["luminance"] = luminance_keys(&luminance);
    }
    view["gaze"] = match &settings.gaze {
        Gaze::Centre => json!("center"),
        Gaze::Builtin => json!("builtin"),
        Gaze::Point(point) => json!(point),
        Gaze::Each(points) => json!(points),
        Gaze::Trace { path, hold } => json!({ "trace": plan.shown(path), "hold": hold }),
    };
    view["eccentricity"] = json!(settings.eccentricity);
    let edges = settings.bands.as_ref().map(|bands| {
        let last = bands.iter().last().map(|(_, to)| to);
        bands.iter().map(|(from, _)| from).chain(last).collect::<Vec<f64>>()
    });
    // Default bands depend on the frames. summary.json contains the bands that were used.
    view["bands_deg"] = json!(edges);
    let (signal, read) = (&settings.signal, &settings.read);
    let crop = settings.crop.map(|crop| [crop.x, crop.y, crop.width, crop.height]);
    let mut signal = json!({
        "channels": signal.channels,
        "exposure_stops": signal.exposure_stops,
        "tonemap": signal.tonemap,
        "transfer": signal.transfer.word(),
        "layer": read.layer,
        "nonfinite": settings.nonfinite,
        "alpha": read.alpha,
        "mask": settings.mask.as_ref().map(|path| plan.shown(path)),
        "crop": crop,
        "max_megapixels": read.max_megapixels,
        "motion": motion_keys(plan, settings),
        "depth": depth_keys(plan, settings),
    });
    // The default is not written, so that results are the same as those of earlier versions.
    if settings.plausibility != Plausibility::default() {
        signal["plausibility"] = json!(settings.plausibility);
    }
    // Keys that belong to one format are listed among the others, as in the experiment file.
    if let (Value::Object(keys), Ok(Value::Object(more))) =
        (&mut signal, serde_json::to_value(&read.formats))
    {
        keys.extend(more);
    }
    let mut tests = BTreeMap::new();
    let mut emulations = BTreeMap::new();
    for (index, test) in &eye.tests {
        let method = plan.methods[*index].clone();
        match test {
            SourceSpec::Emulated(emulation) => {
                emulations.insert(method, emulation_keys(emulation));
            }
            SourceSpec::Files(_) | SourceSpec::Given(_) | SourceSpec::Builtin(_) => {
                tests.insert(method, plan.shown_source(test));
            }
        }
    }
    ResolvedEye {
        eye: eye.eye,
        reference: plan.shown_source(&eye.reference),
        builtin: match &eye.reference {
            SourceSpec::Builtin(frames) => Some(json!(frames)),
            SourceSpec::Files(_) | SourceSpec::Given(_) | SourceSpec::Emulated(_) => None,
        },
        tests,
        emulations,
        test_layers: eye
            .test_layers
            .iter()
            .map(|(index, layer)| (plan.methods[*index].clone(), layer.clone()))
            .collect(),
        view,
        signal,
    }
}

fn motion_keys(plan: &Plan, settings: &Settings) -> Value {
    let mut keys = match &settings.guides.motion {
        MotionChannels::None => json!("none"),
        MotionChannels::Auto => json!("auto"),
        MotionChannels::Preset(preset) => json!(preset),
        MotionChannels::NamedAs(preset, channels) => {
            json!({ "channels": channels, "encoding": preset })
        }
        MotionChannels::Named(NamedMotion { channels, sign, scale, unit }) => json!({
            "channels": channels,
            "sign": sign,
            "scale": scale,
            "unit": unit,
        }),
    };
    with_files(&mut keys, plan, settings.motion_files.as_deref());
    keys
}

fn depth_keys(plan: &Plan, settings: &Settings) -> Value {
    let mut keys = match &settings.guides.depth {
        DepthChannels::None => json!("none"),
        DepthChannels::Auto => json!("auto"),
        DepthChannels::Preset(preset) => json!(preset),
        DepthChannels::Named(channel) => json!({ "channel": channel }),
    };
    with_files(&mut keys, plan, settings.depth_files.as_deref());
    keys
}

/// Adds the separate files in a table, as in the experiment file.
fn with_files(keys: &mut Value, plan: &Plan, files: Option<&Path>) {
    let Some(files) = files else { return };
    if let Value::String(word) = keys {
        *keys = match word.as_str() {
            "auto" | "none" => json!({}),
            preset => json!({ "preset": preset }),
        };
    }
    keys["files"] = json!(plan.shown(files));
}

fn luminance_keys(luminance: &Luminance) -> Value {
    let Luminance { peak_cd_m2, contrast, min_cd_m2, ambient_lux, reflectivity, eotf, gamma } =
        *luminance;
    let mut keys = json!({
        "peak_cd_m2": peak_cd_m2,
        "ambient_lux": ambient_lux,
        "reflectivity": reflectivity,
        "eotf": eotf,
    });
    // The black level in a dark room has priority over the contrast.
    match min_cd_m2 {
        Some(min) => keys["min_cd_m2"] = json!(min),
        None => keys["contrast"] = json!(contrast.unwrap_or(Luminance::CONTRAST)),
    }
    if eotf == Eotf::Gamma {
        keys["gamma"] = json!(gamma);
    }
    keys
}

fn view_keys(spec: &ViewSpec) -> Value {
    match spec {
        ViewSpec::Fov { horizontal_deg, vertical_deg } => {
            let mut view = json!({});
            for (key, fov) in
                [("fov_horizontal_deg", horizontal_deg), ("fov_vertical_deg", vertical_deg)]
            {
                if let Some(fov) = fov {
                    view[key] = json!(fov);
                }
            }
            view
        }
        ViewSpec::FovDiagonal { diagonal_deg } => json!({ "fov_diagonal_deg": diagonal_deg }),
        ViewSpec::Frustum { left, right, up, down } => {
            json!({ "frustum": { "left": left, "right": right, "up": up, "down": down } })
        }
        ViewSpec::PixelPitch { distance_m, pitch_mm } => {
            json!({ "distance_m": distance_m, "pixel_pitch_mm": pitch_mm })
        }
        ViewSpec::Screen { distance_m, size_m } => {
            json!({ "distance_m": distance_m, "screen_m": size_m })
        }
        ViewSpec::Display(display) => json!({ "display": display.name }),
    }
}

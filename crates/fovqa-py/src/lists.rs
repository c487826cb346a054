//! The metrics, methods and displays that there are, as JSON: pairs of name and description, in their order.

use fovqa_emulate::EmulationSpec;
use fovqa_methods::Method;
use fovqa_metrics::{Better, Metric, MetricKind};
use fovqa_params::ParamInfo;
use fovqa_vision::displays as all_displays;
use pyo3::prelude::*;
use serde_json::{Value, json};

/// Parameters by name: default, description and possible values.
fn parameters(params: &[ParamInfo]) -> Value {
    let entry = |param: &ParamInfo| {
        let values = param.values.to_string();
        let of = json!({ "default": param.default, "about": param.about, "values": values });
        (param.name.to_owned(), of)
    };
    Value::Object(params.iter().map(entry).collect())
}

/// All metrics by name.
#[pyfunction]
pub(crate) fn metrics() -> String {
    let entry = |metric: Metric| {
        let info = metric.info();
        let of = json!({
            "label": info.label,
            "unit": info.unit,
            "kind": match info.kind {
                MetricKind::Fidelity => "fidelity",
                MetricKind::Profile => "profile",
                MetricKind::Temporal => "temporal",
            },
            "better": match info.better {
                Better::Higher => Some("higher"),
                Better::Lower => Some("lower"),
                Better::Neither => None,
            },
            "default": Metric::DEFAULT.contains(&metric),
            "per_band": info.per_band,
            "needs_view": info.needs.view,
            "needs_luminance": info.needs.luminance,
            "map": info.map.map(|map| map.name),
            "about": info.about,
            "source": info.source,
            "parameters": parameters(info.params),
        });
        json!([info.key, of])
    };
    Value::Array(Metric::ALL.into_iter().map(entry).collect()).to_string()
}

/// All foveation methods by name.
#[pyfunction]
pub(crate) fn methods() -> String {
    let of_curves: Vec<&str> = Method::all().iter().map(Method::key).collect();
    let emulated = EmulationSpec::methods();
    let infos =
        Method::all().into_iter().map(|method| method.info()).chain(emulated.iter().copied());
    let mut methods: Vec<(&str, Value)> = Vec::new();
    for info in infos {
        if methods.iter().any(|(known, _)| *known == info.key) {
            continue;
        }
        let of = json!({
            "label": info.label,
            "curves": of_curves.contains(&info.key),
            "emulated": emulated.iter().any(|known| known.key == info.key),
            "about": info.about,
            "source": info.source,
            "parameters": parameters(info.params),
        });
        methods.push((info.key, of));
    }
    json!(methods).to_string()
}

/// All displays by name.
#[pyfunction]
pub(crate) fn displays() -> String {
    let entry = |display: &fovqa_vision::Display| {
        let of = json!({
            "resolution": display.resolution,
            "geometry": display.geometry_in_words(),
            "pixels_per_degree": display.central_pixels_per_degree(),
            "peak_cd_m2": display.luminance.map(|luminance| luminance.peak_cd_m2),
            "source": display.source,
        });
        json!([display.name.replace('_', "-"), of])
    };
    Value::Array(all_displays().iter().map(entry).collect()).to_string()
}

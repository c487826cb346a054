//! How one eye sees a scene, and how its frames are read, in words.

use fovqa_params::Words;
use fovqa_plan::{ResolvedEye, ResolvedScene};
use fovqa_results::ViewRecord;
use fovqa_vision::EccentricityKind;
use serde_json::Value;

use crate::overview::Measured;

/// A name with its value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Term {
    pub(super) name: String,
    pub(super) value: String,
}

impl Term {
    pub(super) fn new(name: impl Into<String>, value: impl Into<String>) -> Self {
        Self { name: name.into(), value: value.into() }
    }
}

/// The conditions of an eye in a scene. What was `measured` there says what the experiment left to
/// the frames: their size, the focal length, and the default bands.
pub(super) fn terms(
    scene: &ResolvedScene,
    eye: &ResolvedEye,
    measured: Option<&Measured>,
) -> Vec<Term> {
    let view = measured.and_then(|measured| measured.view.as_ref());
    let all = [
        ("Resolution", resolution(eye, view)),
        ("View", self::view(&eye.view)),
        ("Focal length", view.map(focal_length)),
        ("Gaze", Some(gaze(&eye.view["gaze"], view))),
        ("Eccentricity", view.map(|view| eccentricity(view.eccentricity))),
        ("Bands", measured.and_then(bands)),
        ("Display", luminance(&eye.view["luminance"])),
        ("Signal", Some(signal(&eye.signal))),
        ("Frames", Some(frames(scene, measured))),
    ];
    all.into_iter().filter_map(|(name, value)| Some(Term::new(name, value?))).collect()
}

/// A number with at most two decimals.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2}").parse().unwrap_or(value);
    rounded.to_string()
}

/// A word or number of a setting, as the experiment file writes it.
fn plain(value: &Value) -> String {
    match value {
        Value::String(word) => word.clone(),
        Value::Number(number) => {
            number.as_f64().map_or_else(|| number.to_string(), |n| n.to_string())
        }
        other => other.to_string(),
    }
}

fn resolution(eye: &ResolvedEye, view: Option<&ViewRecord>) -> Option<String> {
    let builtin = eye.builtin.as_ref().map(|builtin| &builtin["size"]);
    let of_builtin = builtin.and_then(|size| Some((size[0].as_u64()?, size[1].as_u64()?)));
    let of_view = view.map(|view| (view.width as u64, view.height as u64));
    of_view.or(of_builtin).map(|(width, height)| format!("{width} × {height} px"))
}

fn view(view: &Value) -> Option<String> {
    let number = |key: &str| view[key].as_f64();
    let mut parts: Vec<String> = Vec::new();
    parts.extend(view["display"].as_str().map(|name| format!("display {name}")));
    for (key, name) in [
        ("fov_horizontal_deg", "horizontally"),
        ("fov_vertical_deg", "vertically"),
        ("fov_diagonal_deg", "diagonally"),
    ] {
        parts.extend(number(key).map(|degrees| format!("{degrees}° {name}")));
    }
    if let Value::Object(sides) = &view["frustum"] {
        let sides = sides.iter().map(|(side, value)| format!("{side} {}", plain(value)));
        parts.push(format!("frustum {}", sides.collect::<Vec<_>>().join(", ")));
    }
    parts.extend(number("pixel_pitch_mm").map(|pitch| format!("pixels of {pitch} mm")));
    match &view["screen_m"] {
        Value::Null => {}
        size => parts.push(format!("screen of {} m", sides_of(size))),
    }
    parts.extend(number("distance_m").map(|distance| format!("from {distance} m")));
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// Width and height, or whatever else stands for a size.
fn sides_of(size: &Value) -> String {
    match size {
        Value::Array(sides) => sides.iter().map(plain).collect::<Vec<_>>().join(" × "),
        size => plain(size),
    }
}

fn focal_length(view: &ViewRecord) -> String {
    let [x, y] = view.focal_px;
    if x.to_bits() == y.to_bits() {
        format!("{} px", short(x))
    } else {
        format!("{} px along x, {} px along y", short(x), short(y))
    }
}

fn gaze(gaze: &Value, view: Option<&ViewRecord>) -> String {
    let place =
        view.map(|ViewRecord { gaze_px: [x, y], .. }| format!("({}, {}) px", short(*x), short(*y)));
    let at = |moves: bool| {
        let first = if moves { "at first " } else { "at " };
        place.as_ref().map(|place| format!(", {first}{place}")).unwrap_or_default()
    };
    match gaze {
        Value::String(word) if word == "center" => format!("the centre of the view{}", at(false)),
        Value::String(word) if word == "builtin" => {
            format!("of the built-in viewer{}", at(true))
        }
        Value::Array(point) => {
            let point = point.iter().map(plain).collect::<Vec<_>>().join(", ");
            format!("fixed at ({point}) px")
        }
        Value::Object(keys) => {
            let hold = keys.get("hold") == Some(&Value::Bool(true));
            let hold = if hold { ", the last one held" } else { "" };
            format!("trace {}{hold}{}", plain(&gaze["trace"]), at(true))
        }
        other => plain(other),
    }
}

fn eccentricity(kind: EccentricityKind) -> String {
    format!("{}: {}", kind.word(), lower_case(kind.about()))
}

/// A text as the end of a sentence.
fn lower_case(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().map(|first| first.to_lowercase().to_string()).unwrap_or_default();
    first + rest.as_str()
}

fn bands(measured: &Measured) -> Option<String> {
    let bands = &measured.bands;
    let last = bands.last().map(|band| band.to_deg);
    let edges = bands.iter().map(|band| band.from_deg).chain(last);
    let edges: Vec<String> = edges.map(|edge| format!("{edge}°")).collect();
    (!edges.is_empty()).then(|| format!("edges {}", edges.join(", ")))
}

fn luminance(luminance: &Value) -> Option<String> {
    let number = |key: &str| luminance[key].as_f64();
    let peak = number("peak_cd_m2")?;
    let mut parts = vec![format!("white {peak} cd/m²")];
    parts.extend(number("min_cd_m2").map(|black| format!("black {black} cd/m²")));
    parts.extend(number("contrast").map(|contrast| format!("contrast {contrast} : 1")));
    if let Some(lux) = number("ambient_lux") {
        let reflected = number("reflectivity").filter(|_| lux > 0.0);
        let reflected =
            reflected.map(|share| format!(", of which it reflects {} %", short(100.0 * share)));
        parts.push(format!("ambient light {lux} lx{}", reflected.unwrap_or_default()));
    }
    parts.push(format!("EOTF {}", plain(&luminance["eotf"])));
    parts.extend(number("gamma").map(|gamma| format!("gamma {gamma}")));
    Some(parts.join(", "))
}

fn signal(signal: &Value) -> String {
    let mut parts = vec![
        format!("channels {}", plain(&signal["channels"])),
        format!("exposure {} stops", plain(&signal["exposure_stops"])),
        format!("tone map {}", plain(&signal["tonemap"])),
        format!("transfer {}", plain(&signal["transfer"])),
    ];
    if let Value::String(layer) = &signal["layer"] {
        parts.push(format!("layer {layer}"));
    }
    if let Value::Array(crop) = &signal["crop"] {
        let [x, y, width, height] =
            [0, 1, 2, 3].map(|i| crop.get(i).map(plain).unwrap_or_default());
        parts.push(format!("cropped to {width} × {height} px at ({x}, {y})"));
    }
    parts.join(", ")
}

fn frames(scene: &ResolvedScene, measured: Option<&Measured>) -> String {
    let scored = measured.map_or_else(|| "none".to_owned(), |measured| measured.frames.to_string());
    let selected = scene.frames.as_ref().map(|frames| format!(" (of {frames})"));
    let rate = scene.fps.map(|fps| format!(", {fps} per second"));
    format!("{scored}{}{}", selected.unwrap_or_default(), rate.unwrap_or_default())
}

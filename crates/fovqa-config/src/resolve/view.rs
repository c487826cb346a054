//! The ways to describe a view.

use fovqa_vision::{Eotf, Luminance, ViewSpec, find_display};

use crate::fault::{Fault, Faults};
use crate::node::Node;

/// The keys that describe a view, alone or in pairs.
const VIEW_WAYS: [&str; 8] = [
    "display",
    "fov_vertical_deg",
    "fov_horizontal_deg",
    "fov_diagonal_deg",
    "frustum",
    "distance_m",
    "pixel_pitch_mm",
    "screen_m",
];

/// The forms in which a view can be given.
pub(super) const VIEW_HELP: &str =
    "give one in [view], such as display = \"vive-pro-eye\" or fov_vertical_deg = 100";

/// Whether a table contains a view.
pub(super) fn gives_view(table: Node<'_>) -> bool {
    VIEW_WAYS.iter().any(|key| table.has(key))
}

/// The view in a table; `None` if there is none.
pub(super) fn view(table: Node<'_>, faults: &mut Faults) -> Option<ViewSpec> {
    let given: Vec<&str> = VIEW_WAYS.into_iter().filter(|key| table.has(key)).collect();
    let number = |key| table.number(key);
    let spec = match given.as_slice() {
        ["display"] => table.text("display").and_then(find_display).cloned().map(ViewSpec::Display),
        ["fov_vertical_deg" | "fov_horizontal_deg"]
        | ["fov_vertical_deg", "fov_horizontal_deg"] => Some(ViewSpec::Fov {
            horizontal_deg: number("fov_horizontal_deg"),
            vertical_deg: number("fov_vertical_deg"),
        }),
        ["fov_diagonal_deg"] => {
            number("fov_diagonal_deg").map(|diagonal_deg| ViewSpec::FovDiagonal { diagonal_deg })
        }
        ["frustum"] => table.table("frustum").and_then(|frustum| {
            let side = |key| frustum.number(key);
            Some(ViewSpec::Frustum {
                left: side("left")?,
                right: side("right")?,
                up: side("up")?,
                down: side("down")?,
            })
        }),
        ["distance_m", "pixel_pitch_mm"] => number("distance_m")
            .zip(number("pixel_pitch_mm"))
            .map(|(distance_m, pitch_mm)| ViewSpec::PixelPitch { distance_m, pitch_mm }),
        ["distance_m", "screen_m"] => number("distance_m")
            .zip(table.array("screen_m"))
            .map(|(distance_m, size_m)| ViewSpec::Screen { distance_m, size_m }),
        [alone @ ("distance_m" | "pixel_pitch_mm" | "screen_m")] => {
            let fault =
                Fault::new(table.span(alone), format!("{alone} alone does not define a view"));
            faults.push(fault.help("a flat screen needs distance_m with pixel_pitch_mm, or distance_m with screen_m = [width, height]"));
            return None;
        }
        [first, .., last] => {
            let message = format!("the view is given in more than one way: {}", given.join(", "));
            let fault = Fault::new(table.span(last), message);
            faults
                .push(fault.label(format!("given together with {first}")).help("keep one of them"));
            return None;
        }
        _ => None,
    };
    if let Some(Err(error)) = spec.as_ref().map(ViewSpec::check) {
        faults.push(Fault::new(table.span(given[0]), error.to_string()));
    }
    spec
}

/// The forms in which photometry can be given.
pub(super) const LUMINANCE_HELP: &str = "give luminance = { peak_cd_m2 = …, … } or luminance = \"htc-vive-pro\" in [view], or a display that has it (`fovqa list displays`)";

/// The photometry in a table; `None` if there is none.
pub(super) fn luminance(table: Node<'_>, faults: &mut Faults) -> Option<Luminance> {
    const KEY: &str = "luminance";
    if let Some(name) = table.text(KEY) {
        let luminance = find_display(name)?.luminance;
        if luminance.is_none() {
            let message = format!("the display {name} has no photometry");
            faults.push(Fault::new(table.span(KEY), message).help(LUMINANCE_HELP));
        }
        return luminance;
    }
    let given = table.table(KEY)?;
    let number = |key| given.number(key);
    let luminance = Luminance {
        contrast: number("contrast"),
        min_cd_m2: number("min_cd_m2"),
        ambient_lux: number("ambient_lux").unwrap_or(0.0),
        reflectivity: number("reflectivity").unwrap_or(Luminance::REFLECTIVITY),
        eotf: given.word("eotf").unwrap_or(Eotf::Srgb),
        gamma: number("gamma").unwrap_or(Luminance::GAMMA),
        ..Luminance::of_peak(number("peak_cd_m2")?)
    };
    if let Err(error) = luminance.check() {
        faults.push(Fault::new(table.span(KEY), error.to_string()));
    }
    Some(luminance)
}

//! A plot of frequency responses.

use fovqa_methods::Setting;
use fovqa_methods::curves::CurveSetting;
use fovqa_methods::sandbox::{F_MAX, FOVEAL, RATE, Sandbox, TRANSITION};
use fovqa_plan::ResponsePlot;

use super::screens::{Screens, once};
use crate::fault::{Fault, Faults};
use crate::node::Node;
use crate::resolve::metrics::param_value;

/// The keys that only this kind has.
pub(super) const KEYS: &[&str] =
    &["eccentricities_deg", "rate_arcmin", "foveal_deg", "transition_deg", "f_max"];

pub(super) fn response(
    root: Node<'_>,
    table: Node<'_>,
    faults: &mut Faults,
) -> Option<ResponsePlot> {
    let Some(eccentricities_deg) = table.numbers("eccentricities_deg") else {
        let message = "a plot of kind \"response\" needs eccentricities";
        let help = "write eccentricities_deg = [20, 30], one panel for each";
        faults.push(Fault::new(table.span("kind"), message).help(help));
        return None;
    };
    let mut sandbox = Sandbox::default();
    for info in [RATE, FOVEAL, TRANSITION, F_MAX] {
        // The grammar has checked the value.
        if let Some(value) = table.value(info.name).and_then(param_value) {
            sandbox.set(info.name, &value);
        }
    }
    let setting = setting(root, table, faults)?;
    let end_deg = setting.eccentricity_deg(setting.corner_px());
    if let Some(beyond) = eccentricities_deg.iter().find(|e| **e > end_deg) {
        let message =
            format!("no pixel is {beyond}° from the gaze: the last one is at {end_deg:.1}°");
        let fault = Fault::new(table.span("eccentricities_deg"), message);
        faults
            .push(fault.help("give smaller eccentricities, or move the gaze with gazes in [view]"));
    }
    let pixels_per_degree = setting.focal_px() * std::f64::consts::PI / 180.0;
    Some(ResponsePlot { eccentricities_deg: once(eccentricities_deg), sandbox, pixels_per_degree })
}

/// The screen and the gaze of the file.
fn setting(root: Node<'_>, table: Node<'_>, faults: &mut Faults) -> Option<Setting> {
    let screens = Screens { tables: [root.table("view"), None], of: "a plot of kind \"response\"" };
    let settings = screens.settings(&table.span("kind"), faults);
    let setting = match settings.first()?.setting() {
        Ok(setting) => setting,
        Err(error) => {
            faults.push(Fault::new(table.span("kind"), error.to_string()));
            return None;
        }
    };
    let same = |other: &CurveSetting| other.setting().is_ok_and(|other| other == setting);
    if !settings.iter().all(same) {
        let message =
            "a plot of kind \"response\" shows one screen and gaze, but [view] has several";
        let help = "give it a file with one resolution and one gaze";
        faults.push(Fault::new(table.span("kind"), message).help(help));
        return None;
    }
    Some(setting)
}

//! `--luminance`.

use fovqa_params::{Words, words_of};
use fovqa_vision::{Eotf, Luminance};

use super::display::display;
use super::no_such::no_such;
use super::values::finite;

/// The photometry of a preset, or keys as in an experiment.
pub(super) fn luminance(text: &str) -> Result<Luminance, String> {
    if !text.contains('=') {
        let display = display(text)?;
        let unknown = || format!("the photometry of {text} is not known");
        return display.luminance.ok_or_else(unknown);
    }
    let mut peak = None;
    let mut given = Luminance::of_peak(f64::NAN);
    for part in text.split(',') {
        let (key, value) =
            part.split_once('=').ok_or("write KEY=VALUE pairs, separated by commas")?;
        let (key, value) = (key.trim().replace('-', "_"), value.trim());
        if key == "eotf" {
            let names: Vec<String> = words_of::<Eotf>().into_iter().map(str::to_owned).collect();
            let found = Eotf::find(&value.to_lowercase());
            given.eotf = found.ok_or_else(|| no_such("eotf", value, &names))?;
            continue;
        }
        let number = finite(value).map_err(|_| format!("{key}: write a number"))?;
        match key.as_str() {
            "peak_cd_m2" => peak = Some(number),
            "contrast" => given.contrast = Some(number),
            "min_cd_m2" => given.min_cd_m2 = Some(number),
            "ambient_lux" => given.ambient_lux = number,
            "reflectivity" => given.reflectivity = number,
            "gamma" => given.gamma = number,
            _ => return Err(no_such("key", &key, &KEYS.map(str::to_owned))),
        }
    }
    let peak_cd_m2 = peak.ok_or("peak_cd_m2, the luminance of the display's white, is missing")?;
    let luminance = Luminance { peak_cd_m2, ..given };
    luminance.check().map_err(|error| error.to_string())?;
    Ok(luminance)
}

/// The keys that [`luminance`] accepts.
const KEYS: [&str; 7] =
    ["peak_cd_m2", "contrast", "min_cd_m2", "ambient_lux", "reflectivity", "eotf", "gamma"];

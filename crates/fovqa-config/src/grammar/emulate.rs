//! The keys of `emulate = { … }`: a method that is emulated from the reference.

use fovqa_emulate::{EmulationSpec, FilterChoice, Jitter, Sampling, Space};
use fovqa_methods::BudgetSamples;
use fovqa_params::words_of;
use fovqa_plan::Eye;

use super::keys::key;
use super::{Key, Kind};

/// The key of a budget.
pub(crate) const BUDGET: &str = "budget";

/// The word of a method that does not take the budget of the experiment.
const NO_BUDGET: &str = "none";

/// A share of the frame's pixels.
pub(super) const SHARE: Kind = Kind::Above(0.0, 1e4);

/// The budget of a method.
const OWN_BUDGET: [Kind; 2] = [SHARE, Kind::Word(&[NO_BUDGET])];

/// The keys that both eyes may have, beside the parameters of the model.
static AROUND: [Key; 8] = [
    key(
        "sampling",
        Kind::Words(words_of::<Sampling>),
        "how a sample reads the reference: point, or the mean of its area",
    ),
    key(
        "jitter",
        Kind::Words(words_of::<Jitter>),
        "how samples move within their cells from frame to frame: none or halton",
    ),
    key("filter", Kind::Words(words_of::<FilterChoice>), "which of the method's filters are on"),
    key("space", Kind::Words(words_of::<Space>), "the values that the method runs on"),
    key("temporal", Kind::Bool, "whether the temporal filter follows the method"),
    key("enhance", Kind::Number(0.0, 100.0), "strength f_max of contrast enhancement"),
    key(
        BUDGET,
        Kind::Either(&OWN_BUDGET),
        "samples as a share of the frame's pixels; sets the method's free parameter; \"none\": not that of the experiment",
    ),
    key(
        "budget_of",
        Kind::Words(words_of::<BudgetSamples>),
        "which samples a budget counts: all, or those that fall into the frame",
    ),
];

/// The keys of the whole method.
static WHOLE: [Key; 3] = [
    key("keep_frames", Kind::Bool, "whether the emulated frames are written beside the results"),
    key(
        "dominant",
        Kind::Words(words_of::<Eye>),
        "the eye that the parameters belong to, where other_eye or reproject is given; default: right",
    ),
    key(
        REPROJECT,
        Kind::Table(&REPROJECTION),
        "the eye that is not dominant takes what it can from the dominant eye's frame",
    ),
];

/// The name of the table of reprojection.
pub(crate) const REPROJECT: &str = "reproject";

static REPROJECTION: [Key; 2] = [
    key(
        "ipd_mm",
        Kind::Above(0.0, 1000.0),
        "distance between both eyes; default: 63, or that of a built-in scene",
    ),
    key("depth_m", Kind::Above(0.0, 1e6), "metres per unit of depth; default: 1"),
];

/// The name of the table with what differs for the other eye.
pub(crate) const OTHER_EYE: &str = "other_eye";

/// What `other_eye` is, for editors.
pub(super) const OTHER_EYE_ABOUT: &str = "what differs for the eye that is not the dominant one";

/// The keys beside the parameters of the model; for the other eye only those that it may have.
pub(super) fn keys(other_eye: bool) -> impl Iterator<Item = &'static Key> + Clone {
    AROUND.iter().chain(WHOLE.iter().filter(move |_| !other_eye))
}

/// The models that can be emulated.
pub(super) fn models() -> Vec<EmulationSpec> {
    let names = EmulationSpec::methods();
    names.into_iter().filter_map(|info| EmulationSpec::new(info.key).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_parameter_has_the_name_of_a_key() {
        for model in models() {
            let clash = |(name, _): &(String, _)| {
                name == "model" || name == OTHER_EYE || keys(false).any(|key| key.name == name)
            };
            assert!(!model.settable().iter().any(clash), "{}", model.key());
        }
    }
}

//! A method that is emulated from the reference.

use fovqa_emulate::{EmulationSpec, FilterChoice, Jitter, Sampling, Space};
use fovqa_methods::BudgetSamples;
use fovqa_params::Words;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::reprojection::{Reproject, Reprojection};

/// A method whose tests are emulated from the reference instead of being read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Emulation {
    /// The method, its parameters, and everything around it.
    pub spec: EmulationSpec,
    /// Whether the emulated frames are written to the folder of the results.
    pub keep_frames: bool,
    /// What it takes from the other eye, or gives to it.
    #[serde(default)]
    pub reprojection: Reprojection,
}

impl Emulation {
    /// How it takes what it can from the dominant eye, if it does.
    pub fn reproject(&self) -> Option<&Reproject> {
        match &self.reprojection {
            Reprojection::Takes(reproject) => Some(reproject),
            Reprojection::None | Reprojection::Gives => None,
        }
    }

    /// Whether its frames depend on the frames before: its own temporal filter, or that of the dominant
    /// eye whose frames it takes, is on.
    pub fn is_temporal(&self) -> bool {
        let dominant = self.reproject().is_some_and(|reproject| reproject.spec.is_temporal());
        self.spec.is_temporal() || dominant
    }

    /// Whether motion or depth of the reference are used.
    pub fn uses_guides(&self) -> bool {
        self.is_temporal() || self.reprojection != Reprojection::None
    }

    /// The method and what was set, in one line: `emulated: rmfr, sigma = 2.6`.
    pub fn in_words(&self) -> String {
        let spec = &self.spec;
        let set = spec.set_by_name().iter();
        let mut parts = vec![format!("emulated: {}", spec.key())];
        parts.extend(set.map(|(name, value)| format!("{name} = {}", value.in_words())));
        if spec.sampling() != Sampling::default() {
            parts.push(format!("sampling = \"{}\"", spec.sampling().word()));
        }
        if spec.jitter() != Jitter::default() {
            parts.push(format!("jitter = \"{}\"", spec.jitter().word()));
        }
        if spec.filters() != FilterChoice::default() {
            parts.push(format!("filter = \"{}\"", spec.filters().word()));
        }
        if spec.space() != Space::default() {
            parts.push(format!("space = \"{}\"", spec.space().word()));
        }
        if spec.is_temporal() && spec.key() != "taa" {
            parts.push("temporal = true".to_owned());
        }
        parts.extend(spec.enhance().map(|f_max| format!("enhance = {f_max}")));
        if let Some(budget) = spec.budget() {
            parts.push(format!("budget = {}", budget.share));
            if budget.of != BudgetSamples::default() {
                parts.push(format!("budget_of = \"{}\"", budget.of.word()));
            }
        }
        if let Some(Reproject { ipd_mm, depth_m, .. }) = self.reproject() {
            parts.push(format!("reproject = {{ ipd_mm = {ipd_mm}, depth_m = {depth_m} }}"));
        }
        parts.join(", ")
    }
}

impl From<EmulationSpec> for Emulation {
    fn from(spec: EmulationSpec) -> Self {
        Self { spec, keep_frames: false, reprojection: Reprojection::None }
    }
}

/// The keys of an emulation, with all its parameters, as in the experiment file.
pub fn emulation_keys(emulation: &Emulation) -> Value {
    let spec = &emulation.spec;
    let parameters = spec.parameters().into_iter();
    let parameters: Map<String, Value> =
        parameters.map(|(name, value)| (name, json!(value))).collect();
    let mut keys = json!({
        "model": spec.key(),
        "parameters": parameters,
        "sampling": spec.sampling(),
        "filter": spec.filters(),
        "space": spec.space(),
        "temporal": spec.is_temporal(),
    });
    if spec.jitter() != Jitter::default() {
        keys["jitter"] = json!(spec.jitter());
    }
    if let Some(f_max) = spec.enhance() {
        keys["enhance"] = json!(f_max);
    }
    if let Some(budget) = spec.budget() {
        keys["budget"] = json!(budget.share);
        keys["budget_of"] = json!(budget.of.word());
        keys["budget_parameter"] = json!(spec.free_parameter());
    }
    if let Some(reproject) = emulation.reproject() {
        keys["reproject"] = json!({
            "ipd_mm": reproject.ipd_mm,
            "depth_m": reproject.depth_m,
            "dominant": reproject.dominant,
        });
    }
    keys
}

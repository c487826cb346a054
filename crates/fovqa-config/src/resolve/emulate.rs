//! `emulate = { … }` of a method: what is emulated from the reference, for each eye.

use std::collections::BTreeSet;
use std::ops::Range;

use fovqa_emulate::{Budget, EmulateError, EmulationSpec};
use fovqa_params::{ParamValue, Words, words_of};
use fovqa_plan::{Emulation, Eye, EyeView, Reprojection, Scene, shown_value};

use super::metrics::param_value;
use super::reproject::{Geometry, Reproject};
use crate::fault::{Fault, Faults};
use crate::grammar::{BUDGET, OTHER_EYE, REPROJECT, quoted};
use crate::node::Node;

/// The parameter of VaFR that assumes what reprojection measures.
const ASSUMED_SHARE: &str = "reprojected_share";

/// An emulated method of the file.
pub(super) struct Emulated {
    /// For scenes with one image per frame, and for the dominant eye.
    dominant: EmulationSpec,
    /// For the other eye, if it differs.
    other: Option<EmulationSpec>,
    keep_frames: bool,
    dominant_eye: Eye,
    /// The keys that differ for the other eye.
    other_keys: BTreeSet<String>,
    /// Whether it has a budget of its own, or takes none.
    own_budget: bool,
    /// Whether the other eye takes what it can from the dominant one.
    reproject: Option<Reproject>,
    /// The position of the table.
    pub(super) span: Range<usize>,
    /// The position of the other eye's table.
    pub(super) other_span: Option<Range<usize>>,
}

impl Emulated {
    /// Reads the table; `None` if the grammar has refused its model.
    ///
    /// `common` is the budget of the experiment.
    pub(super) fn new(
        method: Node<'_>,
        common: Option<Budget>,
        faults: &mut Faults,
    ) -> Option<Self> {
        let node = method.table("emulate")?;
        let (span, place) = (method.span("emulate"), method.text("name").unwrap_or_default());
        let keep_frames = node.flag("keep_frames").unwrap_or(false);
        let mut spec = spec(&[node], faults)?;
        let other = node.table(OTHER_EYE);
        let mut other_spec = other.and_then(|other| self::spec(&[node, other], faults));
        let reproject = Reproject::new(node);
        if node.has("dominant") && other.is_none() && reproject.is_none() {
            let message = format!(
                "the dominant eye of method \"{place}\" says nothing without {OTHER_EYE} or {REPROJECT}"
            );
            let help =
                "add other_eye = { … } with what differs for the other eye, or leave dominant out";
            faults.push(Fault::new(node.span("dominant"), message).help(help));
        }
        for table in [Some(node), other].into_iter().flatten().filter(|_| reproject.is_some()) {
            if table.has(ASSUMED_SHARE) {
                let message = format!(
                    "method \"{place}\" has {ASSUMED_SHARE}, a share that is assumed, and {REPROJECT}, which \
                     measures it"
                );
                faults.push(Fault::new(table.span(ASSUMED_SHARE), message).help("leave one out"));
            }
        }
        for table in [Some(node), other].into_iter().flatten() {
            if table.has("budget_of") && !node.has("budget") && !table.has("budget") {
                let message = "budget_of needs a budget, but none is given";
                faults.push(Fault::new(table.span("budget_of"), message));
            }
        }
        let own_budget = [Some(node), other].into_iter().flatten().any(|table| table.has(BUDGET));
        for spec in [Some(&mut spec), other_spec.as_mut()].into_iter().flatten() {
            if let Some(budget) = common.filter(|_| !own_budget && spec.free_parameter().is_some())
            {
                // The grammar has checked the share.
                let _ = spec.set_budget(budget);
            }
            if let Err(error) = spec.check_budget() {
                let help = if own_budget {
                    "leave one of them out"
                } else {
                    "the budget is that of the experiment: leave the parameter out, or add budget = \"none\""
                };
                let message = format!("method \"{place}\": {error}");
                faults.push(Fault::new(span.clone(), message).help(help));
                break;
            }
        }
        Some(Self {
            dominant: spec,
            other_keys: other
                .iter()
                .flat_map(|other| other.entries())
                .map(|e| e.0.to_owned())
                .collect(),
            own_budget,
            other: other_spec,
            keep_frames,
            dominant_eye: node.word("dominant").unwrap_or(Eye::Right),
            reproject,
            span,
            other_span: other.map(|_| node.span(OTHER_EYE)),
        })
    }

    /// Whether it can take a budget of the whole experiment.
    pub(super) fn takes_common_budget(&self) -> bool {
        !self.own_budget && self.dominant.free_parameter().is_some()
    }

    /// The keys that can be swept.
    pub(super) fn sweepable(&self) -> Vec<String> {
        let parameters = self.dominant.settable().into_iter().map(|(name, _)| name);
        let around = AROUND_SWEPT.into_iter().map(str::to_owned);
        parameters.chain(around).collect()
    }

    /// The method at a point of a sweep. A key that differs for the other eye stays for that one.
    pub(super) fn at(&self, point: &[(&str, &ParamValue)]) -> Result<Self, String> {
        let mut at = Self {
            dominant: self.dominant.clone(),
            other: self.other.clone(),
            other_keys: BTreeSet::new(),
            reproject: self.reproject.clone(),
            span: self.span.clone(),
            other_span: self.other_span.clone(),
            ..*self
        };
        for (key, value) in point {
            set(&mut at.dominant, key, value)?;
            if let Some(other) = at.other.as_mut().filter(|_| !self.other_keys.contains(*key)) {
                set(other, key, value)?;
            }
        }
        for spec in [Some(&at.dominant), at.other.as_ref()].into_iter().flatten() {
            spec.check_budget().map_err(|error| error.to_string())?;
        }
        Ok(at)
    }

    /// What the eyes of a scene see, in their order, and what is wrong with that.
    pub(super) fn of_scene(
        &self,
        method: &str,
        scene: &Scene,
        faults: &mut Faults,
    ) -> Vec<Emulation> {
        let geometry = self.reproject.as_ref().and_then(|reproject| {
            reproject.of_scene(method, scene).map_err(|fault| faults.push(fault)).ok()
        });
        let of_eye = |view: &EyeView| {
            let is_other = view.eye.is_some_and(|eye| eye != self.dominant_eye);
            let reprojection = match geometry {
                None => Reprojection::None,
                Some(_) if !is_other => Reprojection::Gives,
                Some(Geometry { ipd_mm, depth_m }) => {
                    let (dominant, spec) = (self.dominant_eye, self.dominant.clone());
                    let reproject = fovqa_plan::Reproject { dominant, spec, ipd_mm, depth_m };
                    Reprojection::Takes(Box::new(reproject))
                }
            };
            let other = self.other.as_ref().filter(|_| is_other);
            let spec = other.unwrap_or(&self.dominant).clone();
            Emulation { spec, keep_frames: self.keep_frames, reprojection }
        };
        scene.eyes.iter().map(of_eye).collect()
    }
}

/// The keys beside parameters that can be swept.
const AROUND_SWEPT: [&str; 8] =
    ["sampling", "jitter", "filter", "space", "temporal", "enhance", BUDGET, "budget_of"];

/// Sets a key of a spec.
fn set(spec: &mut EmulationSpec, key: &str, value: &ParamValue) -> Result<(), String> {
    fn word<T: Words>(key: &str, value: &ParamValue) -> Result<T, String> {
        let text = shown_value(value);
        T::find(&text).ok_or_else(|| no_word(key, &text, &words_of::<T>()))
    }
    let number = || value.number().ok_or_else(|| format!("{key} must be a number"));
    let said = |done: Result<(), EmulateError>| done.map_err(|error| error.to_string());
    match key {
        "sampling" => spec.set_sampling(word(key, value)?),
        "jitter" => spec.set_jitter(word(key, value)?),
        "space" => spec.set_space(word(key, value)?),
        "filter" => said(spec.set_filters(word(key, value)?))?,
        "temporal" => {
            let on = value.flag().ok_or_else(|| format!("{key} must be true or false"))?;
            spec.set_temporal(on);
        }
        "enhance" => said(spec.set_enhance(number()?))?,
        BUDGET => {
            let of = spec.budget().map(|budget| budget.of).unwrap_or_default();
            said(spec.set_budget(Budget { share: number()?, of }))?;
        }
        "budget_of" => {
            let of = word(key, value)?;
            let share = spec.budget().ok_or("budget_of needs a budget")?.share;
            said(spec.set_budget(Budget { share, of }))?;
        }
        parameter => said(spec.set(parameter, value))?,
    }
    Ok(())
}

/// The words that a key of an emulated method may have, in a message.
fn no_word(key: &str, text: &str, words: &[&str]) -> String {
    format!("{key} cannot be \"{text}\": write one of {}", quoted(words.iter().copied()))
}

/// The spec of some tables, of which later ones override earlier ones.
fn spec(tables: &[Node<'_>], faults: &mut Faults) -> Option<EmulationSpec> {
    let mut spec = EmulationSpec::new(tables.first()?.text("model")?).ok()?;
    let before = faults.count();
    let mut said = |done: Result<(), EmulateError>, span: Range<usize>| {
        if let Err(error) = done {
            faults.push(Fault::new(span, error.to_string()));
        }
    };
    let settable = spec.settable();
    let is_parameter = |name: &str| settable.iter().any(|(known, _)| known == name);
    for table in tables {
        for (name, at, value) in table.entries().filter(|(name, ..)| is_parameter(name)) {
            if let Some(value) = param_value(value) {
                said(spec.set(name, &value), at);
            }
        }
    }
    // The last table that has a key decides.
    let of = |key: &str| tables.iter().rev().find(|table| table.has(key)).copied();
    if let Some(sampling) = of("sampling").and_then(|table| table.word("sampling")) {
        spec.set_sampling(sampling);
    }
    if let Some(jitter) = of("jitter").and_then(|table| table.word("jitter")) {
        spec.set_jitter(jitter);
    }
    if let Some(table) = of("filter")
        && let Some(filter) = table.word("filter")
    {
        said(spec.set_filters(filter), table.span("filter"));
    }
    if let Some(space) = of("space").and_then(|table| table.word("space")) {
        spec.set_space(space);
    }
    if let Some(on) = of("temporal").and_then(|table| table.flag("temporal")) {
        spec.set_temporal(on);
    }
    if let Some(table) = of("enhance")
        && let Some(f_max) = table.number("enhance")
    {
        said(spec.set_enhance(f_max), table.span("enhance"));
    }
    if let Some(table) = of("budget")
        && let Some(share) = table.number("budget")
    {
        let samples = of("budget_of").and_then(|table| table.word("budget_of"));
        let budget = Budget { share, of: samples.unwrap_or_default() };
        said(spec.set_budget(budget), table.span("budget"));
    }
    (faults.count() == before).then_some(spec)
}

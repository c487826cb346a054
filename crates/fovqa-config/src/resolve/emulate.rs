//! `emulate = { … }` of a method: what is emulated from the reference, for each eye.

use std::ops::Range;

use fovqa_emulate::{Budget, EmulateError, EmulationSpec};
use fovqa_plan::{Emulation, Eye, EyeView, Reprojection, Scene};

use super::metrics::param_value;
use super::reproject::{Geometry, Reproject};
use crate::fault::{Fault, Faults};
use crate::grammar::{OTHER_EYE, REPROJECT};
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
    /// Whether the other eye takes what it can from the dominant one.
    reproject: Option<Reproject>,
    /// The position of the table.
    pub(super) span: Range<usize>,
    /// The position of the other eye's table.
    pub(super) other_span: Option<Range<usize>>,
}

impl Emulated {
    /// Reads the table; `None` if the grammar has refused its model.
    pub(super) fn new(method: Node<'_>, faults: &mut Faults) -> Option<Self> {
        let node = method.table("emulate")?;
        let (span, place) = (method.span("emulate"), method.text("name").unwrap_or_default());
        let keep_frames = node.flag("keep_frames").unwrap_or(false);
        let spec = spec(&[node], faults)?;
        let other = node.table(OTHER_EYE);
        let other_spec = other.and_then(|other| self::spec(&[node, other], faults));
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
        Some(Self {
            dominant: spec,
            other: other_spec,
            keep_frames,
            dominant_eye: node.word("dominant").unwrap_or(Eye::Right),
            reproject,
            span,
            other_span: other.map(|_| node.span(OTHER_EYE)),
        })
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

//! The record of an emulation.

use fovqa_emulate::{BudgetReport, EmulationSpec};
use fovqa_engine::FoveatedFrame;
use fovqa_params::{ParamValue, Words};
use fovqa_results::{
    BudgetRecord, FOVEATE_SCHEMA, Failure, FoveateErrorRecord, FoveateRecord, FoveatedRecord,
    ViewRecord,
};
use fovqa_vision::{EccentricityKind, ViewSpec};

/// What the first frame determines.
#[derive(Debug)]
pub(super) struct First {
    view: Option<ViewRecord>,
    parameters: Vec<(String, ParamValue)>,
    budget: Option<BudgetRecord>,
}

impl First {
    pub(super) fn new(view: Option<&ViewSpec>, frame: &FoveatedFrame<'_>) -> Self {
        let (width, height) = (frame.before.width(), frame.before.height());
        let view = view.and_then(|view| view.resolve(width, height).ok());
        let view = view.map(|resolved| ViewRecord {
            width,
            height,
            focal_px: resolved.view.focal_px,
            gaze_px: frame.gaze_px,
            // Emulation measures angles as renderers do.
            eccentricity: EccentricityKind::Planar,
        });
        let budget = frame.emulator.budget().map(budget_record);
        // Enhancement may follow a parameter that was solved.
        let mut parameters = frame.emulator.spec().parameters();
        if let Some(budget) = &budget {
            for (name, value) in &mut parameters {
                if *name == budget.parameter {
                    *value = budget.value.clone();
                }
            }
        }
        Self { view, parameters, budget }
    }

    /// The budget of the first frame, if there is one.
    pub(super) fn budget(&self) -> Option<&BudgetRecord> {
        self.budget.as_ref()
    }
}

/// The record of all frames.
pub(super) fn record(
    spec: &EmulationSpec,
    first: Option<First>,
    frames: Vec<FoveatedRecord>,
    failures: &[Failure],
) -> FoveateRecord {
    let none = || First { view: None, parameters: spec.parameters(), budget: None };
    let First { view, parameters, budget } = first.unwrap_or_else(none);
    FoveateRecord {
        schema: FOVEATE_SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        method: spec.key().to_owned(),
        parameters,
        sampling: spec.sampling().word(),
        filter: spec.filters().word(),
        space: spec.space().word(),
        temporal: spec.is_temporal(),
        enhance: spec.enhance(),
        budget,
        view,
        frames,
        errors: failures
            .iter()
            .map(|failure| FoveateErrorRecord {
                frame: failure.frame,
                input: failure.reference.clone(),
                message: failure.message.clone(),
            })
            .collect(),
    }
}

/// The record of a frame.
pub(super) fn foveated_record(
    frame: &FoveatedFrame<'_>,
    output: String,
    buffer_files: Vec<String>,
    budget: Option<BudgetRecord>,
) -> FoveatedRecord {
    let counts = frame.emulator.counts();
    let pixels = frame.before.width() as f64 * frame.before.height() as f64;
    FoveatedRecord {
        frame: frame.frame,
        input: frame.input.to_owned(),
        output,
        buffer_files,
        gaze_px: frame.gaze_px,
        buffers: counts.buffers.clone(),
        samples: counts.samples,
        samples_on_screen: counts.samples_on_screen,
        samples_beyond: counts.samples_beyond,
        samples_share: counts.share(pixels),
        quads: counts.quads,
        budget,
    }
}

/// The record of a budget.
pub(super) fn budget_record(report: &BudgetReport) -> BudgetRecord {
    BudgetRecord {
        share: report.budget.share,
        of: report.budget.of.word(),
        parameter: report.parameter.to_owned(),
        value: report.value.clone(),
        ideal_share: report.ideal_share,
        rounded_share: report.rounded_share,
    }
}

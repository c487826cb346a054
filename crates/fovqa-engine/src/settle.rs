//! Selects the metrics that a view allows, before any pixel is read.

use fovqa_metrics::{Metric, MetricKind};
use fovqa_plan::{MetricChoice, Plan, Settings};
use fovqa_vision::ViewSpec;

use crate::error::{EngineError, no_view};
use crate::found::FoundView;

/// The metrics of a view, and the default metrics that are left out because there is no view.
///
/// # Errors
/// If the value of a parameter is not possible, or a requested metric needs a view and there is
/// none.
pub(crate) fn metrics(
    plan: &Plan,
    settings: &Settings,
) -> Result<(Vec<Metric>, Vec<Metric>), EngineError> {
    plan.params.check()?;
    if let Some(view) = &settings.view {
        view.check()?;
    } else if let Some(what) = settings.lacks_view()
        // Without metrics, only emulated methods use the gaze, and some of them need no view.
        && !plan.metrics.metrics().is_empty()
    {
        return Err(EngineError::NoView { what: what.to_owned() });
    }
    let lacking = |metric: &Metric| settings.view.is_none() && metric.info().needs.view;
    match &plan.metrics {
        MetricChoice::Named(named) => {
            let foveal: Vec<Metric> = named.iter().copied().filter(lacking).collect();
            if !foveal.is_empty() {
                return Err(no_view(&foveal));
            }
            check_light(named, settings)?;
            let mut metrics = named.clone();
            metrics.sort_unstable();
            metrics.dedup();
            Ok((metrics, Vec::new()))
        }
        MetricChoice::Default => {
            let (left_out, metrics) = Metric::DEFAULT.into_iter().partition(lacking);
            Ok((metrics, left_out))
        }
    }
}

impl FoundView {
    /// The metrics for frames that were found. A single frame has no temporal differences.
    pub(crate) fn metrics(&self, plan: &Plan) -> Result<(Vec<Metric>, Vec<Metric>), EngineError> {
        let settings = &plan.scenes[self.scene].eyes[self.eye].settings;
        let (mut metrics, left_out) = metrics(plan, settings)?;
        if plan.metrics == MetricChoice::Default && self.frames.len() < 2 {
            metrics.retain(|metric| !metric.is(MetricKind::Temporal));
        }
        Ok((metrics, left_out))
    }
}

/// Checks that luminance-based metrics have a display that can show the files.
fn check_light(metrics: &[Metric], settings: &Settings) -> Result<(), EngineError> {
    let of_light = metrics.iter().filter(|metric| metric.info().needs.luminance);
    let names: Vec<&str> = of_light.map(|metric| metric.info().label).collect();
    if names.is_empty() {
        return Ok(());
    }
    let what = names.join(" and ");
    match (settings.photometry(), settings.shown_wrongly()) {
        (None, _) => {
            let display = match &settings.view {
                Some(ViewSpec::Display(display)) => Some(display.name.clone()),
                _ => None,
            };
            Err(EngineError::NoLuminance { what, display })
        }
        (Some(_), Some(why)) => Err(EngineError::ShownWrongly { what, why }),
        (Some(_), None) => Ok(()),
    }
}

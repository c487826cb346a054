//! Which metrics a view allows, before a pixel is read.

use fovqa_metrics::{Metric, MetricKind};
use fovqa_plan::{MetricChoice, Plan, Settings};
use fovqa_vision::ViewSpec;

use crate::error::{EngineError, no_view};
use crate::found::FoundView;

/// The metrics of a view, and those of the default ones that are left out for want of one.
///
/// # Errors
/// When a parameter cannot be, or something that was asked for needs a view that is not there.
pub(crate) fn metrics(
    plan: &Plan,
    settings: &Settings,
) -> Result<(Vec<Metric>, Vec<Metric>), EngineError> {
    plan.params.check()?;
    if let Some(view) = &settings.view {
        view.check()?;
    } else if let Some(what) = settings.lacks_view() {
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
    /// The same for frames that were found: one alone has no differences over time.
    pub(crate) fn metrics(&self, plan: &Plan) -> Result<(Vec<Metric>, Vec<Metric>), EngineError> {
        let settings = &plan.scenes[self.scene].eyes[self.eye].settings;
        let (mut metrics, left_out) = metrics(plan, settings)?;
        if plan.metrics == MetricChoice::Default && self.frames.len() < 2 {
            metrics.retain(|metric| !metric.is(MetricKind::Temporal));
        }
        Ok((metrics, left_out))
    }
}

/// Whether what is of light has a display that can show the files.
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

//! `--metrics` and `--set`.

use clap::Args;
use fovqa_metrics::{Metric, ParamSet, Params};
use fovqa_params::ParamValue;
use fovqa_plan::MetricChoice;

use super::no_such::no_such;
use super::offered::{self, offering};
use super::values::literal;

#[derive(Debug, Args)]
#[command(next_help_heading = "Metrics")]
pub(crate) struct MetricArgs {
    /// Metrics to compute, separated by commas; `fovqa list metrics` shows all
    /// [default: mse,psnr,ssim,fpsnr,rms-contrast,haar and, for a sequence, atd; metrics that do not
    /// fit are left out]
    #[arg(long, value_name = "NAME,NAME,…", value_delimiter = ',', value_parser = offering(metric, offered::metrics), hide_possible_values = true)]
    metrics: Vec<Metric>,
    /// A parameter of a metric, such as ssim.sigma=1.5
    #[arg(long = "set", value_name = "METRIC.PARAM=VALUE", value_parser = assignment)]
    set: Vec<Assignment>,
}

#[derive(Debug, Clone)]
struct Assignment {
    metric: Metric,
    param: String,
    value: ParamValue,
}

fn metric(name: &str) -> Result<Metric, String> {
    Metric::find(name.trim())
        .ok_or_else(|| no_such("metric", name, &Metric::ALL.map(|m| m.key().replace('_', "-"))))
}

fn assignment(text: &str) -> Result<Assignment, String> {
    let form = || "write METRIC.PARAM=VALUE".to_owned();
    let (name, value) = text.split_once('=').ok_or_else(form)?;
    let (name, param) = name.trim().split_once('.').ok_or_else(form)?;
    let metric = metric(name)?;
    let value = literal(value.trim())?;
    // The value is checked here, where the argument is known. Later, only combinations of values
    // are checked.
    Params::default().set(metric, param, &value).map_err(|error| error.to_string())?;
    Ok(Assignment { metric, param: param.to_owned(), value })
}

impl MetricArgs {
    pub(crate) fn choice(&self) -> MetricChoice {
        if self.metrics.is_empty() {
            MetricChoice::Default
        } else {
            MetricChoice::Named(self.metrics.clone())
        }
    }

    pub(crate) fn params(&self) -> Result<ParamSet, String> {
        let mut params = ParamSet::default();
        for Assignment { metric, param, value } in &self.set {
            params.set(*metric, param, value).map_err(|error| error.to_string())?;
        }
        Ok(params)
    }
}

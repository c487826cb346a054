//! Draws a metric against eccentricity.

use fovqa::{Dialect, Metric};
use fovqa_params::Words;
use fovqa_plan::FigureFormat;
use fovqa_report::{Band, ProfileLine, profile_picture};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::document::Document;
use crate::error::wrong_request;
use crate::worker::work;

/// A line: its name, whether it belongs to the reference, and for each band its edges and its value.
type Line = (String, bool, Vec<(f64, f64, Option<f64>)>);

/// The figure of lines as a file: `svg`, `pdf` or `png`. `document` has an experiment with `[figures]`.
#[pyfunction]
pub(crate) fn profile<'py>(
    py: Python<'py>,
    document: &Bound<'py, PyDict>,
    metric: &str,
    lines: Vec<Line>,
    title: Option<String>,
    format: &str,
) -> PyResult<Bound<'py, PyBytes>> {
    let settings = Document::arguments(document)?.experiment()?.figures;
    let metric = Metric::find(metric)
        .ok_or_else(|| wrong_request(format!("there is no metric {metric}"), ""))?;
    let format = FigureFormat::find(format)
        .ok_or_else(|| wrong_request(format!("figures are svg, pdf or png, not {format}"), ""))?;
    let band = |(from_deg, to_deg, value)| Band { from_deg, to_deg, value, error: None };
    let line = |(name, is_reference, bands): Line| ProfileLine {
        name,
        is_reference,
        bands: bands.into_iter().map(band).collect(),
    };
    let lines: Vec<ProfileLine> = lines.into_iter().map(line).collect();
    let (drawn, _) = work(py, Dialect::Arguments, None, move |_| {
        profile_picture(metric, &lines, title.as_deref(), &settings, format)
    })?;
    let drawn = drawn.map_err(|error| {
        wrong_request(error.to_string(), "change width_in, height_in, aspect or font_pt")
    })?;
    let drawn = drawn.ok_or_else(|| {
        wrong_request(
            format!("{} has no values by eccentricity", metric.info().label),
            "score with a view, and with metrics that have values in bands",
        )
    })?;
    Ok(PyBytes::new(py, &drawn))
}

//! Finds figures that cannot have the size that was asked for before anything is scored. They are
//! laid out with the names of the experiment and made-up values.

use fovqa_metrics::Metric;
use fovqa_plan::{FigureSettings, Plot, PlotKind, Resolved};
use fovqa_plot::Printed;
use fovqa_results::{ExperimentRecord, Inputs, RUN_SCHEMA, RunRecord};

use crate::band_spread::BandSpread;
use crate::figures::{Source, default_plots};
use crate::frame_values::FrameValues;
use crate::overview::{Measured, Overview};
use crate::plot_figures::plot_figures;
use crate::print::{PNG_DPI, set_axes, style_of};
use crate::sheet::{NamedFigure, ReportError};

/// Figures of one plot that are laid out. The others differ only in the names of scenes.
const MOST_FIGURES: usize = 40;

/// A method in a scene that will be scored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExpectedScore {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: String,
    /// Number of frames.
    pub frames: usize,
    /// Whether the scene has a view, and so eccentricity bands.
    pub has_bands: bool,
}

/// The figures of an experiment that cannot have the size that was asked for: the first one of each
/// plot. `levels` is the number of levels of the wavelet.
pub fn impossible_figures(
    resolved: &Resolved,
    scores: &[ExpectedScore],
    metrics: &[Metric],
    levels: usize,
) -> Vec<ReportError> {
    let is_sized = |plot: &Plot| {
        let FigureSettings { width_in, height_in, aspect, .. } = plot.figure;
        let is_wide = matches!(plot.kind, PlotKind::Crops | PlotKind::Bars | PlotKind::Frames);
        is_wide || width_in.or(height_in).or(aspect).is_some()
    };
    let experiment =
        ExperimentRecord { file: String::new(), sha256: String::new(), text: String::new() };
    let run = RunRecord {
        schema: RUN_SCHEMA.to_owned(),
        version: String::new(),
        experiment,
        resolved: resolved.clone(),
        inputs: Inputs::default(),
        inputs_file: None,
        files: std::collections::BTreeMap::default(),
    };
    let mut overview = Overview::default();
    let mut values = FrameValues::default();
    for ExpectedScore { scene, method, frames, has_bands } in scores {
        let measured = Measured::expected(metrics, *frames, has_bands.then_some(levels));
        overview.insert(scene, method.clone(), measured);
        values.expect(scene, method, metrics);
    }
    let spread = BandSpread::default();
    let source =
        Source { run: &run, overview: &overview, values: &values, folder: None, spread: &spread };
    let plots = if resolved.plots.is_empty() {
        let plots = default_plots(&source).into_iter();
        plots.map(|plot| Plot { figure: resolved.figures.clone(), ..plot }).collect()
    } else {
        resolved.plots.clone()
    };
    let impossible = |plot: &Plot| {
        let mut figures = plot_figures(&source, plot).into_iter().take(MOST_FIGURES);
        figures.find_map(|figure| check(NamedFigure { settings: plot.figure.clone(), ..figure }))
    };
    plots.iter().filter(|plot| is_sized(plot)).filter_map(impossible).collect()
}

/// Why a figure cannot be printed, if it cannot.
pub(crate) fn check(figure: NamedFigure) -> Option<ReportError> {
    let NamedFigure { name, mut figure, settings, .. } = figure;
    set_axes(&mut figure, &settings);
    let printed = figure.print(&style_of(&figure, &settings));
    let fits = |printed: Printed| {
        if settings.has_png() { printed.check_png(PNG_DPI) } else { Ok(()) }
    };
    let checked = printed.and_then(fits);
    let error = ReportError::Plot { name, error: checked.err()? };
    error.is_of_settings().then_some(error)
}

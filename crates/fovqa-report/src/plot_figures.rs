//! The figures of a plot of any kind.

use fovqa_plan::{Plot, PlotKind};

use crate::figures::{Source, figures};
use crate::sheet::NamedFigure;
use crate::sweep;

/// The figures of a plot; empty for a table.
pub(crate) fn plot_figures(source: &Source<'_>, plot: &Plot) -> Vec<NamedFigure> {
    match plot.kind {
        PlotKind::Sweep => sweep::figures(source, plot),
        _ => figures(source, plot),
    }
}

//! The panels of a curves file's figures, and the figures of a file that names none.

use std::collections::BTreeSet;
use std::ops::Range;

use fovqa_methods::curves::CurveSource;
use fovqa_plan::{
    CurvePlan, CurvePlot, CurvePlotKind, CurveTable, CurveTableKind, PanelOf, RateKind, TableAcross,
};

use super::shown::shown;
use crate::fault::{Fault, Faults};

/// Maximum number of panels that a page can show.
const MOST: usize = 48;

/// Gives a file that names no plot and no table all plots and tables that fit. A picture of each
/// curve is left out if there are too many.
pub(super) fn all_that_fit(plan: &mut CurvePlan) {
    let panels = usual_panels(plan, None, RateKind::default());
    let rates = CurvePlot { panels, ..CurvePlot::default() };
    if !plan.curves.iter().any(|spec| matches!(spec.source, CurveSource::Method { .. })) {
        plan.plots = vec![CurvePlot { panels: PanelOf::One, ..rates }];
        return;
    }
    // Log-polar methods are so dense at the gaze that nothing else could be seen on a linear axis.
    let density = CurvePlot { kind: CurvePlotKind::Density, log: true, ..CurvePlot::default() };
    plan.plots = vec![rates];
    let pictures = panels_of(plan, &density);
    if pictures <= MOST {
        plan.plots.push(density);
    } else {
        plan.left_out.push(format!(
            "the plot density is left out: it would have {pictures} panels, but at most {MOST} are allowed; \
             add [[plot]] with kind = \"density\" and curves = […]"
        ));
    }
    let all = [CurveTableKind::Samples, CurveTableKind::SpeedUp, CurveTableKind::Acuity];
    let table = |kind| CurveTable { kind, curves: None, across: TableAcross::default() };
    plan.tables = all.map(table).to_vec();
}

/// Checks that a figure has no more panels than a page can show.
pub(super) fn few_panels(
    plot: &CurvePlot,
    plan: &CurvePlan,
    span: Range<usize>,
    faults: &mut Faults,
) {
    let panels = panels_of(plan, plot);
    if panels > MOST {
        let message = format!("the figure has {panels} panels, but at most {MOST} are allowed");
        let help = match plot.kind {
            CurvePlotKind::Rates => {
                "name some of the curves with curves = […], or give panels = \"one\""
            }
            _ => "name some of the curves with curves = […]",
        };
        faults.push(Fault::new(span, message).help(help));
    }
}

/// The number of panels of a figure.
fn panels_of(plan: &CurvePlan, plot: &CurvePlot) -> usize {
    let mut different: BTreeSet<String> = BTreeSet::new();
    for spec in shown(plan, plot.curves.as_deref()) {
        let CurveSource::Method { setting, .. } = &spec.source else { continue };
        let size = [setting.view.width, setting.view.height];
        different.insert(match (plot.kind, plot.panels) {
            (CurvePlotKind::Density | CurvePlotKind::Samples, _) => {
                format!("{} {size:?} {:?}", spec.name, setting.gaze_px)
            }
            (CurvePlotKind::Rates, PanelOf::Curve) => {
                format!("{} {size:?} {:?} {}", spec.name, setting.gaze_px, setting.direction_deg)
            }
            (CurvePlotKind::Rates, PanelOf::Setting) => {
                format!("{size:?} {:?} {}", setting.gaze_px, setting.direction_deg)
            }
            (CurvePlotKind::Rates, PanelOf::Name) => spec.name.clone(),
            (CurvePlotKind::Rates, PanelOf::Resolution) => format!("{size:?}"),
            (CurvePlotKind::Rates, PanelOf::Gaze) => format!("{:?}", setting.gaze_px),
            (CurvePlotKind::Rates, PanelOf::Direction) => setting.direction_deg.to_string(),
            _ => String::new(),
        });
    }
    let sides = if plot.rate == RateKind::Both { 2 } else { 1 };
    different.len() * sides
}

/// What each panel shows if the file does not say it: a curve with its areas. Of many curves with
/// several settings each panel shows one setting, so that methods are compared on the same screen.
/// If these are too many panels, each shows more.
pub(super) fn usual_panels(plan: &CurvePlan, wanted: Option<&[String]>, rate: RateKind) -> PanelOf {
    const FEW: usize = 4;
    let (mut names, mut settings, mut curves) = (BTreeSet::new(), Vec::new(), 0);
    for spec in shown(plan, wanted) {
        let CurveSource::Method { setting, .. } = &spec.source else { continue };
        let at = (setting.view, setting.gaze_px, setting.direction_deg);
        names.insert(&spec.name);
        if !settings.contains(&at) {
            settings.push(at);
        }
        curves += 1;
    }
    let many = names.len() > 1 && settings.len() > 1 && curves > FEW;
    let usual = if many { PanelOf::Setting } else { PanelOf::Curve };
    let curves = wanted.map(<[String]>::to_vec);
    let plot = CurvePlot { rate, curves, ..CurvePlot::default() };
    let fits = |panels: &PanelOf| {
        let plot = CurvePlot { panels: *panels, ..plot.clone() };
        panels_of(plan, &plot) <= MOST
    };
    let others = [PanelOf::Setting, PanelOf::Name, PanelOf::Resolution];
    [usual].into_iter().chain(others).find(fits).unwrap_or(PanelOf::One)
}

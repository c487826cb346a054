//! Frequency responses: what the sandbox of Patney et al. 2016 leaves of gratings at an eccentricity,
//! against what can be detected and resolved there (their Fig. 3).

use fovqa_plan::{CurvePlot, ResponsePlot};
use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Look, PanelChart};
use fovqa_vision::acuity::THIBOS_1996;

use super::Source;
use super::models::named;
use crate::sheet::NamedFigure;

/// Factor between the frequencies of neighbouring points of a line.
const STEP: f64 = 1.02;
/// The axis begins where the widest blur leaves almost everything: at this number of cycles per σ.
const FIRST: f64 = 0.02;
/// The axis begins here if nothing is blurred more.
const FIRST_CPD: f64 = 0.1;
/// Space above the highest value and right of the last one, as a factor.
const ROOM: f64 = 1.08;
/// Frequencies are the same if they differ by less than this share.
const SAME: f64 = 1e-6;

/// A threshold or limit: a vertical line.
struct Mark {
    name: String,
    cpd: f64,
    /// Its look among the references.
    index: usize,
}

struct Responses<'a> {
    plot: &'a ResponsePlot,
    /// The ends of the horizontal axis.
    ends_cpd: (f64, f64),
    /// The upper end of the vertical axis.
    top: f64,
}

/// A figure with a panel for each eccentricity. `None` for a plot of another kind.
pub(super) fn figure(source: &Source<'_>, plot: &CurvePlot) -> Option<NamedFigure> {
    let response = plot.response.as_ref()?;
    let marks: Vec<Vec<Mark>> =
        response.eccentricities_deg.iter().map(|e| marks(source, response, *e)).collect();
    let most_cpd = marks.iter().flatten().map(|mark| mark.cpd).fold(0.0, f64::max);
    let widths = response.eccentricities_deg.iter().map(|e| response.sandbox.width_deg(*e));
    let first_cpd = (FIRST / widths.fold(0.0, f64::max)).min(FIRST_CPD);
    let mut responses =
        Responses { plot: response, ends_cpd: (first_cpd, ROOM * most_cpd), top: ROOM };
    let lines: Vec<Vec<LineSeries>> =
        response.eccentricities_deg.iter().map(|e| responses.lines(*e)).collect();
    let gains = lines.iter().flatten().flat_map(|line| &line.points).filter_map(|(_, y)| *y);
    responses.top = ROOM * gains.fold(1.0, f64::max);
    let panels = response.eccentricities_deg.iter().zip(lines).zip(&marks);
    let mut panels: Vec<LineChart> =
        panels.map(|((e, lines), marks)| responses.panel(*e, lines, marks)).collect();
    let figure = if panels.len() == 1 {
        let mut chart = panels.remove(0);
        chart.title = plot.title.clone().or(chart.title);
        Figure::Line(chart)
    } else {
        let columns = if matches!(panels.len(), 2 | 4) { 2 } else { 3 };
        Figure::Panels(PanelChart { title: plot.title.clone(), panels, columns })
    };
    let caption = "Contrast that is left of a grating, by its spatial frequency";
    let named = named(plot, "response", caption, figure);
    let note =
        "aliased ends at the Nyquist frequency of its samples, beyond which it shows aliases";
    Some(NamedFigure { caption: format!("{}; {note}", named.caption), ..named })
}

impl Responses<'_> {
    fn panel(&self, eccentricity_deg: f64, lines: Vec<LineSeries>, marks: &[Mark]) -> LineChart {
        let width_deg = self.plot.sandbox.width_deg(eccentricity_deg);
        let strength = self.plot.sandbox.strength(eccentricity_deg);
        let mark = |mark: &Mark| LineSeries {
            name: mark.name.clone(),
            look: Look::new(mark.index),
            reference: true,
            points: vec![(mark.cpd, Some(0.0)), (mark.cpd, Some(self.top))],
            ..LineSeries::default()
        };
        LineChart {
            title: Some(format!(
                "{eccentricity_deg}°: σ = {}°, f = {}",
                short(width_deg),
                short(strength)
            )),
            x: Axis {
                log: true,
                min: Some(self.ends_cpd.0),
                max: Some(self.ends_cpd.1),
                ..Axis::new("Spatial frequency (cpd)")
            },
            y: Axis {
                min: Some(0.0),
                max: Some(self.top),
                ..Axis::new("Gain (contrast out / in)")
            },
            series: lines.into_iter().chain(marks.iter().map(mark)).collect(),
            ..LineChart::default()
        }
    }

    /// The methods, up to the Nyquist frequency of the display and of their samples.
    fn lines(&self, e: f64) -> Vec<LineSeries> {
        let ResponsePlot { sandbox, pixels_per_degree: ppd, .. } = self.plot;
        let display_cpd = ppd / 2.0;
        let line = |index: usize, name: &str, end_cpd: f64, gain: &dyn Fn(f64) -> f64| {
            let cpds = std::iter::successors(Some(self.ends_cpd.0), |cpd| Some(cpd * STEP));
            let cpds = cpds.take_while(|cpd| *cpd < end_cpd).chain([end_cpd]);
            let points = cpds.map(|cpd| (cpd, Some(gain(cpd))));
            LineSeries {
                name: name.to_owned(),
                look: Look::new(index),
                smooth: true,
                points: points.collect(),
                ..LineSeries::default()
            }
        };
        let aliased_cpd = sandbox.aliased_nyquist_cpd(e, *ppd);
        vec![
            line(0, "aliased", aliased_cpd, &|cpd| sandbox.aliased_gain(e, cpd, *ppd)),
            line(1, "stable", display_cpd, &|cpd| sandbox.stable_gain(e, cpd)),
            line(2, "perceptual target", display_cpd, &|cpd| {
                sandbox.perceptual_target_gain(e, cpd)
            }),
        ]
    }
}

/// A number with at most three decimals.
fn short(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The thresholds at an eccentricity and the display's limit. Acuity that is the measured threshold
/// of resolution is not drawn again.
fn marks(source: &Source<'_>, plot: &ResponsePlot, e: f64) -> Vec<Mark> {
    let mut marks = Vec::new();
    let mut add = |index: usize, name: String, cpd: f64| marks.push(Mark { name, cpd, index });
    let measured = (e - THIBOS_1996.eccentricity_deg).abs() < SAME;
    if measured {
        add(0, "Detection (Thibos et al. 1996)".to_owned(), THIBOS_1996.detection_cpd);
        add(1, "Resolution (Thibos et al. 1996)".to_owned(), THIBOS_1996.resolution_cpd);
    }
    let model = &source.file.plan.acuity;
    // This does not fail, because the model was already used when the file was read.
    if let Ok(curve) = model.curve() {
        let cpd = curve.cutoff_cpd(e);
        let again = measured && (cpd / THIBOS_1996.resolution_cpd - 1.0).abs() < SAME;
        if !again {
            add(2, format!("Resolution ({})", model.info().label), cpd);
        }
    }
    add(3, "Display's Nyquist frequency".to_owned(), plot.pixels_per_degree / 2.0);
    marks
}

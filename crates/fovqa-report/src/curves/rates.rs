//! Figures of rates and acuity against eccentricity, with the areas that are over- and
//! under-sampled.

use fovqa_methods::curves::{Curve, CurvePoint};
use fovqa_plan::{AcuityScale, CurvePlot, PanelOf, RateKind, RateUnit};
use fovqa_plot::{Axis, Figure, Fill, FillKind, LineChart, LineSeries, Look, PanelChart};

use super::Source;
use super::axes;
use super::bands::{Member, bands};
use super::labels::{Labels, name, resolution, screen};
use super::looks::Looks;
use crate::sheet::NamedFigure;

/// Factor between the end of the axis and the highest acuity or display rate, if a rate grows
/// without limit.
const ROOM: f64 = 1.15;

/// The direction of a rate.
#[derive(Clone, Copy, PartialEq)]
enum Along {
    Radial,
    Tangential,
}

impl Along {
    fn of(self, point: &CurvePoint) -> f64 {
        match self {
            Along::Radial => point.radial_cpd,
            Along::Tangential => point.tangential_cpd,
        }
    }

    fn display(self, point: &CurvePoint) -> Option<f64> {
        point.display_cpd.map(|cpd| cpd[usize::from(self == Along::Tangential)])
    }

    fn name(self) -> &'static str {
        match self {
            Along::Radial => "radial",
            Along::Tangential => "tangential",
        }
    }
}

struct Rates<'a> {
    source: &'a Source<'a>,
    plot: &'a CurvePlot,
    labels: Labels,
    looks: Looks,
    /// Whether each panel has only one curve of a method.
    alone: bool,
    /// Names of displays, in the same order.
    displays: Vec<String>,
}

pub(super) fn figure(source: &Source<'_>, plot: &CurvePlot) -> NamedFigure {
    let mut curves = source.chosen(plot.curves.as_deref());
    if plot.unit == RateUnit::PerPixel {
        curves.retain(|curve| curve.counts.is_some());
    }
    let labels = Labels::of(&curves);
    let looks = Looks::of(source, &curves, &labels, plot.panels);
    let mut displays: Vec<String> = Vec::new();
    for screen in curves.iter().filter_map(|curve| screen(curve)) {
        let name = format!("Display {}", resolution(screen));
        if !displays.contains(&name) {
            displays.push(name);
        }
    }
    let mut rates = Rates { source, plot, labels, looks, alone: false, displays };
    let groups = rates.groups(&curves);
    let shaded = |group: &[&Curve]| group.iter().filter(|curve| screen(curve).is_some()).count();
    rates.alone = groups.iter().all(|(_, group)| shaded(group) <= 1);
    let along: &[Along] = match plot.rate {
        RateKind::Radial => &[Along::Radial],
        RateKind::Tangential => &[Along::Tangential],
        RateKind::Both => &[Along::Radial, Along::Tangential],
    };
    let mut charts: Vec<LineChart> = Vec::new();
    for (title, group) in &groups {
        for &along in along {
            let which = if plot.rate == RateKind::Both { along.name() } else { "" };
            let title = match (title.as_str(), which) {
                ("", "") => String::new(),
                ("", which) => capitalised(which),
                (title, "") => title.to_owned(),
                (title, which) => format!("{title}, {which}"),
            };
            charts.push(rates.chart(title, group, along));
        }
    }
    let capped = curves.iter().any(|curve| rates.is_capped(curve, along));
    let cut = charts.iter().any(|chart| chart.y.max.is_some()) && plot.y_limits.is_none();
    if charts.len() > 1 {
        // The axis of a panel has no space for more.
        for chart in &mut charts {
            chart.y.title = chart.y.title.replace("cycles per degree", "cpd");
        }
        axes::share(&mut charts);
    }
    let figure = if charts.len() == 1 {
        let only = charts.swap_remove(0);
        Figure::Line(LineChart { title: plot.title.clone().or(only.title.clone()), ..only })
    } else {
        let columns = match charts.len() {
            n if n <= 4 => 2,
            _ => 3,
        };
        Figure::Panels(PanelChart { title: plot.title.clone(), panels: charts, columns })
    };
    let what = match plot.rate {
        RateKind::Radial => "Radial shading rate",
        RateKind::Tangential => "Tangential shading rate",
        RateKind::Both => "Radial and tangential shading rate",
    };
    let cut = if cut {
        "; the axis ends above acuity and display, and higher rates are cut off"
    } else {
        ""
    };
    let caption = plot.title.clone().unwrap_or_else(|| format!("{what} against eccentricity"));
    let capped = if capped {
        "; where a method samples more densely than the display, the rate is that of the display"
    } else {
        ""
    };
    let name = plot.name.clone().unwrap_or_else(|| "rates".to_owned());
    NamedFigure::new(name, format!("{caption}{capped}{cut}"), figure)
}

fn capitalised(word: &str) -> String {
    let mut chars = word.chars();
    chars.next().map(|c| c.to_uppercase().chain(chars).collect()).unwrap_or_default()
}

impl<'a> Rates<'a> {
    /// The curves of each panel, with its title. Curves without a screen are shown in all panels of
    /// screens.
    fn groups(&self, curves: &[&'a Curve]) -> Vec<(String, Vec<&'a Curve>)> {
        let mut groups: Vec<(String, Vec<&Curve>)> = Vec::new();
        let everywhere = |curve: &Curve| {
            screen(curve).is_none() && !matches!(self.plot.panels, PanelOf::One | PanelOf::Curve)
        };
        for curve in curves.iter().filter(|curve| !everywhere(curve)) {
            let title = self.labels.title(curve, self.plot.panels);
            match groups.iter_mut().find(|(known, _)| *known == title) {
                Some((_, group)) => group.push(curve),
                None => groups.push((title, vec![curve])),
            }
        }
        for curve in curves.iter().filter(|curve| everywhere(curve)) {
            for (_, group) in &mut groups {
                group.push(curve);
            }
        }
        groups
    }

    fn chart(&self, title: String, group: &[&Curve], along: Along) -> LineChart {
        let plot = self.plot;
        let mut series: Vec<LineSeries> = Vec::new();
        let mut members: Vec<Member> = Vec::new();
        for curve in group {
            let label = self.labels.label(curve, plot.panels);
            let look = self.looks.look(&curve.spec.name, &label);
            let points = self.points(curve, |point| Some(self.shown(point, along)), along);
            if plot.band && screen(curve).is_some() {
                members.push(Member { name: name(curve), look: self.looks.of_name(curve), points });
                continue;
            }
            series.push(LineSeries {
                name: label,
                look,
                points,
                smooth: true,
                ..LineSeries::default()
            });
        }
        let (edges, bands) = bands(members);
        series.extend(edges);
        series.extend(plot.marks.iter().enumerate().map(|(i, (name, [e, cpd]))| LineSeries {
            name: name.clone(),
            look: self.looks.beside(first_of(&plot.marks, name).unwrap_or(i)),
            unlisted: first_of(&plot.marks, name) != Some(i),
            points: vec![(*e, Some(*cpd))],
            ..LineSeries::default()
        }));
        if plot.display.unwrap_or(plot.unit == RateUnit::Cpd) {
            series.extend(self.displays(group, along));
        }
        // Acuity is drawn last, because a curve that follows it would hide it.
        series.extend(self.acuity(group, along));
        let rate = match plot.rate {
            // If the panels are side by side, their titles name the direction.
            RateKind::Both => "Rate".to_owned(),
            _ => format!("{} rate", capitalised(along.name())),
        };
        let y = match plot.unit {
            RateUnit::Cpd if group.iter().all(|curve| screen(curve).is_none()) => {
                "Acuity (cycles per degree)".to_owned()
            }
            RateUnit::Cpd => format!("{rate} (cycles per degree)"),
            RateUnit::PerPixel => format!("{rate} over the display's own"),
        };
        let limits = plot.y_limits.map(|[low, high]| (low, high)).or_else(|| self.limits(&series));
        LineChart {
            title: Some(title).filter(|title| !title.is_empty()),
            x: Axis::new("Eccentricity (°)"),
            y: Axis {
                log: plot.log,
                min: limits.map(|l| l.0),
                max: limits.map(|l| l.1),
                ..Axis::new(y)
            },
            y_from_zero: !plot.log,
            fills: if plot.band { bands } else { self.fills(group, along) },
            series,
            ..LineChart::default()
        }
    }

    /// Ends of the axis if a rate is so high that the other curves could not be seen.
    fn limits(&self, series: &[LineSeries]) -> Option<(f64, f64)> {
        let most = |reference: bool| {
            let of = series.iter().filter(|series| series.reference == reference);
            of.flat_map(|series| &series.points).filter_map(|(_, y)| *y).fold(0.0, f64::max)
        };
        let (references, rates) = (most(true), most(false));
        let hidden = !self.plot.log && references > 0.0 && rates > 2.0 * references;
        hidden.then_some((0.0, references * ROOM))
    }

    /// The rate that is shown at a point: at most the display's own.
    fn shown(&self, point: &CurvePoint, along: Along) -> f64 {
        match along.display(point) {
            Some(display) if !self.plot.beyond_display => along.of(point).min(display),
            _ => along.of(point),
        }
    }

    /// Whether a curve is somewhere drawn below its rate. Rates that equal the display's own may
    /// differ in the last digits.
    fn is_capped(&self, curve: &Curve, along: &[Along]) -> bool {
        const EQUAL: f64 = 1.0 - 1e-9;
        let capped = |point: &CurvePoint| {
            along.iter().any(|&along| self.shown(point, along) < along.of(point) * EQUAL)
        };
        curve.points.iter().any(capped)
    }

    fn points(
        &self,
        curve: &Curve,
        of: impl Fn(&CurvePoint) -> Option<f64>,
        along: Along,
    ) -> Vec<(f64, Option<f64>)> {
        let value = |point: &CurvePoint| match self.plot.unit {
            RateUnit::Cpd => of(point),
            RateUnit::PerPixel => Some(of(point)? / along.display(point)?),
        };
        curve.points.iter().map(|point| (point.eccentricity_deg, value(point))).collect()
    }

    /// The acuity that the plan compares rates with, over the eccentricities of a panel. `None` if
    /// the panel shows only acuity models, or if the unit is pixels and the panel's screens differ.
    fn acuity(&self, group: &[&Curve], along: Along) -> Option<LineSeries> {
        let model = &self.source.file.plan.acuity;
        let acuity = model.curve().ok()?;
        let shaded: Vec<&&Curve> = group.iter().filter(|c| screen(c).is_some()).collect();
        let by_display =
            self.plot.unit == RateUnit::PerPixel && self.plot.acuity_scale == AcuityScale::Display;
        if by_display && !same_displays(group) {
            return None;
        }
        let longest = shaded.iter().max_by_key(|curve| curve.points.len())?;
        let cut_off = |point: &CurvePoint| Some(acuity.cutoff_cpd(point.eccentricity_deg));
        let points = match self.plot.acuity_scale {
            AcuityScale::Display => self.points(longest, cut_off, along),
            AcuityScale::Own => {
                let most = acuity.cutoff_cpd(0.0);
                let own = |point: &CurvePoint| {
                    (point.eccentricity_deg, cut_off(point).map(|cpd| cpd / most))
                };
                longest.points.iter().map(own).collect()
            }
        };
        Some(LineSeries {
            name: match self.source.file.plan.acuity_parameters.as_str() {
                "" => format!("Acuity ({})", model.info().label),
                set => format!("Acuity ({}, {})", model.info().label, set.replace(';', ", ")),
            },
            reference: true,
            points,
            ..LineSeries::default()
        })
    }

    /// The displays' own rates. Each is drawn once, up to the largest eccentricity of any curve on
    /// the display.
    fn displays(&self, group: &[&Curve], along: Along) -> Vec<LineSeries> {
        let mut found: Vec<(String, &Curve)> = Vec::new();
        for &curve in group {
            let Some(screen) = screen(curve) else { continue };
            let name = format!("Display {}", resolution(screen));
            match found.iter_mut().find(|(known, _)| *known == name) {
                Some((_, longest)) if longest.points.len() < curve.points.len() => *longest = curve,
                Some(_) => {}
                None => found.push((name, curve)),
            }
        }
        let line = |(name, curve): (String, &Curve)| {
            let look = self.displays.iter().position(|known| *known == name).unwrap_or_default();
            LineSeries {
                name,
                // Acuity has the first look of a reference, so displays start with the second.
                look: Look::new(1 + look),
                reference: true,
                points: self.points(curve, |point| along.display(point), along),
                ..LineSeries::default()
            }
        };
        found.into_iter().map(line).collect()
    }

    /// The areas in which the rate of a panel's only curve is below and above acuity.
    fn fills(&self, group: &[&Curve], along: Along) -> Vec<Fill> {
        let shaded: Vec<&&Curve> = group.iter().filter(|c| screen(c).is_some()).collect();
        let compared = self.plot.acuity_scale == AcuityScale::Display;
        let wanted = self.plot.areas.unwrap_or(self.alone && compared);
        let (true, Ok(acuity)) = (wanted, self.source.file.plan.acuity.curve()) else {
            return Vec::new();
        };
        let mut fills = Vec::new();
        for curve in shaded {
            let rates = self.points(curve, |point| Some(self.shown(point, along)), along);
            let cut_off = |point: &CurvePoint| Some(acuity.cutoff_cpd(point.eccentricity_deg));
            let needed = self.points(curve, cut_off, along);
            let value = |y: Option<f64>| y.unwrap_or(f64::NAN);
            let both = rates.iter().zip(&needed);
            let below: Vec<(f64, f64, f64)> =
                both.map(|((e, rate), (_, needed))| (*e, value(*rate), value(*needed))).collect();
            let above = below.iter().map(|&(e, rate, needed)| (e, needed, rate)).collect();
            let fill = |name: &str, kind, points| Fill { name: name.to_owned(), kind, points };
            fills.push(fill("Under-sampled", FillKind::Deficit, below));
            fills.push(fill("Over-sampled", FillKind::Surplus, above));
        }
        fills
    }
}

/// The place of the first mark with a name; marks with the same name look the same.
fn first_of(marks: &[(String, [f64; 2])], name: &str) -> Option<usize> {
    marks.iter().position(|(known, _)| known == name)
}

/// Whether all curves of a panel have the same number of pixels per degree.
fn same_displays(group: &[&Curve]) -> bool {
    let mut views = group.iter().filter_map(|curve| screen(curve)).map(|screen| screen.view);
    views.next().is_none_or(|first| views.all(|other| other == first))
}

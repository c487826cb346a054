//! Tables that compare methods: measures side by side, with one column per method. The table of the
//! papers (RMFR, Table 1) has one row per scene, marks the best value of each row, and ends with an
//! average row. The table of ratios ([`ratios`]) has one row per eccentricity band.

mod csv;
mod group;
mod html;
mod latex;
mod markdown;
mod ratios;
mod terminal;

use fovqa_metrics::{Better, Metric};
use fovqa_plan::Plot;
use fovqa_results::{GuideSource, RunRecord};

use group::Group;
pub(crate) use markdown::escaped_markdown;
pub(crate) use ratios::{Ratios, statistic, statistic_in_words};

use crate::overview::{Measured, Overview};

/// A table of values over the frames.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonTable {
    /// The caption on the page.
    caption: String,
    /// The heading of the first column, which names what the rows are.
    corner: &'static str,
    methods: Vec<String>,
    groups: Vec<Group>,
    rows: Vec<ComparedRow>,
    notes: Vec<String>,
}

/// Heading of the first column if each row is a scene.
const SCENE: &str = "scene";

const FOVEAL_NOTE: &str = "FPSNR and FSSIM: the papers print no constants for the foveal weight; \
                           values can be compared between methods, not with papers.";

const FVVDP_NOTE: &str = "FovVideoVDP: JOD of the sequence; 10 means no visible difference, 1 less means that 75 % of \
                          observers prefer the reference. There is no lower limit.";

const ATD_NOTE: &str =
    "ATD: average temporal difference of the test in percent of the reference's.";

const SAMPLES_NOTE: &str = "Samples: what an emulated method shades, in percent of the frame's pixels. Emulation from a finished frame \
     understates aliasing and flicker.";

#[derive(Debug, Clone, PartialEq)]
struct ComparedRow {
    label: String,
    /// Whether the row is an average over the scenes.
    average: bool,
    /// The cells, by group and then by method.
    cells: Vec<Vec<Cell>>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Cell {
    value: Option<f64>,
    best: bool,
}

impl ComparisonTable {
    /// The table that a plot describes, with its scenes, methods and metric, or with all of them.
    /// `None` if nothing was scored.
    pub(crate) fn new(run: &RunRecord, overview: &Overview, plot: &Plot) -> Option<Self> {
        let wanted = |names: &Option<Vec<String>>, name: &String| {
            names.as_ref().is_none_or(|names| names.contains(name))
        };
        let methods: Vec<String> =
            run.resolved.methods.iter().filter(|m| wanted(&plot.methods, m)).cloned().collect();
        let scenes: Vec<&str> = run
            .resolved
            .scenes
            .iter()
            .map(|scene| &scene.name)
            .filter(|name| wanted(&plot.scenes, name))
            .map(String::as_str)
            .collect();
        let scored = |metric: &Metric| {
            overview.all().iter().any(|measured| measured.value(*metric).is_some())
        };
        let of_plot = |metric: &Metric| plot.metric.as_ref().is_none_or(|key| key == metric.key());
        let metrics: Vec<Metric> =
            Metric::ALL.into_iter().filter(|m| scored(m) && of_plot(m)).collect();
        if metrics.is_empty() || methods.is_empty() || scenes.is_empty() {
            return None;
        }
        let emulated =
            plot.metric.is_none() && overview.all().iter().any(|of| of.samples_percent.is_some());
        let columns: Vec<Column> = metrics.iter().map(|metric| Column::Metric(*metric)).collect();
        let samples = emulated.then_some(Column::Samples);
        let columns: Vec<Column> = columns.into_iter().chain(samples).collect();
        let groups: Vec<Group> = columns.iter().map(|column| column.group()).collect();
        let value =
            |scene: &str, method: &str, column: Column| column.value(overview.of(scene, method)?);
        let mut rows: Vec<ComparedRow> = scenes
            .iter()
            .map(|scene| {
                let cells = columns.iter().zip(&groups).map(|(&column, group)| {
                    marked(group, methods.iter().map(|method| value(scene, method, column)))
                });
                ComparedRow { label: (*scene).to_owned(), average: false, cells: cells.collect() }
            })
            .collect();
        let names: Vec<&str> = methods.iter().map(String::as_str).collect();
        let common: Vec<Vec<&str>> = columns
            .iter()
            .map(|column| {
                let has = |scene: &str, method: &str| value(scene, method, *column).is_some();
                scenes_of_all(&scenes, &names, has)
            })
            .collect();
        rows.extend(average(&groups, &rows, &common));
        let mut notes = vec!["Means over frames; the best of each row is marked.".to_owned()];
        if metrics.contains(&Metric::Fpsnr) || metrics.contains(&Metric::Fssim) {
            notes.push(FOVEAL_NOTE.to_owned());
        }
        if metrics.contains(&Metric::Fvvdp) {
            notes.push(FVVDP_NOTE.to_owned());
        }
        if metrics.contains(&Metric::Atd) {
            notes.push(ATD_NOTE.to_owned());
            notes.extend(without_motion(overview, &scenes, &methods));
        }
        if emulated {
            notes.push(SAMPLES_NOTE.to_owned());
        }
        notes.extend(unequal_frames(overview, &scenes, &methods));
        notes.extend(identical_frames(overview, &scenes, &methods));
        let (caption, corner) = ("Comparison".to_owned(), SCENE);
        Some(Self { caption, corner, methods, groups, rows, notes })
    }

    /// Whether each row is a scene.
    fn is_of_scenes(&self) -> bool {
        self.corner == SCENE
    }

    /// The caption of the table.
    pub fn caption(&self) -> &str {
        &self.caption
    }

    /// Remarks that must be shown together with the numbers.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

/// The scenes in which every method has a value of a metric. Means over scenes use only these, in
/// tables and figures alike, because means over different scenes could not be compared.
pub(crate) fn common_scenes<'a>(
    overview: &Overview,
    scenes: &[&'a str],
    methods: &[&str],
    metric: Metric,
) -> Vec<&'a str> {
    scenes_of_all(scenes, methods, |scene, method| {
        overview.of(scene, method).is_some_and(|measured| measured.value(metric).is_some())
    })
}

/// The scenes in which every method has a value.
fn scenes_of_all<'a>(
    scenes: &[&'a str],
    methods: &[&str],
    has: impl Fn(&str, &str) -> bool,
) -> Vec<&'a str> {
    let all = |scene: &&str| methods.iter().all(|method| has(scene, method));
    scenes.iter().copied().filter(all).collect()
}

/// What a group of columns shows.
#[derive(Debug, Clone, Copy)]
enum Column {
    /// The values of a metric.
    Metric(Metric),
    /// The samples of emulated methods.
    Samples,
}

impl Column {
    fn group(self) -> Group {
        match self {
            Self::Metric(metric) => group(metric),
            Self::Samples => Group::samples(),
        }
    }

    fn value(self, measured: &Measured) -> Option<f64> {
        match self {
            Self::Metric(metric) => measured.value(metric),
            Self::Samples => measured.samples_percent,
        }
    }
}

/// The label of a mean over `of` of `all` scenes.
pub(crate) fn average_label(of: usize, all: usize) -> String {
    if of == all {
        "Average".to_owned()
    } else {
        format!("Average of the {of} scenes all methods have")
    }
}

/// The columns of a metric: its values or, for temporal differences, the percentage that the papers
/// use.
fn group(metric: Metric) -> Group {
    let info = metric.info();
    match metric {
        Metric::Atd => Group::ratio(info.label.to_owned(), "atd_percent".to_owned(), info.better),
        metric => Group::of(metric),
    }
}

/// Values with the best ones marked. A value that prints the same as the best value counts as best.
/// A single value is not marked.
fn marked(group: &Group, values: impl Iterator<Item = Option<f64>>) -> Vec<Cell> {
    let values: Vec<Option<f64>> = values.collect();
    let found = values.iter().copied().flatten();
    let best = match group.better {
        Better::Higher => found.reduce(f64::max),
        Better::Lower => found.reduce(f64::min),
        Better::Neither => None,
    };
    let several = values.iter().flatten().count() > 1;
    let best = best.filter(|_| several).map(|best| group.shown(Some(best)));
    let cell = |value: Option<f64>| Cell {
        value,
        best: value.is_some() && best.as_ref() == Some(&group.shown(value)),
    };
    values.into_iter().map(cell).collect()
}

/// The means over the scenes that all methods have ([`common_scenes`], for each measure). Only
/// measures with at least two such scenes are included; `None` if there is no such measure.
fn average(groups: &[Group], rows: &[ComparedRow], common: &[Vec<&str>]) -> Option<ComparedRow> {
    let mut scenes = Vec::new();
    let cells = groups.iter().enumerate().map(|(index, group)| {
        let whole: Vec<&Vec<Cell>> = rows
            .iter()
            .filter(|row| common[index].contains(&row.label.as_str()))
            .map(|row| &row.cells[index])
            .collect();
        let several = whole.len() > 1;
        if several {
            scenes.push(whole.len());
        }
        let of = |method: usize| {
            mean(&whole.iter().filter_map(|cells| cells[method].value).collect::<Vec<_>>())
        };
        let methods = rows[0].cells[index].len();
        marked(group, (0..methods).map(|method| of(method).filter(|_| several)))
    });
    let cells = cells.collect();
    let (fewest, most) = (scenes.iter().min().copied()?, scenes.iter().max().copied()?);
    let label = if fewest == most {
        average_label(fewest, rows.len())
    } else {
        "Average of the scenes all methods have".to_owned()
    };
    Some(ComparedRow { label, average: true, cells })
}

/// The arithmetic mean; `None` if there are no values. It is infinite if any value is, so that a
/// perfect result in one scene does not lower the average.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Lists items for a note. If there are very many, only the first ones are listed.
fn first(listed: &[String], separator: &str) -> String {
    const MOST: usize = 20;
    let text = listed[..listed.len().min(MOST)].join(separator);
    match listed.len().saturating_sub(MOST) {
        0 => text,
        more => format!("{text}{separator}and {more} more"),
    }
}

/// A note on the scenes in which temporal differences were measured without motion vectors.
fn without_motion(overview: &Overview, scenes: &[&str], methods: &[String]) -> Option<String> {
    let still = |scene: &&&str| {
        let atd = |method: &String| overview.of(scene, method)?.atd.as_ref();
        let taken = methods.iter().filter_map(atd).filter(|atd| atd.ratio.is_some());
        taken.clone().count() > 0 && taken.clone().all(|atd| atd.motion == GuideSource::None)
    };
    let still: Vec<&str> = scenes.iter().filter(still).copied().collect();
    let which = still.join(", ");
    (!still.is_empty()).then(|| {
        format!("ATD without motion vectors, where all movement counts as a difference: {which}.")
    })
}

/// A note on the scenes in which the methods were not scored on the same number of frames.
fn unequal_frames(overview: &Overview, scenes: &[&str], methods: &[String]) -> Option<String> {
    let unequal: Vec<String> = scenes
        .iter()
        .filter_map(|scene| {
            let scored: Vec<(&String, usize)> = methods
                .iter()
                .filter_map(|method| Some((method, overview.of(scene, method)?.frames)))
                .collect();
            let most = scored.iter().map(|(_, frames)| *frames).max()?;
            let fewer = scored.iter().filter(|(_, frames)| *frames < most);
            let fewer: Vec<String> =
                fewer.map(|(method, frames)| format!("{method} {frames} of {most}")).collect();
            (!fewer.is_empty()).then(|| format!("{scene}: {}", first(&fewer, ", ")))
        })
        .collect();
    (!unequal.is_empty()).then(|| {
        format!("Not all methods were scored on the same frames ({}).", first(&unequal, "; "))
    })
}

/// A note on the frames with infinite decibels, which are not part of any mean.
fn identical_frames(overview: &Overview, scenes: &[&str], methods: &[String]) -> Option<String> {
    let pairs = scenes.iter().flat_map(|scene| methods.iter().map(move |method| (scene, method)));
    let identical: Vec<String> = pairs
        .filter_map(|(scene, method)| {
            let comparison = overview.of(scene, method)?;
            let count = comparison.scores().find_map(|score| score.identical_frames)?;
            (0 < count && count < comparison.frames)
                .then(|| format!("{scene}, {method}: {count} of {}", comparison.frames))
        })
        .collect();
    (!identical.is_empty()).then(|| {
        let which = first(&identical, "; ");
        format!("Means of decibels leave out frames that are identical to the reference ({which}).")
    })
}

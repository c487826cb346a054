//! What the figures of a study have in common: their names, and the words of their captions.

use fovqa_plot::Figure;
use fovqa_study::Settings;
use fovqa_study::adjust::Adjustment;
use fovqa_study::bootstrap::Interval;
use fovqa_study::json::By;

use crate::figures::slug;
use crate::sheet::NamedFigure;
use crate::text_table::printable;

/// The most bytes of a group's name in the name of a file.
const MOST_BYTES: usize = 60;
/// The most characters of a name in a caption.
const MOST_CHARACTERS: usize = 60;
/// The most figures of one kind.
pub(super) const MOST_FIGURES: usize = 12;

/// The name of an analysis, and the settings that captions state.
pub(super) struct Context {
    name: String,
    confidence: f64,
    adjust: Adjustment,
}

impl Context {
    pub(super) fn new(name: &str, settings: &Settings) -> Self {
        Self { name: slug(name), confidence: settings.confidence, adjust: settings.adjust }
    }

    /// A figure whose file name says its kind and, if there are several groups, its group.
    pub(super) fn figure(
        &self,
        kind: &str,
        group: &str,
        (caption, figure): (String, Figure),
    ) -> NamedFigure {
        let group = slug(group);
        let group = &group[..group.floor_char_boundary(MOST_BYTES)];
        let parts = [self.name.as_str(), kind, group];
        let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        NamedFigure::new(parts.join("-"), caption, figure)
    }

    /// The coverage of intervals: `95 %`.
    pub(super) fn coverage(&self) -> String {
        format!("{} %", rounded(100.0 * self.confidence))
    }

    /// What stars mean, for the test that they are of.
    pub(super) fn stars(&self, test: &str) -> String {
        let adjusted = match self.adjust {
            Adjustment::Holm => "adjusted by Holm's method",
            Adjustment::Bonferroni => "adjusted by Bonferroni's method",
            Adjustment::None => "not adjusted",
        };
        format!("stars: {test}, p {adjusted}, * p < .05, ** p < .01, *** p < .001")
    }
}

/// A share as percent with one decimal: `70.7 %`.
pub(super) fn percent(share: f64) -> String {
    format!("{} %", (1000.0 * share).round() / 10.0)
}

/// A number with up to six digits.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// The parts of a caption that are not empty.
pub(super) fn caption(parts: &[&str]) -> String {
    parts.iter().copied().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
}

/// The name of a group: its values, without those of their columns.
pub(super) fn group_name(by: &By) -> String {
    by.0.iter().map(|(_, value)| value.as_str()).collect::<Vec<_>>().join(", ")
}

/// The columns and values of a group for a caption; empty for the only group.
pub(super) fn group_in_words(by: &By) -> String {
    let of = |(column, value): &(String, String)| format!("{} = {}", short(column), short(value));
    by.0.iter().map(of).collect::<Vec<_>>().join(", ")
}

/// The beginning of a name, for a caption.
pub(super) fn short(name: &str) -> String {
    let name = printable(name);
    match name.char_indices().nth(MOST_CHARACTERS) {
        None => name,
        Some((end, _)) => format!("{}…", &name[..end]),
    }
}

/// The parts of a list with this many elements at most, one part for each figure, and a phrase about
/// elements beyond the most figures.
pub(super) fn parts<'a, T>(
    all: &'a [T],
    per_figure: usize,
    most_figures: usize,
    what: &str,
) -> (Vec<&'a [T]>, String) {
    let shown = all.len().min(per_figure * most_figures);
    (all[..shown].chunks(per_figure.max(1)).collect(), left_out(all.len(), shown, what))
}

/// A phrase about what a figure does not show; empty if it shows all.
pub(super) fn left_out(all: usize, shown: usize, what: &str) -> String {
    if shown < all {
        format!("only the first {shown} of {all} {what} are shown")
    } else {
        String::new()
    }
}

/// The ends of an interval, infinite where a limit is undefined; `None` if both are.
pub(super) fn ends(interval: Option<Interval>) -> Option<[f64; 2]> {
    match interval? {
        [None, None] => None,
        [low, high] => Some([low.unwrap_or(f64::NEG_INFINITY), high.unwrap_or(f64::INFINITY)]),
    }
}

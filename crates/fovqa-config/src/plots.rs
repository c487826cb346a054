//! Tables and figures an experiment asks for.

use serde::{Deserialize, Serialize};

/// What a table or figure shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PlotKind {
    /// Scenes against metrics and methods, the best of each row marked.
    Table,
    /// A metric against eccentricity.
    Profile,
    /// A metric per scene and method.
    Bars,
    /// A metric's spread over the frames.
    Frames,
    /// A metric frame by frame, with saccades marked.
    Sequence,
    /// Test / reference by eccentricity, as a table.
    Ratios,
}

/// One table or figure, or one for each metric.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plot {
    /// What it shows.
    pub kind: PlotKind,
    /// Key of its metric; `None`: each that fits.
    pub metric: Option<String>,
    /// Its scenes; `None`: all.
    pub scenes: Option<Vec<String>>,
    /// Its methods; `None`: all.
    pub methods: Option<Vec<String>>,
    /// Levels of the wavelet; `None`: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levels: Option<Vec<usize>>,
    /// Statistic of the wavelet; `None`: its energy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub statistic: Option<String>,
}

impl Plot {
    /// A plot of one kind, of all there is.
    pub fn of(kind: PlotKind) -> Self {
        Self { kind, metric: None, scenes: None, methods: None, levels: None, statistic: None }
    }
}

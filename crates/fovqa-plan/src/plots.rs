//! Tables and figures that an experiment requests.

use fovqa_params::words;
use serde::{Deserialize, Serialize};

use crate::figures::FigureSettings;

words! {
    /// What a table or figure shows.
    pub enum PlotKind {
        /// Scenes against metrics and methods, the best of each row marked.
        Table "table" "Scenes against metrics and methods, the best of each row marked";
        /// A metric against eccentricity.
        Profile "profile" "A metric against eccentricity";
        /// A metric per scene and method.
        Bars "bars" "A metric per scene and method";
        /// A metric's spread over the frames.
        Frames "frames" "A metric's spread over the frames";
        /// A metric frame by frame, with saccades marked.
        Sequence "sequence" "A metric frame by frame, with saccades marked";
        /// Test / reference by eccentricity, as a table.
        Ratios "ratios" "Test / reference by eccentricity, as a table";
    }
}

/// One table or figure, or one for each metric.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// What it shows.
    pub kind: PlotKind,
    /// Key of its metric; `None` for each metric that fits.
    pub metric: Option<String>,
    /// Its scenes; `None` for all.
    pub scenes: Option<Vec<String>>,
    /// Its methods; `None` for all.
    pub methods: Option<Vec<String>>,
    /// Levels of the wavelet; `None` for all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levels: Option<Vec<usize>>,
    /// Statistic of the wavelet; `None` for the energy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub statistic: Option<String>,
    /// How its figures are printed.
    #[serde(default, skip_serializing_if = "FigureSettings::is_default")]
    pub figure: FigureSettings,
}

impl Plot {
    /// A plot of one kind that shows everything.
    pub fn of(kind: PlotKind) -> Self {
        Self {
            kind,
            metric: None,
            scenes: None,
            methods: None,
            levels: None,
            statistic: None,
            figure: FigureSettings::default(),
        }
    }
}

//! Tables and figures that an experiment requests.

use fovqa_params::words;
use serde::{Deserialize, Serialize};

use crate::crops::CropRegion;
use crate::figures::FigureSettings;

words! {
    /// What a table or figure shows.
    pub enum PlotKind {
        /// Methods against metrics in each scene, the best marked.
        Table "table" "Methods against metrics in each scene, the best marked";
        /// A metric against eccentricity.
        Profile "profile" "A metric against eccentricity";
        /// A metric per scene and method.
        Bars "bars" "A metric per scene and method";
        /// A metric's spread over the frames.
        Frames "frames" "A metric's spread over the frames";
        /// A metric frame by frame, with saccades marked.
        Sequence "sequence" "A metric frame by frame, with saccades marked";
        /// Regions of the reference and of all methods, side by side.
        Crops "crops" "Regions of the reference and of all methods, magnified side by side";
        /// Test / reference against eccentricity.
        RatioProfile "ratio_profile" "Test / reference against eccentricity";
        /// Test / reference by eccentricity, as a table.
        Ratios "ratios" "Test / reference by eccentricity, as a table";
        /// A metric over the parameters of a sweep.
        Sweep "sweep" "A metric over the parameters of a sweep";
        /// The best point of each sweep, as a table.
        Optima "optima" "The best point of each sweep, as a table";
        /// The budget of each method, and how it was met, as a table.
        Budgets "budgets" "The budget of each method, and how it was met, as a table";
    }
}

words! {
    /// What the rows and columns of a table are.
    #[derive(Default)]
    pub enum TableLayout {
        /// One row per method, in a section for each scene; one column per metric.
        #[default]
        Methods "methods" "One row per method, in a section for each scene; one column per metric";
        /// One row per scene; one column per metric and method.
        Scenes "scenes" "One row per scene; one column per metric and method";
        /// One row per metric, in a section for each scene; one column per method.
        Transposed "transposed" "One row per metric, in a section for each scene; one column per method";
    }
}

words! {
    /// Where a table shows the averages over its scenes.
    #[derive(Default)]
    pub enum AveragePlace {
        /// Before the scenes.
        First "first" "Before the scenes";
        /// After the scenes.
        #[default]
        Last "last" "After the scenes";
        /// In place of the scenes.
        Only "only" "In place of the scenes";
        /// Nowhere.
        None "none" "Nowhere";
    }
}

words! {
    /// The values whose standard deviation a table shows.
    pub enum SpreadOver {
        /// The values of the scenes, beside their average.
        Scenes "scenes" "The values of the scenes, beside their average";
        /// The values of the frames, beside the value of each scene.
        Frames "frames" "The values of the frames, beside the value of each scene";
    }
}

words! {
    /// What error bars show.
    pub enum ErrorBars {
        /// The standard error of the mean.
        StandardError "se" "Standard error of the mean";
        /// The 95 % confidence interval of the mean.
        Confidence "ci95" "95 % confidence interval of the mean (Student's t)";
        /// The standard deviation.
        Deviation "sd" "Standard deviation";
    }
}

words! {
    /// How a distribution is drawn.
    #[derive(Default)]
    pub enum SpreadShape {
        /// A box plot.
        #[default]
        Box "box" "Box plot";
        /// A violin.
        Violin "violin" "Violin: the density, with quartiles and median inside";
    }
}

/// One table or figure, or one for each metric.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// What it shows.
    pub kind: PlotKind,
    /// Key of its metric; `None` for each metric that fits.
    pub metric: Option<String>,
    /// Keys of several metrics, in the order in which they are shown; for a comparison table, also
    /// [`Plot::SAMPLES`] and [`Plot::QUADS`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub metrics: Option<Vec<String>>,
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
    /// What the error bars of bars and profiles show; `None` for none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error_bars: Option<ErrorBars>,
    /// How distributions over frames are drawn.
    #[serde(default, skip_serializing_if = "is_default")]
    pub shape: SpreadShape,
    /// Regions that are shown side by side.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<CropRegion>,
    /// How its figures are printed.
    #[serde(default, skip_serializing_if = "FigureSettings::is_default")]
    pub figure: FigureSettings,
    /// Its caption, as plain text; `None` for one that describes the content.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub caption: Option<String>,
    /// The label of a table in LaTeX; `None` for one made from the name of the experiment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// The name in a table's file names; `None` for the usual names.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// What the rows and columns of a table are.
    #[serde(default, skip_serializing_if = "is_default")]
    pub layout: TableLayout,
    /// Where a table shows averages.
    #[serde(default, skip_serializing_if = "is_default")]
    pub average: AveragePlace,
    /// The standard deviation that a table shows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<SpreadOver>,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Plot {
    /// The word for the samples of emulated methods in a list of metrics.
    pub const SAMPLES: &'static str = "samples";

    /// The word for the quads of emulated methods in a list of metrics.
    pub const QUADS: &'static str = "quads";

    /// A plot of one kind that shows everything.
    pub fn of(kind: PlotKind) -> Self {
        Self {
            kind,
            metric: None,
            metrics: None,
            scenes: None,
            methods: None,
            levels: None,
            statistic: None,
            error_bars: None,
            shape: SpreadShape::default(),
            regions: Vec::new(),
            figure: FigureSettings::default(),
            caption: None,
            label: None,
            name: None,
            layout: TableLayout::default(),
            average: AveragePlace::default(),
            spread: None,
        }
    }

    /// The metrics that the plot names, in order; `None` if it names none.
    pub fn named(&self) -> Option<Vec<&str>> {
        let one = || self.metric.as_deref().map(|metric| vec![metric]);
        let several = self.metrics.as_ref();
        several.map(|keys| keys.iter().map(String::as_str).collect()).or_else(one)
    }
}

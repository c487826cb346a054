//! The form of the data that the viewer's script reads.

use std::collections::BTreeMap;

use fovqa_metrics::{MapInfo, MapScale};
use fovqa_plan::FrameChoice;
use fovqa_results::MapBlocks;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::number::Number;

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct ViewerData {
    /// Six hexadecimal digits for each of 256 colours, that of no difference first.
    pub(super) palette: String,
    pub(super) no_value: String,
    pub(super) maps: BTreeMap<&'static str, MapData>,
    #[serde(serialize_with = "in_order")]
    pub(super) metrics: Vec<(&'static str, MetricData)>,
    pub(super) scenes: Vec<SceneData>,
}

/// Writes a table whose keys keep their order.
fn in_order<S: Serializer, T: Serialize>(
    entries: &[(&'static str, T)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(entries.len()))?;
    for (key, value) in entries {
        map.serialize_entry(key, value)?;
    }
    map.end()
}

#[derive(Debug, Serialize)]
pub(super) struct MapData {
    label: &'static str,
    unit: &'static str,
    about: &'static str,
    scale: ScaleData,
}

#[derive(Debug, Serialize)]
struct ScaleData {
    kind: &'static str,
    none: f32,
    most: f32,
}

impl MapData {
    pub(super) fn of(map: &MapInfo) -> Self {
        let scale = match map.scale {
            MapScale::Linear { none, most } => ScaleData { kind: "linear", none, most },
            MapScale::Logarithmic { none, most } => ScaleData { kind: "log", none, most },
        };
        Self { label: map.label, unit: map.unit.unwrap_or_default(), about: map.about, scale }
    }
}

#[derive(Debug, Serialize)]
pub(super) struct MetricData {
    pub(super) label: String,
    pub(super) unit: &'static str,
    pub(super) better: &'static str,
    pub(super) about: &'static str,
    pub(super) digits: usize,
}

#[derive(Debug, Serialize)]
pub(super) struct SceneData {
    pub(super) name: String,
    pub(super) eyes: Vec<EyeData>,
}

#[derive(Debug, Serialize)]
pub(super) struct EyeData {
    pub(super) eye: &'static str,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) view: Option<ViewData>,
    pub(super) bands_deg: Vec<f64>,
    pub(super) methods: Vec<String>,
    pub(super) sequence: Option<SequenceData>,
    pub(super) frames: Vec<FrameData>,
}

#[derive(Debug, Serialize)]
pub(super) struct ViewData {
    pub(super) focal_px: [f64; 2],
    pub(super) principal_px: [f64; 2],
    pub(super) eccentricity: &'static str,
}

#[derive(Debug, Serialize)]
pub(super) struct SequenceData {
    pub(super) frames: Vec<i64>,
    pub(super) gaze_px: Option<Vec<Option<[f64; 2]>>>,
    /// The metric that ranks the frames.
    pub(super) loss: Option<String>,
    /// For each metric, the values of each method.
    pub(super) metrics: BTreeMap<&'static str, Vec<Vec<Number>>>,
}

#[derive(Debug, Serialize)]
pub(super) struct FrameData {
    pub(super) frame: i64,
    pub(super) why: Vec<FrameChoice>,
    pub(super) gaze_px: Option<[f64; 2]>,
    pub(super) rings: Vec<RingData>,
    pub(super) reference: PictureData,
    pub(super) tests: Vec<TestData>,
}

/// A ring of one eccentricity.
#[derive(Debug, Serialize)]
pub(super) struct RingData {
    pub(super) deg: f64,
    pub(super) lines: Vec<Line>,
}

/// The points of a line: x and y of each in turn.
pub(super) type Line = Vec<f64>;

#[derive(Debug, Serialize)]
pub(super) struct PictureData {
    /// The picture itself as a data URL.
    pub(super) src: String,
    /// The address of the picture in full, relative to the page.
    pub(super) full: String,
}

#[derive(Debug, Serialize)]
pub(super) struct TestData {
    /// Index among the methods of the view.
    pub(super) method: usize,
    #[serde(flatten)]
    pub(super) picture: PictureData,
    pub(super) borders: Vec<Line>,
    pub(super) scores: BTreeMap<&'static str, Number>,
    pub(super) bands: Vec<BTreeMap<&'static str, Number>>,
    pub(super) maps: Vec<TestMap>,
}

#[derive(Debug, Serialize)]
pub(super) struct TestMap {
    #[serde(flatten)]
    pub(super) blocks: MapBlocks,
    /// The address of the map's picture, relative to the page.
    pub(super) full: String,
}

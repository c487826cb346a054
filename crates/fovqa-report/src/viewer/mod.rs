//! What the viewer on the page of a run shows: pictures of the chosen frames, their maps as means over
//! blocks, and the scores beside them. The script `templates/viewer.js` reads it as JSON.

mod data;
mod frame_scores;
mod number;
mod pictures;
mod sequence;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use fovqa_metrics::{Better, Metric};
use fovqa_params::Words;
use fovqa_plot::{MAP_NO_VALUE, map_palette};
use fovqa_results::{
    FileError, FrameImages, FrameRecord, IMAGES_JSON, IMAGES_SCHEMA, ImagesRecord, ViewImages,
    read_json_file, read_record,
};

use crate::comparison::Measure;
use crate::figures::Source;
use data::{EyeData, MapData, MetricData, SceneData, ViewData, ViewerData};
use frame_scores::FrameScores;
use pictures::frame;
use sequence::sequence;

/// The size in bytes from which a page with pictures opens slowly.
const MANY_BYTES: usize = 50_000_000;

/// The data of the viewer.
#[derive(Debug, Default)]
pub(crate) struct Viewer {
    /// JSON; `None` if the run has no pictures.
    pub(crate) json: Option<String>,
    /// What the user should know of pictures that are missing.
    pub(crate) warnings: Vec<String>,
}

impl Viewer {
    /// Reads the pictures of a run from its folder.
    pub(crate) fn read(source: &Source<'_>, folder: &Path) -> Result<Self, FileError> {
        let list = folder.join(IMAGES_JSON);
        if !list.is_file() || source.run.resolved.report.frames.is_empty() {
            return Ok(Self::default());
        }
        let record: Result<ImagesRecord, _> =
            read_json_file(&list, IMAGES_SCHEMA, "a list of pictures");
        let record = match record {
            Ok(record) => record,
            // The page has everything else.
            Err(error) => {
                let warnings = vec![format!(
                    "{error}; the page has no viewer, and `fovqa run EXPERIMENT --output {} --resume` \
                     writes the list again",
                    folder.display()
                )];
                return Ok(Self { json: None, warnings });
            }
        };
        let scores = FrameScores::read(folder, source.run, &record)?;
        let mut missing = BTreeSet::new();
        let mut scenes: Vec<SceneData> = Vec::new();
        for view in &record.views {
            let Some(eye) = eye(source, folder, view, &scores, &mut missing) else { continue };
            match scenes.last_mut() {
                Some(scene) if scene.name == view.scene => scene.eyes.push(eye),
                _ => scenes.push(SceneData { name: view.scene.clone(), eyes: vec![eye] }),
            }
        }
        let warnings = missing.into_iter().map(|what| {
            format!(
                "{what} missing; `fovqa run EXPERIMENT --output {} --resume` takes them again",
                folder.display()
            )
        });
        let mut warnings: Vec<String> = warnings.collect();
        if scenes.is_empty() {
            return Ok(Self { json: None, warnings });
        }
        let resolved = &source.run.resolved;
        let metrics = resolved.metrics_in_order().into_iter();
        let metrics = metrics.filter(|metric| resolved.metrics.contains_key(metric.key()));
        let data = ViewerData {
            palette: map_palette().into_iter().map(hex).collect::<Vec<_>>().concat(),
            no_value: hex(MAP_NO_VALUE),
            maps: maps(&scenes),
            metrics: metrics.map(|metric| (metric.key(), metric_data(metric))).collect(),
            scenes,
        };
        let json = serde_json::to_string(&data).ok();
        let bytes = json.as_ref().map_or(0, String::len);
        if bytes > MANY_BYTES {
            warnings.push(format!(
                "report.html holds {} MB of pictures; a smaller `size` or fewer `frames` in [report] make it open faster",
                bytes / 1_000_000
            ));
        }
        Ok(Self { json, warnings })
    }
}

/// What the maps of these scenes are.
fn maps(scenes: &[SceneData]) -> BTreeMap<&'static str, MapData> {
    let eyes = scenes.iter().flat_map(|scene| &scene.eyes);
    let tests = eyes.flat_map(|eye| &eye.frames).flat_map(|frame| &frame.tests);
    let shown: BTreeSet<&str> =
        tests.flat_map(|test| &test.maps).map(|map| map.blocks.map.as_str()).collect();
    let known = Metric::ALL.into_iter().flat_map(|metric| metric.info().maps());
    known.filter(|map| shown.contains(map.name)).map(|map| (map.name, MapData::of(map))).collect()
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("{r:02x}{g:02x}{b:02x}")
}

fn metric_data(metric: Metric) -> MetricData {
    let info = metric.info();
    let measure = Measure::of(metric);
    MetricData {
        label: measure.label.clone(),
        unit: measure.unit,
        better: match info.better {
            Better::Higher => "higher",
            Better::Lower => "lower",
            Better::Neither => "neither",
        },
        about: info.about,
        digits: measure.decimals(),
    }
}

/// The frames of a scene, as one eye sees it; `None` if there are no pictures.
fn eye(
    source: &Source<'_>,
    folder: &Path,
    view: &ViewImages,
    scores: &FrameScores,
    missing: &mut BTreeSet<String>,
) -> Option<EyeData> {
    let frames: Vec<_> = view
        .frames
        .iter()
        .filter_map(|chosen| frame(folder, view, chosen, scores, missing))
        .collect();
    let first = view.frames.iter().find_map(|chosen| {
        let images = FrameImages::new(folder, &view.scene, view.eye, chosen.frame);
        read_record::<FrameRecord>(&images.record())
    })?;
    let [width, height] = first.frame_px;
    Some(EyeData {
        eye: view.eye.map(Words::word).unwrap_or_default(),
        width,
        height,
        view: first.view.as_ref().map(|view| ViewData {
            focal_px: view.focal_px,
            principal_px: view.principal_px,
            eccentricity: view.eccentricity.word(),
        }),
        bands_deg: first.view.map(|view| view.bands_deg).unwrap_or_default(),
        methods: view.methods.clone(),
        sequence: sequence(source, view),
        frames,
    })
    .filter(|eye| !eye.frames.is_empty())
}

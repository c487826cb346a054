//! The pictures and maps of one frame.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Read;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use fovqa_params::Words;
use fovqa_results::{
    ChosenFrame, FrameImages, FrameRecord, FrameView, TestRecord, ViewImages, open_result_file,
    read_record,
};
use fovqa_vision::{Eccentricity, View};

use super::data::{FrameData, Line, PictureData, RingData, TestData, TestMap};
use super::frame_scores::{FrameScores, Scores};
use super::number::{Number, hundredths};
use crate::page::address;

/// Maximum size of a picture on the page in bytes.
const MOST_BYTES: u64 = 1 << 30;

/// The pictures of a frame. What is missing is left out and named.
pub(super) fn frame(
    folder: &Path,
    view: &ViewImages,
    chosen: &ChosenFrame,
    scores: &FrameScores,
    missing: &mut BTreeSet<String>,
) -> Option<FrameData> {
    let images = FrameImages::new(folder, &view.scene, view.eye, chosen.frame);
    let beside = FrameImages::new(Path::new(""), &view.scene, view.eye, chosen.frame);
    let picture = |small: PathBuf, full: PathBuf| {
        let bytes = whole_webp(&small)?;
        let src = format!("data:image/webp;base64,{}", BASE64_STANDARD.encode(bytes));
        Some(PictureData { src, full: link(&full) })
    };
    let lost = |missing: &mut BTreeSet<String>| {
        missing.insert(format!("pictures of {}, frame {}, are", view.scene, chosen.frame));
    };
    let reference = picture(images.reference_on_page(), beside.reference());
    let record = read_record::<FrameRecord>(&images.record());
    let Some((reference, record)) = reference.zip(record) else {
        lost(missing);
        return None;
    };
    let eye = view.eye.map(Words::word).unwrap_or_default();
    let bands_deg = record.view.as_ref().map(|view| view.bands_deg.as_slice()).unwrap_or_default();
    let mut tests = Vec::new();
    for (index, method) in view.methods.iter().enumerate() {
        let scored = scores.of(&view.scene, eye, method, chosen.frame);
        let found = picture(images.test_on_page(method), beside.test(method));
        let found = found.zip(read_record::<TestRecord>(&images.test_record(method)));
        match (found, scored) {
            (Some((picture, TestRecord { borders, maps })), scored) => {
                let maps = maps
                    .into_iter()
                    .map(|blocks| TestMap { full: link(&beside.map(method, &blocks.map)), blocks });
                tests.push(TestData {
                    method: index,
                    picture,
                    borders: borders.iter().map(|border| line(border)).collect(),
                    scores: scored.map(|scored| numbers(&scored.whole)).unwrap_or_default(),
                    bands: scored.map(|scored| of_bands(scored, bands_deg)).unwrap_or_default(),
                    maps: maps.collect(),
                });
            }
            // A method without a score of this frame has no picture of it either.
            (None, None) => {}
            (None, Some(_)) => lost(missing),
        }
    }
    Some(FrameData {
        frame: chosen.frame,
        why: chosen.why.clone(),
        gaze_px: record.view.as_ref().map(|view| view.gaze_px),
        rings: record.view.map(|view| rings(record.frame_px, &view)).unwrap_or_default(),
        reference,
        tests,
    })
}

/// The bytes of a WebP file; `None` if it is missing or was not written to its end.
fn whole_webp(path: &Path) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    open_result_file(path).ok()?.take(MOST_BYTES).read_to_end(&mut bytes).ok()?;
    let length =
        bytes.strip_prefix(b"RIFF")?.first_chunk().map(|size| u32::from_le_bytes(*size))?;
    (length as usize + 8 == bytes.len()).then_some(bytes)
}

/// The address of a file beside the page.
fn link(path: &Path) -> String {
    address(&path.to_string_lossy().replace('\\', "/"))
}

fn numbers(scores: &BTreeMap<&'static str, f64>) -> BTreeMap<&'static str, Number> {
    scores.iter().map(|(key, value)| (*key, Number(Some(*value)))).collect()
}

/// The scores of each band, in the order of their edges.
fn of_bands(scores: &Scores, edges_deg: &[f64]) -> Vec<BTreeMap<&'static str, Number>> {
    let [from @ .., _] = edges_deg else { return Vec::new() };
    from.iter().map(|from| numbers(&scores.band(*from))).collect()
}

/// The rings at the edges of the bands.
fn rings([width, height]: [usize; 2], view: &FrameView) -> Vec<RingData> {
    let FrameView { focal_px, principal_px, gaze_px, eccentricity, ref bands_deg } = *view;
    let seen = View { width, height, focal_px, principal_px };
    let eccentricity = Eccentricity::new(seen, gaze_px, eccentricity);
    let edges = bands_deg.iter().copied().filter(|deg| *deg > 0.0);
    let ring = |deg: f64| {
        let lines: Vec<Line> = eccentricity.ring(deg).iter().map(|points| line(points)).collect();
        RingData { deg, lines }
    };
    edges.map(ring).filter(|ring| !ring.lines.is_empty()).collect()
}

fn line(points: &[[f64; 2]]) -> Line {
    points.iter().flatten().map(|at| hundredths(*at)).collect()
}

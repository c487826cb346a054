//! Regions of the reference and of all methods, side by side.

use std::io::Cursor;
use std::path::Path;

use fovqa_plan::{CropRegion, Plot};
use fovqa_plot::{Figure, MontageChart, MontageRow, Photo};
use fovqa_results::{CropRecord, crop_folder};
use png::{ColorType, Decoder, Transformations};

use super::{NamedFigure, Selection};

impl Selection<'_> {
    /// The figure of a plot's regions; `None` if no picture of them was written.
    pub(super) fn crops(&self, plot: &Plot) -> Option<NamedFigure> {
        let mut names: Vec<&str> = Vec::new();
        let mut rows: Vec<MontageRow> = Vec::new();
        for region in &plot.regions {
            let scenes = self.scenes.iter().filter(|scene| region.is_in(scene));
            let shown: Vec<MontageRow> =
                scenes.filter_map(|scene| self.row(region, scene)).collect();
            if !shown.is_empty() {
                names.push(&region.name);
            }
            rows.extend(shown);
        }
        if rows.is_empty() {
            return None;
        }
        let methods = self.methods.iter().map(|(method, _)| (*method).to_owned());
        let columns = ["Reference".to_owned()].into_iter().chain(methods).collect();
        let caption = format!(
            "Regions of the frames ({}); their eccentricity, and the magnification compared with the whole frame \
             at the width of this figure",
            names.join(", ")
        );
        let figure = Figure::Montage(MontageChart { title: None, columns, rows });
        Some(NamedFigure::new("crops".to_owned(), caption, figure))
    }

    fn row(&self, region: &CropRegion, scene: &str) -> Option<MontageRow> {
        // Of two eyes, the left one is shown.
        let eyes = [None, Some("left"), Some("right")].into_iter();
        let folders =
            eyes.map(|eye| (eye, crop_folder(self.source.folder, scene, eye, &region.name)));
        let (eye, folder, record) = folders.into_iter().find_map(|(eye, folder)| {
            let file = CropRecord::file(&folder);
            let record: CropRecord = file.is_file().then(|| read_record(&file)).flatten()?;
            Some((eye, folder, record))
        })?;
        let tests = self.methods.iter().map(|(method, _)| CropRecord::test_file(&folder, method));
        let files = [CropRecord::reference_file(&folder)].into_iter().chain(tests);
        let pictures: Vec<Option<Photo>> = files.map(|file| read_photo(&file)).collect();
        let [x, y] = record.corner_px.map(|edge| edge as f64);
        let mut label = vec![region.name.clone()];
        if self.scenes.len() > 1 {
            label.push(scene.to_owned());
        }
        label.extend(eye.map(|eye| format!("{eye} eye")));
        if region.frame.is_some() {
            label.push(format!("frame {}", record.frame));
        }
        label.extend(record.eccentricity_deg.map(|deg| format!("{deg:.1}° from the gaze")));
        label.push(MontageRow::MAGNIFICATION.to_owned());
        Some(MontageRow {
            label: label.join(", "),
            frame_width: record.frame_px[0],
            pictures,
            cross: record.gaze_px.map(|[gaze_x, gaze_y]| (gaze_x - x, gaze_y - y)),
        })
    }
}

fn read_record(file: &Path) -> Option<CropRecord> {
    // A file that was damaged has no figure, like one that is missing.
    serde_json::from_slice(&std::fs::read(file).ok()?).ok()
}

/// The pixels of a picture that a run has written; `None` if it is missing or damaged.
fn read_photo(file: &Path) -> Option<Photo> {
    let bytes = std::fs::read(file).ok()?;
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16);
    let mut reader = decoder.read_info().ok()?;
    let mut samples = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut samples).ok()?;
    let samples = &samples[..info.buffer_size()];
    let rgb = match info.color_type {
        ColorType::Grayscale => samples.iter().map(|gray| [*gray; 3]).collect(),
        ColorType::Rgb => samples.as_chunks::<3>().0.to_vec(),
        ColorType::Indexed | ColorType::GrayscaleAlpha | ColorType::Rgba => return None,
    };
    Some(Photo { width: info.width as usize, rgb })
}

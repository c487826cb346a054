//! Regions of the reference and of all methods, side by side.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use fovqa_plan::{CropRegion, Plot};
use fovqa_plot::{Figure, MontageChart, MontageRow, Photo};
use fovqa_results::{CropRecord, crop_folder};
use png::{ColorType, Decoder, Transformations};

use super::{NamedFigure, Selection};
use crate::overview::Measured;
use crate::print::style;

/// The heading of the column of the reference.
const REFERENCE: &str = "Reference";
/// The longer side of a blank picture in pixels.
const BLANK_PX: usize = 64;

impl Selection<'_> {
    /// The figures of a plot's regions: one, or several if the methods do not fit beside each
    /// other. Empty if no picture was written.
    pub(super) fn crops(&self, plot: &Plot) -> Vec<NamedFigure> {
        let most = MontageChart::most_columns(&self.headings(), &style(&plot.figure)) - 1;
        let parts = self.parts_of(most).into_iter();
        parts.filter_map(|part| Some(part.labelled(part.montage(plot)?))).collect()
    }

    fn headings(&self) -> Vec<String> {
        let methods = self.methods.iter().map(|(method, _)| *method);
        [REFERENCE].into_iter().chain(methods).map(str::to_owned).collect()
    }

    fn montage(&self, plot: &Plot) -> Option<NamedFigure> {
        let mut names: Vec<&str> = Vec::new();
        let mut rows: Vec<MontageRow> = Vec::new();
        let mut warnings = Vec::new();
        for region in &plot.regions {
            let scenes = self.scenes.iter().filter(|scene| region.is_in(scene));
            let shown: Vec<MontageRow> =
                scenes.filter_map(|scene| self.row(region, scene, &mut warnings)).collect();
            if !shown.is_empty() {
                names.push(&region.name);
            }
            rows.extend(shown);
        }
        if rows.is_empty() {
            if warnings.is_empty() {
                return None;
            }
            names = plot.regions.iter().map(|region| region.name.as_str()).collect();
        }
        let caption = format!(
            "Regions of the frames ({}); their eccentricity, and the magnification compared with the whole frame \
             at the width of this figure",
            names.join(", ")
        );
        let columns = self.headings();
        let figure = Figure::Montage(MontageChart { title: None, columns, rows });
        Some(NamedFigure { warnings, ..NamedFigure::new("crops".to_owned(), caption, figure) })
    }

    fn row(
        &self,
        region: &CropRegion,
        scene: &str,
        warnings: &mut Vec<String>,
    ) -> Option<MontageRow> {
        let Some(results) = self.source.folder else { return Some(self.blank(region)) };
        // Of two eyes, the left one is shown.
        let eyes = [None, Some("left"), Some("right")].into_iter();
        let folders = eyes.map(|eye| (eye, crop_folder(results, scene, eye, &region.name)));
        let folders: Vec<(Option<&str>, PathBuf)> = folders.collect();
        let record = |(eye, folder): &(Option<&'static str>, PathBuf)| {
            Some((*eye, folder.clone(), read_record(&CropRecord::file(folder))?))
        };
        let Some((eye, folder, record)) = folders.iter().find_map(record) else {
            let there = folders.iter().find(|(_, folder)| folder.is_dir());
            if there.is_some() || self.is_expected(region, scene) {
                let (_, folder) = there.unwrap_or(&folders[0]);
                warnings.push(again(&CropRecord::file(folder)));
            }
            return None;
        };
        let tests = self.methods.iter().map(|(method, _)| {
            let is_expected = self.source.has_frame(scene, method, record.frame);
            (CropRecord::test_file(&folder, method), is_expected)
        });
        let files = [(CropRecord::reference_file(&folder), true)].into_iter().chain(tests);
        let pictures = files.map(|(file, is_expected)| {
            let photo = read_photo(&file);
            // A method that was not scored there has no picture.
            if photo.is_none() && (is_expected || file.exists()) {
                warnings.push(again(&file));
            }
            photo
        });
        let pictures: Vec<Option<Photo>> = pictures.collect();
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

    /// Whether the run must have written pictures of a region of a scene.
    fn is_expected(&self, region: &CropRegion, scene: &str) -> bool {
        self.all.iter().any(|method| {
            let measured = self.source.overview.of(scene, method);
            let size = measured.and_then(Measured::frame_px);
            let has_frame = |frame| self.source.has_frame(scene, method, frame);
            size.is_some_and(|[width, height]| region.corner((width, height)).is_some())
                && region.frame.is_none_or(has_frame)
        })
    }

    /// A row of blank pictures with the shape of a region, before anything was scored.
    fn blank(&self, region: &CropRegion) -> MontageRow {
        let [width, height] = region.size;
        let most = width.max(height);
        let side = |side: usize| (side * BLANK_PX).div_ceil(most).max(1);
        let (width, height) = (side(width), side(height));
        let photo = Photo { width, rgb: vec![[0; 3]; width * height] };
        MontageRow {
            label: region.name.clone(),
            frame_width: width,
            pictures: vec![Some(photo); self.methods.len() + 1],
            cross: None,
        }
    }
}

/// The warning about a file that is missing or damaged.
fn again(file: &Path) -> String {
    let (what, first) =
        if file.exists() { ("is damaged", "delete it, and ") } else { ("is missing", "") };
    format!(
        "{}: the file of a region {what}; {first}`fovqa run FILE --resume` writes it again",
        file.display()
    )
}

fn read_record(file: &Path) -> Option<CropRecord> {
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

//! Pictures side by side: one row per region of a frame, one column per method.

use crate::axes::axis::AXIS_STROKE;
use crate::canvas::colour::{INK, WHITE};
use crate::canvas::drawing::{Anchor, Drawing, Rect, Stroke, Text};
use crate::canvas::photo::Photo;
use crate::canvas::text::{DESCENT, LINE_PITCH, TICK_PX};
use crate::canvas::wrap::{keeps_words, wrap};
use crate::page::layout::{self, MARGIN_PX};
use crate::page::paper::Paper;
use crate::page::style::Style;

/// Distance between pictures.
const GAP_PX: f64 = 4.0;
/// The largest number of lines of a heading.
const MOST_LINES: usize = 3;
/// Distance from text to pictures.
const TEXT_GAP_PX: f64 = 3.0;
/// Half the length of the arms of a cross.
const CROSS_PX: f64 = 5.0;
/// The smallest width of a picture where columns can be left to another figure.
const LEAST_CELL_PX: f64 = 84.0;
/// A picture of this width is not made wider for the sake of its heading.
const WIDE_CELL_PX: f64 = 170.0;
/// The text in place of a missing picture.
const MISSING: &str = "n/a";

/// Pictures in rows and columns that are as wide as a page. All pictures of a row have one size.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MontageChart {
    /// The title above the figure.
    pub title: Option<String>,
    /// The headings of the columns.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<MontageRow>,
}

/// The pictures of one region.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MontageRow {
    /// What they show, above them. [`MAGNIFICATION`](Self::MAGNIFICATION) in it becomes the
    /// magnification as they are printed.
    pub label: String,
    /// Width in pixels of the frame that they are regions of, for the magnification.
    pub frame_width: usize,
    /// A picture for each column; `None` where there is none.
    pub pictures: Vec<Option<Photo>>,
    /// A position in pixels of the pictures, such as the gaze, which is marked with a cross if it
    /// is within them.
    pub cross: Option<(f64, f64)>,
}

impl MontageRow {
    /// Stands for the magnification in a label: how much larger a pixel is printed than if the
    /// whole frame were as wide as the figure.
    pub const MAGNIFICATION: &'static str = "{magnification}";

    /// Width and height of its pictures in pixels.
    fn size(&self) -> (usize, usize) {
        let sizes = self.pictures.iter().flatten().map(|photo| (photo.width, photo.height()));
        sizes.fold((1, 1), |most, size| (most.0.max(size.0), most.1.max(size.1)))
    }
}

impl MontageChart {
    /// The largest number of columns with these headings that fit beside each other in a style, so
    /// that pictures are not too small and no heading is cut; at least 2.
    pub fn most_columns(headings: &[String], style: &Style) -> usize {
        let width_px = Paper::new(style).page_px;
        let fits = |columns: &usize| {
            let cell_px = cell_px(width_px, *columns);
            let is_whole = |heading: &String| {
                keeps_words(heading, TICK_PX, cell_px)
                    && wrap(heading, TICK_PX, cell_px, MOST_LINES + 1).len() <= MOST_LINES
            };
            cell_px >= WIDE_CELL_PX || (cell_px >= LEAST_CELL_PX && headings.iter().all(is_whole))
        };
        (2..=headings.len()).rev().find(fits).unwrap_or(2)
    }

    pub(crate) fn draw(&self, paper: &Paper) -> Drawing {
        let width_px = paper.page_px;
        let cell_px = cell_px(width_px, self.columns.len().max(1));
        let (mut drawing, mut top) = layout::head(self.title.as_deref(), &[], MARGIN_PX, width_px);
        let left = |column: usize| MARGIN_PX + column as f64 * (cell_px + GAP_PX);

        let heads: Vec<Vec<String>> =
            self.columns.iter().map(|name| wrap(name, TICK_PX, cell_px, MOST_LINES)).collect();
        let lines = heads.iter().map(Vec::len).max().unwrap_or(0);
        for (column, head) in heads.iter().enumerate() {
            for (i, line) in head.iter().enumerate() {
                // Short headings stand at the bottom, beside the pictures.
                let line_of = lines - head.len() + i;
                let baseline = top + TICK_PX * (1.0 - DESCENT + line_of as f64 * LINE_PITCH);
                let at = (left(column) + cell_px / 2.0, baseline);
                drawing.text(Text::new(line, at, TICK_PX, Anchor::Middle));
            }
        }
        top += lines as f64 * TICK_PX * LINE_PITCH + TEXT_GAP_PX;

        for row in &self.rows {
            let (width, height) = row.size();
            let ratio = (height as f64 / width as f64).clamp(0.1, 4.0);
            let magnification =
                cell_px / width as f64 * row.frame_width as f64 / (width_px - 2.0 * MARGIN_PX);
            let label =
                row.label.replace(MontageRow::MAGNIFICATION, &format!("×{magnification:.1}"));
            for line in wrap(&label, TICK_PX, width_px - 2.0 * MARGIN_PX, MOST_LINES) {
                let at = (MARGIN_PX, top + TICK_PX * (1.0 - DESCENT));
                drawing.text(Text::new(line, at, TICK_PX, Anchor::Start));
                top += TICK_PX * LINE_PITCH;
            }
            top += TEXT_GAP_PX;
            for (column, picture) in row.pictures.iter().take(self.columns.len()).enumerate() {
                let rect = Rect {
                    left: left(column),
                    top,
                    right: left(column) + cell_px,
                    bottom: top + cell_px * ratio,
                };
                if let Some(photo) = picture {
                    draw_photo(&mut drawing, rect, photo, row.cross);
                } else {
                    let at = rect.centre();
                    drawing.text(Text::new(MISSING, at, TICK_PX, Anchor::Middle));
                }
                drawing.frame(rect, AXIS_STROKE);
            }
            top += cell_px * ratio + GAP_PX + TEXT_GAP_PX;
        }
        if self.rows.is_empty() {
            let plot = Rect {
                left: MARGIN_PX,
                top,
                right: width_px - MARGIN_PX,
                bottom: top + 4.0 * TICK_PX,
            };
            layout::write_no_data(&mut drawing, plot);
            top = plot.bottom;
        }
        drawing.height_px = (top + MARGIN_PX).ceil();
        drawing
    }
}

/// The width of a picture.
fn cell_px(width_px: f64, columns: usize) -> f64 {
    let columns = columns as f64;
    (width_px - 2.0 * MARGIN_PX - (columns - 1.0) * GAP_PX) / columns
}

/// Draws a picture, with a white cross with a dark edge if it is within the picture.
fn draw_photo(drawing: &mut Drawing, rect: Rect, photo: &Photo, cross: Option<(f64, f64)>) {
    drawing.photo(rect, photo.clone());
    let (width, height) = (photo.width as f64, photo.height() as f64);
    let Some((x, y)) = cross else { return };
    let at = (rect.left + x / width * rect.width(), rect.top + y / height * rect.height());
    let room = rect.left + CROSS_PX..=rect.right - CROSS_PX;
    let room_down = rect.top + CROSS_PX..=rect.bottom - CROSS_PX;
    if !room.contains(&at.0) || !room_down.contains(&at.1) {
        return;
    }
    for (colour, width_px) in [(INK, 3.0), (WHITE, 1.2)] {
        let stroke = Stroke { colour, width_px };
        drawing.line(&[(at.0 - CROSS_PX, at.1), (at.0 + CROSS_PX, at.1)], stroke);
        drawing.line(&[(at.0, at.1 - CROSS_PX), (at.0, at.1 + CROSS_PX)], stroke);
    }
}

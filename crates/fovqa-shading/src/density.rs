//! Samples per pixel over the field, as a picture.

use fovqa_config::CurveSetting;
use fovqa_methods::{Method, Place};

use crate::curve::CurveError;

/// Samples per pixel of a frame, at the centres of cells, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct DensityMap {
    /// Cells of a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Samples per pixel; 0 where there are none.
    pub values: Vec<f64>,
}

/// The density of a method over a frame, in cells: `cells` along its longer side at most.
///
/// # Errors
/// When the method cannot be applied.
pub fn density_map(
    method: &Method,
    screen: &CurveSetting,
    cells: usize,
) -> Result<DensityMap, CurveError> {
    let setting = screen.setting()?;
    let foveation = method.over(&setting)?;
    let [gaze_x, gaze_y] = setting.gaze_px();
    let (width, height) = (screen.view.width, screen.view.height);
    let shrink = (width.max(height) as f64 / cells as f64).max(1.0);
    let [columns, rows] =
        [width, height].map(|side| ((side as f64 / shrink).round() as usize).max(1));
    let steps = [width as f64 / columns as f64, height as f64 / rows as f64];
    let mut values = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let [x, y] =
                [(column, steps[0]), (row, steps[1])].map(|(i, step)| (i as f64 + 0.5) * step);
            let place = Place::at([x - gaze_x, y - gaze_y]);
            values.push(foveation.density(place));
        }
    }
    Ok(DensityMap { columns, rows, values })
}

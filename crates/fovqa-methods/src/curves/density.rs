//! A map of the samples per pixel over the field.

use super::error::CurveError;
use super::setting::CurveSetting;
use crate::registry::Method;
use crate::setting::Place;

/// The samples per pixel of a frame at the centres of cells, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct DensityMap {
    /// The number of cells in a row.
    pub columns: usize,
    /// The number of rows.
    pub rows: usize,
    /// Samples per pixel; 0 where the method has none.
    pub values: Vec<f64>,
}

/// The density of a method over a frame, in cells: at most `cells` along its longer side.
///
/// # Errors
/// When the method cannot be applied.
pub fn density_map(
    method: &Method,
    screen: &CurveSetting,
    cells: usize,
) -> Result<DensityMap, CurveError> {
    let setting = screen.setting()?;
    let foveation = method.apply(&setting)?;
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

#[cfg(test)]
mod tests {
    use fovqa_vision::{EccentricityKind, Tangential, ViewSpec};

    use super::*;

    fn map(
        name: &str,
        (width, height): (usize, usize),
        gaze_px: [f64; 2],
        cells: usize,
    ) -> DensityMap {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(100.0) };
        let view = spec.resolve(width, height).unwrap().view;
        let screen = CurveSetting {
            view,
            gaze_px,
            direction_deg: 0.0,
            tangential: Tangential::Paper,
            eccentricity: EccentricityKind::Planar,
        };
        density_map(&Method::find(name).unwrap(), &screen, cells).unwrap()
    }

    /// Values are the densities at the centres of the cells, row by row.
    #[test]
    fn cells_are_sampled_at_their_centres() {
        let found = map("rmfr", (800, 1000), [200.0, 900.0], 50);
        assert_eq!((found.columns, found.rows, found.values.len()), (40, 50, 2000));
        let axis = |side: f64, gaze: f64, at: f64| {
            let (f, t) = (0.38 * side, at - gaze);
            let a = if t < 0.0 { gaze } else { side - gaze };
            f * (f + a) / ((t.abs() + f).powi(2) * 2.6)
        };
        for row in 0..50 {
            for column in 0..40 {
                let [x, y] = [column, row].map(|i| 20.0 * (i as f64 + 0.5));
                let want = axis(800.0, 200.0, x) * axis(1000.0, 900.0, y);
                let value = found.values[row * 40 + column];
                assert!((value / want - 1.0).abs() < 1e-12, "{column} {row}");
            }
        }
    }

    #[test]
    fn cells_are_no_smaller_than_pixels_and_never_none() {
        let small = map("full", (30, 20), [15.0, 10.0], 100);
        assert_eq!((small.columns, small.rows), (30, 20));
        // Cells have 30/7 x 20/5 pixels.
        let oblong = map("rmfr", (30, 20), [15.0, 0.0], 7);
        assert_eq!((oblong.columns, oblong.rows), (7, 5));
        let y = |row: f64| 7.6 * 27.6 / ((4.0 * (row + 0.5) + 7.6).powi(2));
        assert!((oblong.values[7 * 3] / oblong.values[7] / (y(3.0) / y(1.0)) - 1.0).abs() < 1e-12);
        let flat = map("full", (1000, 4), [500.0, 2.0], 50);
        assert_eq!((flat.columns, flat.rows, flat.values), (50, 1, vec![1.0; 50]));
    }
}

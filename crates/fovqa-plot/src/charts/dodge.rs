//! Moves curves with error bars sideways, so that the error bars of several curves at one position
//! do not hide each other.

use crate::marks::error_bar::CAP_PX;

/// Distance between two error bars side by side: their caps and a gap.
const APART_PX: f64 = 2.0 * CAP_PX + 1.0;
/// The share of the distance between two positions that the error bars of one position fill.
const FILLED: f64 = 0.7;
/// How far an error bar may stand beyond the border of the plot area.
const BEYOND_PX: f64 = 3.0;
/// Positions are equal if they differ by less.
const EQUAL_PX: f64 = 1.0;

/// How far each curve is moved, from the positions of its error bars in the plot area. A curve without error bars
/// stays where it is, and so do all if no two curves have an error bar at one position.
pub(crate) fn shifts_px(curves: &[Vec<f64>], plot_width_px: f64) -> Vec<f64> {
    let with_bars: Vec<usize> = (0..curves.len()).filter(|i| !curves[*i].is_empty()).collect();
    let mut shifts = vec![0.0; curves.len()];
    let mut positions: Vec<(f64, usize)> =
        with_bars.iter().flat_map(|i| curves[*i].iter().map(move |x| (*x, *i))).collect();
    positions.sort_by(|a, b| a.0.total_cmp(&b.0));
    let steps = || positions.windows(2).map(|pair| (pair[1].0 - pair[0].0, pair));
    if !steps().any(|(step, pair)| step < EQUAL_PX && pair[0].1 != pair[1].1) {
        return shifts;
    }
    let room_px = steps().map(|(step, _)| step).filter(|step| *step >= EQUAL_PX);
    let room_px = room_px.fold(plot_width_px / 2.0, f64::min);
    let middle = (with_bars.len() as f64 - 1.0) / 2.0;
    let border_px = |x: f64| x.min(plot_width_px - x).max(0.0) + BEYOND_PX;
    let border_px = positions.iter().map(|(x, _)| border_px(*x)).fold(f64::INFINITY, f64::min);
    let apart_px = APART_PX.min(FILLED * room_px / with_bars.len() as f64);
    let apart_px = apart_px.min(border_px / middle);
    for (nth, curve) in with_bars.into_iter().enumerate() {
        shifts[curve] = (nth as f64 - middle) * apart_px;
    }
    shifts
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn only_curves_whose_error_bars_meet_are_moved() {
        let at = |xs: &[f64]| xs.to_vec();
        assert_eq!(shifts_px(&[at(&[10.0, 50.0]), at(&[30.0])], 200.0), [0.0, 0.0]);
        assert_eq!(shifts_px(&[at(&[10.0, 50.0])], 200.0), [0.0]);
        let two = [at(&[10.0, 50.0]), at(&[]), at(&[10.0, 50.0])];
        assert_eq!(shifts_px(&two, 200.0), [-3.5, 0.0, 3.5]);
        // At the border they stay in the picture.
        let shifts = shifts_px(&vec![at(&[0.0, 100.0]); 3], 200.0);
        assert_eq!(shifts, [-3.0, 0.0, 3.0]);
        // Many stay nearer to their own position than to the next one.
        let many = vec![at(&[10.0, 30.0]); 10];
        let shifts = shifts_px(&many, 200.0);
        assert!((shifts[9] - shifts[0] - 12.6).abs() < 1e-9, "{shifts:?}");
    }
}

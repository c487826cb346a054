//! How well a falling function of the distance from a place describes values in a frame.

use std::ops::Range;

/// A value at a place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cell {
    pub(crate) at: [f32; 2],
    pub(crate) value: f32,
}

/// Rings of equal width, up to the diagonal of the frame.
const RINGS: usize = 24;

/// Places to be tried along each side.
const PLACES: usize = 20;

/// Of these, only each so many are tried at first.
const COARSE: usize = 2;

/// The sum of the squared deviations of the cells from the best function of the distance from `place`
/// that falls or stays everywhere (isotonic regression of the rings, by pooling adjacent violators).
pub(crate) fn deviation(cells: &[Cell], place: [f32; 2], diagonal: f32) -> f32 {
    let mut rings = [[0.0f32; 2]; RINGS];
    let mut squares = 0.0;
    for cell in cells {
        let ring = distance(cell.at, place) / diagonal * RINGS as f32;
        let ring = &mut rings[(ring as usize).min(RINGS - 1)];
        ring[0] += 1.0;
        ring[1] += cell.value;
        squares += cell.value * cell.value;
    }
    let mut pooled: Vec<[f32; 2]> = Vec::with_capacity(RINGS);
    for ring in rings.into_iter().filter(|ring| ring[0] > 0.0) {
        let mut ring = ring;
        while let Some([n, sum]) = pooled.last()
            && sum / n < ring[1] / ring[0]
        {
            ring = [ring[0] + n, ring[1] + sum];
            pooled.pop();
        }
        pooled.push(ring);
    }
    squares - pooled.iter().map(|[n, sum]| sum * sum / n).sum::<f32>()
}

/// The place in a frame from which the values fall best, and the deviation there: the best one of a
/// coarse grid, and then of a finer one around it.
pub(crate) fn best_place(
    cells: &[Cell],
    (width, height): (usize, usize),
    diagonal: f32,
) -> ([f32; 2], f32) {
    let best = |xs: Range<usize>, ys: Range<usize>, step: usize| {
        let places = ys.step_by(step).flat_map(|y| xs.clone().step_by(step).map(move |x| (x, y)));
        let tried = places.map(|(x, y)| {
            let along = |nth: usize, side: usize| nth as f32 / PLACES as f32 * side as f32;
            let place = [along(x, width), along(y, height)];
            ((x, y), place, deviation(cells, place, diagonal))
        });
        tried.min_by(|a, b| a.2.total_cmp(&b.2))
    };
    let all = 0..PLACES + 1;
    let coarse = best(all.clone(), all, COARSE);
    let around = |at: usize| at.saturating_sub(COARSE - 1)..(at + COARSE).min(PLACES + 1);
    let fine = coarse.and_then(|((x, y), ..)| best(around(x), around(y), 1));
    fine.map_or(([0.0; 2], f32::MAX), |(_, place, deviation)| (place, deviation))
}

pub(crate) fn distance(a: [f32; 2], b: [f32; 2]) -> f32 {
    let [x, y] = [a[0] - b[0], a[1] - b[1]];
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_from_which_values_fall_is_found() {
        let cells: Vec<Cell> = (0..400)
            .map(|nth| {
                let at = [(nth % 20) as f32 * 50.0 + 25.0, (nth / 20) as f32 * 40.0 + 20.0];
                Cell { at, value: -distance(at, [250.0, 560.0]).powf(0.7) }
            })
            .collect();
        let diagonal = 1_280.0;
        let (place, least) = best_place(&cells, (1000, 800), diagonal);
        assert!(distance(place, [250.0, 560.0]) < 1e-3, "{place:?}");
        assert!(deviation(&cells, [700.0, 200.0], diagonal) > 20.0 * least);
        // A function that rises everywhere is best described by its mean.
        let rising: Vec<Cell> =
            cells.iter().map(|cell| Cell { value: -cell.value, ..*cell }).collect();
        let mean = rising.iter().map(|cell| cell.value).sum::<f32>() / 400.0;
        let variance: f32 = rising.iter().map(|cell| (cell.value - mean).powi(2)).sum();
        assert!((deviation(&rising, place, diagonal) / variance - 1.0).abs() < 1e-2);
    }
}

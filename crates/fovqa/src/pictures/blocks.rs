//! Means of a map over blocks of pixels, as the page of a run holds them.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use fovqa_metrics::{Map, Metric};
use fovqa_results::MapBlocks;
use half::f16;
use miniz_oxide::deflate::compress_to_vec;

/// Pixels of the page's picture on a side of a block, about: a map needs fewer values than a picture.
const PICTURE_PIXELS: usize = 4;
/// Level of compression, from 0 to 10.
const LEVEL: u8 = 6;

/// The means of a map for a page whose pictures have at most `size` pixels on the longer side.
/// `side` is the longer side of the frame in pixels.
pub(super) fn blocks(map: &Map, side: usize, size: usize) -> MapBlocks {
    // A value of the map may stand for several pixels.
    let step = step_of(map.name);
    let most = (size / PICTURE_PIXELS).max(1);
    let values_a_block = side.div_ceil(most).max(1).div_ceil(step);
    let [columns, rows] = [map.width, map.height].map(|side| side.div_ceil(values_a_block));
    let means = (0..rows * columns).map(|i| mean(map, values_a_block, i % columns, i / columns));
    let bytes: Vec<u8> = means.flat_map(|mean| f16::from_f64(mean).to_le_bytes()).collect();
    MapBlocks {
        map: map.name.to_owned(),
        block: values_a_block * step,
        columns,
        rows,
        values: BASE64_STANDARD.encode(compress_to_vec(&bytes, LEVEL)),
    }
}

/// Side of the pixels for which a value of a map stands.
fn step_of(name: &str) -> usize {
    let maps = Metric::ALL.into_iter().filter_map(|metric| metric.info().map);
    let block = maps.into_iter().find(|map| map.name == name).map_or(1, |map| map.block);
    block.max(1) as usize
}

/// The mean of the values in a block; NaN if it has none.
fn mean(map: &Map, block: usize, column: usize, row: usize) -> f64 {
    let (mut sum, mut count) = (0.0, 0_u32);
    for y in row * block..((row + 1) * block).min(map.height) {
        let line = &map.values[y * map.width..(y + 1) * map.width];
        for value in &line[column * block..((column + 1) * block).min(map.width)] {
            if !value.is_nan() {
                sum += f64::from(*value);
                count += 1;
            }
        }
    }
    if count == 0 { f64::NAN } else { sum / f64::from(count) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use miniz_oxide::inflate::decompress_to_vec;

    fn map(name: &'static str, width: usize, height: usize, values: Vec<f32>) -> Map {
        Map { name, width, height, values, is_half: false, pictures: Vec::new() }
    }

    fn halves(blocks: &MapBlocks) -> Vec<f64> {
        let bytes = decompress_to_vec(&BASE64_STANDARD.decode(&blocks.values).unwrap()).unwrap();
        bytes.chunks(2).map(|pair| f16::from_le_bytes([pair[0], pair[1]]).to_f64()).collect()
    }

    #[test]
    fn blocks_hold_the_means_of_the_values_that_exist() {
        let mut values: Vec<f32> = (0..60).map(|i| i as f32).collect();
        values[1] = f32::NAN;
        for y in [3, 4, 5] {
            values[y * 10 + 8] = f32::NAN;
            values[y * 10 + 9] = f32::NAN;
        }
        // Ten pixels, five of the page's, one and a quarter blocks: blocks of 8 x 8 pixels.
        let blocks = blocks(&map("ssim", 10, 6, values.clone()), 10, 8);
        assert_eq!((blocks.block, blocks.columns, blocks.rows), (5, 2, 2));
        let found = halves(&blocks);
        let expected = |x: std::ops::Range<usize>, y: std::ops::Range<usize>| {
            let all: Vec<f64> = y
                .flat_map(|y| x.clone().map(move |x| (x, y)))
                .map(|(x, y)| f64::from(values[y * 10 + x]))
                .filter(|value| !value.is_nan())
                .collect();
            all.iter().sum::<f64>() / all.len() as f64
        };
        let means = [
            expected(0..5, 0..5),
            expected(5..10, 0..5),
            expected(0..5, 5..6),
            expected(5..10, 5..6),
        ];
        for (found, mean) in found.iter().zip(means) {
            assert!((found - mean).abs() <= mean / 2048.0, "{found} {mean}");
        }
    }

    #[test]
    fn a_block_without_values_has_none_and_a_coarse_map_keeps_its_pixels() {
        let none = blocks(&map("ssim", 2, 1, vec![f32::NAN, 0.5]), 2, 8);
        assert!(halves(&none)[0].is_nan() && (halves(&none)[1] - 0.5).abs() < 1e-9);
        // GMSD has a value for 2 x 2 pixels: 100 pixels are 50 values, in blocks of 7 pixels or more.
        let gmsd = blocks(&map("gmsd", 50, 50, vec![1.0; 2500]), 100, 64);
        assert_eq!((gmsd.block, gmsd.columns), (8, 13));
    }
}

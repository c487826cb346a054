//! Means of a map over blocks of pixels, as the page of a run holds them.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use fovqa_metrics::Map;
use fovqa_results::MapBlocks;
use half::f16;
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;

/// Pixels of the page's picture on a side of a block, about: a map needs fewer values than a picture.
const PICTURE_PIXELS: usize = 4;
/// Level of compression, from 0 to 10.
const LEVEL: u8 = 6;

/// The means of a map for a page whose pictures have at most `size` pixels on the longer side.
pub(crate) fn blocks(map: &Map, size: usize) -> MapBlocks {
    // A value of the map may stand for several pixels.
    let step = map.info.block;
    let side = map.frame_size.0.max(map.frame_size.1);
    let most = (size / PICTURE_PIXELS).max(1);
    let values_a_block = side.div_ceil(most).max(1).div_ceil(step);
    let [columns, rows] =
        <[usize; 2]>::from(map.info.size(map.frame_size)).map(|side| side.div_ceil(values_a_block));
    let means = (0..rows * columns).map(|i| mean(map, values_a_block, i % columns, i / columns));
    let bytes: Vec<u8> = means.flat_map(|mean| f16::from_f64(mean).to_le_bytes()).collect();
    MapBlocks {
        map: map.info.name.to_owned(),
        block: values_a_block * step,
        columns,
        rows,
        values: BASE64_STANDARD.encode(compress_to_vec(&bytes, LEVEL)),
    }
}

/// The means of blocks row by row, NaN where there is no value; `None` if the record is damaged.
pub(crate) fn means(blocks: &MapBlocks) -> Option<Vec<f64>> {
    let count = blocks.columns.checked_mul(blocks.rows)?;
    let packed = BASE64_STANDARD.decode(&blocks.values).ok()?;
    let bytes = decompress_to_vec_with_limit(&packed, count.checked_mul(2)?).ok()?;
    let values = bytes.chunks_exact(2).map(|pair| f16::from_le_bytes([pair[0], pair[1]]).to_f64());
    Some(values.collect()).filter(|values: &Vec<f64>| values.len() == count)
}

/// The mean of the values in a block; NaN if it has none.
fn mean(map: &Map, block: usize, column: usize, row: usize) -> f64 {
    let (mut sum, mut count) = (0.0, 0_u32);
    let (width, height) = map.info.size(map.frame_size);
    for y in row * block..((row + 1) * block).min(height) {
        let line = &map.values[y * width..(y + 1) * width];
        for value in &line[column * block..((column + 1) * block).min(width)] {
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
    use fovqa_metrics::Metric;

    fn map(metric: Metric, frame_size: (usize, usize), values: Vec<f32>) -> Map {
        let info = metric.info().map.unwrap();
        Map { info, frame_size, values, is_half: false, pictures: Vec::new() }
    }

    fn halves(blocks: &MapBlocks) -> Vec<f64> {
        means(blocks).unwrap()
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
        let blocks = blocks(&map(Metric::Ssim, (10, 6), values.clone()), 8);
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
    fn a_damaged_record_has_no_means() {
        let good = blocks(&map(Metric::Ssim, (10, 6), vec![0.5; 60]), 8);
        assert!(means(&good).is_some());
        for bad in [
            MapBlocks { rows: 3, ..good.clone() },
            MapBlocks { rows: usize::MAX, ..good.clone() },
            MapBlocks { values: good.values[..4].to_owned(), ..good.clone() },
            MapBlocks { values: "?".to_owned(), ..good },
        ] {
            assert_eq!(means(&bad), None);
        }
    }

    #[test]
    fn a_block_without_values_has_none_and_a_coarse_map_keeps_its_pixels() {
        let none = blocks(&map(Metric::Ssim, (2, 1), vec![f32::NAN, 0.5]), 8);
        assert!(halves(&none)[0].is_nan() && (halves(&none)[1] - 0.5).abs() < 1e-9);
        // GMSD has a value for 2 x 2 pixels: 100 pixels are 50 values, in blocks of 7 pixels or more.
        let gmsd = blocks(&map(Metric::Gmsd, (100, 100), vec![1.0; 2500]), 64);
        assert_eq!((gmsd.block, gmsd.columns), (8, 13));
    }
}

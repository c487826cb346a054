//! `--maps`: the value of every pixel, and its picture.

use fovqa_io::{ReadOptions, read_frame};
use fovqa_testkit::synthetic::{codes, disturbed};

use crate::fovqa::Folder;
use crate::runs::experiment_folder::bytes;

const SIZE: (usize, usize) = (300, 70);

fn folder() -> Folder {
    let folder = Folder::new();
    let reference = codes(SIZE.0, SIZE.1, 3, 1);
    folder.png("a.png", SIZE.0, SIZE.1, &reference);
    folder.png("b.png", SIZE.0, SIZE.1, &disturbed(&reference, 40.0, 2));
    folder
}

/// The values of a map, row by row.
fn values(folder: &Folder, file: &str) -> Vec<f32> {
    let map = read_frame(&folder.path(file), &ReadOptions::default()).unwrap().frame;
    assert_eq!((map.width(), map.height()), SIZE, "{file}");
    (0..SIZE.0 * SIZE.1).map(|i| map.sample(0, i % SIZE.0, i / SIZE.0)).collect()
}

#[test]
fn the_squared_error_of_every_pixel() {
    let folder = folder();
    let mse = folder.metric("mse", &["a.png", "b.png", "--maps", "maps"]);
    let map = values(&folder, "maps/mse-0000.exr");
    let reference = codes(SIZE.0, SIZE.1, 3, 1);
    let test = disturbed(&reference, 40.0, 2);
    for (i, value) in map.iter().enumerate() {
        let squared = |c: usize| {
            let [a, b] = [&reference, &test].map(|codes| f64::from(codes[3 * i + c]) / 255.0);
            (a - b) * (a - b)
        };
        let want = (squared(0) + squared(1) + squared(2)) / 3.0;
        assert!((f64::from(*value) - want).abs() < 1e-7, "{i}: {value} for {want}");
    }
    let mean = map.iter().map(|value| f64::from(*value)).sum::<f64>() / map.len() as f64;
    assert!((mean - mse).abs() < 1e-9);
    assert_eq!(bytes(&folder.path("maps")).len(), 2, "values and picture of one map");
}

#[test]
fn ssim_where_the_window_fits() {
    let folder = folder();
    let ssim = folder.metric("ssim", &["a.png", "b.png", "--maps", "maps"]);
    let map = values(&folder, "maps/ssim-0000.exr");
    let fits = |i: usize| {
        let (x, y) = (i % SIZE.0, i / SIZE.0);
        (5..SIZE.0 - 5).contains(&x) && (5..SIZE.1 - 5).contains(&y)
    };
    assert!(map.iter().enumerate().all(|(i, value)| value.is_nan() != fits(i)));
    let inside: Vec<f64> = map.iter().filter(|v| !v.is_nan()).map(|v| f64::from(*v)).collect();
    let mean = inside.iter().sum::<f64>() / inside.len() as f64;
    assert!((mean - ssim).abs() < 1e-6, "{mean} for {ssim}");
    // Each value is the SSIM of the window alone, also at the borders of tiles and blocks of rows.
    let (reference, test) =
        (codes(SIZE.0, SIZE.1, 3, 1), disturbed(&codes(SIZE.0, SIZE.1, 3, 1), 40.0, 2));
    for (x, y) in [(5, 5), (255, 63), (256, 64), (257, 60), (294, 64)] {
        let window = |picture: &[u8]| -> Vec<u8> {
            let row = |y: usize| &picture[3 * (y * SIZE.0 + x - 5)..3 * (y * SIZE.0 + x + 6)];
            (y - 5..y + 6).flat_map(row).copied().collect()
        };
        folder.png("wa.png", 11, 11, &window(&reference));
        folder.png("wb.png", 11, 11, &window(&test));
        let alone = folder.metric("ssim", &["wa.png", "wb.png"]);
        let found = f64::from(map[y * SIZE.0 + x]);
        assert!((found - alone).abs() < 1e-6, "({x}, {y}): {found} for {alone}");
    }
    let picture = folder.path("maps/ssim-0000.png");
    let picture = read_frame(&picture, &ReadOptions::default()).unwrap().frame;
    assert!((picture.sample(0, 0, 0) - 128.0).abs() < 1e-6, "gray where there is no value");
}

#[test]
fn a_mask_leaves_pixels_out_and_equal_pictures_are_dark() {
    let folder = folder();
    let mask = |i: usize| if i % SIZE.0 < 200 { 255 } else { 0 };
    folder.png(
        "m.png",
        SIZE.0,
        SIZE.1,
        &(0..SIZE.0 * SIZE.1).flat_map(|i| [mask(i); 3]).collect::<Vec<u8>>(),
    );
    let masked = ["a.png", "a.png", "--metrics", "psnr,ssim", "--mask", "m.png", "--maps", "maps"];
    folder.score(&masked).ok();
    let map = values(&folder, "maps/mse-0000.exr");
    for (i, value) in map.iter().enumerate() {
        assert_eq!(value.is_nan(), i % SIZE.0 >= 200, "{i}");
        assert!(value.is_nan() || *value == 0.0);
    }
    let ssim = values(&folder, "maps/ssim-0000.exr");
    let alike = |value: &f32| value.to_bits() == 1f32.to_bits();
    assert!(ssim.iter().all(|value| value.is_nan() || alike(value)));
    let picture = folder.path("maps/mse-0000.png");
    let picture = read_frame(&picture, &ReadOptions::default()).unwrap().frame;
    assert!(picture.sample(0, 0, 0) < 1.0 && picture.sample(2, 0, 0) < 5.0);
}

/// The same bytes for any number of threads; in a run each comparison has a folder of its own.
#[test]
fn maps_of_a_run() {
    let folder = folder();
    folder.write(
        "e.toml",
        "name = \"e\"\n[[scene]]\nname = \"room\"\nreference = \"a.png\"\n\
         [[method]]\nname = \"B\"\ntest = \"b.png\"\n[metrics]\npsnr = {}\nssim = {}\n",
    );
    for threads in ["1", "3"] {
        folder.run(&["run", "e.toml", "--maps", threads, "--threads", threads]).ok();
    }
    let of = |threads: &str| bytes(&folder.path(&format!("{threads}/room/B")));
    assert_eq!(of("1").len(), 4);
    assert_eq!(of("1"), of("3"));
}

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
    assert!((picture.sample(0, 0, 0) - 221.0).abs() < 1e-6, "gray where there is no value");
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
    // The darkest colour of viridis, without any line: there is no view.
    assert_eq!(picture.width(), SIZE.0);
    assert!(picture.height() > SIZE.1 + 40, "the colour bar is below");
    for (x, y) in (0..SIZE.1).flat_map(|y| (0..200).map(move |x| (x, y))) {
        assert_eq!(
            [0, 1, 2].map(|c| picture.sample(c, x, y).round() as u8),
            [68, 1, 84],
            "{x} {y}"
        );
    }
}

/// With a view, the rings are where the bands change, and a cross is at the gaze.
#[test]
fn bands_and_gaze_are_drawn_over_the_colours() {
    let folder = Folder::new();
    let (width, height) = (600, 400);
    folder.png("a.png", width, height, &vec![90; 3 * width * height]);
    let view = ["--fov-vertical", "60", "--gaze", "150,220", "--bands", "0,10,25,80"];
    let score = ["a.png", "a.png", "--metrics", "mse,gmsd", "--maps", "maps"];
    folder.score(&[&score[..], &view].concat()).ok();
    let focal = 200.0 / 30f64.to_radians().tan();
    let ray = |x: f64, y: f64| [(x - 300.0) / focal, (y - 200.0) / focal, 1.0];
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let gaze = ray(150.0, 220.0);
    let deg = |x: usize, y: usize| {
        let at = ray(x as f64 + 0.5, y as f64 + 0.5);
        (dot(at, gaze) / (dot(at, at) * dot(gaze, gaze)).sqrt()).acos().to_degrees()
    };
    for map in ["mse", "gmsd"] {
        let path = folder.path(&format!("maps/{map}-0000.png"));
        let picture = read_frame(&path, &ReadOptions::default()).unwrap().frame;
        let is_light = |x: usize, y: usize| picture.sample(1, x, y) > 150.0;
        assert!(is_light(150, 220) && is_light(145, 220) && is_light(150, 226), "the cross");
        // Along a row above the labels, the light pixels are those where a band begins.
        let row = 100;
        for x in 1..width {
            let near = |edge: f64| (deg(x, row) - edge).abs() * focal.to_radians() < 2.0;
            let changes =
                [10.0, 25.0].iter().any(|edge| (deg(x - 1, row) < *edge) != (deg(x, row) < *edge));
            assert!(!changes || is_light(x, row) || is_light(x - 1, row), "{map}: {x}");
            assert!(!is_light(x, row) || near(10.0) || near(25.0), "{map}: {x}");
        }
    }
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

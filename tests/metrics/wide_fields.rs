//! FovVideoVDP in fields so wide, for their pixels per degree, that half a pixel more passes 90°.

use crate::fovqa::Folder;

const LUMINANCE: &str = "peak_cd_m2=100,contrast=1000";

fn write(folder: &Folder, (width, height): (usize, usize)) {
    let gray = |of: &dyn Fn(usize, usize) -> usize| -> Vec<u8> {
        let pixels = (0..width * height).map(|i| of(i % width, i / width) as u8);
        pixels.flat_map(|code| [code; 3]).collect()
    };
    let reference = |x: usize, y: usize| (x * 37 + y * 101) % 97 + 60;
    let test = |x: usize, y: usize| reference(x, y) + (x * 7 + y * 13) % 5 * 8;
    folder.png("a.png", width, height, &gray(&reference));
    folder.png("b.png", width, height, &gray(&test));
}

/// JOD by pyfvvdp 1.2.2, whose default gaze is the pixel at half of width and height.
#[test]
fn the_reference_program_is_reproduced_with_a_warning() {
    for (size, fov, gaze, wanted) in [
        ((96, 80), "140", "48.5,40.5", 8.829_954),
        ((96, 80), "150", "20.5,60.5", 8.779_680),
        ((64, 64), "160", "32.5,32.5", 8.575_780),
    ] {
        let folder = Folder::new();
        write(&folder, size);
        let arguments = ["a.png", "b.png", "--fov-horizontal", fov, "--gaze", gaze];
        let metric = ["--metrics", "fvvdp", "--luminance", LUMINANCE, "--format", "json"];
        let run = folder.score(&[&arguments[..], &metric].concat()).ok();
        let jod = run.json()["sequence"]["fvvdp"]["jod"].as_f64().unwrap();
        assert!((jod - wanted).abs() < 3e-4, "{fov}: {jod} for {wanted}");
        assert!(run.stderr.contains("the field is too wide for its"), "{}", run.stderr);
        // Looked at directly, no pixel is magnified.
        let direct = ["--set", "fvvdp.foveated=false"];
        let run = folder.score(&[&arguments[..], &metric, &direct].concat()).ok();
        assert!(!run.stderr.contains("too wide"), "{}", run.stderr);
    }
}

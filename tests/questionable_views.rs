//! Views in other units than those asked for, files whose pixels are not square, and frames that do not
//! fit into memory.

use fovqa_testkit::exr_files::{File, Part};

use crate::fovqa::Folder;

fn with_pair() -> Folder {
    let folder = Folder::new();
    folder.png_pair("a.png", "b.png", 480, 400);
    folder
}

#[test]
fn a_frustum_in_degrees_is_refused() {
    let folder = with_pair();
    let score = |frustum: &str| folder.score(&["a.png", "b.png", "--frustum", frustum]);
    score("45,45,40,40")
        .fails(2, &["more than 85° to one side", "the tangents are 1, 1, 0.8391, 0.8391"]);
    score("-45,45,45,-45").fails(2, &["the tangents are -1, 1, 1, -1"]);
    score("0.6,0.6,0.5,0.5").ok();
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfrustum = { left = 50, right = 45, up = 48, down = 48 }\n[[scene]]\nname = \"s\"\n\
         reference = \"a.png\"\n[[method]]\nname = \"A\"\ntest = \"b.png\"\n",
    );
    folder.run(&["run", "e.toml"]).fails(2, &["if these are degrees", "frustum"]);
    let curves =
        ["curves", "--method", "kfr", "--resolution", "1440x1600", "--frustum", "45,45,48,48"];
    folder.run(&curves).fails(2, &["if these are degrees"]);
}

#[test]
fn other_units_are_questioned() {
    let folder = with_pair();
    for (view, words) in [
        (&["--fov-vertical", "1.92"][..], "1.92 radians would be 110 degrees"),
        (&["--fov-horizontal", "172"], "whole angles"),
        (&["--fov-diagonal", "1.92"], "radians"),
        (
            &["--distance-m", "600", "--pixel-pitch-mm", "0.25"],
            "600 millimetres would be 0.6 metres",
        ),
        (&["--distance-m", "0.6", "--pixel-pitch-mm", "250"], "a pixel 250 millimetres"),
        // 1.2, 1.2, 1, 1 in radians: square pixels only as angles.
        (
            &["--frustum", "0.876058,0.876058,0.785398,0.785398"],
            "the tangents 1.20, 1.20, 1.00, 1.00",
        ),
        (&["--frustum", "1.2,1.0,1.2,1.0"], "in the order left, right, up, down"),
        (&["--fov-vertical", "90", "--fov-horizontal", "80"], "taller than they are wide"),
    ] {
        let run = folder.score(&[&["a.png", "b.png", "--metrics", "fpsnr"], view].concat());
        run.ok().says(&["warning", words]);
    }
    for view in [
        &["--fov-vertical", "110"][..],
        &["--frustum", "1.2,1.2,1,1"],
        &["--distance-m", "0.6", "--pixel-pitch-mm", "0.25"],
        &["--display", "vive-pro-eye"],
    ] {
        let run = folder.score(&[&["a.png", "b.png", "--metrics", "fpsnr"], view].concat()).ok();
        assert!(
            !run.stderr.contains("questionable") && !run.stderr.contains("% "),
            "{}",
            run.stderr
        );
    }
    let curves =
        ["curves", "--method", "kfr", "--resolution", "1440x1600", "--fov-vertical", "1.92"];
    folder.run(&curves).ok().says(&["1.92 radians would be 110 degrees"]);
}

/// The width of a pixel over its height has to be that of the view.
#[test]
fn a_pixel_aspect_ratio_agrees_with_the_view() {
    let folder = Folder::new();
    let write = |name: &str, pixel_aspect: f32| {
        let part = Part::rgb((48, 40), |x, y| (x * 7 + y * 3) as f32 / 1000.0);
        File { pixel_aspect, ..File::new(vec![part]) }.write(&folder.path(name));
    };
    write("square.exr", 1.000_001);
    write("wide.exr", 2.0);
    let score = |names: [&str; 2], view: &[&str]| {
        folder.score(&[&names, &["--metrics", "fpsnr"][..], view].concat())
    };
    let one = ["--fov-vertical", "60"];
    score(["square.exr"; 2], &one).ok();
    for names in [["wide.exr", "square.exr"], ["square.exr", "wide.exr"], ["wide.exr"; 2]] {
        score(names, &one).fails(
            3,
            &[
                "wide.exr has the pixelAspectRatio 2",
                "the view has 1.0000",
                "horizontal and the vertical",
            ],
        );
    }
    // Pixels that are twice as wide: a focal length of half as many.
    let both = ["--frustum", "1.2,1.2,0.5,0.5"];
    score(["wide.exr"; 2], &both).ok();
    // Without a view nothing depends on it.
    folder.score(&["wide.exr", "wide.exr", "--metrics", "psnr"]).ok();
}

/// A header that declares more than any machine has, where the limit on sizes lets it pass.
#[test]
fn frames_that_cannot_fit_into_memory_are_not_begun() {
    let folder = with_pair();
    let png = |side: u32| {
        let mut header = b"IHDR".to_vec();
        header.extend([side.to_be_bytes(), side.to_be_bytes()].concat());
        header.extend([8, 2, 0, 0, 0]);
        let mut file = b"\x89PNG\r\n\x1a\n\0\0\0\x0d".to_vec();
        file.extend(&header);
        file.extend(crc32(&header).to_be_bytes());
        file.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
        file
    };
    for name in ["c.png", "d.png"] {
        folder.write(name, png(1_000_000));
    }
    let score = ["c.png", "d.png", "--metrics", "fvvdp", "--display", "htc-vive-pro"];
    let large = ["--max-megapixels", "1000000"];
    let run = folder.score(&[&score[..], &large].concat());
    #[cfg(target_os = "linux")]
    let run = run.says(&[
        "frames of 1000000x1000000 pixels need at least",
        "FovVideoVDP 10000.0 GB",
        "are available",
        "leave fvvdp out with --metrics",
        "--crop",
    ]);
    assert_eq!((run.code, run.stdout.as_str()), (3, ""));
    folder.score(&score).fails(3, &["more than the limit of 256 megapixels"]);
}

/// The checksum of a PNG chunk.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc: u32, _| {
            if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 }
        })
    })
}

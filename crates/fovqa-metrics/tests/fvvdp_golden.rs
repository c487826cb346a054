//! Compares FovVideoVDP with the reference program, for every case of the golden values, frame by
//! frame and band by band, through the library's API.

#![allow(clippy::unwrap_used, reason = "a test fails where a golden value is missing")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fovqa_frame::{Frame, LuminanceTables, SignalParams, Transfer};
use fovqa_metrics::fvvdp::{
    ColorSpace, Fvvdp, FvvdpFrame, Geometry, Grid, Padding, Params, Photometry, Stream, Time, jod,
};
use fovqa_metrics::{Key, Metric, Regions, Rows, pu_psnr};
use fovqa_testkit::fvvdp_golden::{FvvdpCase, Golden};
use fovqa_vision::{
    BandEdges, BandMap, Display, Eccentricity, EccentricityKind, Eotf, Luminance, View, ViewSpec,
    find_display,
};
use serde_json::Value;

/// The required tolerance is 0.01; the reference program's own rounding error is 1e-4.
const JOD: f64 = 3e-4;

fn photometry(case: &FvvdpCase, display: &Display) -> Photometry {
    let Some(given) = &case.photometry else {
        return Photometry::new(display.luminance.expect("a display with photometry"));
    };
    let number = |key: &str| given.get(key).and_then(Value::as_f64);
    let luminance = if given["type"] == "absolute" {
        Luminance {
            eotf: Eotf::Absolute,
            min_cd_m2: number("L_min"),
            ..Luminance::of_peak(number("L_max").unwrap())
        }
    } else {
        assert_eq!(given["EOTF"], "gamma");
        Luminance {
            eotf: Eotf::Gamma,
            gamma: number("gamma").unwrap(),
            contrast: number("contrast"),
            ambient_lux: number("E_ambient").unwrap(),
            reflectivity: number("k_refl").unwrap(),
            ..Luminance::of_peak(number("Y_peak").unwrap())
        }
    };
    Photometry::new(luminance)
}

/// The geometry of frames that are stretched over the display of a case.
fn geometry(case: &FvvdpCase, display: &Display) -> Geometry {
    let Some(given) = &case.geometry else {
        let spec = ViewSpec::Display(display.clone());
        let view = spec.resolve(case.width, case.height).unwrap().view;
        return Geometry::new(view, Some(display.central_pixels_per_degree()));
    };
    let number = |key: &str| given.get(key).and_then(Value::as_f64);
    let [w, h] = [0, 1].map(|i| given["resolution"][i].as_u64().unwrap() as usize);
    let spec = if let Some(fov) = number("fov_horizontal") {
        ViewSpec::Fov { horizontal_deg: Some(fov), vertical_deg: None }
    } else {
        let diagonal_m = number("diagonal_size_inches").unwrap() * 0.0254;
        let aspect = w as f64 / h as f64;
        let height_m = diagonal_m / (1.0 + aspect * aspect).sqrt();
        let distance_m = number("distance_display_heights").unwrap() * height_m;
        ViewSpec::Screen { distance_m, size_m: [height_m * aspect, height_m] }
    };
    let own = spec.resolve(w, h).unwrap().view;
    let scale = [case.width as f64 / w as f64, case.height as f64 / h as f64];
    let scaled = |pair: [f64; 2]| [pair[0] * scale[0], pair[1] * scale[1]];
    let view = View {
        width: case.width,
        height: case.height,
        focal_px: scaled(own.focal_px),
        principal_px: scaled(own.principal_px),
    };
    Geometry::new(view, Some(Geometry::new(own, None).pixels_per_degree))
}

struct CaseScores {
    jod: f64,
    frames: Vec<FvvdpFrame>,
    pu_psnr_db: Vec<f64>,
}

fn found(golden: &Golden, case: &FvvdpCase, keep: bool) -> CaseScores {
    let display = find_display(&case.display).unwrap();
    let geometry = geometry(case, display);
    assert!((geometry.pixels_per_degree / case.ppd - 1.0).abs() < 1e-6, "{}", case.id);
    let padding = match case.temp_padding.as_deref() {
        None | Some("replicate") => Padding::Replicate,
        Some("circular") => Padding::Circular,
        Some("pingpong") => Padding::Pingpong,
        Some(other) => panic!("{other}"),
    };
    let color_space = match case.color_space.as_deref() {
        None => ColorSpace::default(),
        Some("Adobe RGB (1998)") => ColorSpace::find("adobe_rgb").unwrap(),
        Some(other) => panic!("{other}"),
    };
    let params =
        Params { foveated: case.foveated, temp_padding: padding, color_space, ..Params::default() };
    let photometry = photometry(case, display);
    let encoded = photometry.eotf().is_relative() || photometry.eotf() == Eotf::Pq;
    let transfer = encoded.then_some(Transfer::Srgb);
    let tables = photometry.tables(SignalParams { transfer, ..SignalParams::default() }, &params);
    let pictures = golden.frames(case);
    let [reference, test] = pictures.each_ref().map(|frames| luminance(frames, &tables));
    assert_eq!((reference.len(), test.len()), (case.n_frames, case.n_frames), "{}", case.id);

    let time = Time::new(reference.len(), case.fps, padding).unwrap();
    let fvvdp = Fvvdp::new(geometry, &params);
    let frequencies: Vec<f64> = fvvdp.frequencies_cpd().collect();
    assert_eq!(frequencies.len() + 1, case.rho_band.len(), "{}", case.id);
    let edges = BandEdges::new(vec![0.0, 2.0, 5.0, 10.0]).unwrap();
    let mut streams = [&reference, &test].map(|frames| {
        let before = time.before_first().into_iter().map(|f| (f, Arc::clone(&frames[f])));
        Stream::begin(&time, &frames[0], &before.collect::<BTreeMap<_, _>>())
    });
    let mut frames = Vec::new();
    for index in 0..reference.len() {
        if index > 0 {
            streams[0].push(index, Arc::clone(&reference[index]));
            streams[1].push(index, Arc::clone(&test[index]));
        }
        let gaze_px = case.gaze_px(index);
        let eccentricity = Eccentricity::new(geometry.view, gaze_px, EccentricityKind::Angular);
        let regions = fvvdp.regions(&eccentricity, &edges);
        let prepared = fvvdp.reference(streams[0].channels(&time), gaze_px, keep);
        frames.push(fvvdp.score(&prepared, &streams[1].channels(&time), &regions, None));
    }
    let bands = BandMap::without_bands(case.width, case.height);
    let pu = |(reference, test): (&Frame, &Frame)| {
        let mut rows = Rows::default();
        pu_psnr::rows(reference, test, &tables, &Regions::unmasked(&bands), &mut rows);
        rows.value(Key::of(Metric::PuPsnr)).unwrap()
    };
    let q = frames.iter().map(|frame| frame.q).sum::<f64>() / frames.len() as f64;
    let pu_psnr_db = pictures[0].iter().zip(&pictures[1]).map(pu).collect();
    CaseScores { jod: jod(q), frames, pu_psnr_db }
}

fn luminance(frames: &[Frame], tables: &LuminanceTables) -> Vec<Arc<Grid>> {
    frames.iter().map(|frame| Arc::new(Grid::luminance(frame, tables))).collect()
}

fn check(folder: &Path) {
    let golden = Golden::read(folder);
    assert!(!golden.cases.is_empty());
    for case in &golden.cases {
        let found = found(&golden, case, false);
        assert!((found.jod - case.jod).abs() <= JOD, "{}: {} for {}", case.id, found.jod, case.jod);
        for (band, (wanted, cpd)) in case.q_per_ch.iter().zip(&case.rho_band).enumerate() {
            for (index, frame) in found.frames.iter().enumerate() {
                let band = &frame.bands[band];
                assert!((band.cpd / cpd - 1.0).abs() < 1e-6, "{}", case.id);
                let found = [Some(band.sustained), band.transient];
                for (found, wanted) in found.iter().zip(wanted) {
                    let Some(found) = found else { continue };
                    let error = (found - wanted[index]).abs() / (wanted[index] + 0.1);
                    assert!(error < 2e-3, "{}: Q {found} for {}", case.id, wanted[index]);
                }
            }
        }
        if let Some(wanted) = case.pu_psnr_db {
            let mean = found.pu_psnr_db.iter().sum::<f64>() / found.pu_psnr_db.len() as f64;
            assert!((mean - wanted).abs() < 1e-3, "{}: {mean} dB for {wanted}", case.id);
        }
    }
}

#[test]
fn all_cases() {
    let folder = root().join("../shared/golden/fvvdp");
    if folder.is_dir() {
        check(&folder);
    }
}

#[test]
fn committed_cases() {
    check(&root().join("tests/golden/fvvdp"));
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

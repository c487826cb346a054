//! The example programs do what they say.

#[allow(dead_code, reason = "its main is for `cargo run --example`")]
#[path = "../examples/experiment.rs"]
mod experiment;
#[allow(dead_code, reason = "its main is for `cargo run --example`")]
#[path = "../examples/score_pair.rs"]
mod score_pair;

use std::path::Path;

use fovqa::Metric;

#[test]
fn a_pair_in_memory_is_scored() {
    let reference = score_pair::reference();
    let near = score_pair::foveated(&reference, [120, 100], 90);
    let far = score_pair::foveated(&reference, [120, 100], 40);
    let [near, far] = [near, far].map(|test| score_pair::score_pair(&reference, &test).unwrap());
    for metric in [Metric::Psnr, Metric::Fpsnr, Metric::Ssim] {
        assert!(near.value(metric) > far.value(metric), "{metric:?}");
    }
    // Within the radius nothing differs.
    let ssim = near.maps.iter().find(|map| map.name == "ssim").unwrap();
    assert_eq!(ssim.values.dim(), (200, 240));
    assert!((ssim.values[[100, 120]] - 1.0).abs() < 1e-6 && ssim.values[[10, 10]] < 0.99);
    let same = score_pair::score_pair(&reference, &reference).unwrap();
    assert_eq!(same.value(Metric::Psnr), Some(f64::INFINITY));
}

#[test]
fn an_experiment_is_run() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/renders.toml");
    let folder = tempfile::tempdir().unwrap();
    let finished = experiment::run(&file, folder.path().join("out")).unwrap();
    assert!(finished.scored > 0 && finished.errors == 0 && finished.drawn.is_some());
    assert!(finished.folder.join("report.html").is_file());
}

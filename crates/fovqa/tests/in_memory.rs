//! Plans whose inputs and results are in memory give what files give.

use std::path::{Path, PathBuf};

use fovqa::{
    Compared, Emulation, EmulationSpec, EyeView, FoveateOutputs, Gaze, Given, Metric, MetricChoice,
    Plan, ReadOptions, Scene, ScoreReport, Settings, Silent, SourceOptions, SourceSpec, ViewSpec,
    foveate_files, foveate_frames, open_source, score_files, score_plan,
};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/small/living-room").join(name)
}

fn settings() -> Settings {
    let view = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(95.0) };
    Settings { view: Some(view), ..Settings::default() }
}

fn plan(settings: Settings, test: SourceSpec) -> Plan {
    let reference = file("gt.png").into();
    let eye = EyeView { reference, tests: vec![(0, test)], settings, ..EyeView::default() };
    Plan {
        scenes: vec![Scene { eyes: vec![eye], ..Scene::default() }],
        methods: vec![String::new()],
        metrics: MetricChoice::Named(vec![Metric::Psnr, Metric::Ssim, Metric::Fpsnr]),
        ..Plan::default()
    }
}

fn score(settings: Settings, given: &Given) -> Result<ScoreReport, fovqa::Error> {
    score_files(&plan(settings, file("rmfr.png").into()), given, None, &Silent)
}

#[test]
fn a_gaze_for_each_frame_is_the_gaze() {
    let of = |gaze| score(Settings { gaze, ..settings() }, &Given::new());
    let each = of(Gaze::Each(vec![[200.0, 300.0]])).unwrap();
    let point = of(Gaze::Point([200.0, 300.0])).unwrap();
    let rows = |report: &ScoreReport| report.frames[0].rows.clone();
    assert_eq!(rows(&each), rows(&point));
    assert_ne!(rows(&each), rows(&of(Gaze::Centre).unwrap()));
    assert_eq!(each.frames[0].gaze_px, Some([200.0, 300.0]));
    for points in [vec![], vec![[1.0, 2.0]; 2]] {
        let error = of(Gaze::Each(points)).unwrap_err();
        assert!(error.is_usage() && error.to_string().contains("gaze points is"), "{error}");
    }
}

#[test]
fn a_mask_may_come_from_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mask.png");
    let codes: Vec<u8> =
        (0..720 * 800).flat_map(|i| [if i % 720 < 300 { 255 } else { 90 }; 3]).collect();
    std::fs::write(&path, fovqa_io::png_rgb8(720, 800, &codes).unwrap()).unwrap();
    let options = SourceOptions { base: PathBuf::new(), read: ReadOptions::default(), hash: false };
    let given: Given = [("lens".to_owned(), open_source(&path, options).unwrap())].into();
    let of_file = score(Settings { mask: Some(path), ..settings() }, &Given::new()).unwrap();
    let given_mask = Some("lens".to_owned());
    let of_program =
        score(Settings { given_mask: given_mask.clone(), ..settings() }, &given).unwrap();
    assert_eq!(of_program.frames[0].rows, of_file.frames[0].rows);
    assert_ne!(of_program.frames[0].rows, score(settings(), &given).unwrap().frames[0].rows);
    let error = score(Settings { given_mask, ..settings() }, &Given::new()).unwrap_err();
    assert!(error.to_string().contains("\"lens\""), "{error}");
}

#[test]
fn maps_are_handed_over_with_their_heat_maps() {
    let folder = tempfile::tempdir().unwrap();
    let plan = Plan { maps: true, ..plan(settings(), file("rmfr.png").into()) };
    let written = score_files(&plan, &Given::new(), Some(folder.path()), &Silent).unwrap();
    let mut seen = Vec::new();
    let compared = score_plan(&plan, &Given::new(), &Silent, &mut |pair| {
        for map in pair.maps {
            let picture = folder.path().join(format!("{}-0000.png", map.info.name));
            assert_eq!(pair.heat_map(map)?, std::fs::read(picture)?);
            seen.push(map.info.name);
        }
        Ok(())
    });
    let Compared::OneEye(report) = compared.unwrap() else { panic!("one eye") };
    assert_eq!(*report, written);
    assert_eq!(seen, ["mse", "ssim"]);
    let refused =
        score_plan(&plan, &Given::new(), &Silent, &mut |_| Err(std::io::Error::other("full")));
    assert!(refused.unwrap_err().to_string().contains("full"));
}

#[test]
fn emulated_frames_are_those_that_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let spec = || SourceSpec::from(Emulation::from(EmulationSpec::new("rmfr").unwrap()));
    let path = folder.path().join("shown.png");
    let outputs = FoveateOutputs { frames: path.clone(), buffers: None };
    let plan = Plan { metrics: MetricChoice::Named(Vec::new()), ..plan(settings(), spec()) };
    let written = foveate_files(&plan, &Given::new(), &outputs, &Silent).unwrap();
    let mut frames = Vec::new();
    let shown =
        foveate_frames(&plan, &Given::new(), true, &Silent, &mut |frame| frames.push(frame))
            .unwrap();
    let read = fovqa_io::read_frame(&path, &ReadOptions::default()).unwrap().frame;
    assert_eq!((frames.len(), frames[0].frame.samples()), (1, read.samples()));
    let buffer = &frames[0].buffers[0];
    assert_eq!([buffer.width(), buffer.height()], shown.record.frames[0].buffers[0]);
    assert_eq!(
        shown.record.frames[0].samples.to_bits(),
        written.record.frames[0].samples.to_bits()
    );
}

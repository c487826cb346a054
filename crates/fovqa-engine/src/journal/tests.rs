//! What is written can be read again without loss of a bit. Damaged lines are refused.

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_metrics::{Image, Key, Metric, Parts, Pooling, Rows, Subject};
use fovqa_plan::{Experiment, Eye, EyeView, Plan, Scene};
use fovqa_results::{
    Doubt, Failure, FrameResult, FvvdpViewing, GuideSource, GuideSources, Identity, ViewResult,
};

use super::read::Said;
use super::seal::sealed;
use super::write::Lines;
use super::*;
use crate::findings::{Entry, Findings, Outcome, Settled, ViewFindings};

fn plan() -> Plan {
    let eye =
        |eye| EyeView { eye, tests: vec![(0, "a".into()), (1, "b".into())], ..EyeView::default() };
    let scene = |name: &str, eyes| Scene { name: name.to_owned(), eyes, ..Scene::default() };
    let both = Eye::BOTH.map(|side| eye(Some(side))).into();
    Plan {
        scenes: vec![scene("one", vec![eye(None)]), scene("two", both)],
        methods: vec!["A".to_owned(), "B, \"quoted\"".to_owned()],
        ..Plan::default()
    }
}

/// A frame with every optional value.
fn frame() -> FrameResult {
    let values = [0.1 + 0.2, f64::INFINITY, f64::NEG_INFINITY, -0.0, f64::MIN_POSITIVE, 1e22];
    let parts = [
        Parts::Value,
        Parts::Mean { sum: 1.0 / 3.0, weight: 1e22 },
        Parts::Deviation { count: 3.0, sum: f64::MAX, squares: 0.1 + 0.7 },
    ];
    let mut rows = Rows::default();
    for (index, metric) in Metric::ALL.into_iter().enumerate() {
        for (nth, statistic) in metric.info().statistics.iter().enumerate() {
            let key = Key::named(Subject::Metric(metric), statistic.name).unwrap();
            let image = Image::ALL[nth % 3];
            let value = Some(values[(index + nth) % values.len()]);
            let parts = match statistic.frames {
                Pooling::WeightedMean | Pooling::Decibels => parts[1],
                Pooling::Deviation => parts[2],
                _ => parts[nth % parts.len()],
            };
            rows.push(key.of_image(image), value, parts);
            rows.push(key.in_band(index), None, Parts::Value);
            rows.push(key.on_level(nth + 1).in_band(0), Some(1.0 / 7.0), parts);
        }
    }
    rows.count(Key::pixels(Subject::Pixels).in_band(1), 3);
    rows.count(Key::pixels(Subject::PixelsOutsideBands), 0);
    rows.count(Key::pixels(Subject::PixelsLeftOut), 1 << 40);
    FrameResult {
        frame: i64::MIN,
        reference: "gt/ä \u{1}.png".into(),
        test: "a".into(),
        gaze_px: Some([0.1, -7.25]),
        gaze_step_deg: Some(1e-300),
        doubts: vec![Doubt { check: "gaze".to_owned(), message: "the test\n\"is\"".to_owned() }],
        rows: rows.into(),
    }
}

/// A frame without any optional value.
fn bare_frame() -> FrameResult {
    let mut rows = Rows::default();
    let parts = Parts::Mean { sum: 0.0, weight: 1.0 };
    rows.push(Key::of(Metric::Psnr), Some(f64::INFINITY), parts);
    rows.score(Key::of(Metric::Mse), 5.0);
    FrameResult {
        gaze_px: None,
        gaze_step_deg: None,
        doubts: Vec::new(),
        rows: rows.into(),
        ..frame()
    }
}

fn failure(frame: Option<i64>) -> Failure {
    let text = |text: &str| text.to_owned();
    let (message, help) = (text("no\npicture"), text("mend {it}"));
    Failure { frame, reference: text("gt/1"), test: text("a/1"), message, help }
}

fn findings() -> Findings {
    let mut findings = Findings::default();
    let id = |sha256: &str| Identity::new(1 << 60, sha256);
    findings.inputs.add("gt/ä.png".into(), id("00"));
    findings.inputs.add("b".into(), id("11"));
    findings.problems.push(((0, 1, 0), failure(None)));
    let outcome = |method, result| {
        let guides = GuideSources { motion: GuideSource::Test, depth: GuideSource::Reference };
        Box::new(Outcome { method, result, guides })
    };
    let bare = Outcome { guides: GuideSources::default(), ..*outcome(1, Ok(bare_frame())) };
    let failed = Outcome { guides: GuideSources::default(), ..*outcome(0, Err(failure(Some(3)))) };
    let sight = FvvdpViewing {
        pixels_per_degree: 13.1,
        peak_cd_m2: 100.1,
        black_cd_m2: 0.1,
        foveated: true,
        frequencies_cpd: vec![6.5, 0.1 + 0.2],
        fps: Some(23.976),
        missing: None,
        eyes_jod: None,
    };
    let still = FvvdpViewing { fps: None, foveated: false, ..sight.clone() };
    let settled = Settled {
        view: Some(ViewResult {
            size: [3, 4],
            focal_px: [1.1, 2.2],
            gaze_px: [0.1 + 0.2, 0.25],
            eccentricity: fovqa_vision::EccentricityKind::Planar,
            bands_deg: vec![(0.0, 5.0), (5.0, 10.1)],
        }),
        metrics: vec![Metric::Psnr, Metric::MsSsim, Metric::Atd],
        gaze_held: Some(2),
        fvvdp: BTreeMap::from([(0, sight), (1, still)]),
        missing: BTreeMap::from([(1, "frame 3 could not be scored".to_owned())]),
        passed_over: 0,
    };
    let of = |pairs, settled| ViewFindings { pairs, settled, ..ViewFindings::default() };
    let pairs =
        BTreeMap::from([(0, outcome(0, Ok(frame()))), (1, Box::new(bare)), (2, Box::new(failed))]);
    findings.views.insert((0, 0), of(pairs, Some(settled)));
    let none = Settled { metrics: vec![Metric::Mse], passed_over: 2, ..Settled::default() };
    findings.views.insert((1, 0), of(BTreeMap::new(), Some(none)));
    let failed = Some(failure(None));
    findings.views.insert((1, 1), ViewFindings { failed, ..ViewFindings::default() });
    findings
}

fn header(plan: &Plan, shard: Option<&str>) -> Header {
    let text = "name = \"e\"\n".to_owned();
    let experiment =
        Experiment { plan: plan.clone(), text, path: "x/e.toml".into(), ..Experiment::default() };
    let found = crate::found::FoundInputs { views: vec![], problems: vec![] };
    let mut header = Header::new(&experiment, &found, shard.map(|shard| shard.parse().unwrap()));
    for (scene, eye) in [("one", None), ("two", Some(Eye::Left)), ("two", Some(Eye::Right))] {
        let (scene, files) = (scene.to_owned(), String::new());
        header.views.push(ViewFiles { scene, eye, pairs: 4, files });
    }
    header
}

fn read_text(folder: &Path) -> Box<Text> {
    match read(folder).unwrap() {
        Content::Journal(text) => text,
        _ => panic!("it is a journal"),
    }
}

fn said(folder: &Path, lines: &[u8]) -> Said {
    std::fs::write(folder.join(JOURNAL), lines).unwrap();
    read_text(folder).said(&plan(), &mut Shared::default()).unwrap()
}

#[test]
fn everything_is_read_again_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let (plan, findings) = (plan(), findings());
    let header = header(&plan, None);
    let mut journal = Journal::begin(folder.path(), &header, &plan, &findings).unwrap();
    let text = read_text(folder.path());
    assert_eq!(text.header, header);
    assert_eq!(header.experiment_file(), "e.toml");
    let said = text.said(&plan, &mut Shared::default()).unwrap();
    assert!(!said.torn && !said.done && said.twice.is_none());
    // The debug texts are compared too, because equal numbers may differ in their sign.
    assert_eq!(said.findings, findings);
    assert_eq!(format!("{:?}", said.findings), format!("{findings:?}"));
    // A later line replaces an earlier one.
    let mended = Outcome { method: 0, result: Ok(bare_frame()), guides: GuideSources::default() };
    let finished = crate::findings::Finished {
        named: crate::findings::Named::of(&plan, (0, 0, 0)),
        step: 2,
        result: mended.result.as_ref(),
        guides: mended.guides,
        maps: &[],
        kept: None,
        crops: &[],
        pictures: None,
        seen: None,
    };
    journal.write(Entry::Pair(finished)).unwrap();
    let said = read_text(folder.path()).said(&plan, &mut Shared::default()).unwrap();
    assert_eq!(*said.findings.views[&(0, 0)].pairs[&2], mended);
    assert!(!said.done);
}

/// The order is the same however the lines were ordered, and whichever of them were written twice.
#[test]
fn what_is_finished_stands_in_one_order() {
    let folder = tempfile::tempdir().unwrap();
    let (plan, mut findings) = (plan(), findings());
    findings.views.entry((0, 0)).or_default().before.push((1, failure(None)));
    for shard in [None, Some("1/1")] {
        let header = header(&plan, shard);
        let finish = |known: &Findings, findings: &Findings| {
            let journal = Journal::begin(folder.path(), &header, &plan, known).unwrap();
            journal.finish(&header, &plan, findings).unwrap();
            std::fs::read(folder.path().join(JOURNAL)).unwrap()
        };
        let whole = finish(&Findings::default(), &findings);
        assert_eq!(finish(&findings, &findings), whole);
        // Line by line, the inputs last; the views in their order, and the other way round.
        let views = findings.views.clone().into_iter();
        let mut parts: Vec<Findings> = views
            .map(|view| Findings { views: [view].into(), ..Findings::default() })
            .chain([Findings { views: BTreeMap::new(), ..findings.clone() }])
            .collect();
        for _ in 0..2 {
            let mut journal =
                Journal::begin(folder.path(), &header, &plan, &Findings::default()).unwrap();
            for part in &parts {
                part.record(&plan, &mut |entry| journal.write(entry)).unwrap();
            }
            journal.finish(&header, &plan, &findings).unwrap();
            assert!(std::fs::read(folder.path().join(JOURNAL)).unwrap() == whole);
            parts.reverse();
        }
        let said = read_text(folder.path()).said(&plan, &mut Shared::default()).unwrap();
        assert_eq!((said.done, said.torn), (shard.is_some(), false));
        assert_eq!(said.findings, findings);
        // A pair that does not belong to the run is not written. The step after the last of the four pairs
        // belongs to it only as an error: a source continues there.
        let with = |step, of: usize| {
            let mut more = findings.clone();
            let pairs = &mut more.views.get_mut(&(0, 0)).unwrap().pairs;
            pairs.insert(step, pairs[&of].clone());
            more
        };
        let (scored, failed) = (0, 2);
        for more in [with(4, scored), with(5, scored), with(5, failed)] {
            assert_eq!(finish(&findings, &more), whole);
        }
        let continues = with(4, failed);
        assert_ne!(finish(&findings, &continues), whole);
        let said = read_text(folder.path()).said(&plan, &mut Shared::default()).unwrap();
        assert_eq!((said.torn, said.findings), (false, continues));
    }
}

#[test]
fn what_is_no_number_is_read_again() {
    let mut result = bare_frame();
    let mut rows: Rows = result.rows.iter().collect();
    rows.score(Key::of(Metric::Ssim), f64::NAN);
    result.rows = rows.into();
    result.gaze_step_deg = Some(f64::NAN);
    let finished = crate::findings::Finished {
        named: crate::findings::Named { scene: "one", method: "A", eye: None },
        step: 0,
        result: Ok(&result),
        guides: GuideSources::default(),
        maps: &[],
        kept: None,
        crops: &[],
        pictures: None,
        seen: None,
    };
    let folder = tempfile::tempdir().unwrap();
    Journal::begin(folder.path(), &header(&plan(), None), &plan(), &Findings::default()).unwrap();
    let head = std::fs::read(folder.path().join(JOURNAL)).unwrap();
    let lines = Lines::default().of(Entry::Pair(finished));
    let said = said(folder.path(), &[head, lines].concat());
    let again = said.findings.views[&(0, 0)].pairs[&0].result.as_ref().unwrap();
    assert_eq!(format!("{again:?}"), format!("{result:?}"));
}

#[test]
fn a_piece_of_a_line_is_dropped_and_what_is_behind_it() {
    let folder = tempfile::tempdir().unwrap();
    let plan = plan();
    Journal::begin(folder.path(), &header(&plan, None), &plan, &findings()).unwrap();
    let whole = std::fs::read(folder.path().join(JOURNAL)).unwrap();
    let lines: Vec<&[u8]> = whole.split_inclusive(|byte| *byte == b'\n').collect();
    for end in lines[0].len()..=whole.len() {
        let said = said(folder.path(), &whole[..end]);
        assert_eq!(said.torn, whole[end - 1] != b'\n', "{end}");
        let before = whole[..end].split(|byte| *byte == b'\n').count() - 1;
        let frames = lines[..before]
            .iter()
            .filter(|line| String::from_utf8_lossy(line).contains("\"step\""));
        assert_eq!(said.findings.pairs(), frames.count(), "{end}");
    }
    // If the file ends within the first line, there is no journal yet.
    for end in [1, 20, lines[0].len() - 2] {
        std::fs::write(folder.path().join(JOURNAL), &whole[..end]).unwrap();
        assert!(matches!(read(folder.path()).unwrap(), Content::Other), "{end}");
    }
    std::fs::write(folder.path().join(JOURNAL), "").unwrap();
    assert!(matches!(read(folder.path()).unwrap(), Content::Nothing));
}

/// Gives changed lines valid checksums, as if they had been written so.
fn resealed(lines: &str) -> String {
    let line = |line: &str| match line.rsplit_once(",\"sum\":") {
        Some((object, _)) => String::from_utf8(sealed(format!("{object}}}").into_bytes())).unwrap(),
        None => line.to_owned(),
    };
    lines.split_inclusive('\n').map(line).collect()
}

#[test]
fn a_line_that_was_changed_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let plan = plan();
    Journal::begin(folder.path(), &header(&plan, None), &plan, &findings()).unwrap();
    let whole = std::fs::read_to_string(folder.path().join(JOURNAL)).unwrap();
    let lines: Vec<&str> = whole.split_inclusive('\n').collect();
    for at in 0..lines.len() {
        let changed = lines[at].replacen("\"gt/1\"", "\"gt/2\"", 1).replacen(":1", ":2", 1);
        if changed == lines[at] {
            continue;
        }
        let text = [&lines[..at], &[&*changed], &lines[at + 1..]].concat().concat();
        let found = said(folder.path(), text.as_bytes());
        assert_eq!((found.changed, found.done), (Some(at + 1), false), "{changed}");
        assert!(said(folder.path(), resealed(&text).as_bytes()).changed.is_none());
    }
}

#[test]
fn lines_of_something_else_are_not_understood() {
    let folder = tempfile::tempdir().unwrap();
    let plan = plan();
    Journal::begin(folder.path(), &header(&plan, Some("1/3")), &plan, &Findings::default())
        .unwrap();
    let head = std::fs::read(folder.path().join(JOURNAL)).unwrap();
    assert_eq!(shard_in(folder.path()), Some("1/3".parse().unwrap()));
    let line = |named: crate::findings::Named<'_>, step| {
        let result = bare_frame();
        let guides = GuideSources::default();
        let finished = crate::findings::Finished {
            named,
            step,
            result: Ok(&result),
            guides,
            maps: &[],
            kept: None,
            crops: &[],
            pictures: None,
            seen: None,
        };
        String::from_utf8(Lines::default().of(Entry::Pair(finished))).unwrap()
    };
    let named = |scene, method, eye| crate::findings::Named { scene, method, eye };
    let good = line(named("one", "A", None), 3);
    let torn = |line: &str| {
        let line = resealed(line);
        let said = said(folder.path(), &[&head, line.as_bytes(), good.as_bytes()].concat());
        assert_eq!(said.changed, None, "{line}");
        assert_eq!(said.findings.pairs(), usize::from(!said.torn), "{line}");
        said.torn
    };
    assert!(!torn(&good));
    for bad in [
        line(named("three", "A", None), 3),
        line(named("one", "C", None), 3),
        line(named("one", "A", Some(Eye::Left)), 3),
        // One line belongs to the second shard, the other to no shard.
        line(named("two", "A", Some(Eye::Left)), 0),
        line(named("one", "A", None), 4),
        good.replace("\"mse\"", "\"msf\""),
        good.replace("\"pair\"", "\"pear\""),
        good.replace("\"inf\"", "\"much\""),
        // One number too many, one too few, and invalid parts.
        good.replace("[5.0,", "[5.0,1.0,"),
        good.replace("[5.0,", "["),
        good.replace("0.0,1.0]", "0.0,null]"),
        good.replace("\"inf\"", "false"),
        // A band and a level that no frame has.
        good.replacen("\"pair\",null,null,0", "\"pair\",null,65536,0", 1),
        good.replacen("\"pair\",null,null,0", "\"pair\",2048,null,0", 1),
        // Keys in another order, a repeated key, and a number of keys that does not exist.
        good.replace("\"mse\"", "\"ssim\""),
        good.replace("\"mse\"", "\"psnr\""),
        good.replace("\"keys\":0", "\"keys\":7"),
        "[]\n".to_owned(),
        "{}\n".to_owned(),
        "{\"done\":1}\n".to_owned(),
        "\n".to_owned(),
    ] {
        assert!(torn(&bad), "{bad}");
    }
    let id = |sha256: &str| {
        let object = format!("{{\"input\":\"x\",\"bytes\":1,\"sha256\":\"{sha256}\"}}");
        String::from_utf8(sealed(object.into_bytes())).unwrap()
    };
    let twice = [id("0"), id("0"), id("1")].concat();
    assert_eq!(said(folder.path(), &[&head, twice.as_bytes()].concat()).twice.unwrap(), "x");
    // A text that differs from the one in the header.
    let other = String::from_utf8(head).unwrap().replace("name = ", "nome = ");
    std::fs::write(folder.path().join(JOURNAL), other).unwrap();
    assert!(matches!(read(folder.path()).unwrap(), Content::Other));
}

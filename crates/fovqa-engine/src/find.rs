//! Finds what is known before any pixel is read: the paired frames of every scene and the gaze for
//! each frame.

use std::collections::{BTreeMap, BTreeSet};

use fovqa_frame::source::{Source, SourceError};
use fovqa_io::sequence::{FramePair, PairingError, Pairs, Spacing, pair};
use fovqa_metrics::Metric;
use fovqa_metrics::fvvdp::Padding;
use fovqa_plan::{Emulation, EyeView, Plan, Scene};
use fovqa_vision::GazeAt;

use crate::error::EngineError;
use crate::find_gaze::gaze;
use crate::found::{FoundInputs, FoundView, Problem, frame_size, is_wanted};
use crate::found_frame::{FoundFrame, GuideFrames};
use crate::foveator;
use crate::remarks::remarks;
use crate::sources::{Given, Opener, builtin};
use crate::test_source::TestSource;
use crate::timing::timings;
use crate::view_frame::fixed_gaze;
use crate::view_sources::ViewSources;

/// Finds and pairs the frames of every scene. Reads names and gaze traces, but no pixels. `given`
/// are the sources that the plan names but does not contain.
pub fn find(plan: &Plan, given: &Given) -> FoundInputs {
    let mut found = FoundInputs { views: Vec::new(), problems: Vec::new() };
    for (scene_index, scene) in plan.scenes.iter().enumerate() {
        for (eye, view) in scene.eyes.iter().enumerate() {
            let problem = |method, error: EngineError| {
                let error = error.with_paths(&|path| plan.shown(path).into());
                Problem { scene: scene_index, eye, method, error }
            };
            let builtin = match builtin(view) {
                Ok(builtin) => builtin,
                Err(error) => {
                    found.problems.push(problem(None, error));
                    continue;
                }
            };
            let opener = Opener { plan, view, given, builtin: builtin.clone() };
            let reference = match opener.reference() {
                Ok(reference) => reference,
                Err(error) => {
                    found.problems.push(problem(None, error));
                    continue;
                }
            };
            let mut tests = BTreeMap::new();
            let mut pairings = Vec::new();
            let mut passed_over = 0;
            let mut numbers = BTreeSet::new();
            for (method, test) in &view.tests {
                let paired = opener
                    .test(*method, test)
                    .and_then(|test| Ok((partners(&*reference, &test)?, test)));
                match paired {
                    Ok((mut pairs, test)) => {
                        tests.insert(*method, test);
                        let mut alone = std::mem::take(&mut pairs.alone);
                        numbers.extend(pairs.pairs.iter().map(|pair| pair.number));
                        let sides = alone.reference.iter().chain(&alone.test);
                        numbers.extend(sides.filter_map(|(number, _)| *number));
                        alone.retain(|number| is_wanted(plan, scene, number));
                        if scene.allow_missing {
                            passed_over += alone.count();
                        } else if alone.count() > 0 {
                            let error = PairingError::Unpaired(alone).into();
                            found.problems.push(problem(Some(*method), error));
                        }
                        pairings.push((*method, pairs));
                    }
                    Err(error) => found.problems.push(problem(Some(*method), error)),
                }
            }
            if pairings.is_empty() {
                continue;
            }
            let mut problems = Vec::new();
            let numbering = pairings[0].1.numbering.clone();
            let spacing = Spacing::of(&numbers);
            match select(plan, scene, merge(pairings, &spacing)).and_then(|mut frames| {
                let [motion, depth] = opener.guides(&*reference, &mut frames)?;
                let mask = opener.given_mask()?;
                let sources = ViewSources { reference, builtin, tests, motion, depth, mask };
                let mut remarks = remarks(plan, scene, view, &sources, (&numbering, &spacing))?;
                let fps = scene.fps.or_else(|| sources.all().find_map(Source::fps));
                let (trace, of_gaze) = gaze(plan, view, &sources, fps, &frames)?;
                remarks.extend(of_gaze);
                let impossible = emulations(view, &sources, &frames, trace.as_deref());
                problems.extend(impossible.into_iter().map(|(m, error)| problem(Some(m), error)));
                let found_view = FoundView {
                    scene: scene_index,
                    eye,
                    sources,
                    frames,
                    fps,
                    trace,
                    passed_over,
                    remarks,
                };
                if plan.metrics.metrics().contains(&Metric::Fvvdp) {
                    timings(&found_view, found_view.fps, &plan.params.fvvdp)?;
                    refuse_streams(plan, &found_view)?;
                }
                Ok(found_view)
            }) {
                Ok(view) => found.views.push(view),
                Err(error) => found.problems.push(problem(None, error)),
            }
            found.problems.append(&mut problems);
        }
        number_alike(&mut found.views, scene_index);
    }
    found
}

/// Pairs the tests of a method with their references.
fn partners(reference: &dyn Source, test: &TestSource) -> Result<Pairs, PairingError> {
    let reference = reference.listing();
    pair(reference, test.read().map_or(reference, Source::listing))
}

/// The emulated methods that are not possible for the frames that were found, as far as that can be
/// known before a frame is read.
fn emulations(
    eye: &EyeView,
    sources: &ViewSources,
    frames: &[FoundFrame],
    trace: Option<&[GazeAt]>,
) -> Vec<(usize, EngineError)> {
    // A frame whose size cannot be found out becomes an error when it is read.
    let size = || frame_size(eye, sources, frames);
    let mut emulations = sources.emulations().peekable();
    let Some(size) = emulations.peek().and_then(|_| size()) else { return Vec::new() };
    let gaze_px = trace.and_then(|trace| Some(trace.first()?.px)).or(fixed_gaze(eye));
    let view = eye.settings.view.as_ref();
    let fault = |(method, emulation): (usize, &Emulation)| {
        let error = foveator::check(&emulation.spec, view, size, gaze_px).err()?;
        Some((method, error))
    };
    emulations.filter_map(fault).collect()
}

/// Refuses streams and temporal filters if FovVideoVDP needs later frames to begin a sequence.
fn refuse_streams(plan: &Plan, view: &FoundView) -> Result<(), EngineError> {
    let mut streams = view.sources.all().filter(|source| source.is_read_once());
    let looks_ahead = plan.params.fvvdp.temp_padding != Padding::Replicate;
    let looks_ahead = looks_ahead && view.frames.len() > 1;
    let mut emulations = view.sources.emulations().filter(|_| looks_ahead);
    if let Some((_, emulation)) =
        emulations.find(|(_, emulation)| emulation.is_temporal() || emulation.reproject().is_some())
    {
        let method = emulation.spec.key();
        return Err(match emulation.reproject() {
            Some(_) => EngineError::ReprojectsAhead { method },
            None => EngineError::LooksAhead { method },
        });
    }
    match streams.next().filter(|_| looks_ahead) {
        None => Ok(()),
        Some(stream) => {
            let message = format!(
                "{}: with this fvvdp.temp_padding, FovVideoVDP begins with later frames, but a stream can only \
                 be read once and in order",
                stream.listing().argument
            );
            let help = "write it to a file first, or leave fvvdp.temp_padding at replicate";
            Err(SourceError::new(message, help).into())
        }
    }
}

/// Gives both eyes the same frame number if each has one frame and the numbers differ: the numbers
/// then tell the eyes apart, not the frames. (With a gaze trace the numbers stay, because the gaze
/// was found by them.)
fn number_alike(views: &mut [FoundView], scene: usize) {
    let first = views.partition_point(|view| view.scene < scene);
    if let [left, right] = &mut views[first..]
        && left.trace.is_none()
        && right.trace.is_none()
        && let ([left], [right]) = (left.frames.as_mut_slice(), right.frames.as_mut_slice())
        && left.number != right.number
    {
        (left.number, right.number) = (0, 0);
    }
}

/// The pairs of all methods, ordered by number and reference. If the reference is a single file, it
/// can have several numbers: one test carries its own number and another does not.
fn merge(pairings: Vec<(usize, Pairs)>, spacing: &Spacing) -> Vec<FoundFrame> {
    let mut frames: BTreeMap<(i64, usize), FoundFrame> = BTreeMap::new();
    let mut order: Vec<(i64, usize)> = Vec::new();
    for (method, pairs) in pairings {
        for FramePair { number, reference, test } in pairs.pairs {
            let position = spacing.place(number);
            let key = (number, reference);
            let frame = frames.entry(key).or_insert_with(|| {
                order.push(key);
                let guides = GuideFrames::default();
                FoundFrame { number, position, reference, guides, tests: Vec::new() }
            });
            frame.tests.push((method, test));
        }
    }
    // The sort is stable: items with the same number stay in the order in which they were found.
    order.sort_by_key(|(number, _)| *number);
    let mut merged = Vec::with_capacity(order.len());
    merged.extend(order.into_iter().filter_map(|key| {
        let mut frame = frames.remove(&key)?;
        frame.tests.shrink_to_fit();
        Some(frame)
    }));
    merged
}

/// Keeps the frames that both the plan and the scene ask for.
fn select(
    plan: &Plan,
    scene: &Scene,
    mut frames: Vec<FoundFrame>,
) -> Result<Vec<FoundFrame>, EngineError> {
    let numbers = || frames.iter().map(|frame| frame.number);
    let (first, last) = (numbers().min().unwrap_or(0), numbers().max().unwrap_or(0));
    frames.retain(|frame| is_wanted(plan, scene, frame.number));
    if frames.is_empty() {
        return Err(EngineError::NoFrames { first, last });
    }
    Ok(frames)
}

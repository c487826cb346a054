//! `fovqa check`: shows the plan, the frames that were found, and the warnings of a run, without
//! reading a pixel unless previews are asked for.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use fovqa::{Complaint, Events, Failure, FoundInputs, FoundView, Given};
use fovqa_config::{FileKind, file_kind};
use fovqa_engine::FoundFrame;
use fovqa_frame::source::Origin;
use fovqa_io::frame_size;
use fovqa_methods::curves::CurveSource;
use fovqa_metrics::{Metric, MetricKind, Params};
use fovqa_plan::{Experiment, EyeView, Gaze, MetricChoice, SourceSpec};
use fovqa_report::Text;
use fovqa_results::needs_frames;

use crate::args::CheckArgs;
use crate::diagnostic;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{experiment, output};
use fovqa::Dialect;

pub(crate) fn run(args: &CheckArgs) -> Exit {
    match file_kind(&args.experiment) {
        Ok(Some(FileKind::Curves)) => return curves(args),
        Ok(Some(FileKind::Study)) => return study(args),
        // An error is explained when the file is read.
        _ => {}
    }
    let mut experiment = match experiment::read(&args.experiment) {
        Ok(experiment) => experiment,
        Err(exit) => return exit,
    };
    // They need memory in a run.
    experiment.plan.pictures = experiment.wanted_pictures();
    let found = fovqa::find(&experiment.plan, &Given::default());
    let terminal = Terminal::speaking(Dialect::Experiment);
    // The warnings come after the plan, as they do in a run.
    let warnings = Later::default();
    let mut metrics = match fovqa::foresee(&experiment.plan, &found, &warnings) {
        Ok(metrics) => metrics,
        Err(error) => return experiment::failed(&error.into()),
    };
    leave_out_temporal(&experiment.plan.params, &mut metrics, &found, &warnings);
    let failures = if args.previews {
        match fovqa::preview(&experiment.plan, &found, &warnings) {
            Ok(failures) => failures,
            Err(error) => return experiment::failed(&error.into()),
        }
    } else {
        Vec::new()
    };
    if let Err(error) = fovqa::foresee_figures(&experiment, &found, &metrics, &warnings) {
        return experiment::failed(&error);
    }
    if let Err(error) = fovqa::check_study_of(&experiment, &warnings) {
        return experiment::failed(&error);
    }
    let text = plan(&experiment, &metrics, &found);
    let printed = output::text(&Text::from(text));
    for message in warnings.0.take() {
        terminal.warn(&message);
    }
    for (scene, Failure { frame, message, help, .. }) in &failures {
        let frame = frame.map(|frame| format!(", frame {frame}")).unwrap_or_default();
        let message = Dialect::Experiment.spell(&format!("{scene}{frame}: {message}"));
        diagnostic::error(&message, &Dialect::Experiment.spell(help));
    }
    for Complaint { message, help } in fovqa::problems(&experiment, &found) {
        diagnostic::error(&message, &Dialect::Experiment.spell(&help));
    }
    let masks = masks(&experiment) & frames(&found);
    if found.problems.iter().any(|problem| problem.error.is_usage()) {
        Exit::Usage
    } else if found.problems.is_empty() && failures.is_empty() && masks {
        printed
    } else {
        Exit::Input
    }
}

/// Takes the metrics that compare frames with those before them from the list if no scene has enough frames.
fn leave_out_temporal(
    params: &Params,
    metrics: &mut Vec<Metric>,
    found: &FoundInputs,
    events: &dyn Events,
) {
    let Some(most) = found.views.iter().map(|view| view.frames.len()).max() else { return };
    let lacks = |metric: &mut Metric| {
        metric.is(MetricKind::Temporal) && most < params.frames_needed(*metric)
    };
    for metric in metrics.extract_if(.., lacks) {
        let needs = needs_frames(params.frames_needed(metric));
        events.warn(&format!("{} has no value: it {needs}", metric.info().label));
    }
}

/// Keeps warnings until the plan is printed.
#[derive(Default)]
struct Later(RefCell<Vec<String>>);

impl Events for Later {
    fn warn(&self, message: &str) {
        self.0.borrow_mut().push(message.to_owned());
    }

    fn progress(&self, _done: usize, _total: usize) {}
}

/// Checks and shows the curves, tables and figures of a file.
fn curves(args: &CheckArgs) -> Exit {
    let file = match experiment::read_curves(&args.experiment) {
        Ok(file) => file,
        Err(exit) => return exit,
    };
    let warnings = Later::default();
    if let Err(error) = fovqa::check_curves(&file, &warnings) {
        return experiment::failed(&error);
    }
    let mut text = format!("{}: {}\n", file.name, count(file.plan.curves.len(), "curve"));
    for spec in &file.plan.curves {
        let (model, screen) = match &spec.source {
            CurveSource::Acuity(model) => (model.info().label, String::new()),
            CurveSource::Method { method, setting } => {
                let ([x, y], view) = (setting.gaze_px, setting.view);
                let at = format!(
                    ", {}x{}, gaze ({x}, {y}), direction {}°",
                    view.width, view.height, setting.direction_deg
                );
                (method.info().label, at)
            }
        };
        let set = if spec.parameters.is_empty() { "" } else { ", " };
        let _ = writeln!(text, "  {}: {model}{set}{}{screen}", spec.name, spec.parameters);
    }
    for why in &file.plan.left_out {
        diagnostic::note(why);
    }
    let plots = count(file.plan.plots.len(), "figure");
    let tables = count(file.plan.tables.len(), "table");
    let _ = writeln!(text, "\n{plots}, {tables}; output: reports/{}", file.name);
    let printed = output::text(&Text::from(text));
    for message in warnings.0.take() {
        diagnostic::warning(&message);
    }
    printed
}

/// Checks a study file with its tables, and shows its analyses.
fn study(args: &CheckArgs) -> Exit {
    let file = match experiment::read_study(&args.experiment) {
        Ok(file) => file,
        Err(exit) => return exit,
    };
    if let Err(error) = fovqa::check_study(&file) {
        return experiment::failed(&error);
    }
    let mut text = format!("{}: {}\n", file.name, several(file.analyses.len()));
    for of in &file.analyses {
        let table = of.table.as_ref().or(of.scores.as_ref());
        let table = table.map(|table| format!(" of {}", table.display())).unwrap_or_default();
        let _ = writeln!(text, "  {}: {}{table}", of.name, of.request.kind());
    }
    let _ = writeln!(text, "\noutput: reports/{}", file.name);
    output::text(&Text::from(text))
}

fn several(analyses: usize) -> String {
    if analyses == 1 { "1 analysis".to_owned() } else { format!("{analyses} analyses") }
}

/// Checks that every mask exists and can be read.
fn masks(experiment: &Experiment) -> bool {
    let eyes = experiment.plan.scenes.iter().flat_map(|scene| &scene.eyes);
    let masks: BTreeSet<&Path> = eyes.filter_map(|eye| eye.settings.mask.as_deref()).collect();
    let mut readable = true;
    for mask in masks {
        if let Err(error) = frame_size(mask) {
            let (mask, kind) = (experiment.plan.shown(mask), error.kind);
            let help = Dialect::Experiment.spell(kind.help());
            diagnostic::error(&format!("the mask {mask}: {kind}"), &help);
            readable = false;
        }
    }
    readable
}

/// Whether every frame is an existing file. Reports the first missing file of each view.
fn frames(found: &FoundInputs) -> bool {
    let mut there = true;
    for view in &found.views {
        let origins = view.frames.iter().flat_map(|frame| view.sources.of_frame(frame));
        let origins = origins.flat_map(|(source, at)| source.origins(at));
        let is_missing = |(_, origin): &(String, Origin)| match origin {
            Origin::File(path) => !path.is_file(),
            Origin::Made(_) => false,
        };
        let mut missing = origins.filter(is_missing);
        if let Some((file, _)) = missing.next() {
            let more = missing.count();
            let more = if more > 0 { format!(" (and {more} more)") } else { String::new() };
            let message = format!("{file}: the file is missing{more}");
            diagnostic::error(&message, "fetch it (git annex get, dvc pull), or render it again");
            there = false;
        }
    }
    there
}

fn plan(experiment: &Experiment, metrics: &[Metric], found: &FoundInputs) -> String {
    let mut text = String::new();
    let metrics: Vec<&str> = metrics.iter().map(|metric| metric.info().label).collect();
    let by_default = match experiment.plan.metrics {
        MetricChoice::Default => " (by default)",
        MetricChoice::Named(_) => "",
    };
    let _ = writeln!(text, "{}: {}{by_default}", experiment.name, metrics.join(", "));
    for view in &found.views {
        scene(&mut text, experiment, view);
    }
    if !experiment.gates.is_empty() {
        let _ = writeln!(text, "\n{}", count(experiment.gates.len(), "gate rule"));
    }
    for rule in &experiment.gates {
        let of = [&rule.scene, &rule.method, &rule.eye].into_iter().flatten();
        let of = of.map(String::as_str).collect::<Vec<_>>().join(", ");
        let of = if of.is_empty() { of } else { format!(" of {of}") };
        let _ = writeln!(text, "  line {}: {}{of}: {}", rule.line, rule.quantity, rule.limits());
    }
    if let Some(study) = &experiment.study {
        let _ = writeln!(text, "\nmean opinion scores: {}", study.file);
    }
    let tests: usize =
        found.views.iter().flat_map(|view| &view.frames).map(|f| f.tests.len()).sum();
    let _ = writeln!(
        text,
        "\n{} to score; output: reports/{}",
        count(tests, "test frame"),
        experiment.name
    );
    text
}

fn scene(text: &mut String, experiment: &Experiment, view: &FoundView) {
    let scene = &experiment.plan.scenes[view.scene];
    let eye = &scene.eyes[view.eye];
    let side = eye.eye.map(|eye| format!(", {} eye", eye.name())).unwrap_or_default();
    let reference = &view.sources.reference;
    let size = view.frames.iter().find_map(|frame| reference.size(frame.reference).ok());
    let size = match (eye.settings.crop, size) {
        (Some(crop), _) => Some((crop.width, crop.height)),
        (None, size) => size,
    };
    let pixels = size.map(|(w, h)| format!(" of {w}x{h} px")).unwrap_or_default();
    let frames = count(view.frames.len(), "frame");
    let numbers = match view.frames.as_slice() {
        [first, .., last] => format!(", {} to {}", first.number, last.number),
        _ => String::new(),
    };
    let _ = writeln!(text, "\n{}{side}: {frames}{numbers}{pixels}", scene.name);
    let mut lines = vec![("reference", experiment.plan.shown_source(&eye.reference))];
    for (method, path) in &eye.tests {
        let with = |frame: &&FoundFrame| frame.tests.iter().any(|(m, _)| m == method);
        let there = view.frames.iter().filter(with).count();
        let missing = match (there, view.frames.len()) {
            (0, _) => " (none found)".to_owned(),
            (there, all) if there < all => format!(" ({there} of {})", count(all, "frame")),
            _ => String::new(),
        };
        let sweep = experiment.plan.sweeps.iter().find(|sweep| sweep.methods().contains(method));
        match (sweep, path) {
            // The points of a sweep share a line.
            (Some(sweep), _) if sweep.first != *method => {}
            (Some(sweep), SourceSpec::Emulated(emulation)) => {
                let (key, swept) = (emulation.spec.key(), sweep.in_words());
                lines.push((&sweep.method, format!("emulated: {key}, swept: {swept}{missing}")));
            }
            _ => {
                let path = experiment.plan.shown_source(path);
                lines.push((&experiment.plan.methods[*method], format!("{path}{missing}")));
            }
        }
    }
    if let Some(seen) = seen(eye, size) {
        lines.push(("view", seen));
    }
    lines.push(("gaze", gaze(experiment, eye, view)));
    let width = lines.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    for (name, value) in lines {
        let _ = writeln!(text, "  {name:width$}  {value}");
    }
}

fn count(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

fn seen(eye: &EyeView, size: Option<(usize, usize)>) -> Option<String> {
    let (w, h) = size?;
    let view = eye.settings.view.as_ref()?.resolve(w, h).ok()?.view;
    let [fx, fy] = view.focal_px;
    let focal =
        if (fx - fy).abs() < 1e-9 * fx { format!("{fx:.2}") } else { format!("{fx:.2} x {fy:.2}") };
    Some(format!(
        "focal length {focal} px, {:.2} px per degree at the centre",
        view.pixels_per_degree()
    ))
}

fn gaze(experiment: &Experiment, eye: &EyeView, view: &FoundView) -> String {
    match &eye.settings.gaze {
        Gaze::Centre => "at the principal point".to_owned(),
        Gaze::Builtin => "that of the viewer in the built-in scene".to_owned(),
        Gaze::Point([x, y]) => format!("({x}, {y}) px"),
        Gaze::Each(_) => "a point for each frame".to_owned(),
        Gaze::Trace { path, .. } => {
            let held = view.trace.iter().flatten().filter(|gaze| gaze.held).count();
            let held = if held > 0 {
                format!(", kept from an earlier frame in {}", count(held, "frame"))
            } else {
                String::new()
            };
            format!("{}{held}", experiment.plan.shown(path))
        }
    }
}

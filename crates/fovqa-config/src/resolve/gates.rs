//! `[[gate]]`.

use std::ops::Range;
use std::path::{Path, PathBuf};

use fovqa_metrics::{Better, Key, Metric, MetricKind, Pooling, Statistic, Subject, spectrum};

use super::plots::Known;
use super::scenes::SceneEntry;
use super::view::VIEW_HELP;
use crate::fault::{Fault, Faults};
use crate::grammar::quoted;
use crate::nearest::nearest;
use crate::node::Node;
use fovqa_plan::{Aggregate, Allowance, GateRule, Quantity, SpreadTest, better};

const ORIENTATIONS: [&str; 3] = ["lh", "hl", "hh"];

/// The rules. Mistakes are added to `faults`.
pub(super) fn gates(
    root: Node<'_>,
    text: &str,
    known: &Known<'_>,
    faults: &mut Faults,
) -> Vec<GateRule> {
    let tables = root.tables("gate").into_iter();
    let rules = tables.filter_map(|(table, span)| rule(table, span, text, known, faults));
    // A rule for a method that is swept is one for each of its points.
    let of_points = |rule: GateRule| match &rule.method {
        None => vec![rule],
        Some(method) => {
            let points = known.methods.called(method).iter();
            points.map(|point| GateRule { method: Some(point.clone()), ..rule.clone() }).collect()
        }
    };
    rules.collect::<Vec<_>>().into_iter().flat_map(of_points).collect()
}

/// The baselines. Their paths are relative to the experiment file.
pub(super) fn baselines(root: Node<'_>, base: &Path) -> Vec<PathBuf> {
    let listed = root.names("baseline").unwrap_or_default();
    let all = root.text("baseline").into_iter().chain(listed.into_iter().map(|(path, _)| path));
    all.map(|path| base.join(path)).collect()
}

fn rule(
    table: Node<'_>,
    span: Range<usize>,
    text: &str,
    known: &Known<'_>,
    faults: &mut Faults,
) -> Option<GateRule> {
    let before = faults.count();
    let metric = metric(table, known, faults)?;
    let quantity = quantity(table, metric, known, faults);
    let scenes = known.scenes.iter().map(|scene| scene.scene.name.as_str()).collect::<Vec<_>>();
    let methods = known.methods.referable();
    let scene = one_of(table, "scene", &scenes, faults);
    let method = one_of(table, "method", &methods, faults);
    let eye = table.text("eye").map(str::to_owned);
    let of =
        |resolved: &&SceneEntry| scene.as_ref().is_none_or(|name| *name == resolved.scene.name);
    let two_eyes = known.scenes.iter().filter(of).any(|scene| scene.scene.eyes.len() > 1);
    if eye.is_some() && !two_eyes {
        let message = "the rule names an eye, but none of its scenes has two eyes";
        faults.push(Fault::new(table.span("eye"), message));
    }
    let of_scenes = known.scenes.iter().filter(of).collect::<Vec<_>>();
    bands(table, metric, &quantity.statistic, &of_scenes, faults);
    let rule = GateRule {
        line: text.get(..span.start).unwrap_or_default().matches('\n').count() + 1,
        name: table.text("name").map(str::to_owned),
        quantity,
        scene,
        method,
        eye,
        at_least: table.number("at_least"),
        at_most: table.number("at_most"),
        max_drop: allowance(table, "max_drop", faults),
        max_rise: allowance(table, "max_rise", faults),
        spread: spread_test(table, faults),
    };
    if faults.count() == before {
        direction(table, span, &rule, faults);
    }
    Some(rule)
}

/// The metric, if it is scored.
fn metric(table: Node<'_>, known: &Known<'_>, faults: &mut Faults) -> Option<Metric> {
    let key = table.text("metric")?;
    let scored = known.metrics.metrics();
    let found = scored.iter().copied().find(|metric| metric.key() == key);
    if found.is_none() {
        let message = format!("the gate's metric {key} is not scored");
        let keys = scored.iter().map(|metric| metric.key());
        let help = format!("add it to [metrics]; the scored metrics are {}", quoted(keys));
        faults.push(Fault::new(table.span("metric"), message).help(help));
    }
    found
}

fn quantity(table: Node<'_>, metric: Metric, known: &Known<'_>, faults: &mut Faults) -> Quantity {
    let statistic = statistic(table, metric, known, faults);
    let image = image(table, metric, &statistic, faults);
    let per_frame = table.flag("per_frame") == Some(true);
    let whole = matches!(
        (metric, statistic.as_str()),
        (Metric::Fvvdp, Quantity::JOD) | (_, Quantity::POOLED)
    );
    if per_frame && whole {
        let message =
            format!("{statistic} describes the whole sequence and has no value per frame");
        let help = if metric == Metric::Fvvdp {
            "use statistic = \"frame_jod\", or leave out statistic"
        } else {
            "leave out statistic"
        };
        faults.push(Fault::new(table.span("statistic"), message).help(help));
    }
    let aggregate = match table.text("aggregate") {
        Some(word) if per_frame => {
            let message = format!("with per_frame, each frame is checked, and there is no {word}");
            let help = "leave out aggregate or per_frame";
            faults.push(Fault::new(table.span("aggregate"), message).help(help));
            None
        }
        Some(word) if whole => {
            let message = format!("{statistic} describes the whole sequence and has no {word}");
            let help = if metric == Metric::Fvvdp {
                "leave out aggregate, or use statistic = \"frame_jod\""
            } else {
                "leave out aggregate or statistic"
            };
            faults.push(Fault::new(table.span("aggregate"), message).help(help));
            None
        }
        Some(word) => {
            let aggregate = Aggregate::find(word);
            if aggregate.is_none() {
                let fault =
                    Fault::new(table.span("aggregate"), format!("aggregate cannot be \"{word}\""));
                faults.push(fault.help("write \"mean\", \"min\", \"max\", or \"p01\" to \"p99\""));
            }
            aggregate
        }
        None if whole || per_frame => None,
        // The aggregate of maxima is the maximum. A ratio is already computed from the largest
        // values.
        None if is_maximum(metric, &statistic) && image != "ratio" => Some(Aggregate::Max),
        None => Some(Aggregate::Mean),
    };
    let level = level(table, metric, &statistic, known, faults);
    let band_deg = table.array("band_deg");
    Quantity {
        metric: metric.key().to_owned(),
        statistic,
        image,
        level,
        band_deg,
        aggregate,
        per_frame,
    }
}

fn statistic(table: Node<'_>, metric: Metric, known: &Known<'_>, faults: &mut Faults) -> String {
    let orientations = known.params.haar.orientations;
    let allowed = allowed(metric, orientations);
    let Some(word) = table.text("statistic") else {
        if matches!(metric, Metric::Haar | Metric::Spectrum) {
            let message = format!("a gate on {} needs a statistic", metric.key());
            let fault = Fault::new(table.span("metric"), message);
            faults.push(fault.help(format!("choose one of {}", quoted(allowed.iter().copied()))));
        }
        let own = match (metric, table.flag("per_frame")) {
            (Metric::Fvvdp, Some(true)) => Quantity::FRAME_JOD,
            (Metric::Fvvdp, _) => Quantity::JOD,
            _ => "",
        };
        return own.to_owned();
    };
    if !allowed.contains(&word) {
        let message = format!("{} has no statistic \"{word}\"", metric.key());
        let help = if allowed.is_empty() {
            "leave out statistic: aggregate decides how frames become one value".to_owned()
        } else {
            let words = quoted(allowed.iter().copied());
            let split = ORIENTATIONS.iter().any(|of| word.ends_with(&format!("_{of}")));
            let more = if metric == Metric::Haar && split && !orientations {
                "; statistics of an orientation need haar = { orientations = true }"
            } else {
                ""
            };
            format!("choose one of {words}{more}")
        };
        faults.push(Fault::new(table.span("statistic"), message).help(help));
    }
    word.to_owned()
}

fn is_maximum(metric: Metric, statistic: &str) -> bool {
    let key = Key::named(Subject::Metric(metric), statistic);
    key.is_some_and(|key| key.statistic().is_maximum())
}

/// The statistics that a rule can use: those of single frames, and that of the whole sequence.
fn allowed(metric: Metric, orientations: bool) -> Vec<&'static str> {
    let of_orientation =
        |name: &str| ORIENTATIONS.iter().any(|of| name.ends_with(&format!("_{of}")));
    let shown = |statistic: &&Statistic| {
        let is_quality = !statistic.is_count && !statistic.is_setting;
        let named = !statistic.name.is_empty() && is_quality && statistic.has_row;
        named && (orientations || !of_orientation(statistic.name))
    };
    let of_sequence = match metric {
        Metric::Fvvdp => Some(Quantity::JOD),
        metric => metric.pools_frames().then_some(Quantity::POOLED),
    };
    let of_frames = metric.info().statistics.iter().filter(shown).map(|statistic| statistic.name);
    of_sequence.into_iter().chain(of_frames).collect()
}

/// Whether a statistic of a profile compares both images.
fn is_of_pair(metric: Metric, statistic: &str) -> bool {
    metric == Metric::Spectrum && statistic == spectrum::CUTOFF
}

fn image(table: Node<'_>, metric: Metric, statistic: &str, faults: &mut Faults) -> String {
    let of_pair = metric.is(MetricKind::Fidelity) || is_of_pair(metric, statistic);
    let (usual, needed) = match metric.info().kind {
        _ if of_pair => ("pair", false),
        MetricKind::Fidelity => ("pair", false),
        MetricKind::Temporal => ("test", false),
        MetricKind::Profile => ("ratio", true),
    };
    match table.text("image") {
        Some(word) if of_pair && word != "pair" => {
            let name = if statistic.is_empty() || metric.is(MetricKind::Fidelity) {
                metric.key()
            } else {
                statistic
            };
            let message = format!("{name} has one value per pair of images, and so no {word}");
            faults.push(Fault::new(table.span("image"), message).help("leave out image"));
        }
        Some("pair") if !of_pair => {
            let message = format!("{} has values for each image, not for the pair", metric.key());
            let fault = Fault::new(table.span("image"), message);
            faults.push(fault.help("write \"test\", \"reference\" or \"ratio\""));
        }
        Some(word) => return word.to_owned(),
        None if needed => {
            let message = format!("a gate on {} needs an image", metric.key());
            let fault = Fault::new(table.span("metric"), message);
            faults.push(fault.help("add image = \"ratio\", \"test\" or \"reference\""));
        }
        None => {}
    }
    usual.to_owned()
}

fn level(
    table: Node<'_>,
    metric: Metric,
    statistic: &str,
    known: &Known<'_>,
    faults: &mut Faults,
) -> Option<i64> {
    let given = table.number("level").map(|level| level as i64);
    let spatial = statistic.starts_with("q_");
    let of_spectrum = metric == Metric::Spectrum && statistic != spectrum::CUTOFF;
    let levels = i64::from(known.params.haar.levels);
    let mut fault = |key: &str, message: String| {
        let fault = Fault::new(table.span(key), message);
        faults.push(fault.help(if metric == Metric::Spectrum {
            "level k is the half octave around 2^(k/2) cycles per degree, such as 4 for 4 cpd"
        } else {
            "levels count from 1, the finest"
        }));
    };
    match given {
        None if metric == Metric::Haar || spatial || of_spectrum => {
            fault("metric", format!("a gate on {} {statistic} needs a level", metric.key()));
        }
        Some(level) if !of_spectrum && level < 1 => {
            fault("level", format!("{} has no level {level}", metric.key()));
        }
        Some(level) if metric == Metric::Haar && level > levels => {
            fault("level", format!("haar has {levels} levels, so it has no level {level}"));
        }
        Some(_) if metric != Metric::Haar && !spatial && !of_spectrum => {
            let name = if is_of_pair(metric, statistic) { statistic } else { metric.key() };
            fault("level", format!("{name} has no levels"));
        }
        _ => {}
    }
    given
}

/// Checks that a rule's band is one, or a union, of the scored bands, as far as this is known
/// before frames are read.
fn bands(
    table: Node<'_>,
    metric: Metric,
    statistic: &str,
    scenes: &[&SceneEntry],
    faults: &mut Faults,
) {
    let span = table.span("band_deg");
    let Some([from, to]) = table.array::<2>("band_deg") else {
        // A test against the spread of repeated runs checks every band.
        if table.has("alpha") {
            return;
        }
        let of_bands = metric.is(MetricKind::Profile)
            || (metric == Metric::Fvvdp && table.text("statistic") == Some("share"));
        if of_bands {
            let message = format!("a gate on {} needs a band", metric.key());
            let fault = Fault::new(table.span("metric"), message);
            faults.push(fault.help("add band_deg = [from, to], in degrees"));
        }
        return;
    };
    if from >= to {
        let fault = Fault::new(span, format!("the band from {from}° to {to}° is empty"));
        faults.push(fault.help("write band_deg = [from, to] with from below to"));
        return;
    }
    let of_bands = metric != Metric::Fvvdp || table.text("statistic") == Some("share");
    if !metric.info().per_band || !of_bands {
        let (message, help) = if metric == Metric::Fvvdp {
            let statistic = table.text("statistic").unwrap_or("jod");
            let help = "leave out band_deg, or use statistic = \"share\"";
            (format!("fvvdp {statistic} has no value per band"), help)
        } else {
            (format!("{} has no value per band", metric.key()), "leave out band_deg")
        };
        faults.push(Fault::new(span, message).help(help));
        return;
    }
    let of_frames =
        Key::named(Subject::Metric(metric), statistic).filter(|key| !key.statistic().is_per_band);
    if of_frames.is_some() {
        let message = format!("{statistic} of {} has no value per band", metric.key());
        faults.push(Fault::new(span, message).help("leave out band_deg or statistic"));
        return;
    }
    let mut inside = 0;
    for settings in scenes.iter().flat_map(|scene| &scene.scene.eyes).map(|eye| &eye.settings) {
        if settings.view.is_none() {
            let message = "bands need a view, but a scene of the rule has none";
            faults.push(Fault::new(span, message).help(VIEW_HELP));
            return;
        }
        let known = match &settings.bands {
            Some(edges) => edges.iter().collect(),
            // The number of default bands is known only when the frames are read.
            None => default_bands(),
        };
        let within = |edges: &&(f64, f64)| from <= edges.0 && edges.1 <= to;
        inside = inside.max(known.iter().filter(within).count());
        let begins = known.iter().any(|(edge, _)| edge.to_bits() == from.to_bits());
        let ends = known.iter().any(|(_, edge)| edge.to_bits() == to.to_bits());
        if !begins || !ends {
            let message = "the band must begin and end at edges of scored bands";
            let help = if settings.bands.is_some() {
                let all = known.iter().map(|(from, to)| format!("{from} to {to}"));
                format!("the scored bands are, in degrees: {}", all.collect::<Vec<_>>().join(", "))
            } else {
                "the default bands are 0, 5, 10, …; give others with bands_deg".to_owned()
            };
            faults.push(Fault::new(span, message).help(help));
            return;
        }
    }
    // The pooled value of all frames is computed from the metric's own value.
    let statistic = if statistic == Quantity::POOLED { "" } else { statistic };
    let key = Key::named(Subject::Metric(metric), statistic);
    let apart = key.is_some_and(|key| key.statistic().bands == Pooling::None);
    if inside > 1 && apart {
        let message = format!("{} of several bands cannot be combined", metric.key());
        faults.push(Fault::new(span, message).help("name one band"));
    }
}

/// The default bands up to the largest possible eccentricity.
fn default_bands() -> Vec<(f64, f64)> {
    fovqa_vision::BandEdges::default_up_to(179.0).iter().collect()
}

/// The name in a key, if it is one of the known names.
fn one_of(table: Node<'_>, key: &str, known: &[&str], faults: &mut Faults) -> Option<String> {
    let name = table.text(key)?;
    if !known.contains(&name) {
        let fault = Fault::new(table.span(key), format!("there is no {key} \"{name}\""));
        let label =
            nearest(name, known.iter().copied()).map(|near| format!("did you mean \"{near}\"?"));
        let help = format!("the {key}s are {}", quoted(known.iter().copied()));
        faults.push(fault.label(label.unwrap_or_default()).help(help));
    }
    Some(name.to_owned())
}

fn allowance(table: Node<'_>, key: &str, faults: &mut Faults) -> Option<Allowance> {
    if let Some(units) = table.number(key) {
        return Some(Allowance::Units(units));
    }
    let text = table.text(key)?;
    let percent = Allowance::percent(text);
    if percent.is_none() {
        let fault = Fault::new(table.span(key), format!("{key} cannot be \"{text}\""));
        faults.push(
            fault.help("write a number in the metric's unit, or a percentage such as \"2%\""),
        );
    }
    percent
}

/// The test against the spread of repeated runs, if the rule has one.
fn spread_test(table: Node<'_>, faults: &mut Faults) -> Option<SpreadTest> {
    let Some(alpha) = table.number("alpha") else {
        if table.has("adjust") {
            let message = "adjust has no effect without alpha";
            let help = "add alpha = 0.01, or leave out adjust";
            faults.push(Fault::new(table.span("adjust"), message).help(help));
        }
        return None;
    };
    Some(SpreadTest { alpha, adjust: table.word("adjust").unwrap_or_default() })
}

/// Checks that a rule has limits, and that they have the same direction as its metric.
fn direction(table: Node<'_>, span: Range<usize>, rule: &GateRule, faults: &mut Faults) {
    let Quantity { metric, statistic, image, .. } = &rule.quantity;
    let what = if statistic.is_empty() { metric.clone() } else { format!("{metric} {statistic}") };
    let keys = ["at_least", "at_most", "max_drop", "max_rise"];
    if rule.spread.is_some() {
        for key in keys.iter().filter(|key| table.has(key)) {
            let message = format!("a rule with alpha has no {key}");
            let help = "write a rule of its own for each";
            faults.push(Fault::new(table.span(key), message).help(help));
        }
        if rule.quantity.per_frame {
            let message = "a rule with alpha tests whole runs, and has no per_frame";
            let help = "leave out per_frame: the bands of each run are tested";
            faults.push(Fault::new(table.span("per_frame"), message).help(help));
        }
        return;
    }
    if !keys.iter().any(|key| table.has(key)) {
        let fault = Fault::new(span, format!("the gate on {what} has no limit"));
        faults.push(fault.help("add at_least, at_most, max_drop, max_rise or alpha"));
        return;
    }
    let (wrong, why): (&[&str], &str) = match better(Metric::find(metric), statistic, image) {
        Better::Higher => (&["at_most", "max_rise"], "higher is better"),
        Better::Lower => (&["at_least", "max_drop"], "lower is better"),
        Better::Neither => (&["max_drop", "max_rise"], "neither higher nor lower is better"),
    };
    for key in wrong.iter().filter(|key| table.has(key)) {
        let message = format!("{key} points the wrong way: for {what}, {why}");
        let help = match why {
            "higher is better" => "use at_least or max_drop",
            "lower is better" => "use at_most or max_rise",
            _ => "use at_least and at_most",
        };
        faults.push(Fault::new(table.span(key), message).help(help));
    }
    if let (Some(least), Some(most)) = (rule.at_least, rule.at_most)
        && least > most
    {
        let message = format!("no value can be at least {least} and at most {most}");
        faults.push(Fault::new(table.span("at_most"), message));
    }
}

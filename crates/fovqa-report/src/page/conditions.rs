//! The conditions of a run: those of all scenes once, and then what differs between scenes.

use std::collections::BTreeSet;

use fovqa_methods::Method;
use fovqa_plan::{Resolved, ResolvedEye, ResolvedScene};
use fovqa_results::RunRecord;
use serde_json::Value;

use super::left_out::left_out;
use super::places::{place_name, some};
use super::terms::{Term, terms};
use crate::frame_values::FrameValues;
use crate::overview::{Measured, Overview};

/// Maximum number of groups of scenes.
const MOST_PLACES: usize = 24;
/// Maximum number of methods.
const MOST_METHODS: usize = 40;

/// The conditions under which frames were scored.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Conditions {
    /// What is the same for all scenes and eyes.
    pub(super) everywhere: Vec<Term>,
    pub(super) places: Vec<Place>,
    /// Number of scenes that are not listed.
    pub(super) more_places: usize,
    pub(super) methods: Vec<Term>,
    /// Number of methods that are not listed.
    pub(super) more_methods: usize,
    /// What has no values, and why.
    pub(super) left_out: Vec<String>,
}

/// Scenes and eyes that differ from others in the same way.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    pub(super) names: String,
    pub(super) terms: Vec<Term>,
}

impl Conditions {
    pub(super) fn of(run: &RunRecord, overview: &Overview, values: &FrameValues) -> Self {
        let resolved = &run.resolved;
        let mut all: Vec<(String, Vec<Term>)> = Vec::new();
        for scene in &resolved.scenes {
            for eye in &scene.eyes {
                let measured = most_frames(resolved, overview, scene, eye);
                all.push((place_name(scene, eye), terms(scene, eye, measured)));
            }
        }
        let first = all.first().map(|(_, terms)| terms.clone()).unwrap_or_default();
        let is_same = |term: &Term| all.iter().all(|(_, terms)| terms.contains(term));
        let everywhere: Vec<Term> = first.into_iter().filter(is_same).collect();
        let (places, more_places) = places(all, &everywhere);
        let methods = resolved.methods.iter().take(MOST_METHODS);
        Self {
            places,
            more_places,
            methods: methods.map(|name| method(resolved, name)).collect(),
            more_methods: resolved.methods.len().saturating_sub(MOST_METHODS),
            left_out: left_out(run, overview, values),
            everywhere,
        }
    }
}

/// The method with the most frames. Frames of others may be missing.
fn most_frames<'a>(
    resolved: &Resolved,
    overview: &'a Overview,
    scene: &ResolvedScene,
    eye: &ResolvedEye,
) -> Option<&'a Measured> {
    let name = eye.eye.map_or("", |eye| eye.name());
    let of_eye = resolved.methods.iter().flat_map(|method| overview.eyes_of(&scene.name, method));
    let of_eye = of_eye.filter(|measured| measured.eye == name);
    // Of equals the first, as they are listed.
    of_eye.reduce(|most, next| if next.frames > most.frames { next } else { most })
}

/// The places with what differs from `everywhere`, those that are alike together; and how many are
/// not listed.
fn places(all: Vec<(String, Vec<Term>)>, everywhere: &[Term]) -> (Vec<Place>, usize) {
    let mut groups: Vec<(Vec<String>, Vec<Term>)> = Vec::new();
    for (name, mut terms) in all {
        terms.retain(|term| !everywhere.contains(term));
        match groups.iter_mut().find(|(_, known)| *known == terms) {
            _ if terms.is_empty() => {}
            Some((names, _)) => names.push(name),
            None => groups.push((vec![name], terms)),
        }
    }
    let more = groups.iter().skip(MOST_PLACES).map(|(names, _)| names.len()).sum();
    let listed = groups.into_iter().take(MOST_PLACES);
    (listed.map(|(names, terms)| Place { names: some(&names), terms }).collect(), more)
}

/// A method, and how its frames were made. If that differs between scenes, all ways are named.
fn method(resolved: &Resolved, name: &str) -> Term {
    let mut ways: BTreeSet<String> = BTreeSet::new();
    for eye in resolved.scenes.iter().flat_map(|scene| &scene.eyes) {
        if let Some(keys) = eye.emulations.get(name) {
            ways.insert(emulation(keys));
        } else if eye.tests.contains_key(name) {
            ways.insert("read from files".to_owned());
        }
    }
    Term::new(name, ways.into_iter().collect::<Vec<_>>().join("; "))
}

/// An emulation with its budget.
fn emulation(keys: &Value) -> String {
    let word = |key: &str| keys[key].as_str().unwrap_or_default();
    let label = Method::find(word("model")).map_or(word("model"), |method| method.info().label);
    let mut parts = vec![format!("emulated {label}")];
    if let Some(share) = keys["budget"].as_f64() {
        let percent: f64 = format!("{:.4}", 100.0 * share).parse().unwrap_or(100.0 * share);
        let of = if word("budget_of") == "on_screen" { " on the screen" } else { "" };
        let budget = format!(
            "budget {percent} % of the frame's pixels{of}, met by solving for {}",
            word("budget_parameter")
        );
        parts.push(budget);
    }
    parts.extend(keys["jitter"].as_str().map(|jitter| format!("jitter {jitter}")));
    if keys["temporal"] == Value::Bool(true) {
        parts.push("temporal filter".to_owned());
    }
    if !keys["reproject"].is_null() {
        parts.push("reprojected from the other eye".to_owned());
    }
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn term(name: &str, value: &str) -> Term {
        Term::new(name, value)
    }

    #[test]
    fn places_that_differ_alike_are_named_together() {
        let all = ["a", "b", "c"].map(|name| {
            let gaze = if name == "b" { "left" } else { "right" };
            (name.to_owned(), vec![term("View", "100°"), term("Gaze", gaze)])
        });
        let (places, more) = places(all.to_vec(), &[term("View", "100°")]);
        let places: Vec<(&str, &str)> =
            places.iter().map(|place| (&*place.names, &*place.terms[0].value)).collect();
        assert_eq!((places, more), (vec![("a, c", "right"), ("b", "left")], 0));
    }

    #[test]
    fn many_places_are_counted() {
        let all = (0..30).map(|nth| (format!("s{nth}"), vec![term("Frames", &nth.to_string())]));
        let (places, more) = places(all.collect(), &[]);
        assert_eq!((places.len(), more), (24, 6));
        let names: Vec<String> = (0..8).map(|nth| nth.to_string()).collect();
        assert_eq!(some(&names), "0, 1, 2, 3, 4, 5 and 2 more");
    }
}

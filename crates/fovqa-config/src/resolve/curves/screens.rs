//! The screens of a curve: every resolution with every gaze and direction.

use std::ops::Range;

use fovqa_vision::{EccentricityKind, View, ViewSpec};
use serde_spanned::Spanned;
use toml::de::DeValue;

use crate::fault::{Fault, Faults};
use crate::grammar::{MOST_CURVES, resolution};
use crate::node::{Node, numbers, text};
use crate::resolve::view::{gives_view, view};
use fovqa_methods::curves::CurveSetting;

/// The tables that describe the screens of a curve, with the most specific one last.
pub(super) struct Screens<'a> {
    pub(super) tables: [Option<Node<'a>>; 2],
    /// What needs a screen, for messages.
    pub(super) of: &'static str,
}

impl<'a> Screens<'a> {
    fn having(&self, key: &str) -> Option<Node<'a>> {
        self.tables.iter().rev().flatten().find(|table| table.has(key)).copied()
    }

    fn values(&self, key: &str) -> Vec<&'a Spanned<DeValue<'a>>> {
        let value = self.having(key).and_then(|table| table.value(key)).map(Spanned::get_ref);
        match value {
            Some(DeValue::Array(items)) => items.iter().collect(),
            _ => Vec::new(),
        }
    }

    /// Every resolution with every gaze and direction.
    pub(super) fn settings(&self, span: &Range<usize>, faults: &mut Faults) -> Vec<CurveSetting> {
        let gives = |table: &&Node<'a>| gives_view(**table);
        let Some(seen) = self.tables.iter().rev().flatten().find(gives) else {
            let message = format!("{} needs a view, but no view is given", self.of);
            let help =
                "give one in [view], such as fov_vertical_deg = 110 or display = \"vive-pro-eye\"";
            faults.push(Fault::new(span.clone(), message).help(help));
            return Vec::new();
        };
        let Some(spec) = view(*seen, faults) else { return Vec::new() };
        let mut sizes: Vec<[usize; 2]> =
            self.values("resolutions").into_iter().filter_map(|v| resolution(text(v)?)).collect();
        if sizes.is_empty() {
            if let ViewSpec::Display(display) = &spec {
                sizes.push(display.resolution);
            } else {
                let message = format!("{} needs a resolution, but none is given", self.of);
                let help = "give some, such as resolutions = [\"2560x1440\"] in [view]";
                faults.push(Fault::new(span.clone(), message).help(help));
            }
        }
        let gazes: Vec<Option<[f64; 2]>> = self
            .values("gazes")
            .into_iter()
            .map(|gaze| numbers(gaze).and_then(|xy| <[f64; 2]>::try_from(xy).ok()))
            .collect();
        let gazes = if gazes.is_empty() { vec![None] } else { gazes };
        let directions = self.having("directions_deg").and_then(|t| t.numbers("directions_deg"));
        let directions = directions.unwrap_or_else(|| vec![0.0]);
        let having = |key: &str| self.having(key);
        let tangential = having("tangential").and_then(|table| table.word("tangential"));
        let tangential = tangential.unwrap_or_default();
        let eccentricity = having("eccentricity").and_then(|table| table.word("eccentricity"));
        let eccentricity = eccentricity.unwrap_or(EccentricityKind::Planar);
        let (sizes, gazes, directions) = (once(sizes), once(gazes), once(directions));
        let all = sizes.len() * gazes.len() * directions.len();
        if all > MOST_CURVES {
            let message = format!("these are {all} curves, but at most {MOST_CURVES} are allowed");
            let help = "name fewer resolutions, gazes or directions";
            faults.push(Fault::new(span.clone(), message).help(help));
            return Vec::new();
        }
        let mut settings = Vec::new();
        for [width, height] in sizes {
            let view: View = match spec.resolve(width, height) {
                Ok(resolved) => resolved.view,
                Err(error) => {
                    faults.push(Fault::new(span.clone(), error.to_string()));
                    continue;
                }
            };
            for gaze in &gazes {
                let gaze_px = gaze.unwrap_or(view.principal_px);
                settings.extend(directions.iter().map(|&direction_deg| CurveSetting {
                    view,
                    gaze_px,
                    direction_deg,
                    tangential,
                    eccentricity,
                }));
            }
        }
        once(settings)
    }
}

/// Values that appear twice give only one curve.
pub(super) fn once<T: PartialEq>(values: Vec<T>) -> Vec<T> {
    let mut once = Vec::new();
    for value in values {
        if !once.contains(&value) {
            once.push(value);
        }
    }
    once
}

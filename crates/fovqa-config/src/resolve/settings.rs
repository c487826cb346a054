//! `[view]`, `[signal]`, and the keys of scenes and eyes that override them.

use std::ops::Range;
use std::path::Path;

use fovqa_frame::{Crop, SignalParams};
use fovqa_io::{FormatOptions, ReadOptions, Y4mOptions};
use fovqa_params::Words;
use fovqa_vision::{BandEdges, ViewSpec};
use serde_spanned::Spanned;
use toml::de::DeValue;

use super::guides::guides;
use super::placeholders::Placeholders;
use super::placeholders::path;
use super::view::{VIEW_HELP, gives_view, luminance, view};
use crate::fault::{Fault, Faults};
use crate::node::{Node, numbers, table, text};
use fovqa_plan::{Eye, Gaze, Settings};

/// The tables that describe how one eye sees a scene, from the most general to the most specific.
pub(super) struct Layers<'a> {
    tables: Vec<Node<'a>>,
    eye: Option<Eye>,
}

impl<'a> Layers<'a> {
    pub(super) fn new(root: Node<'a>, scene: Node<'a>, eye: Option<Eye>) -> Self {
        let general = [root.table("view"), root.table("signal")];
        // The key is allowed at the top of the file too, where it counts least.
        let mut tables: Vec<Node<'a>> =
            root.has("plausibility").then_some(root).into_iter().collect();
        for table in general.into_iter().flatten() {
            tables.push(table);
            tables.extend(eye.and_then(|eye| table.table(eye.name())));
        }
        tables.push(scene);
        tables.extend(eye.and_then(|eye| scene.table(eye.name())));
        Self { tables, eye }
    }

    /// The most specific table that has a key.
    fn having(&self, key: &str) -> Option<Node<'a>> {
        self.tables.iter().rev().find(|table| table.has(key)).copied()
    }

    fn text(&self, key: &str) -> Option<&'a str> {
        self.having(key)?.text(key)
    }

    /// The value of a word, or its default if none is given.
    fn word<T: Words + Default>(&self, key: &str) -> T {
        self.having(key).and_then(|table| table.word(key)).unwrap_or_default()
    }

    fn span(&self, key: &str) -> Range<usize> {
        self.having(key).map(|table| table.span(key)).unwrap_or_default()
    }

    /// The settings. Mistakes are added to `faults`.
    pub(super) fn settings(
        &self,
        base: &Path,
        placeholders: Placeholders<'_>,
        faults: &mut Faults,
    ) -> Settings {
        let crop = self.having("crop").and_then(|table| table.array::<4>("crop"));
        let crop = crop.map(|[x, y, width, height]| {
            if width < 1.0 || height < 1.0 {
                let fault = Fault::new(self.span("crop"), "crop contains no pixels");
                faults.push(fault.label("[x, y, width, height], width and height above 0"));
            }
            let [x, y, width, height] = [x, y, width, height].map(|side| side as usize);
            Crop { x, y, width, height }
        });
        let mask = self
            .text("mask")
            .and_then(|text| path(placeholders, base, text, self.span("mask"), faults));
        let guides =
            guides(self.having("motion"), self.having("depth"), base, placeholders, faults);
        let settings = Settings {
            guides: guides.options,
            motion_files: guides.motion_files,
            depth_files: guides.depth_files,
            read: self.read(),
            crop,
            mask,
            given_mask: None,
            signal: self.signal(),
            nonfinite: self.word("nonfinite"),
            plausibility: self.word("plausibility"),
            view: self.view(faults),
            luminance: self.having("luminance").and_then(|table| luminance(table, faults)),
            gaze: self.gaze(base, placeholders, faults),
            eccentricity: self.word("eccentricity"),
            bands: self.bands(faults),
        };
        if settings.view.is_none() && self.having("eccentricity").is_some() {
            let message = "eccentricity needs a view, but no view is given";
            faults.push(Fault::new(self.span("eccentricity"), message).help(VIEW_HELP));
        }
        if let Some(what) = settings.lacks_view() {
            let key = if settings.bands.is_some() { "bands_deg" } else { "gaze" };
            let fault =
                Fault::new(self.span(key), format!("{what} needs a view, but no view is given"));
            faults.push(fault.help(VIEW_HELP));
        }
        settings
    }

    fn read(&self) -> ReadOptions {
        let default = ReadOptions::default();
        let megapixels = self.having("max_megapixels").and_then(|t| t.number("max_megapixels"));
        ReadOptions {
            layer: self.text("layer").map(str::to_owned),
            alpha: self.word("alpha"),
            max_megapixels: megapixels.map_or(default.max_megapixels, |n| n as u64),
            formats: FormatOptions {
                y4m: Y4mOptions { range: self.word("range"), matrix: self.word("matrix") },
            },
            ..default
        }
    }

    fn signal(&self) -> SignalParams {
        let stops = self.having("exposure_stops").and_then(|t| t.number("exposure_stops"));
        SignalParams {
            transfer: self.word("transfer"),
            exposure_stops: stops.unwrap_or(0.0),
            tonemap: self.word("tonemap"),
            channels: self.word("channels"),
        }
    }

    /// The view of the most specific table that contains one. The view of a scene replaces the
    /// general one completely.
    fn view(&self, faults: &mut Faults) -> Option<ViewSpec> {
        view(*self.tables.iter().rev().find(|table| gives_view(**table))?, faults)
    }

    fn gaze(&self, base: &Path, placeholders: Placeholders<'_>, faults: &mut Faults) -> Gaze {
        let Some(value) = self.having("gaze").and_then(|table| table.value("gaze")) else {
            return Gaze::Centre;
        };
        let value = match (table(value), self.eye) {
            (Some(sides), eye) if sides.has("left") || sides.has("right") => {
                let one = eye.and_then(|eye| sides.value(eye.name()));
                if sides.has("trace") || sides.has("hold") {
                    let message = "gaze has both a trace and the gaze of an eye";
                    faults.push(Fault::new(value.span(), message).help(
                        "give each eye its own: { left = { trace = \"…\" }, right = { trace = \"…\" } }",
                    ));
                }
                let Some(one) = one else {
                    let one_for_both = "gaze is given per eye, but the scene has one reference";
                    let message = eye.map_or_else(
                        || one_for_both.to_owned(),
                        |eye| format!("gaze has no entry for the {} eye", eye.name()),
                    );
                    faults.push(Fault::new(value.span(), message));
                    return Gaze::Centre;
                };
                one
            }
            _ => value,
        };
        gaze_of(value, base, placeholders, faults)
    }

    /// Whether the user has said where the eye looks.
    pub(super) fn has_gaze(&self) -> bool {
        self.having("gaze").is_some()
    }

    /// The position of the gaze.
    pub(super) fn gaze_span(&self) -> Range<usize> {
        self.span("gaze")
    }

    fn bands(&self, faults: &mut Faults) -> Option<BandEdges> {
        let edges = self.having("bands_deg")?.numbers("bands_deg")?;
        match BandEdges::new(edges) {
            Ok(edges) => Some(edges),
            Err(error) => {
                let fault = Fault::new(self.span("bands_deg"), error.to_string());
                faults.push(fault.help("write increasing degrees, such as [0, 5, 10, 20, 30]"));
                None
            }
        }
    }
}

fn gaze_of(
    value: &Spanned<DeValue<'_>>,
    base: &Path,
    placeholders: Placeholders<'_>,
    faults: &mut Faults,
) -> Gaze {
    if let Some(Ok(point)) = numbers(value).map(<[f64; 2]>::try_from) {
        return Gaze::Point(point);
    }
    if text(value) == Some("builtin") {
        return Gaze::Builtin;
    }
    let Some(trace) = table(value) else { return Gaze::Centre };
    let Some(text) = trace.text("trace") else {
        faults.push(
            Fault::new(value.span(), "gaze is a table without a trace").help(
                "write [x, y] in pixels, { trace = \"gaze.csv\" }, or { left = …, right = … }",
            ),
        );
        return Gaze::Centre;
    };
    match path(placeholders, base, text, trace.span("trace"), faults) {
        Some(path) => Gaze::Trace { path, hold: trace.flag("hold").unwrap_or(false) },
        None => Gaze::Centre,
    }
}

//! Emulation alone: a frame is decoded, emulated and turned into codes again, without being written.

use std::path::Path;

use fovqa::{EmulationSpec, ViewSpec};
use fovqa_emulate::{Emulator, FilterChoice, History, Picture};
use fovqa_frame::{SignalParams, SignalTables};
use fovqa_io::{ReadOptions, read_frame};

/// Methods without filters, for which decoding the frame is the measure.
pub(crate) const PLAIN: [&str; 10] =
    ["full", "rmfr", "deamp", "guenter", "cps", "linear", "kfr", "lafr", "vafr", "visual-polar"];

/// The others: a method, and what is applied to it.
pub(crate) const FILTERED: [[&str; 2]; 9] = [
    ["stable", ""],
    ["aliased", ""],
    ["perceptual-target", ""],
    ["kfr", "filters"],
    ["lafr", "filters"],
    ["vafr", "filters"],
    ["deamp", "filters"],
    ["taa", ""],
    ["rmfr", "enhancement"],
];

/// Decodes a file and emulates a method on it.
pub(crate) fn emulate(method: &str, applied: &str, file: &Path) {
    let frame = read_frame(file, &ReadOptions::default()).unwrap().frame;
    let mut spec = EmulationSpec::new(method).unwrap();
    match applied {
        "filters" => spec.set_filters(FilterChoice::Own).unwrap(),
        "enhancement" => spec.set_enhance(1.0).unwrap(),
        _ => {}
    }
    let (width, height) = (frame.width(), frame.height());
    let view = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(60.0) };
    let view = view.resolve(width, height).unwrap().view;
    let emulator = Emulator::new(&spec, [width, height], Some(&view), view.principal_px).unwrap();
    let tables = SignalTables::new(SignalParams::default());
    if spec.is_temporal() {
        // The first frame passes through; the second one is filtered.
        let picture = Picture::from_frame(&frame, &tables);
        let mut history = History::default();
        for _ in 0..2 {
            emulator.emulate_next(&picture, None, &mut history).unwrap();
        }
    } else {
        emulator.emulate_codes8(&frame, &tables).unwrap();
    }
}

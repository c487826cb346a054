//! Tables of samples and load, of speed-up, and of the field compared with acuity.

use fovqa_methods::Counts;
use fovqa_methods::curves::Curve;
use fovqa_plan::{CurveTable, CurveTableKind, TableAcross};

use super::Source;
use super::labels::{Labels, resolution, screen};
use crate::plain_table::{Cell, Column, PlainTable};
use crate::sentence::sentence;

/// A table and the name of its files.
pub(super) fn table(source: &Source<'_>, table: &CurveTable) -> (&'static str, PlainTable) {
    let mut curves = source.chosen(table.curves.as_deref());
    curves.retain(|curve| curve.counts.is_some());
    match table.kind {
        CurveTableKind::Samples => ("table-samples", samples(&alike(curves), table.across)),
        CurveTableKind::SpeedUp => ("table-speed-up", speed_up(&alike(curves))),
        CurveTableKind::Acuity => ("table-acuity", acuity(source, &alike(curves))),
    }
}

/// Each method on each screen once, because sample counts do not depend on the direction.
pub(super) fn alike(curves: Vec<&Curve>) -> Vec<&Curve> {
    let mut once: Vec<&Curve> = Vec::new();
    for curve in curves {
        let same = |known: &&Curve| {
            let at = |curve: &Curve| screen(curve).map(|s| (s.view, s.gaze_px));
            known.spec.name == curve.spec.name && at(known) == at(curve)
        };
        if !once.iter().any(same) {
            once.push(curve);
        }
    }
    once
}

fn pixels(curve: &Curve) -> f64 {
    screen(curve).map_or(0.0, |s| s.view.width as f64 * s.view.height as f64)
}

/// Text with its long numbers rounded. Solved parameters, for example, have long numbers.
fn rounded(text: &str) -> String {
    const LONG: usize = 8;
    let mut shown = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let number = &rest[start..];
        let end = number.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(number.len());
        shown.push_str(&rest[..start]);
        let short = match number[..end].parse::<f64>() {
            Ok(value) if end > LONG => format!("{value:.4}"),
            _ => number[..end].to_owned(),
        };
        shown.push_str(&short);
        rest = &number[end..];
    }
    shown + rest
}

fn notes<'a>(curves: impl Iterator<Item = &'a &'a Curve>) -> Vec<String> {
    let mut notes: Vec<String> = Vec::new();
    for note in curves.flat_map(|curve| &curve.notes) {
        let sentence = sentence(note);
        if !notes.contains(&sentence) {
            notes.push(sentence);
        }
    }
    notes
}

/// One row per method and two columns per resolution, or the other way round as in Table 1 of VaFR.
/// Counts are in thousands.
fn samples(curves: &[&Curve], across: TableAcross) -> PlainTable {
    let mut sizes: Vec<String> = Vec::new();
    let mut rows: Vec<(String, Vec<&Curve>)> = Vec::new();
    let labels = Labels::of(curves);
    for curve in curves {
        let size = screen(curve).map(resolution).unwrap_or_default();
        if !sizes.contains(&size) {
            sizes.push(size);
        }
        let name = labels.row(curve);
        match rows.iter_mut().find(|(known, _)| *known == name) {
            Some((_, row)) => row.push(curve),
            None => rows.push((name, vec![curve])),
        }
    }
    let methods = if across == TableAcross::Methods { joined(&rows) } else { rows };
    let names: Vec<String> = methods.iter().map(|(name, _)| name.clone()).collect();
    let (corner, heads) = match across {
        TableAcross::Resolutions => (Column::new("Method", "method"), &sizes),
        TableAcross::Methods => (Column::new("Resolution", "resolution"), &names),
    };
    let mut columns = vec![corner.repeated()];
    for head in heads {
        let plain = head.replace(" × ", "x");
        let samples = Column::new(head.clone(), format!("samples {plain}"));
        columns.push(samples.in_paper(head, "Samples (10³)"));
        columns.push(Column::new("load", format!("load {plain}")).in_paper(head, "Load"));
    }
    let cells = |row: &[&Curve], size: &String| {
        let of_size = |curve: &&&Curve| screen(curve).map(resolution).as_ref() == Some(size);
        let found =
            row.iter().find(of_size).and_then(|curve| Some((curve, curve.counts.as_ref()?)));
        found.map_or_else(Default::default, |(curve, Counts { samples, .. })| {
            let thousands = format!("{:.1}", samples / 1000.0);
            [Cell::number(thousands, *samples), Cell::percent(samples / pixels(curve))]
        })
    };
    let rows: Vec<Vec<Cell>> = match across {
        TableAcross::Resolutions => methods
            .iter()
            .map(|(name, row)| {
                let head = std::iter::once(Cell::text(name));
                head.chain(sizes.iter().flat_map(|size| cells(row, size))).collect()
            })
            .collect(),
        TableAcross::Methods => sizes
            .iter()
            .map(|size| {
                let head = std::iter::once(Cell::text(size));
                head.chain(methods.iter().flat_map(|(_, row)| cells(row, size))).collect()
            })
            .collect(),
    };
    let mut said = vec![
        "Samples per frame and eye in thousands, and their share of the display's pixels."
            .to_owned(),
    ];
    if has_beyond(curves) {
        said.push(
            "For VaFR, these are its own counts, up to 60°, without the samples that a wider frame needs beyond."
                .to_owned(),
        );
    }
    said.extend(notes(curves.iter()));
    PlainTable { caption: "Samples and load".to_owned(), columns, rows, notes: said }
}

/// Methods and their curves.
type Rows<'a> = Vec<(String, Vec<&'a Curve>)>;

/// The methods, where those of one name up to a comma are one if no resolution has two of them: a
/// method with another parameter at each resolution.
fn joined<'a>(rows: &[(String, Vec<&'a Curve>)]) -> Rows<'a> {
    let stem = |name: &str| name.split(',').next().unwrap_or(name).trim().to_owned();
    let sizes = |row: &[&Curve]| -> Vec<_> {
        row.iter().map(|curve| screen(curve).map(resolution)).collect()
    };
    let mut joined: Rows<'a> = Vec::new();
    for (name, row) in rows {
        let family = || rows.iter().filter(|(other, _)| stem(other) == stem(name));
        let all: Vec<_> = family().flat_map(|(_, row)| sizes(row)).collect();
        let apart = all.iter().enumerate().all(|(i, size)| !all[..i].contains(size));
        if !apart || family().count() == 1 {
            joined.push((name.clone(), row.clone()));
        } else if let Some((_, known)) = joined.iter_mut().find(|(known, _)| *known == stem(name)) {
            known.extend(row);
        } else {
            joined.push((stem(name), row.clone()));
        }
    }
    joined
}

fn has_beyond(curves: &[&Curve]) -> bool {
    curves.iter().any(|c| c.counts.as_ref().is_some_and(|counts| counts.samples_beyond > 0.0))
}

fn speed_up(curves: &[&Curve]) -> PlainTable {
    let labels = Labels::of(curves);
    let beyond = has_beyond(curves);
    let mut columns = vec![
        Column::new("Method", "method").repeated(),
        Column::new("Parameters", "parameters"),
        Column::new("Resolution", "resolution").repeated(),
        Column::new("Buffers (px)", "buffers_px"),
        Column::new("Samples", "samples"),
        Column::new("Share", "share"),
        Column::new("Speed-up", "speed_up"),
        Column::new("On screen", "samples_on_screen"),
    ];
    if beyond {
        columns.push(Column::new("Beyond", "samples_beyond"));
    }
    let rows = curves.iter().filter_map(|curve| {
        let counts = curve.counts.as_ref()?;
        let buffers = counts.buffers.iter().map(|[w, h]| format!("{w:.1} × {h:.1}"));
        let plain = counts.buffers.iter().map(|[w, h]| format!("{w:?}x{h:?}"));
        let speed_up = pixels(curve) / counts.whole();
        let mut row = vec![
            Cell::text(labels.row(curve)),
            Cell {
                shown: rounded(&curve.spec.parameters.replace(';', "; ")),
                value: curve.spec.parameters.clone(),
                is_number: false,
            },
            Cell::text(screen(curve).map(resolution).unwrap_or_default()),
            Cell {
                shown: buffers.collect::<Vec<_>>().join(", "),
                value: plain.collect::<Vec<_>>().join(";"),
                is_number: false,
            },
            Cell::count(counts.samples),
            Cell::percent(counts.whole() / pixels(curve)),
            Cell::number(format!("{speed_up:.2}"), speed_up),
            Cell::count(counts.samples_on_screen),
        ];
        if beyond {
            row.push(Cell::count(counts.samples_beyond));
        }
        Some(row)
    });
    let mut said = vec![
        "Ideal counts: the sides of a real buffer are whole numbers of pixels. Speed-up: the display's \
         pixels divided by the samples, the most that shading alone could gain."
            .to_owned(),
    ];
    if beyond {
        said.push(
            "Beyond: the samples that a frame wider than 60° needs in addition to VaFR's own count; share, \
             speed-up and samples on screen include them."
                .to_owned(),
        );
    }
    said.extend(notes(curves.iter()));
    let rows = rows.collect();
    PlainTable {
        caption: "Samples and theoretical speed-up".to_owned(),
        columns,
        rows,
        notes: said,
    }
}

/// Headings of the table of acuity in LaTeX.
const FIELD: &str = "Field below acuity";
const ABOVE: &str = "Samples above acuity";

fn acuity(source: &Source<'_>, curves: &[&Curve]) -> PlainTable {
    let labels = Labels::of(curves);
    let columns = vec![
        Column::new("Method", "method").repeated(),
        Column::new("Resolution", "resolution").repeated(),
        Column::new("Field below, radial", "below_radial").in_paper(FIELD, "Radial"),
        Column::new("tangential", "below_tangential").in_paper(FIELD, "Tangential"),
        Column::new("either", "below").in_paper(FIELD, "Either"),
        Column::new("Samples above", "samples_above").in_paper(ABOVE, "Number"),
        Column::new("of those on screen", "above").in_paper(ABOVE, "On screen"),
    ];
    let rows = curves.iter().filter_map(|curve| {
        let field = curve.shares?;
        Some(vec![
            Cell::text(labels.row(curve)),
            Cell::text(screen(curve).map(resolution).unwrap_or_default()),
            Cell::percent(field.below_radial),
            Cell::percent(field.below_tangential),
            Cell::percent(field.below),
            Cell::count(field.samples_above),
            Cell::percent(field.above),
        ])
    });
    let plan = &source.file.plan;
    let model = plan.acuity.info();
    let set = match plan.acuity_parameters.as_str() {
        "" => String::new(),
        set => format!(" with {}", set.replace(';', ", ")),
    };
    let mut said = vec![format!(
        "Compared with {} acuity{set} ({}): the share of the frame's pixels where the rate is below acuity, \
         and the samples on screen that exceed what acuity needs or the display shows. A rate above the \
         display's own counts as that of the display. Evaluated at the centres of cells: \
         shares are exact to about a thousandth, samples to about a hundredth.",
        model.label, model.source
    )];
    said.extend(notes(curves.iter()));
    PlainTable {
        caption: "The field compared with acuity".to_owned(),
        columns,
        rows: rows.collect(),
        notes: said,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_are_rounded() {
        let text = "sigmas=[1.6570480818262846, 2.5]; fit=\"fixed\"";
        assert_eq!(rounded(text), "sigmas=[1.6570, 2.5]; fit=\"fixed\"");
    }
}

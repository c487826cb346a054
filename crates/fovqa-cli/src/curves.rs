//! `fovqa curves`: writes one curve as CSV, or makes the figures and tables of files.

use std::fmt::Write as _;
use std::path::Path;

use fovqa::{CurvesFile, Locking};
use fovqa_methods::curves::{Curve, trace};
use fovqa_report::Text;

use crate::args::CurvesArgs;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{diagnostic, experiment, output};
use fovqa::Dialect;

pub(crate) fn run(args: &CurvesArgs) -> Exit {
    if args.curves.is_empty() { one(args) } else { files(args) }
}

/// Writes the curve that the options describe.
fn one(args: &CurvesArgs) -> Exit {
    let traced =
        args.spec().and_then(|spec| trace(&spec, args.range()).map_err(|error| error.to_string()));
    match traced {
        Ok(curve) => {
            if args.has_budget() {
                diagnostic::note(&format!("the budget gives {}", curve.spec.parameters));
            }
            for note in &curve.notes {
                diagnostic::note(note);
            }
            output::write(|out| out.write_all(csv(&curve).as_bytes()))
        }
        Err(message) => {
            diagnostic::error(&message, "`fovqa curves --help` shows examples");
            Exit::Usage
        }
    }
}

fn csv(curve: &Curve) -> String {
    let mut text = String::from("eccentricity_deg,radial_cpd,tangential_cpd\n");
    for point in &curve.points {
        let _ = writeln!(
            text,
            "{:?},{:?},{:?}",
            point.eccentricity_deg, point.radial_cpd, point.tangential_cpd
        );
    }
    text
}

/// Makes the figures and tables of files, each in its own folder. If one of the files contains a
/// mistake, nothing is made.
fn files(args: &CurvesArgs) -> Exit {
    let mut files: Vec<CurvesFile> = Vec::new();
    let mut wrong = None;
    for path in &args.curves {
        match experiment::read_curves(path) {
            Ok(file) => files.push(file),
            Err(exit) => wrong = Some(exit),
        }
    }
    if let Some(exit) = wrong {
        if !files.is_empty() {
            diagnostic::note("nothing is drawn, because one of the files is wrong");
        }
        return exit;
    }
    for (i, file) in files.iter().enumerate() {
        if let Some(other) = files[..i].iter().find(|other| other.name == file.name) {
            let (a, b) = (other.path.display(), file.path.display());
            let message = format!(
                "{a} and {b} have the same name, {:?}, and would share a folder",
                file.name
            );
            diagnostic::error(&message, "give each file its own name");
            return Exit::Usage;
        }
    }
    let alone = files.len() == 1;
    let mut outcome = Exit::Done;
    for file in &files {
        let folder = args.output.as_ref();
        let folder =
            folder.map(|folder| if alone { folder.clone() } else { folder.join(&file.name) });
        // An error in one folder does not prevent the others from being written.
        if let Err(exit) = draw(file, folder.as_deref(), args.lock.locking()) {
            outcome = exit;
        }
    }
    outcome
}

fn draw(file: &CurvesFile, folder: Option<&Path>, locking: Locking) -> Result<(), Exit> {
    let terminal = Terminal::speaking(Dialect::Options);
    let (folder, drawn) = fovqa::curves(file, folder, locking, &terminal)
        .map_err(|error| experiment::said(&error, Dialect::Options))?;
    let mut text = Text::default();
    for table in drawn.tables {
        text.push_table(table);
        text.push_str("\n");
    }
    let printed = output::text(&text);
    let figures =
        if drawn.figures == 1 { "1 figure" } else { &format!("{} figures", drawn.figures) };
    let shown = folder.display();
    diagnostic::note(&format!("{shown}: curves.csv, {figures}; look at {shown}/index.html"));
    if printed == Exit::Done { Ok(()) } else { Err(printed) }
}

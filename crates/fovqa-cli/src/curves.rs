//! `fovqa curves`: one curve as CSV, or the figures and tables of files.

use fovqa_shading::{Curve, trace};

use crate::args::CurvesArgs;
use crate::exit::Exit;
use crate::{diagnostic, output};

pub(crate) fn run(args: &CurvesArgs) -> Exit {
    let traced =
        args.spec().and_then(|spec| trace(&spec, args.range()).map_err(|error| error.to_string()));
    match traced {
        Ok(curve) => {
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
    use std::fmt::Write as _;
    let mut text = String::from("eccentricity_deg,radial_cpd,tangential_cpd\n");
    for row in &curve.rows {
        let _ = writeln!(
            text,
            "{:?},{:?},{:?}",
            row.eccentricity_deg, row.radial_cpd, row.tangential_cpd
        );
    }
    text
}

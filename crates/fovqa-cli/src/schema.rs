//! `fovqa schema`: prints the JSON Schema of a file format.

use crate::args::SchemaOf;
use crate::exit::Exit;
use crate::output;

pub(crate) fn run(what: SchemaOf) -> Exit {
    let schema = match what {
        SchemaOf::Experiment => fovqa_config::schema(),
        SchemaOf::Curves => fovqa_config::curves_schema(),
        SchemaOf::Study => fovqa_config::study_schema(),
    };
    output::write(|out| {
        serde_json::to_writer_pretty(&mut *out, &schema)?;
        out.write_all(b"\n")
    })
}

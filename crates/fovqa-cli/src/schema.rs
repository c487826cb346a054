//! `fovqa schema`: the JSON Schema of the experiment file.

use crate::exit::Exit;
use crate::output;

pub(crate) fn run() -> Exit {
    output::write(|out| {
        serde_json::to_writer_pretty(&mut *out, &fovqa_config::schema())?;
        out.write_all(b"\n")
    })
}

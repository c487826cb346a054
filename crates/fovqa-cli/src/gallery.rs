//! `fovqa gallery`: writes a built-in scene as files.

use crate::args::GalleryArgs;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{diagnostic, experiment, threads};
use fovqa::Dialect;

pub(crate) fn run(args: &GalleryArgs) -> Exit {
    if let Err(exit) = threads::started(args.threads) {
        return exit;
    }
    let request = match args.request() {
        Ok(request) => request,
        Err(message) => {
            let message = Dialect::Options.spell(&message);
            diagnostic::error(&message, "`fovqa gallery --help` shows every option");
            return Exit::Usage;
        }
    };
    match fovqa::write_gallery(&request, &args.output, &Terminal::default()) {
        Ok(frames) => {
            let frames =
                if frames == 1 { "1 frame".to_owned() } else { format!("{frames} frames") };
            diagnostic::note(&format!("{}: {frames}", args.output.display()));
            Exit::Done
        }
        Err(error) => experiment::said(&error, Dialect::Options),
    }
}

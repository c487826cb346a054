//! `fovqa foveate`: writes what a method would have shown, and prints what it would have shaded.

use fovqa::{FoveateOutputs, Given};

use crate::args::{FoveateArgs, FoveateFormat};
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{diagnostic, experiment, failures, output, threads};
use fovqa::Dialect;

pub(crate) fn run(args: FoveateArgs) -> Exit {
    if let Err(exit) = threads::started(args.threads) {
        return exit;
    }
    let format = args.format;
    let outputs = FoveateOutputs { frames: args.output.clone(), buffers: args.buffer.clone() };
    let plan = args.spec().and_then(|(spec, unused)| Ok((args.plan(spec)?, unused)));
    let (plan, unused) = match plan {
        Ok(plan) => plan,
        Err(refused) => {
            let spell = |text: &str| Dialect::Options.spell(text);
            diagnostic::error(&spell(&refused.message), &spell(&refused.help));
            return Exit::Usage;
        }
    };
    for warning in unused {
        diagnostic::warning(&warning);
    }
    let terminal = Terminal::default();
    let foveated = match fovqa::foveate_files(&plan, &Given::default(), &outputs, &terminal) {
        Ok(foveated) => foveated,
        Err(error) => return experiment::said(&error, Dialect::Options),
    };
    let record = &foveated.record;
    failures::show(&foveated.failures, record.frames.len(), "emulated");
    // If nothing was emulated, print nothing that looks like a result.
    let written = if record.frames.is_empty() {
        Exit::Done
    } else {
        match format {
            FoveateFormat::Text => output::text(&fovqa_report::foveate_text(record)),
            FoveateFormat::Json => output::write(|out| record.write_json(out)),
        }
    };
    if foveated.failures.is_empty() { written } else { Exit::Input }
}

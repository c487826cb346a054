//! `fovqa limit`: how far methods can foveate before a rule fails.

use fovqa::LimitOptions;

use crate::args::LimitArgs;
use crate::exit::Exit;
use crate::progress::Terminal;
use crate::{diagnostic, experiment, output, threads};
use fovqa::Dialect;

pub(crate) fn run(args: &LimitArgs) -> Exit {
    searched(args).unwrap_or_else(|exit| exit)
}

fn searched(args: &LimitArgs) -> Result<Exit, Exit> {
    let experiment = experiment::read(&args.experiment)?;
    threads::started(args.threads)?;
    let options = LimitOptions {
        output: args.output.clone(),
        vary: args.vary.replace('-', "_"),
        from: args.from,
        to: args.to,
        steps: usize::try_from(args.steps).unwrap_or(LimitOptions::STEPS),
        tolerance: args.tolerance,
        methods: args.methods.clone(),
        frames: args.frames,
        locking: args.lock.locking(),
    };
    let terminal = Terminal::speaking(Dialect::Options);
    let found = fovqa::find_limits(&experiment, &options, &terminal)
        .map_err(|error| experiment::said(&error, Dialect::Options))?;
    let printed = output::text(&found.drawn.table);
    let shown = found.folder.display();
    let figures = match found.drawn.figures {
        1 => "1 figure".to_owned(),
        n => format!("{n} figures"),
    };
    diagnostic::note(&format!("{shown}: limits.csv, {figures}; look at {shown}/index.html"));
    Ok(printed)
}

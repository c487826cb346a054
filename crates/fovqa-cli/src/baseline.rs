//! `fovqa baseline save|show|accept`.

use fovqa::Saved;
use fovqa_report::{baseline_table, difference_table};

use crate::args::{AcceptArgs, BaselineCommand, SaveArgs};
use crate::exit::Exit;
use crate::{diagnostic, experiment, output};

pub(crate) fn run(command: &BaselineCommand) -> Exit {
    let done = match command {
        BaselineCommand::Save(args) => save(args),
        BaselineCommand::Show(args) => fovqa::read_baseline(&args.baseline)
            .map(|baseline| output::text(&baseline_table(&baseline))),
        BaselineCommand::Accept(args) => accept(args),
    };
    done.unwrap_or_else(|error| experiment::failed(&error))
}

fn save(args: &SaveArgs) -> Result<Exit, fovqa::Error> {
    let saved =
        fovqa::save_baseline(&args.results, &args.baseline, &args.repeats, &args.frames.frames())?;
    let baseline = &saved.baseline;
    let values: usize = baseline.comparisons.iter().map(|c| c.values().count()).sum();
    let file = args.baseline.display();
    diagnostic::note(&format!(
        "{file}: {} comparisons, {values} values",
        baseline.comparisons.len()
    ));
    say_frames(&saved);
    Ok(Exit::Done)
}

fn say_frames(saved: &Saved) {
    match saved.frames {
        0 if saved.removed => {
            diagnostic::note(
                "the frames of the earlier values were removed; --frames keeps new ones",
            );
        }
        0 => {}
        1 => diagnostic::note("1 frame is kept beside it"),
        frames => diagnostic::note(&format!("{frames} frames are kept beside it")),
    }
}

fn accept(args: &AcceptArgs) -> Result<Exit, fovqa::Error> {
    let path = &args.baseline;
    let accepted = fovqa::accept_baseline(&args.results, path, &args.scenes, &args.repeats)?;
    if let Some(why) = &accepted.taken_otherwise {
        diagnostic::warning(&format!("the values were measured differently: {why}"));
    }
    let count = accepted.differences.len();
    let table = difference_table(&accepted.differences);
    let printed = output::text(&table);
    if args.dry_run {
        diagnostic::note(&format!("{count} values differ; nothing was written"));
        return Ok(printed);
    }
    if printed != Exit::Done {
        // If the differences could not be shown, the new baseline is not written.
        return Ok(printed);
    }
    let saved = accepted.write(path, &args.frames.frames())?;
    diagnostic::note(&format!("{}: {count} values have changed", path.display()));
    say_frames(&saved);
    Ok(printed)
}

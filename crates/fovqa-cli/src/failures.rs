//! Frames that failed, on stderr.

use fovqa::Failure;

use crate::diagnostic;
use fovqa::Dialect;

/// Maximum number of failures that are shown, so that they fit on a terminal.
const SHOWN: usize = 20;

/// Shows the frames that failed, beside `others` that did not. `what` says what was to be done with
/// them, as in "could not be scored".
pub(crate) fn show(failures: &[Failure], others: usize, what: &str) {
    for failure in failures.iter().take(SHOWN) {
        let frame = match failure.frame {
            Some(frame) if failures.len() + others > 1 => format!("frame {frame}: "),
            _ => String::new(),
        };
        let help = Dialect::Options.spell(&failure.help);
        diagnostic::error(&format!("{frame}{}", Dialect::Options.spell(&failure.message)), &help);
    }
    let more = failures.len().saturating_sub(SHOWN);
    if more > 0 {
        diagnostic::note(&format!(
            "{more} more frames could not be {what}; --format json lists them"
        ));
    }
}

//! `fovqa published-numbers`: the papers' numbers beside the computed ones.

use fovqa_published::{Tables, page, rows};

use crate::args::PublishedNumbersArgs;
use crate::diagnostic;
use crate::exit::Exit;
use crate::output;

pub(crate) fn run(args: &PublishedNumbersArgs) -> Exit {
    let tables = match args.tables.as_deref().map(Tables::read).transpose() {
        Ok(tables) => tables,
        Err(error) => {
            diagnostic::error(&error.to_string(), &error.help());
            return Exit::Input;
        }
    };
    let page = page(&rows(tables.as_ref()));
    output::write(|out| out.write_all(page.as_bytes()))
}

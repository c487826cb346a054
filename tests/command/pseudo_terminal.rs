//! The command in a pseudo-terminal of a given width.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{Winsize, tcsetwinsize};

use crate::fovqa::command;

/// How a run in a terminal ended.
pub(super) struct Shown {
    pub(super) code: i32,
    /// Everything that was written, with the sequences that control the terminal.
    pub(super) raw: String,
}

impl Shown {
    /// The text without colours.
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        let mut chars = self.raw.chars();
        while let Some(c) = chars.next() {
            match c {
                '\u{1b}' => {
                    // A sequence begins with `[` and ends with a letter.
                    chars.find(char::is_ascii_alphabetic);
                }
                '\r' => {}
                c => text.push(c),
            }
        }
        text
    }
}

/// Runs the command with both outputs on a terminal of this many columns.
pub(super) fn shown(folder: &Path, columns: u16, arguments: &[&str]) -> Shown {
    let mut command = command(arguments);
    command.current_dir(folder).env_remove("COLUMNS");
    of(command, columns)
}

/// Runs a command with both outputs on a terminal of this many columns.
pub(super) fn of(mut command: Command, columns: u16) -> Shown {
    let terminal = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&terminal).unwrap();
    unlockpt(&terminal).unwrap();
    let size = Winsize { ws_row: 40, ws_col: columns, ws_xpixel: 0, ws_ypixel: 0 };
    tcsetwinsize(&terminal, size).unwrap();
    let name = ptsname(&terminal, Vec::new()).unwrap();
    let side = File::options().read(true).write(true).open(name.to_str().unwrap()).unwrap();
    command.env("TERM", "xterm-256color").env_remove("NO_COLOR");
    command.stdout(Stdio::from(side.try_clone().unwrap())).stderr(Stdio::from(side));
    let mut child = command.spawn().unwrap();
    // The command now holds the only other side of the terminal.
    drop(command);
    let (mut terminal, mut bytes) = (File::from(terminal), Vec::new());
    let mut buffer = [0; 4096];
    // Reading ends with an error when the other side is closed.
    while let Ok(count) = terminal.read(&mut buffer) {
        if count == 0 {
            break;
        }
        bytes.extend_from_slice(&buffer[..count]);
    }
    let code = child.wait().unwrap().code().unwrap_or(-1);
    Shown { code, raw: String::from_utf8(bytes).unwrap() }
}

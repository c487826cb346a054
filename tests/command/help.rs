//! Help of every command.

use crate::fovqa::Folder;

/// The names of the subcommands in a help text.
fn subcommands(help: &str) -> Vec<String> {
    let list = help.split("\nCommands:\n").nth(1).unwrap_or_default();
    let lines = list.lines().take_while(|line| !line.is_empty());
    // The rest of a description is indented further.
    let lines = lines.filter_map(|line| line.strip_prefix("  ")).filter(|l| !l.starts_with(' '));
    let names = lines.filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

/// Checks the help of a command and of its subcommands. Returns how many commands there are.
fn check(folder: &Folder, command: &[&str]) -> usize {
    let mut count = 1;
    for option in ["-h", "--help"] {
        let help = folder.run(&[command, &[option]].concat()).ok().stdout;
        for line in help.lines() {
            let length = line.chars().count();
            assert!(length < 100, "{command:?} {option}, {length} characters:\n{line}");
        }
        if option == "-h" {
            for name in subcommands(&help) {
                count += check(folder, &[command, &[&*name]].concat());
            }
        }
    }
    count
}

#[test]
fn no_line_of_help_has_100_characters() {
    let count = check(&Folder::new(), &[]);
    assert!(count > 25, "only {count} commands were found");
}

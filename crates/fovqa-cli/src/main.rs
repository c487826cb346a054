//! The `fovqa` command.

fn main() -> std::process::ExitCode {
    fovqa_cli::main()
}

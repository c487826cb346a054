//! The command under test: `fovqa` itself, built with this package.

fn main() -> std::process::ExitCode {
    fovqa_cli::main()
}

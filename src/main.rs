use std::process::ExitCode;

fn main() -> ExitCode {
    shotsilk::cli::main()
}

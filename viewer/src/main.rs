//! `manyview-points FILE`

use manyview_points::app;
use std::process::ExitCode;

fn main() -> ExitCode {
    match app::run(&clap::Parser::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("manyview-points: {error}");
            ExitCode::from(2)
        }
    }
}

//! Measurements that our helper makes in a context of its own, a line of JSON for each.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use super::library;
use super::program::without_layer;
use std::ffi::OsString;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

/// Runs the helper without the layer, and gives each line that it prints.
///
/// # Errors
/// It is not there, does not start, or ends with another status than 0.
pub fn lines(arguments: &[String], each: &mut dyn FnMut(&str)) -> Result<(), LaunchError> {
    let helper = library::helper(library::PROBE)?;
    let arguments: Vec<_> = arguments.iter().map(OsString::from).collect();
    let mut command = without_layer(&helper, &arguments);
    let system = |source| LaunchError::System {
        doing: "running manyview-probe",
        source,
    };
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(system)?;
    for line in child
        .stdout
        .take()
        .map(BufReader::new)
        .into_iter()
        .flat_map(BufRead::lines)
    {
        each(&line.map_err(system)?);
    }
    match child.wait().map_err(system)? {
        status if status.success() => Ok(()),
        status => Err(system(std::io::Error::other(format!(
            "it ended with {status}"
        )))),
    }
}

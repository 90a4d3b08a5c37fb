//! Views by instances: the draw is made with as many times the instances, and views change fastest.
//!
//! ```text
//! view = gl_InstanceID % views     what the program sees: gl_InstanceID / views
//! ```
//! Based on: GL_OVR_multiview as ANGLE has it by instances. Attributes with a divisor advance with the program's own instances where the
//! caller multiplies the divisor by the views. Below GLSL 1.30 there is no remainder, so it is put together.

use super::edit::Edits;
use super::names::{Names, Uniform};
use super::version::Version;

const BY_EXTENSION: &str = "gl_InstanceIDARB";

/// The count of instances: its name, and the extension that it needs.
fn counter(version: Version) -> (&'static str, Option<&'static str>) {
    if version.number >= 140 {
        ("gl_InstanceID", None)
    } else {
        (BY_EXTENSION, Some("GL_ARB_draw_instanced"))
    }
}

fn declaration(names: &Names) -> String {
    format!("uniform int {};", names.uniform(Uniform::Views))
}

/// Gives the program its own count.
pub(super) fn divide(edits: &mut Edits, names: &Names) {
    let views = names.uniform(Uniform::Views);
    let firsts = ["gl_InstanceID", BY_EXTENSION]
        .map(|name| edits.replace_name(name, &format!("({name} / {views})")));
    if let Some(first) = firsts.into_iter().flatten().min() {
        edits.declare(declaration(names), first);
    }
}

/// The uniform, where the program's text does not need it, and the extension.
pub(super) fn declare(edits: &mut Edits, names: &Names, version: Version, used: bool) {
    let (_, extension) = counter(version);
    if let Some(extension) = extension {
        edits.require(extension);
    }
    if !used {
        edits.append(declaration(names));
    }
}

/// `int mv_view`, in the body of a function.
pub(super) fn view(edits: &mut Edits, names: &Names, version: Version) {
    let (counter, _) = counter(version);
    let (view, views) = (names.other("view"), names.uniform(Uniform::Views));
    edits.append(format!(
        "    int {view} = {counter} - {counter} / {views} * {views};"
    ));
}

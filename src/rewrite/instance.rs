//! Views by instances: the number of instances is multiplied by the number of views, and the view changes fastest.
//!
//! ```text
//! view = gl_InstanceID % views     what the program sees: gl_InstanceID / views
//! ```
//! Based on: GL_OVR_multiview, as ANGLE emulates it by instances. Attributes with a divisor advance with the program's own instances
//! if the caller multiplies the divisor by the number of views. GLSL below 1.30 has no operator `%`, so the remainder is computed by
//! a division.

use super::edit::Edits;
use super::names::{Names, Uniform};
use super::version::Version;

const BY_EXTENSION: &str = "gl_InstanceIDARB";

/// The built-in that counts instances: its name, and the extension that it needs.
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

/// Replaces the program's uses of the instance number by the number without views.
pub(super) fn divide(edits: &mut Edits, names: &Names) {
    let views = names.uniform(Uniform::Views);
    let firsts = ["gl_InstanceID", BY_EXTENSION]
        .map(|name| edits.replace_name(name, &format!("({name} / {views})")));
    if let Some(first) = firsts.into_iter().flatten().min() {
        edits.declare(declaration(names), first);
    }
}

/// Requires the extension, and declares the uniform where [`divide`] has not. `used`: the program's source reads the instance number.
pub(super) fn declare(edits: &mut Edits, names: &Names, version: Version, used: bool) {
    let (_, extension) = counter(version);
    if let Some(extension) = extension {
        edits.require(extension);
    }
    if !used {
        edits.append(declaration(names));
    }
}

/// Writes the statement that declares `int mv_view`.
pub(super) fn view(edits: &mut Edits, names: &Names, version: Version) {
    let (counter, _) = counter(version);
    let (view, views) = (names.other("view"), names.uniform(Uniform::Views));
    edits.append(format!(
        "    int {view} = {counter} - {counter} / {views} * {views};"
    ));
}

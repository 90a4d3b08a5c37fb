//! Features that a source uses, found by its tokens. Names in macros and in all branches of `#if` count as used.

use super::far_end::is_at_far_end;
use super::memory_writes::MemoryWrites;
use super::scan::{Kind, Scan};
use super::version::Version;

/// Features that a source uses. More than 12 fields: one for each word that matters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Facts {
    /// The version of the source.
    pub version: Version,
    /// There is a `main`. A source without one is a helper, whose functions are called from another shader object.
    pub main: bool,
    /// `ftransform()` or the projection matrix of the compatibility profile, so that a shifted projection matrix takes effect.
    pub projection: bool,
    /// `gl_FragCoord`
    pub frag_coord: bool,
    /// `origin_upper_left`: `gl_FragCoord.y` counts downwards.
    pub upper_left: bool,
    /// `pixel_center_integer`: `gl_FragCoord` is whole in the middle of a pixel.
    pub whole_centre: bool,
    /// `gl_FragColor` or `gl_FragData`
    pub frag_data: bool,
    /// `gl_InstanceID`, also as `gl_InstanceIDARB`.
    pub instance: bool,
    /// `gl_Layer`
    pub layer: bool,
    /// `gl_ViewportIndex`
    pub viewport_index: bool,
    /// `gl_ClipVertex`
    pub clip_vertex: bool,
    /// `gl_ClipDistance`
    pub clip_distance: bool,
    /// `gl_CullDistance`
    pub cull_distance: bool,
    /// The source names outputs for transform feedback.
    pub feedback: bool,
    /// A vertex shader puts all vertices at the far end of the depths, z = w in clip space.
    pub far_end: bool,
    /// There are subroutines, whose uniforms belong to the program that is bound.
    pub subroutines: bool,
    /// The memory that is written; a second draw would write it again.
    pub writes: MemoryWrites,
    /// Uniform 4x4 matrices.
    pub matrices: Vec<Matrix>,
}

/// A uniform matrix, which may be a camera.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Matrix {
    /// As written, without the index of an array.
    pub name: String,
    /// The name of the uniform block that it is in.
    pub block: Option<String>,
}

impl Facts {
    /// Whether a fragment shader writes to built-in outputs, if it has any. Otherwise it declares its own.
    pub fn writes_built_in(&self) -> bool {
        self.frag_data || !self.version.desktop(130)
    }

    pub(super) fn of(scan: &Scan, version: Version) -> Self {
        let mut facts = Self {
            version,
            main: false,
            projection: false,
            frag_coord: false,
            upper_left: false,
            whole_centre: false,
            frag_data: false,
            instance: false,
            layer: false,
            viewport_index: false,
            clip_vertex: false,
            clip_distance: false,
            cull_distance: false,
            feedback: false,
            far_end: is_at_far_end(scan),
            subroutines: false,
            writes: MemoryWrites::of(scan, version),
            matrices: matrices(scan),
        };
        for at in 0..scan.tokens.len() {
            let name = scan.name(at);
            match &*name {
                b"" => {}
                b"main" => facts.main = true,
                b"ftransform" => facts.projection = true,
                b"gl_FragCoord" => facts.frag_coord = true,
                b"gl_FragColor" | b"gl_FragData" => facts.frag_data = true,
                b"origin_upper_left" => facts.upper_left = true,
                b"pixel_center_integer" => facts.whole_centre = true,
                b"gl_InstanceID" | b"gl_InstanceIDARB" => facts.instance = true,
                b"gl_Layer" => facts.layer = true,
                b"gl_ViewportIndex" => facts.viewport_index = true,
                b"gl_ClipVertex" => facts.clip_vertex = true,
                b"gl_ClipDistance" => facts.clip_distance = true,
                b"gl_CullDistance" => facts.cull_distance = true,
                b"subroutine" => facts.subroutines = true,
                name => {
                    // Also with the suffixes Inverse, Transpose and InverseTranspose.
                    facts.projection |= name.starts_with(b"gl_ModelViewProjectionMatrix")
                        || name.starts_with(b"gl_ProjectionMatrix");
                    facts.feedback |= name.starts_with(b"xfb_");
                }
            }
        }
        facts
    }
}

/// Whether a word may stand between `uniform` and the type.
fn qualifies(name: &[u8]) -> bool {
    matches!(
        name,
        b"highp" | b"mediump" | b"lowp" | b"layout" | b"row_major" | b"column_major"
    )
}

/// Uniform 4x4 matrices by themselves and in blocks.
fn matrices(scan: &Scan) -> Vec<Matrix> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < scan.tokens.len() {
        if *scan.name(at) != *b"uniform" {
            at += 1;
            continue;
        }
        at += 1;
        while qualifies(&scan.name(at)) {
            at += 1;
            if scan.is(at, b'(') {
                while at < scan.tokens.len() && !scan.is(at, b')') {
                    at += 1;
                }
                at += 1;
            }
        }
        if !scan.is(at + 1, b'{') {
            at = declaration(scan, at, None, &mut found);
            continue;
        }
        let block = String::from_utf8_lossy(&scan.name(at)).into_owned();
        at += 2;
        while at < scan.tokens.len() && !scan.is(at, b'}') {
            at = declaration(scan, at, Some(&block), &mut found);
        }
    }
    found
}

/// Reads a declaration up to its end. Returns the index after its semicolon, or the index of the closing brace that ends it.
fn declaration(scan: &Scan, mut at: usize, block: Option<&str>, found: &mut Vec<Matrix>) -> usize {
    let mut matrix = false;
    let mut brackets = 0_usize;
    // Set by the type or a comma, after which a name follows.
    let mut named = false;
    while let Some(token) = scan.tokens.get(at) {
        match token.kind {
            _ if token.directive => {}
            Kind::Mark(b';') => return at + 1,
            Kind::Mark(b'}') => return at,
            Kind::Mark(b'[' | b'(') => brackets += 1,
            Kind::Mark(b']' | b')') => brackets = brackets.saturating_sub(1),
            Kind::Mark(b',') if brackets == 0 => named = true,
            Kind::Name if brackets == 0 => match &*scan.text(token) {
                b"mat4" | b"mat4x4" => (matrix, named) = (true, true),
                name if matrix && named => {
                    found.push(Matrix {
                        name: String::from_utf8_lossy(name).into_owned(),
                        block: block.map(str::to_owned),
                    });
                    named = false;
                }
                _ => {}
            },
            _ => {}
        }
        at += 1;
    }
    at
}

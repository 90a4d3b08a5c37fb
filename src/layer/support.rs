//! Capabilities of a context, and the form in which `manyview-probe` reports them to `manyview doctor`.
#![forbid(unsafe_code)]

use super::LayerError;
use crate::atlas::Limits;
use crate::gl::{Gl, consts as c};
use crate::rewrite::VertexLayer;
use serde::{Deserialize, Serialize};

/// Capabilities of a context.
#[derive(Clone, Copy, Debug)]
pub struct Support {
    /// Major and minor version.
    pub version: (u32, u32),
    /// Whether the context has the fixed-function pipeline.
    pub compatibility: bool,
    /// Whether framebuffer objects can be drawn to upside down, as windows are (GL_MESA_framebuffer_flip_y).
    pub flip: bool,
    /// The shading language that the layer uses, version × 100.
    pub glsl: u32,
    /// GL_MAX_CLIP_DISTANCES; 0 where generated shaders cannot be used.
    pub clip_distances: u32,
    /// The extension by which a vertex shader chooses the layer that it draws to, if the context has one.
    pub vertex_layer: Option<VertexLayer>,
    /// Whether viewports can begin and end between pixels (GL_ARB_viewport_array).
    pub viewports: bool,
    /// Whether transform feedback can be paused, and the driver says whether it is active.
    pub pauses_feedback: bool,
    /// Whether a view can be copied to the others, wherever they lie.
    pub shares: bool,
    /// How large an atlas may be.
    pub limits: Limits,
}

impl Support {
    /// Asks the current context. The error says why it cannot be shown in several views.
    pub fn ask(gl: &Gl) -> Result<Self, LayerError> {
        let (version, es) = (gl.version(), gl.is_es());
        if es && version < (3, 0) {
            return Err(LayerError::Es(version.0, version.1));
        }
        let modern = version >= (3, 0)
            || (gl.has_extension("GL_ARB_framebuffer_object")
                && gl.has_extension("GL_EXT_texture_array"));
        if !modern {
            return Err(LayerError::Version(version.0, version.1));
        }
        let compatibility = !es
            && (version < (3, 1)
                || gl.has_extension("GL_ARB_compatibility")
                || (version >= (3, 2) && gl.get_integer(c::CONTEXT_PROFILE_MASK) & 2 != 0));
        let known = crate::interleave::glsl_version(gl);
        let glsl = if es {
            known
        } else {
            known.min(glsl_of(version))
        };
        let clip_distances = if compatibility && glsl >= 150 {
            gl.get_integer(c::MAX_CLIP_DISTANCES).max(0).unsigned_abs()
        } else {
            0
        };
        let [width, height] = gl.get_integers::<2>(c::MAX_VIEWPORT_DIMS);
        let side = gl.get_integer(c::MAX_TEXTURE_SIZE).min(width).min(height);
        Ok(Self {
            version,
            compatibility,
            flip: gl.has_extension("GL_MESA_framebuffer_flip_y"),
            glsl,
            clip_distances,
            vertex_layer: crate::draw::limits(gl, glsl).vertex_layer,
            viewports: gl.since((4, 1), None) || gl.has_extension("GL_ARB_viewport_array"),
            pauses_feedback: gl.since((4, 0), Some((3, 0)))
                || gl.has_extension("GL_ARB_transform_feedback2"),
            shares: !es || version >= (3, 2),
            limits: Limits {
                side: side.max(1).unsigned_abs(),
                layers: gl
                    .get_integer(c::MAX_ARRAY_TEXTURE_LAYERS)
                    .max(1)
                    .unsigned_abs(),
            },
        })
    }

    /// Whether an index may end a primitive (primitive restart).
    #[must_use]
    pub fn restarts(&self, gl: &Gl) -> bool {
        let on = |since, name| !gl.is_es() && gl.version() >= since && gl.is_enabled(name);
        on((3, 1), c::PRIMITIVE_RESTART) || on((4, 3), c::PRIMITIVE_RESTART_FIXED_INDEX)
    }

    /// Whether generated vertex shaders can place views: compatibility shaders (GLSL 1.50) with two clip distances.
    #[must_use]
    pub fn instanced(&self) -> bool {
        self.clip_distances >= 2
    }

    /// Whether a vertex shader can choose the layer that it draws to.
    #[must_use]
    pub fn layers(&self) -> bool {
        self.vertex_layer.is_some()
    }

    /// Whether generated geometry shaders can place views: GLSL 1.50 has geometry shaders.
    #[must_use]
    pub fn geometry(&self) -> bool {
        self.instanced()
    }

    /// Whether a geometry shader can stand between the shaders of points.
    #[must_use]
    pub fn point_quads(&self) -> bool {
        self.glsl >= 150
    }

    /// The names for `--strategy` that this context supports; `es`: of OpenGL ES. Programs with shaders are synthesised where fixed function is.
    #[must_use]
    pub fn strategies(&self, es: bool) -> Vec<&'static str> {
        let synthesises = self.glsl >= 130;
        [
            ("replay", true),
            ("instanced", self.instanced() || self.layers()),
            ("geometry", self.geometry()),
            ("splats", self.point_quads() && !es),
            ("depth-image", synthesises),
            ("occlusion", self.glsl >= 150 && !es),
            ("hybrid", synthesises),
        ]
        .into_iter()
        .filter_map(|(name, there)| there.then_some(name))
        .collect()
    }

    /// What a user should know about pictures from this context; `es`: of OpenGL ES.
    #[must_use]
    pub fn notes(&self, es: bool) -> Vec<String> {
        let mut notes = Vec::new();
        if !self.flip {
            notes.push("the driver has no GL_MESA_framebuffer_flip_y: a view may differ from the window in single pixels".to_owned());
        }
        if !self.instanced() && (self.compatibility || !self.layers()) {
            let reason = match (self.compatibility, self.glsl) {
                _ if es => "OpenGL ES has no shaders that choose among layers",
                (false, _) => "a core profile has no fixed function to generate shaders for",
                (_, 150..) => "the driver has fewer than two clip distances",
                _ => "instanced and geometry need GLSL 1.50",
            };
            notes.push(format!("{reason}: every draw is replayed"));
        }
        notes
    }
}

/// The shading language that belongs to a version of OpenGL, × 100. A context may know a newer one, but not all that goes with that: one of OpenGL
/// 3.1 has none of the limits of geometry shaders, which GLSL 1.50 has.
fn glsl_of(version: (u32, u32)) -> u32 {
    match version {
        (major, minor) if version >= (3, 3) => major * 100 + minor * 10,
        (3, minor) => 130 + minor * 10,
        _ => 120,
    }
}

/// The line of JSON that `manyview-probe` prints for one API: the context that it made, or why it could not.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Probe {
    /// `glx`, `egl` or `osmesa`.
    pub api: String,
    /// GL_VERSION
    pub version: Option<String>,
    /// GL_RENDERER
    pub renderer: Option<String>,
    /// Whether the layer stands between the probe and the driver.
    pub hooked: bool,
    /// What the layer can use in this context, by the names of `--strategy`.
    pub strategies: Vec<String>,
    /// Other remarks, a sentence each.
    pub notes: Vec<String>,
    /// Why there is no context.
    pub error: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn support(glsl: u32, compatibility: bool, clip_distances: u32) -> Support {
        Support {
            version: (3, 2),
            compatibility,
            flip: true,
            glsl,
            clip_distances,
            vertex_layer: (clip_distances >= 2).then_some(VertexLayer::ArbShaderViewportLayerArray),
            viewports: true,
            shares: true,
            pauses_feedback: true,
            limits: Limits {
                side: 4096,
                layers: 256,
            },
        }
    }

    #[test]
    fn what_is_missing_is_said() {
        let full = support(150, true, 8);
        let synthesised = ["splats", "depth-image", "occlusion", "hybrid"];
        let all = [&["replay", "instanced", "geometry"][..], &synthesised].concat();
        assert_eq!(full.strategies(false), all);
        assert!(full.notes(false).is_empty());
        for (less, synthesised, word) in [
            (support(120, true, 0), &[][..], "GLSL 1.50"),
            (
                support(130, true, 0),
                &["depth-image", "hybrid"],
                "GLSL 1.50",
            ),
            (support(150, true, 1), &synthesised, "clip distances"),
            (support(450, false, 0), &synthesised, "core profile"),
        ] {
            let exact = &["replay"][..];
            assert_eq!(less.strategies(false), [exact, synthesised].concat());
            assert!(
                less.notes(false)[0].contains(word),
                "{:?}",
                less.notes(false)
            );
        }
        let es = support(320, false, 0);
        assert_eq!(es.strategies(true), ["replay", "depth-image", "hybrid"]);
        assert!(
            es.notes(true)[0].contains("OpenGL ES"),
            "{:?}",
            es.notes(true)
        );
        // Programs of a core profile have shaders of their own, and the variants of those choose layers.
        let core = Support {
            vertex_layer: Some(VertexLayer::ArbShaderViewportLayerArray),
            ..support(450, false, 0)
        };
        let all = [&["replay", "instanced"][..], &synthesised].concat();
        assert_eq!(core.strategies(false), all);
        assert!(core.notes(false).is_empty());
    }

    #[test]
    fn a_version_has_its_language() {
        let versions = [
            (1, 4),
            (2, 1),
            (3, 0),
            (3, 1),
            (3, 2),
            (3, 3),
            (4, 2),
            (4, 6),
        ];
        let languages = [120, 120, 130, 140, 150, 330, 420, 460];
        assert_eq!(versions.map(glsl_of), languages);
    }

    #[test]
    fn a_short_line_of_the_probe_is_understood() {
        let probe: Probe =
            serde_json::from_str(r#"{"api": "glx", "error": "no X server"}"#).expect("JSON");
        assert_eq!(probe.error.as_deref(), Some("no X server"));
        assert!(!probe.hooked && probe.strategies.is_empty());
    }
}

//! Reads the fixed-function state of the driver into the key of a generated shader.

use crate::fixed::{
    ColorMaterial, Diagonal, Dialect, FixedKey, FogSource, LEVELS, LIGHTS, Light, Lighting, Limits,
    MaterialFace, MaterialMode, NormalScaling, PointSize, Provoking, Surroundings, TexGen,
    TextureUnit, UNITS, VertexLayer,
};
use crate::gl::{Gl, consts as c};

/// The limits of a context for generated shaders; `glsl`: its version, such as 150.
pub fn limits(gl: &Gl, glsl: u32) -> Limits {
    let get = |name| gl.get_integer(name).max(0) as u32;
    let shader5 = gl.has_extension("GL_ARB_gpu_shader5");
    let layer = [
        VertexLayer::ArbShaderViewportLayerArray,
        VertexLayer::AmdVertexShaderLayer,
    ];
    if glsl < 150 || gl.is_es() {
        return Limits {
            glsl,
            ..Limits::default()
        };
    }
    Limits {
        glsl,
        clip_distances: get(c::MAX_CLIP_DISTANCES),
        vertex_output_components: get(c::MAX_VERTEX_OUTPUT_COMPONENTS),
        geometry_input_components: get(c::MAX_GEOMETRY_INPUT_COMPONENTS),
        geometry_output_components: get(c::MAX_GEOMETRY_OUTPUT_COMPONENTS),
        geometry_output_vertices: get(c::MAX_GEOMETRY_OUTPUT_VERTICES),
        geometry_total_output_components: get(c::MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS),
        geometry_invocations: if shader5 || glsl >= 400 {
            get(c::MAX_GEOMETRY_SHADER_INVOCATIONS)
        } else {
            0
        },
        gpu_shader5: shader5,
        vertex_layer: layer.into_iter().find(|l| gl.has_extension(l.extension())),
    }
}

/// Constant properties of a context that decide how its state is read.
#[derive(Clone, Copy, Debug)]
pub struct Driver {
    pub(super) mesa: bool,
    /// It has assembly programs (GL_ARB_vertex_program).
    pub programs: bool,
    fog_distance: bool,
    clip_planes: u32,
    /// The most vertices that tessellation may make in one draw.
    corners: u64,
}

impl Driver {
    /// The highest tessellation level for a draw of so many patches.
    pub(super) fn level(&self, patches: u64) -> u32 {
        let each = (self.corners / patches.max(1)).isqrt();
        u32::try_from(each.saturating_sub(1)).map_or(LEVELS, |level| level.clamp(1, LEVELS))
    }

    /// Asks the current context.
    pub fn ask(gl: &Gl) -> Driver {
        Driver {
            mesa: gl.get_string(c::VERSION).contains("Mesa"),
            programs: gl.has_extension("GL_ARB_vertex_program"),
            // Measured on llvmpipe 22.3: indices of tessellated vertices have 16 bits and wrap around.
            corners: match gl.is_llvmpipe() {
                true => 0xffff,
                false => u64::MAX,
            },
            fog_distance: gl.has_extension("GL_NV_fog_distance"),
            // The key has one bit for each.
            clip_planes: match gl.is_es() {
                true => 0,
                false => (gl.get_integer(c::MAX_CLIP_DISTANCES).max(0) as u32).min(u8::BITS),
            },
        }
    }
}

/// The state that the vertex stage depends on, kept until a command touches it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedState {
    /// The key, without its target and without the parts that depend on the primitives.
    pub key: FixedKey,
    /// State that can rule out a generated shader, without the parts that depend on the primitives.
    pub surroundings: Surroundings,
    /// GL_COLOR_SUM as the program set it.
    pub color_sum: bool,
    /// GL_VERTEX_PROGRAM_TWO_SIDE as the program set it.
    pub program_two_side: bool,
    /// GL_PROGRAM_POINT_SIZE as the program set it.
    pub program_point_size: bool,
    /// GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION.
    pub quads_follow: bool,
    /// GL_POLYGON_MODE, front and back.
    pub polygon_mode: [u32; 2],
    /// How the size of points is determined.
    pub point: PointSize,
}

impl FixedState {
    /// Reads the state from the driver; `samples` of the framebuffer. Leaves all state as it is.
    pub fn read(gl: &Gl, driver: Driver, samples: u32) -> FixedState {
        let on = |cap| gl.is_enabled(cap);
        let int = |name| gl.get_integer(name) as u32;
        let float = |name| gl.get_floats::<1>(name)[0];
        let color_sum = on(c::COLOR_SUM);
        let attenuation = gl.get_floats::<3>(c::POINT_DISTANCE_ATTENUATION);
        let point = if attenuation == [1.0, 0.0, 0.0] {
            PointSize::Constant
        } else {
            PointSize::Attenuated
        };
        let (units, high_texture_unit) = units(gl);
        let last = int(c::PROVOKING_VERTEX) != c::FIRST_VERTEX_CONVENTION;
        let key = FixedKey {
            lighting: on(c::LIGHTING).then(|| lighting(gl)),
            normals: match (on(c::NORMALIZE), on(c::RESCALE_NORMAL)) {
                (true, _) => NormalScaling::Normalize,
                (_, true) => NormalScaling::Rescale,
                _ => NormalScaling::None,
            },
            fog: fog(gl, driver),
            clip_planes: (0..driver.clip_planes)
                .filter(|i| on(c::CLIP_PLANE0 + i))
                .fold(0, |m, i| m | 1 << i),
            units,
            color_sum,
            clamp_colors: int(c::CLAMP_VERTEX_COLOR) != 0,
            flat: int(c::SHADE_MODEL) == c::FLAT,
            provoking: if last {
                Provoking::Last
            } else {
                Provoking::First
            },
            dialect: if driver.mesa {
                Dialect::Mesa
            } else {
                Dialect::Specification
            },
            ..FixedKey::default()
        };
        let surroundings = Surroundings {
            // An assembly fragment program may read texture units that are not enabled, so it rules out a generated shader, too.
            vertex_program: on(c::VERTEX_PROGRAM_ARB) || on(c::FRAGMENT_PROGRAM_ARB),
            high_texture_unit,
            line_stipple: on(c::LINE_STIPPLE),
            line_width: float(c::LINE_WIDTH),
            point_size: float(c::POINT_SIZE),
            point_size_min: float(c::POINT_SIZE_MIN),
            point_fade_threshold: float(c::POINT_FADE_THRESHOLD_SIZE),
            point_smooth: on(c::POINT_SMOOTH),
            line_smooth: on(c::LINE_SMOOTH),
            polygon_smooth: on(c::POLYGON_SMOOTH),
            multisample: samples > 0 && on(c::MULTISAMPLE),
            ..Surroundings::default()
        };
        FixedState {
            key,
            surroundings,
            color_sum,
            program_two_side: on(c::VERTEX_PROGRAM_TWO_SIDE),
            program_point_size: on(c::PROGRAM_POINT_SIZE),
            quads_follow: gl.version() >= (3, 2)
                && int(c::QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION) != 0,
            polygon_mode: gl.get_integers::<2>(c::POLYGON_MODE).map(|m| m as u32),
            point,
        }
    }

    /// Reads the parts that depend on the material again.
    pub fn reread_material(&mut self, gl: &Gl) {
        if let Some(l) = &mut self.key.lighting {
            l.zero_shininess = zero_shininess(gl);
        }
    }

    /// The key and the surroundings for one primitive mode and modelview matrix (column-major); `material`: glMaterial occurs between
    /// glBegin and glEnd.
    pub fn for_mode(
        &self,
        mode: u32,
        modelview: &[f32; 16],
        material: bool,
    ) -> (FixedKey, Surroundings) {
        let (mut key, mut surroundings) = (self.key, self.surroundings);
        if let Some(l) = &mut key.lighting {
            l.object_space = keeps_lengths(modelview);
        }
        let drawn = &mut surroundings.rasterised;
        (drawn.points, drawn.lines, drawn.polygons) = match mode {
            c::POINTS => (true, false, false),
            c::LINES | c::LINE_STRIP | c::LINE_LOOP => (false, true, false),
            _ => {
                let has = |m| self.polygon_mode.contains(&m);
                surroundings.polygon_mode = has(c::POINT) || has(c::LINE);
                // Edge flags are not tracked, so with outlines they are assumed to be in use.
                surroundings.edge_flags = surroundings.polygon_mode;
                (has(c::POINT), has(c::LINE), has(c::FILL))
            }
        };
        if surroundings.rasterised.points {
            key.point = self.point;
        }
        if let c::QUADS | c::QUAD_STRIP = mode {
            // Measured on llvmpipe: quads are cut from 1 to 3 with the last-vertex convention, from 0 to 2 with the first-vertex one.
            key.target.diagonal = if key.provoking == Provoking::Last {
                Diagonal::OneThree
            } else {
                Diagonal::ZeroTwo
            };
            if !self.quads_follow {
                key.provoking = Provoking::Last;
            }
        }
        surroundings.material_per_vertex = material;
        (key, surroundings)
    }
}

fn lighting(gl: &Gl) -> Lighting {
    let on = |cap| gl.is_enabled(cap);
    let mut lights = [None; LIGHTS];
    for (i, light) in (0u32..).zip(&mut lights) {
        let name = c::LIGHT0 + i;
        if on(name) {
            let one = |p| gl.get_light(name, p)[0];
            *light = Some(Light {
                positional: gl.get_light(name, c::POSITION)[3] != 0.0,
                spot: one(c::SPOT_CUTOFF) != 180.0,
                attenuated: [
                    one(c::CONSTANT_ATTENUATION),
                    one(c::LINEAR_ATTENUATION),
                    one(c::QUADRATIC_ATTENUATION),
                ] != [1.0, 0.0, 0.0],
            });
        }
    }
    let color_material = on(c::COLOR_MATERIAL).then(|| ColorMaterial {
        face: match gl.get_integer(c::COLOR_MATERIAL_FACE) as u32 {
            c::FRONT => MaterialFace::Front,
            c::BACK => MaterialFace::Back,
            _ => MaterialFace::FrontAndBack,
        },
        mode: match gl.get_integer(c::COLOR_MATERIAL_PARAMETER) as u32 {
            c::EMISSION => MaterialMode::Emission,
            c::AMBIENT => MaterialMode::Ambient,
            c::DIFFUSE => MaterialMode::Diffuse,
            c::SPECULAR => MaterialMode::Specular,
            _ => MaterialMode::AmbientAndDiffuse,
        },
    });
    Lighting {
        lights,
        local_viewer: gl.get_integer(c::LIGHT_MODEL_LOCAL_VIEWER) != 0,
        two_side: gl.get_integer(c::LIGHT_MODEL_TWO_SIDE) != 0,
        separate_specular: gl.get_integer(c::LIGHT_MODEL_COLOR_CONTROL) as u32
            == c::SEPARATE_SPECULAR_COLOR,
        color_material,
        zero_shininess: zero_shininess(gl),
        object_space: false,
    }
}

/// Whether a matrix only rotates and translates, within the tolerance of Mesa's `m_matrix.c`.
fn keeps_lengths(m: &[f32; 16]) -> bool {
    let column = |i: usize| glam::Vec3::new(m[i], m[i + 1], m[i + 2]);
    let (x, y, z) = (column(0), column(4), column(8));
    let unit = |v: glam::Vec3| (v.length_squared() - 1.0).abs() < 1e-5;
    let right = |a: glam::Vec3, b: glam::Vec3| a.dot(b).abs() < 1e-5;
    [x, y, z].into_iter().all(unit)
        && right(x, y)
        && right(y, z)
        && right(z, x)
        && [m[3], m[7], m[11], m[15]] == [0.0, 0.0, 0.0, 1.0]
}

/// Whether a face has shininess 0 and a specular colour that is not black, or that follows the current colour.
fn zero_shininess(gl: &Gl) -> bool {
    let specular_follows = gl.is_enabled(c::COLOR_MATERIAL)
        && gl.get_integer(c::COLOR_MATERIAL_PARAMETER) as u32 == c::SPECULAR;
    [c::FRONT, c::BACK].into_iter().any(|face| {
        let black = gl.get_material(face, c::SPECULAR)[..3] == [0.0; 3];
        gl.get_material(face, c::SHININESS)[0] == 0.0 && (!black || specular_follows)
    })
}

fn fog(gl: &Gl, driver: Driver) -> FogSource {
    if !gl.is_enabled(c::FOG) {
        return FogSource::None;
    }
    if gl.get_integer(c::FOG_COORD_SRC) as u32 == c::FOG_COORDINATE {
        return FogSource::Coordinate;
    }
    if !driver.fog_distance {
        return FogSource::DepthMagnitude;
    }
    match gl.get_integer(c::FOG_DISTANCE_MODE_NV) as u32 {
        c::EYE_RADIAL_NV => FogSource::Radial,
        c::EYE_PLANE => FogSource::Depth,
        _ => FogSource::DepthMagnitude,
    }
}

/// The texture units of the key, and whether a unit beyond them is enabled.
fn units(gl: &Gl) -> ([TextureUnit; UNITS], bool) {
    const TARGETS: [u32; 5] = [
        c::TEXTURE_1D,
        c::TEXTURE_2D,
        c::TEXTURE_3D,
        c::TEXTURE_CUBE_MAP,
        c::TEXTURE_RECTANGLE,
    ];
    let identity = glam::Mat4::IDENTITY.to_cols_array();
    let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
    let there = gl.get_integer(c::MAX_TEXTURE_UNITS).clamp(1, 32) as u32;
    let mut units = [TextureUnit::default(); UNITS];
    let mut high = false;
    for index in 0..there {
        gl.active_texture(c::TEXTURE0 + index);
        if !TARGETS.iter().any(|&t| gl.is_enabled(t)) {
            continue;
        }
        let Some(unit) = units.get_mut(index as usize) else {
            high = true;
            break;
        };
        unit.enabled = true;
        unit.matrix = gl.get_matrix(c::TEXTURE_MATRIX) != identity;
        for (i, generation) in (0u32..).zip(&mut unit.generation) {
            if gl.is_enabled(c::TEXTURE_GEN_S + i) {
                *generation = Some(match gl.get_tex_gen_mode(c::S + i) {
                    c::OBJECT_LINEAR => TexGen::ObjectLinear,
                    c::SPHERE_MAP => TexGen::SphereMap,
                    c::REFLECTION_MAP => TexGen::ReflectionMap,
                    c::NORMAL_MAP => TexGen::NormalMap,
                    _ => TexGen::EyeLinear,
                });
            }
        }
    }
    gl.active_texture(active);
    (units, high)
}

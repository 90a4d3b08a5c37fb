//! The values that pass between the stages, and whether they fit the driver's limits.

use super::key::{Amplifier, FixedKey, Tiles};
use super::limits::Limits;
use super::reason::Unsupported;
use super::text::TESSELLATION_VERSION;

/// A value that the vertex stage computes per vertex, beside the position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Varying {
    /// Primary colour of the front face.
    Front,
    /// Primary colour of the back face.
    Back,
    /// Secondary colour of the front face.
    FrontSecondary,
    /// Secondary colour of the back face.
    BackSecondary,
    /// Texture coordinate set.
    TexCoord(usize),
    /// Fog coordinate.
    Fog,
    /// Size of a point.
    PointSize,
    /// The program's vertex, from which each view computes its own x.
    Vertex,
    /// Distance to a user clip plane.
    Plane(u32),
}

impl Varying {
    /// GLSL type.
    pub(super) fn glsl_type(self) -> &'static str {
        match self.components() {
            1 => "float",
            _ => "vec4",
        }
    }

    /// Number of scalars.
    pub(super) fn components(self) -> u32 {
        match self {
            Varying::Front
            | Varying::Back
            | Varying::FrontSecondary
            | Varying::BackSecondary
            | Varying::TexCoord(_)
            | Varying::Vertex => 4,
            Varying::Fog | Varying::PointSize | Varying::Plane(_) => 1,
        }
    }

    /// Name in the block between vertex and geometry shader.
    pub(super) fn member(self) -> String {
        match self {
            Varying::Front => "front".into(),
            Varying::Back => "back".into(),
            Varying::FrontSecondary => "front_secondary".into(),
            Varying::BackSecondary => "back_secondary".into(),
            Varying::TexCoord(unit) => format!("coord{unit}"),
            Varying::Fog => "fog".into(),
            Varying::PointSize => "size".into(),
            Varying::Vertex => "vertex".into(),
            Varying::Plane(plane) => format!("plane{plane}"),
        }
    }

    /// The built-in output that the fixed fragment stage or the rasteriser reads; `None` for a value that neither of them reads.
    pub(super) fn builtin(self, key: &FixedKey) -> Option<String> {
        Some(match self {
            Varying::Front => "gl_FrontColor".into(),
            Varying::Back => "gl_BackColor".into(),
            Varying::FrontSecondary => "gl_FrontSecondaryColor".into(),
            Varying::BackSecondary => "gl_BackSecondaryColor".into(),
            Varying::TexCoord(unit) => format!("gl_TexCoord[{unit}]"),
            Varying::Fog => "gl_FogFragCoord".into(),
            Varying::PointSize => "gl_PointSize".into(),
            Varying::Vertex => return None,
            Varying::Plane(plane) => {
                let rank = key.planes().take_while(|&other| other < plane).count() as u32;
                format!("gl_ClipDistance[{}]", key.target.clip_distances() + rank)
            }
        })
    }

    /// Whether a flat primitive takes it from its provoking vertex.
    pub(super) fn is_color(self) -> bool {
        matches!(
            self,
            Varying::Front | Varying::Back | Varying::FrontSecondary | Varying::BackSecondary
        )
    }
}

/// The values of a key, in the order in which they are declared.
pub(super) fn varyings(key: &FixedKey) -> Vec<Varying> {
    use super::key::{FogSource, PointSize};

    let mut list = vec![Varying::Front];
    if key.two_side() {
        list.push(Varying::Back);
    }
    if key.secondary() {
        list.push(Varying::FrontSecondary);
        if key.two_side() {
            list.push(Varying::BackSecondary);
        }
    }
    list.extend(key.coordinate_sets().map(Varying::TexCoord));
    if key.fog != FogSource::None {
        list.push(Varying::Fog);
    }
    if key.point == PointSize::Attenuated {
        list.push(Varying::PointSize);
    }
    list.push(Varying::Vertex);
    list.extend(key.planes().map(Varying::Plane));
    list
}

/// Scalars that the last vertex stage writes per vertex: position, everything a built-in takes, the tile's clip
/// distances or limits, and from a geometry shader `gl_PrimitiveID`.
fn output_components(key: &FixedKey) -> u32 {
    let varyings = varyings(key)
        .into_iter()
        .filter(|&v| v != Varying::Vertex)
        .map(Varying::components)
        .sum::<u32>();
    // The layer, or the displacement of the vertex.
    let layer = match key.target.tiles {
        Tiles::ClipLeftRight => 0,
        Tiles::Layer => 1,
        Tiles::DistortedRays => 2,
    };
    let primitive_id = u32::from(key.geometry());
    let limits = 2 * u32::from(key.target.discards());
    4 + varyings + key.target.clip_distances() + limits + layer + primitive_id
}

/// Scalars between vertex and geometry shader, per vertex.
fn passed_components(key: &FixedKey) -> u32 {
    4 + varyings(key)
        .into_iter()
        .map(Varying::components)
        .sum::<u32>()
}

/// The largest number of views that one draw of this key can draw, 0 if it cannot draw any.
///
/// A loop in a geometry shader is limited by the vertices and the scalars that it may emit in all (table 23.60: at least
/// 256 and 1024). Invocations are limited by their number (at least 32), and each may emit as much as one loop
/// (`ARB_gpu_shader5`, issue 17). Instances are limited by the array of views alone.
pub fn batch(key: &FixedKey, limits: &Limits) -> u32 {
    let key = key.canonical();
    let capacity = super::VIEWS;
    let vertices = key.target.emitted();
    let components = output_components(&key);
    let per_run = (limits.geometry_output_vertices / vertices)
        .min(limits.geometry_total_output_components / (vertices * components).max(1));
    match key.target.amplifier {
        Amplifier::Instanced | Amplifier::Tessellation | Amplifier::Points => capacity,
        Amplifier::GeometryLoop => per_run.min(capacity),
        Amplifier::GeometryInvocations if per_run == 0 => 0,
        Amplifier::GeometryInvocations => limits.geometry_invocations.min(capacity),
    }
}

/// Refuses a key whose outputs do not fit. `key` is canonical.
pub(super) fn check(key: &FixedKey, limits: &Limits) -> Result<(), Unsupported> {
    let distances = key.clip_distances();
    if distances > limits.clip_distances {
        return Err(Unsupported::ClipDistances {
            needed: distances,
            limit: limits.clip_distances,
        });
    }
    let over = |needed, limit| {
        if needed > limit {
            Err(Unsupported::Components { needed, limit })
        } else {
            Ok(())
        }
    };
    if !key.geometry() {
        return over(output_components(key), limits.vertex_output_components);
    }
    over(passed_components(key), limits.vertex_output_components)?;
    if key.tessellates() {
        let (needed, has) = (TESSELLATION_VERSION, limits.glsl);
        return match has < needed {
            true => Err(Unsupported::ShadingLanguage { needed, has }),
            false => over(output_components(key), limits.vertex_output_components),
        };
    }
    over(passed_components(key), limits.geometry_input_components)?;
    over(output_components(key), limits.geometry_output_components)?;
    if key.target.amplifier == Amplifier::GeometryInvocations && limits.geometry_invocations == 0 {
        return Err(Unsupported::Invocations);
    }
    let (views, limit) = (u32::from(key.target.views), batch(key, limits));
    if views > limit {
        return Err(Unsupported::Views { views, limit });
    }
    Ok(())
}

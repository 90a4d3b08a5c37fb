//! The state to which a generated shader is specialised.
//!
//! A key names *which* computations the fixed-function vertex stage would make, never their values: those reach the
//! shader through the built-in uniforms of the compatibility profile (`gl_LightSource`,
//! `gl_TextureMatrix`, `gl_ClipPlane`, …), which the driver fills from the program's own state.
//!
//! Two draws whose [`canonical`](FixedKey::canonical) keys are equal use the same program. The idea and most of the
//! fields are those of Mesa's `struct state_key` (`src/mesa/main/ffvertex_prog.c`). Zeroing irrelevant fields before
//! hashing is an idea of Regal's (`RegalIff`).

use crate::config::Clip;

/// Number of lights the generator knows (`GL_MAX_LIGHTS` is 8 on every driver we know of).
pub const LIGHTS: usize = 8;
/// Number of texture units the generator knows (`GL_MAX_TEXTURE_COORDS` is 8 likewise).
pub const UNITS: usize = 8;

/// Everything that decides the source of a generated shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FixedKey {
    /// How the draw is repeated for the views, and where the views lie.
    pub target: Target,
    /// `GL_LIGHTING`; `None` when disabled: the current colours pass through.
    pub lighting: Option<Lighting>,
    /// `GL_NORMALIZE`, `GL_RESCALE_NORMAL`.
    pub normals: NormalScaling,
    /// Source of the fog coordinate.
    pub fog: FogSource,
    /// How the size of a point is computed.
    pub point: PointSize,
    /// Bit i: `GL_CLIP_PLANEi` is enabled.
    pub clip_planes: u8,
    /// Texture coordinate sets.
    pub units: [TextureUnit; UNITS],
    /// The fragment stage reads the secondary colour of an unlit vertex: `GL_COLOR_SUM` (or an assembly fragment
    /// program that reads it). With lighting the secondary colour follows [`Lighting::separate_specular`] alone.
    pub color_sum: bool,
    /// `GL_CLAMP_VERTEX_COLOR` is true, or is `GL_FIXED_ONLY` and the colour buffer is fixed point.
    pub clamp_colors: bool,
    /// `glShadeModel(GL_FLAT)`.
    pub flat: bool,
    /// Which vertex gives a flat primitive its colour.
    pub provoking: Provoking,
    /// How the driver reads the specification where drivers differ.
    pub dialect: Dialect,
}

/// How one draw becomes many views.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Target {
    /// What multiplies the primitives.
    pub amplifier: Amplifier,
    /// Where the views lie.
    pub tiles: Tiles,
    /// How a view is clipped to its tile. Layers need no clipping.
    pub clip: Clip,
    /// Input primitive of the geometry or tessellation shader; instanced draws ignore it.
    pub primitive: Primitive,
    /// How the driver splits a quad into triangles. Matters for quads alone.
    pub diagonal: Diagonal,
    /// Views per draw, at least 1; [`batch`](super::batch) is the largest number that fits the driver. It enters the
    /// source of a geometry shader only: an instanced draw takes it as its instance count.
    pub views: u8,
    /// Points are surfaces (see [`surface_size`](super::surface_size)).
    pub surface: bool,
}

/// What repeats a primitive for each view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Amplifier {
    /// `glDraw*Instanced` with one instance per view; the vertex shader reads `gl_InstanceID`.
    #[default]
    Instanced,
    /// A geometry shader emits the primitive in a loop over the views.
    GeometryLoop,
    /// A geometry shader runs once per view (`layout(invocations = N)`).
    GeometryInvocations,
    /// Tessellation subdivides triangles and quads, which are drawn as patches.
    Tessellation,
    /// A geometry shader emits one quad for a point, which holds it in all views: see [`super::point_quads`].
    Points,
}

/// Where the views lie in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tiles {
    /// Side by side in one row: [`Clip`] clips a view at the left and right of its tile, and the frustum clips it at the
    /// bottom and top.
    #[default]
    ClipLeftRight,
    /// One layer of an array texture per view: `gl_Layer`, no clip distances, no map.
    Layer,
    /// No views, but the reference image of an occlusion camera, whose rays are distorted.
    DistortedRays,
}

impl Target {
    /// Number of clip distances the tiles need for themselves.
    pub const fn clip_distances(&self) -> u32 {
        match (self.tiles, self.clip) {
            (Tiles::ClipLeftRight, Clip::Distances) => 2,
            _ => 0,
        }
    }

    /// Whether the geometry shader cuts triangles at the sides of the tile.
    pub const fn cuts(&self) -> bool {
        matches!((self.tiles, self.clip), (Tiles::ClipLeftRight, Clip::Cut))
    }

    /// Greatest number of vertices that a geometry shader emits per view. A triangle that is cut at both sides has up to five.
    pub const fn emitted(&self) -> u32 {
        if self.cuts() {
            5
        } else {
            self.primitive.emitted()
        }
    }

    /// Whether the fragment stage has to discard fragments outside the tile.
    pub const fn discards(&self) -> bool {
        matches!(
            (self.tiles, self.clip),
            (Tiles::ClipLeftRight, Clip::Discard | Clip::Both)
        )
    }
}

/// Input primitives of a geometry shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Primitive {
    /// `GL_POINTS`.
    Points,
    /// `GL_LINES`, `GL_LINE_STRIP`, `GL_LINE_LOOP`.
    Lines,
    /// `GL_TRIANGLES`, `GL_TRIANGLE_STRIP`, `GL_TRIANGLE_FAN`. A `GL_QUAD_STRIP` drawn as a triangle strip would be cut
    /// along the other diagonal than the driver's own: see [`Primitive::QuadStrip`].
    #[default]
    Triangles,
    /// `GL_POLYGON` drawn as `GL_TRIANGLE_FAN`: a flat one has the colour of its first vertex.
    Polygon,
    /// `GL_QUADS` drawn as `GL_LINES_ADJACENCY`: vertices 0, 1, 2, 3 around the quad.
    Quads,
    /// `GL_QUAD_STRIP` re-indexed as `GL_LINES_ADJACENCY`: vertices 2i, 2i+1, 2i+3, 2i+2, around the quad too. The
    /// flat colour is that of 2i+3 (table 13.2), which is the third here and not the fourth.
    QuadStrip,
}

impl Primitive {
    /// Number of vertices that a geometry shader emits per view. A quad is emitted as two triangles and not as a strip of four
    /// vertices: the driver's own triangles start at other vertices than those of a strip, so interpolation would round
    /// differently.
    pub const fn emitted(self) -> u32 {
        match self {
            Primitive::Points => 1,
            Primitive::Lines => 2,
            Primitive::Triangles | Primitive::Polygon => 3,
            Primitive::Quads | Primitive::QuadStrip => 6,
        }
    }
}

/// The diagonal along which the driver splits a quad.
///
/// Colours are interpolated over triangles, so the diagonal shows in a smooth quad with four different colours. Measured on
/// llvmpipe (Mesa 22.3.6), in the vertex order of [`Primitive`]: a quad strip is always split from 0 to 2. Quads are split
/// from 1 to 3 when flat shaded or with the first-vertex convention. Smooth ones with the last-vertex convention are
/// split from 0 to 2 if no vertex of the driver's batch was clipped, and from 1 to 3 otherwise. Clipping is not known
/// beforehand, so 0 to 2 is a guess there; replay is exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Diagonal {
    /// Triangles 0 1 3 and 1 2 3.
    #[default]
    OneThree,
    /// Triangles 0 1 2 and 0 2 3.
    ZeroTwo,
}

/// `glProvokingVertex`. For [`Primitive::Quads`] and [`Primitive::QuadStrip`] the *effective* convention: last, unless
/// `GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION` is true.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Provoking {
    /// `GL_LAST_VERTEX_CONVENTION`, the initial one.
    #[default]
    Last,
    /// `GL_FIRST_VERTEX_CONVENTION`.
    First,
}

/// State of the lighting stage (4.6 compatibility, section 12.2.1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Lighting {
    /// `None`: that light is disabled.
    pub lights: [Option<Light>; LIGHTS],
    /// `GL_LIGHT_MODEL_LOCAL_VIEWER`.
    pub local_viewer: bool,
    /// `GL_LIGHT_MODEL_TWO_SIDE`.
    pub two_side: bool,
    /// `GL_LIGHT_MODEL_COLOR_CONTROL` is `GL_SEPARATE_SPECULAR_COLOR`.
    pub separate_specular: bool,
    /// `GL_SHININESS` of a lit face is 0, and its specular colour is not black or follows the vertex colour. By the
    /// specification the specular factor is then 1; [`Dialect::Mesa`] deviates.
    pub zero_shininess: bool,
    /// The modelview matrix preserves lengths. [`Dialect::Mesa`] then lights in object space, if all lights are directional
    /// and nothing else needs eye space. The colours differ in their last bits only.
    pub object_space: bool,
    /// `GL_COLOR_MATERIAL`; `None` when disabled.
    pub color_material: Option<ColorMaterial>,
}

/// The terms that one enabled light needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Light {
    /// `GL_POSITION` (as GL returns it, in eye space) has w ≠ 0.
    pub positional: bool,
    /// `GL_SPOT_CUTOFF` is not 180.
    pub spot: bool,
    /// The attenuation factors are not (1, 0, 0).
    pub attenuated: bool,
}

/// `glColorMaterial`.
///
/// The driver updates `gl_FrontMaterial` from the *current* colour alone. The shader has to insert a colour per vertex
/// itself, so face and mode are in the key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ColorMaterial {
    /// `GL_COLOR_MATERIAL_FACE`.
    pub face: MaterialFace,
    /// `GL_COLOR_MATERIAL_PARAMETER`.
    pub mode: MaterialMode,
}

/// Faces whose material follows the colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MaterialFace {
    /// `GL_FRONT`
    Front,
    /// `GL_BACK`
    Back,
    /// `GL_FRONT_AND_BACK`
    FrontAndBack,
}

/// The material property that follows the colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MaterialMode {
    /// `GL_EMISSION`
    Emission,
    /// `GL_AMBIENT`
    Ambient,
    /// `GL_DIFFUSE`
    Diffuse,
    /// `GL_SPECULAR`
    Specular,
    /// `GL_AMBIENT_AND_DIFFUSE`
    AmbientAndDiffuse,
}

/// How a normal is scaled after the normal matrix (section 12.1.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum NormalScaling {
    /// Nothing.
    #[default]
    None,
    /// `GL_RESCALE_NORMAL`: one factor from the modelview matrix.
    Rescale,
    /// `GL_NORMALIZE`; wins when both are enabled.
    Normalize,
}

/// Where the fog coordinate comes from (section 16.4). With a vertex shader the fixed fragment stage always takes
/// `gl_FogFragCoord`, whatever `GL_FOG_COORD_SRC` says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FogSource {
    /// `GL_FOG` is disabled and nothing else reads the coordinate.
    #[default]
    None,
    /// `GL_FOG_COORD_SRC` is `GL_FOG_COORD`.
    Coordinate,
    /// `GL_FRAGMENT_DEPTH`, |z| of the eye position: the usual one, and `GL_EYE_PLANE_ABSOLUTE_NV`.
    DepthMagnitude,
    /// `GL_FRAGMENT_DEPTH` with `GL_EYE_PLANE` of `NV_fog_distance`.
    Depth,
    /// `GL_FRAGMENT_DEPTH` with `GL_EYE_RADIAL_NV`.
    Radial,
}

/// How the size of a point is computed (section 14.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PointSize {
    /// No points are drawn (neither `GL_POINTS` nor `glPolygonMode(…, GL_POINT)`).
    #[default]
    Unused,
    /// `GL_POINT_DISTANCE_ATTENUATION` is (1, 0, 0), and `GL_POINT_SIZE` lies between `GL_POINT_SIZE_MIN` and `_MAX`
    /// (Mesa clamps it with a program too, so the upper and lower limit do not matter there). The shader writes no size.
    Constant,
    /// Attenuated with distance, or clamped.
    Attenuated,
}

/// One texture coordinate set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct TextureUnit {
    /// The fragment stage reads it: a target is enabled on the unit.
    pub enabled: bool,
    /// The texture matrix is not the identity.
    pub matrix: bool,
    /// Generation of S, T, R and Q; `None` for a coordinate whose `GL_TEXTURE_GEN_*` is disabled.
    pub generation: [Option<TexGen>; 4],
}

/// `GL_TEXTURE_GEN_MODE` (section 12.1.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TexGen {
    /// `GL_OBJECT_LINEAR`
    ObjectLinear,
    /// `GL_EYE_LINEAR`
    EyeLinear,
    /// `GL_SPHERE_MAP` (S and T)
    SphereMap,
    /// `GL_REFLECTION_MAP` (S, T and R)
    ReflectionMap,
    /// `GL_NORMAL_MAP` (S, T and R)
    NormalMap,
}

/// How the driver reads the specification of fixed function, where drivers differ. A generated shader has to match the
/// driver's own picture, so the caller names the driver; `GL_VERSION` of a Mesa driver contains "Mesa".
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// As the specification has it.
    #[default]
    Specification,
    /// Mesa's `ffvertex_prog.c`: lighting does not divide the eye position by its w, a fog coordinate given by the
    /// program is taken by magnitude, and small multisampled points do not fade. Where its lighting leaves the
    /// specification altogether the key is refused: [`Unsupported::DriverQuirk`](super::Unsupported::DriverQuirk).
    Mesa,
}

impl FixedKey {
    /// The same key, with every field zeroed that does not affect the shader.
    pub fn canonical(mut self) -> Self {
        for unit in &mut self.units {
            if !unit.enabled {
                *unit = TextureUnit::default();
            }
        }
        let eye_space = self.point == PointSize::Attenuated
            || [
                TexGen::EyeLinear,
                TexGen::SphereMap,
                TexGen::ReflectionMap,
                TexGen::NormalMap,
            ]
            .into_iter()
            .any(|mode| self.generates(mode))
            || self.lights().any(|light| light.positional || light.spot)
            || self.lighting.is_some_and(|lighting| lighting.local_viewer);
        if let Some(lighting) = &mut self.lighting {
            lighting.canonicalise();
            lighting.zero_shininess &= self.dialect == Dialect::Mesa;
            lighting.object_space &= self.dialect == Dialect::Mesa && !eye_space;
            self.color_sum = false;
        }
        if !self.needs_normal() {
            self.normals = NormalScaling::None;
        }
        let dialect_matters = self.fog == FogSource::Coordinate
            || self.lighting.is_some_and(|lighting| lighting.local_viewer)
            || self.lights().any(|light| light.positional)
            || self.lighting.is_some_and(|lighting| lighting.object_space)
            || self.driver_quirk();
        if !dialect_matters {
            self.dialect = Dialect::Specification;
        }
        if self.target.tiles != Tiles::ClipLeftRight {
            self.target.clip = Clip::default();
        }
        match self.target.amplifier {
            Amplifier::Instanced => {
                self.target.clip = match self.target.clip {
                    Clip::Both => Clip::Discard,
                    Clip::Cut => Clip::Distances,
                    clip => clip,
                };
                self.target.primitive = Primitive::default();
                self.target.views = 1;
            }
            Amplifier::Tessellation => {
                self.target.views = 1;
                self.point = PointSize::Unused;
            }
            Amplifier::Points => {
                self.target.views = 1;
                self.target.primitive = Primitive::Points;
            }
            Amplifier::GeometryLoop | Amplifier::GeometryInvocations => {
                self.target.views = self.target.views.max(1);
                if self.target.primitive != Primitive::Points {
                    self.point = PointSize::Unused;
                }
            }
        }
        if self.point == PointSize::Constant {
            self.point = PointSize::Unused;
        }
        self.target.surface &= self.target.primitive == Primitive::Points;
        let quad = matches!(
            self.target.primitive,
            Primitive::Quads | Primitive::QuadStrip
        );
        let cut = quad || self.tessellates();
        if !cut {
            self.target.diagonal = Diagonal::default();
            self.provoking = Provoking::default();
        }
        if !cut && self.target.primitive != Primitive::Polygon {
            self.flat = false;
        }
        if !self.flat {
            self.provoking = Provoking::default();
        }
        self
    }

    /// Enabled lights.
    pub(super) fn lights(&self) -> impl Iterator<Item = Light> + '_ {
        self.lighting
            .iter()
            .flat_map(|lighting| lighting.lights.iter().flatten().copied())
    }

    /// A normal is transformed.
    pub(super) fn needs_normal(&self) -> bool {
        self.lights().next().is_some()
            || self.generates(TexGen::SphereMap)
            || self.generates(TexGen::ReflectionMap)
            || self.generates(TexGen::NormalMap)
    }

    /// The eye-space position is computed.
    pub(super) fn needs_eye(&self) -> bool {
        self.clip_planes != 0
            || self.point == PointSize::Attenuated
            || matches!(
                self.fog,
                FogSource::DepthMagnitude | FogSource::Depth | FogSource::Radial
            )
            || self.lights().any(|light| light.positional)
            || self.lighting.is_some_and(|lighting| lighting.local_viewer)
            || self.generates(TexGen::EyeLinear)
            || self.needs_reflection()
    }

    /// The reflection vector is computed.
    pub(super) fn needs_reflection(&self) -> bool {
        self.generates(TexGen::SphereMap) || self.generates(TexGen::ReflectionMap)
    }

    /// Some enabled unit generates a coordinate in this mode.
    pub(super) fn generates(&self, mode: TexGen) -> bool {
        self.units
            .iter()
            .any(|unit| unit.enabled && unit.generation.contains(&Some(mode)))
    }

    /// Both faces are lit.
    pub(super) fn two_side(&self) -> bool {
        self.lighting.is_some_and(|lighting| lighting.two_side)
    }

    /// A secondary colour is written.
    pub(super) fn secondary(&self) -> bool {
        match self.lighting {
            Some(lighting) => lighting.separate_specular,
            None => self.color_sum,
        }
    }

    /// Whether the driver's lighting deviates from the specification in a way that is not imitated. Measured on Mesa 22.3.6
    /// with `ffcheck`:
    /// * if every shininess is 0, an attenuated or spot light has the specular factor (n·L)^(n·L); if one of two lit faces has
    ///   shininess 0, the factor is the CPU's 0^0;
    /// * colour material of the back face alone, with two-sided lighting and colours per vertex, changes the other terms too,
    ///   unless it follows emission.
    pub(super) fn driver_quirk(&self) -> bool {
        let Some(lighting) = self.lighting else {
            return false;
        };
        let back_product = lighting.color_material.is_some_and(|material| {
            material.face == MaterialFace::Back && material.mode != MaterialMode::Emission
        });
        let lit = self.lights().next().is_some();
        self.dialect == Dialect::Mesa
            && (lighting.zero_shininess || lighting.two_side && lit && back_product)
    }

    /// Whether primitives are subdivided by tessellation.
    pub(super) fn tessellates(&self) -> bool {
        self.target.amplifier == Amplifier::Tessellation
    }

    /// Whether a stage after the vertex shader makes the primitives.
    pub(super) fn geometry(&self) -> bool {
        self.target.amplifier != Amplifier::Instanced
    }

    /// Number of clip distances: the tile's own, then one per user plane.
    pub(super) fn clip_distances(&self) -> u32 {
        self.target.clip_distances() + self.clip_planes.count_ones()
    }

    /// Indices of the enabled user planes, ascending.
    pub(super) fn planes(&self) -> impl Iterator<Item = u32> + '_ {
        (0..8).filter(|plane| self.clip_planes >> plane & 1 != 0)
    }

    /// Indices of the coordinate sets that are written, ascending.
    pub(super) fn coordinate_sets(&self) -> impl Iterator<Item = usize> + '_ {
        (0..UNITS).filter(|&unit| self.units[unit].enabled)
    }
}

impl Lighting {
    fn canonicalise(&mut self) {
        for light in self.lights.iter_mut().flatten() {
            // A directional light is not attenuated (12.2.1.1, att_i).
            light.attenuated &= light.positional;
        }
        let lit = self.lights.iter().any(Option::is_some);
        self.local_viewer &= lit;
        self.zero_shininess &= lit;
        self.object_space &= lit;
        // Without a light only emission, ambient and the alpha of diffuse are read.
        if !lit
            && self
                .color_material
                .is_some_and(|material| material.mode == MaterialMode::Specular)
        {
            self.color_material = None;
        }
        if !self.two_side
            && let Some(material) = self.color_material
        {
            self.color_material = match material.face {
                MaterialFace::Back => None,
                MaterialFace::Front | MaterialFace::FrontAndBack => Some(ColorMaterial {
                    face: MaterialFace::Front,
                    ..material
                }),
            };
        }
    }
}

//! The class of a draw, and the reason for it: from the state and the rules of a profile. Calls no GL.
//!
//! The rules without a profile are few and careful: a scene taken for a sky or a display loses its depth, which is worse than a
//! sky that keeps a little.

use super::{Kind, camera, parallax};
use crate::config::{
    Class, DepthRange, DepthState, FlatDepth, Profile, Projection, Rule, Viewport,
};
use crate::gl::{FramebufferName, ListName, TextureName};
use crate::state::{State, Touch};

/// The properties of a draw that decide its class. More than 12 fields: one for each condition of a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traits {
    /// The kind of the program's command.
    pub kind: Kind,
    /// Where the draw goes.
    pub target: Target,
    /// Its number in the frame, counted from 1; clears are not counted.
    pub draw: u32,
    /// How often the depths have been cleared in the frame.
    pub clear: u32,
    /// Its number since the last of these clears, or in the frame, counted from 1.
    pub after_clear: u32,
    /// The display list that is called.
    pub list: Option<ListName>,
    /// The projection under which the raster position was placed.
    pub raster: Projection,
    /// The projection matrix.
    pub projection: Projection,
    /// How much of the window the viewport covers.
    pub viewport: Viewport,
    /// The projection contains no translation and no skew along w, so the eye is at the origin of its space.
    pub centred: bool,
    /// Depth test and mask, where [`Classifier::needs`] asks for them.
    pub depth_state: DepthState,
    /// The depth range, where asked for.
    pub range: DepthRange,
    /// The 2D texture of the active unit, 0 for none; where asked for.
    pub texture: TextureName,
    /// The checksum of that texture's image, 0 where it is not known; where asked for.
    pub image: u64,
    /// The number of the program object in use, in the order of linking, 0 for none; where asked for.
    pub program: u32,
    /// The hash of its sources; where asked for.
    pub shader: u64,
    /// The modelview matrix rotates about the eye and is not the identity; where asked for. It translates by less than float arithmetic leaves
    /// where the program moves its sky to the eye.
    pub turns: bool,
    /// The shader puts all vertices at the far end of the depths.
    pub far_end: bool,
    /// Nothing in perspective has written depth since the frame began or was last cleared.
    pub first: bool,
    /// The last frame began with draws around the eye whose depths were cleared for the scene; how far this one has come.
    pub backdrop: BackdropStage,
    /// Without perspective, and yet a part of a scene (see [`super::decide::OrthographicWatch`]).
    pub slants: bool,
    /// By the frames before, it comes before everything else ([`super::decide::Foreground`]).
    pub foreground: bool,
}

/// How far a frame has come with its backdrop ([`super::decide::Backdrop`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BackdropStage {
    /// None is expected, or it is over.
    None,
    /// The next draw may be the first of it.
    Expected,
    /// It has begun, and nothing else has been drawn yet.
    Begun,
}

/// Where a draw goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The window.
    Window,
    /// A framebuffer of the program's whose picture, or a part of it, ends up in the window; with its number, in the order of first use.
    Pass(u32),
    /// Another framebuffer of the program's, with its number.
    Framebuffer(u32),
    /// No picture: a list that is compiled, selection, feedback.
    Nothing,
}

impl Target {
    /// Whether the picture, or a part of it, ends up in the window.
    pub fn is_shown(self) -> bool {
        matches!(self, Target::Window | Target::Pass(_))
    }
}

/// Why a draw has its class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// A rule of the profile, counted from 1.
    Rule(usize),
    /// It goes to a framebuffer of the program's.
    Framebuffer(u32),
    /// It makes no picture.
    NoPicture,
    /// It fills the picture with one value.
    Whole,
    /// It is drawn at the raster position.
    Raster,
    /// An orthographic projection has no depth to shift by.
    Orthographic,
    /// Without perspective, but seen from an oblique direction and with depths: deeper moves further.
    Slanted,
    /// No projection at all.
    NoProjection,
    /// It is rotated about the eye, writes no depth and comes before the scene.
    TurnsAboutEye,
    /// It is rotated about the eye, and the depths are cleared after it, as in the last frame.
    Backdrop,
    /// It lies at the far end of the depth range: behind everything.
    FarRange,
    /// Its shader puts it at the far end of the depths: behind everything.
    FarEnd,
    /// In perspective, in the near part of the depth range or after a clear of the depths for it: before everything.
    Foreground,
    /// In perspective, and nothing speaks against it.
    Perspective,
    /// Its own shaders place it: in perspective where w varies.
    Shaders,
    /// Its own shaders place it, by matrices without a perspective: flat unless w varies.
    FlatShaders,
    /// Its own shaders place it, by no matrix with a perspective, but w varies: shifted by it.
    ClipForm,
}

impl core::fmt::Display for Why {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Why::Rule(number) => write!(f, "rule {number} of the profile"),
            Why::Framebuffer(name) => write!(f, "drawn to framebuffer {name}, not to the window"),
            Why::NoPicture => f.write_str("selection or feedback, not a picture"),
            Why::Whole => f.write_str("the whole picture"),
            Why::Raster => f.write_str("at the raster position"),
            Why::Orthographic => f.write_str("orthographic projection"),
            Why::Slanted => f.write_str("orthographic projection of a scene, from an oblique direction and with depths"),
            Why::NoProjection => f.write_str("no projection"),
            Why::TurnsAboutEye => {
                f.write_str("turns about the eye, writes no depth, comes before the scene")
            }
            Why::Backdrop => f.write_str(
                "turns about the eye or has no depths, and depths are cleared for the scene after it",
            ),
            Why::FarRange => f.write_str("at the far end of the depth range, behind everything"),
            Why::FarEnd => f.write_str("at the far end of the depths by its shader, behind everything"),
            Why::Foreground => f.write_str(
                "before everything, by a part of the depth range or a clear of the depths for it: in the hand",
            ),
            Why::Perspective => f.write_str("perspective projection"),
            Why::Shaders => f.write_str("shaders of its own: in perspective where w varies"),
            Why::ClipForm => {
                f.write_str("shaders of its own without a matrix for the camera: by w, as measured")
            }
            Why::FlatShaders => {
                f.write_str("shaders of its own without a perspective: flat unless w varies")
            }
        }
    }
}

/// A draw with its class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Classed {
    /// Its class.
    pub class: Class,
    /// Depth of a flat draw: 0 on the panel, 1 infinitely far.
    pub depth: f64,
    /// Distance of zero parallax of a draw of the scene, if it differs from that of the rest: eye-space units.
    pub focal: Option<f64>,
    /// Why.
    pub why: Why,
}

impl Classed {
    /// Whether it is drawn before everything else, such as the weapon in a player's hand.
    pub fn is_foreground(&self) -> bool {
        self.why == Why::Foreground
    }
}

/// Where the scene stands at two places of the window: 0 on the panel, 1 infinitely far, below 0 before the panel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SceneDepths {
    /// In the middle.
    pub middle: f64,
    /// Under the pointer.
    pub pointer: f64,
}

/// Classifies the draws of one program.
#[derive(Clone, Debug)]
pub struct Classifier {
    /// The rules for this program, with their numbers in the file.
    rules: Vec<(usize, Rule)>,
    hud_depth: FlatDepth,
    scene: SceneDepths,
    explains: bool,
}

impl Classifier {
    /// For a program, by the name of its executable. `explains`: all traits are wanted, whether a rule asks for them or not.
    pub fn new(
        profile: &Profile,
        hud_depth: Option<FlatDepth>,
        program: Option<&str>,
        explains: bool,
    ) -> Self {
        Classifier {
            rules: numbered(profile, program),
            hud_depth: hud_depth.or(profile.hud_depth).unwrap_or_default(),
            scene: SceneDepths::default(),
            explains,
        }
    }

    /// Sets other rules, for a program by the name of its executable.
    pub fn change_rules(&mut self, profile: &Profile, program: Option<&str>) {
        self.rules = numbered(profile, program);
    }

    /// Whether all traits are wanted, as for an explanation.
    pub fn set_explains(&mut self, explains: bool) {
        self.explains = explains;
    }

    /// Sets another depth for flat draws that no rule places.
    pub fn change_hud_depth(&mut self, depth: FlatDepth) {
        self.hud_depth = depth;
    }

    /// What flat draws follow: those without a rule, and those of the rules.
    pub fn follows(&self, depth: FlatDepth) -> bool {
        let mut rules = self.rules.iter();
        self.hud_depth == depth || rules.any(|(_, rule)| rule.depth == Some(depth))
    }

    /// Sets where the scene stands that flat draws follow.
    pub fn change_scene(&mut self, scene: SceneDepths) {
        self.scene = scene;
    }

    /// Where the scene stands that flat draws follow.
    pub fn scene(&self) -> SceneDepths {
        self.scene
    }

    fn depth(&self, depth: FlatDepth) -> f64 {
        match depth {
            FlatDepth::At(depth) => depth,
            FlatDepth::Crosshair => self.scene.middle,
            FlatDepth::Cursor => self.scene.pointer,
        }
    }

    /// The groups of state that a draw's class may depend on, beside those that every draw needs. `before`: nothing in perspective has written depth,
    /// or nothing but a backdrop has.
    pub fn needs(&self, kind: Kind, projection: Projection, before: bool) -> Touch {
        if matches!(kind, Kind::Clear { .. } | Kind::Accum) {
            return Touch::NONE;
        }
        let rule = |asks: fn(&Rule) -> bool| {
            self.explains || self.rules.iter().any(|(_, rule)| asks(rule))
        };
        let mut needs = Touch::NONE;
        if rule(|rule| rule.depth_state.is_some()) {
            needs = needs | Touch::DEPTH;
        }
        if rule(|rule| rule.depth_range.is_some()) || projection == Projection::Perspective {
            needs = needs | Touch::RANGE;
        }
        if rule(|rule| !rule.texture.is_empty() || !rule.image.is_empty()) {
            needs = needs | Touch::TEXTURE;
        }
        if projection == Projection::Perspective && before {
            needs = needs | Touch::DEPTH;
        }
        needs
    }

    /// Whether the class may depend on the image of the texture that is sampled.
    pub fn needs_image(&self) -> bool {
        self.explains || self.has_rules_for_images()
    }

    /// Whether a rule asks for the image of a texture.
    pub fn has_rules_for_images(&self) -> bool {
        self.rules.iter().any(|(_, rule)| !rule.image.is_empty())
    }

    /// Whether the class may depend on the program object in use.
    pub fn needs_shader(&self) -> bool {
        let asks = |(_, rule): &(usize, Rule)| !rule.shader.is_empty() || !rule.program.is_empty();
        self.explains || self.rules.iter().any(asks)
    }

    /// Whether the class may depend on the modelview matrix, once the depth state is known.
    /// `backdrop`: nothing but a backdrop has been drawn in this frame ([`super::decide::Backdrop`]).
    pub fn needs_modelview(
        &self,
        projection: Projection,
        first: bool,
        depth: DepthState,
        backdrop: bool,
    ) -> bool {
        projection == Projection::Perspective
            && (self.explains || backdrop || first && depth != DepthState::On)
    }

    /// The class of a draw.
    pub fn class(&self, facts: &Traits) -> Classed {
        let classed = |class, why| Classed {
            class,
            depth: 0.0,
            focal: None,
            why,
        };
        let rule = || self.rules.iter().find(|(_, rule)| matches(rule, facts));
        match facts.target {
            Target::Window | Target::Pass(_) => {}
            // Only rules that name a pass apply here.
            Target::Framebuffer(_) if rule().is_some_and(|(_, rule)| !rule.pass.is_empty()) => {}
            Target::Framebuffer(name) => {
                return classed(Class::OffScreen, Why::Framebuffer(name));
            }
            Target::Nothing => return classed(Class::OffScreen, Why::NoPicture),
        }
        if matches!(facts.kind, Kind::Clear { .. } | Kind::Accum) {
            return classed(Class::Flat, Why::Whole);
        }
        if let Some((number, rule)) = rule() {
            return Classed {
                depth: self.depth(rule.depth.unwrap_or(self.hud_depth)),
                focal: rule.focal_depth,
                ..classed(rule.class, Why::Rule(*number))
            };
        }
        if facts.kind == Kind::Pixels {
            return match facts.raster {
                Projection::Perspective => classed(Class::Scene, Why::Raster),
                Projection::Orthographic => Classed {
                    depth: self.depth(self.hud_depth),
                    ..classed(Class::Flat, Why::Raster)
                },
                Projection::None => classed(Class::Flat, Why::Raster),
            };
        }
        match facts.projection {
            _ if facts.slants => classed(Class::Scene, Why::Slanted),
            Projection::Orthographic => Classed {
                depth: self.depth(self.hud_depth),
                ..classed(Class::Flat, Why::Orthographic)
            },
            // Vertices in clip space are mostly those of quads over the whole window; a shift would show their edges.
            Projection::None => classed(Class::Flat, Why::NoProjection),
            // Only a sky is drawn like this: anything that is not behind everything needs depths.
            Projection::Perspective if facts.range == DepthRange::Far => {
                classed(Class::Sky, Why::FarRange)
            }
            Projection::Perspective if facts.far_end => classed(Class::Sky, Why::FarEnd),
            Projection::Perspective if is_sky(facts) => classed(Class::Sky, Why::TurnsAboutEye),
            Projection::Perspective if is_in_backdrop(facts) => classed(Class::Sky, Why::Backdrop),
            Projection::Perspective if facts.foreground => classed(Class::Scene, Why::Foreground),
            Projection::Perspective => classed(Class::Scene, Why::Perspective),
        }
    }
}

/// A sky rotates with the camera but stays centred on it. It writes no depth, so it is drawn before anything that does. Under the identity
/// nothing is a sky: programs that transform vertices themselves draw everything with it.
fn is_sky(facts: &Traits) -> bool {
    facts.first && facts.is_around_eye() && facts.depth_state != DepthState::On
}

/// A backdrop is around the eye. A sun that follows it stands at a place, and has no depths.
fn is_in_backdrop(facts: &Traits) -> bool {
    match facts.backdrop {
        BackdropStage::None => false,
        BackdropStage::Expected => facts.is_around_eye(),
        BackdropStage::Begun => facts.is_around_eye() || facts.depth_state == DepthState::Off,
    }
}

fn matches(rule: &Rule, facts: &Traits) -> bool {
    let any = |names: &[u32], name: Option<u32>| {
        names.is_empty() || name.is_some_and(|name| names.contains(&name))
    };
    let within = |range: Option<(u32, u32)>, number: u32| {
        range.is_none_or(|(first, last)| (first..=last).contains(&number))
    };
    any(&rule.texture, Some(facts.texture.0))
        && (rule.image.is_empty() || rule.image.contains(&facts.image))
        && any(&rule.list, facts.list.map(|list| list.0))
        && rule.projection.is_none_or(|p| p == facts.projection)
        && rule.viewport.is_none_or(|v| v == facts.viewport)
        && rule.depth_state.is_none_or(|d| d == facts.depth_state)
        && rule.depth_range.is_none_or(|d| d == facts.range)
        && any(&rule.program, Some(facts.program))
        && any(&rule.pass, facts.pass())
        && (rule.shader.is_empty() || rule.shader.contains(&facts.shader))
        && any(&rule.clear, Some(facts.clear))
        && within(rule.draw, facts.draw)
        && within(rule.after_clear, facts.after_clear)
        && rule.before_depth.is_none_or(|before| before == facts.first)
}

impl Traits {
    /// From the state. The groups that [`Classifier::needs`] names have to be read already; other traits keep neutral values.
    pub fn of(kind: Kind, state: &State) -> Traits {
        let p = &state.matrices.projection;
        Traits {
            kind,
            target: match state.framebuffers.draw {
                _ if state.draws_to_window() => Target::Window,
                FramebufferName::ZERO => Target::Nothing,
                name => Target::Framebuffer(name.0),
            },
            draw: 0,
            clear: 0,
            after_clear: 0,
            list: None,
            raster: Projection::None,
            projection: state.projection_kind(),
            viewport: state.viewport_kind(),
            centred: [p[3], p[7], p[12], p[13], p[15]] == [0.0; 5],
            depth_state: state.classification.depth,
            range: state.classification.range,
            texture: state.classification.texture,
            image: 0,
            program: 0,
            shader: 0,
            turns: turns(&state.classification.modelview, p),
            far_end: false,
            slants: false,
            first: false,
            backdrop: BackdropStage::None,
            foreground: false,
        }
    }

    /// Whether it is drawn around the eye, so that it has no place in the scene.
    pub fn is_around_eye(&self) -> bool {
        self.centred && self.turns
    }

    /// The number of the framebuffer that is drawn to, 0 for the window; none where no picture is drawn.
    pub fn pass(&self) -> Option<u32> {
        match self.target {
            Target::Window => Some(0),
            Target::Pass(name) | Target::Framebuffer(name) => Some(name),
            Target::Nothing => None,
        }
    }
}

/// The rules of a profile for a program, each with its number from 1.
fn numbered(profile: &Profile, program: Option<&str>) -> Vec<(usize, Rule)> {
    let ours = |rule: &Rule| {
        let names = &rule.executable;
        names.is_empty() || names.iter().any(|name| Some(name.as_str()) == program)
    };
    let all = (1..).zip(&profile.rules);
    all.filter(|(_, rule)| ours(rule))
        .map(|(number, rule)| (number, rule.clone()))
        .collect()
}

/// Whether a modelview matrix (column-major) rotates or scales about the eye and is not the identity; `p` is the projection matrix.
fn turns(m: &[f32; 16], p: &[f32; 16]) -> bool {
    if [m[3], m[7], m[11]] != [0.0; 3] || m[15] == 0.0 || *m == glam::Mat4::IDENTITY.to_cols_array()
    {
        return false;
    }
    let off = glam::DVec3::new(m[12].into(), m[13].into(), m[14].into()) / f64::from(m[15]);
    let [near, _] = parallax::planes(p);
    // A camera that does not rotate leaves nothing to round: such a translation is meant, as one to the centres of pixels is.
    off == glam::DVec3::ZERO || camera::rotates(m) && off.length() <= near * camera::ROUNDED
}

mod proposal;
#[cfg(test)]
mod tests;

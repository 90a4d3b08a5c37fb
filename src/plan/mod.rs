//! A draw plus state in, a [`Plan`] value out: which views, which parallax, which strategy. Calls no GL.
#![forbid(unsafe_code)]

pub mod camera;
pub mod class;
pub mod comfort;
pub mod depths;
pub mod frustum;
mod governor;
pub mod parallax;
pub mod trial;

use crate::config::{Class, Strategy, Viewport};
use crate::state::State;
pub use class::{Classed, Classifier, Facts};
pub use comfort::Comfort;
pub use depths::{DepthMappings, Ramp};
pub use frustum::Bounds;
pub use governor::Governor;
pub use parallax::{Rig, Shear};
pub use trial::Trial;

/// What the program draws with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// glBegin … glEnd of one primitive mode.
    Begin(u32),
    /// glDrawArrays of one mode.
    Arrays(u32),
    /// glDrawElements of one mode.
    Elements(u32),
    /// Any other draw from arrays, rectangles, evaluator meshes.
    Other,
    /// glClear and its kin.
    Clear {
        /// Depths as well; taken for granted where the call does not say it.
        depths: bool,
        /// The buffers, as bits of glClear, that it clears for certain where nothing is masked.
        whole: u32,
    },
    /// Display lists.
    List,
    /// At the raster position.
    Pixels,
    /// Accumulation buffer.
    Accum,
}

/// Why a draw did not go by the strategy that was asked for. The texts are keys of the report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Only replay knows this kind of draw.
    Kind(&'static str),
    /// The program's own shaders.
    Program,
    /// The generator of shaders says no.
    Fixed(crate::fixed::Unsupported),
    /// The driver lacks something.
    Driver(&'static str),
    /// The driver refused a generated shader.
    Compile,
    /// A draw that an occlusion camera's rays do not meet.
    NoReference(String),
    /// Views were made of the scene before something that has to be drawn in each.
    Parted(&'static str),
}

impl core::fmt::Display for Reason {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Reason::Kind(what) => write!(f, "{what} are replayed"),
            Reason::Program => f.write_str("the program's own shaders are replayed"),
            Reason::Fixed(u) => write!(f, "{u}"),
            Reason::Driver(what) => write!(f, "the driver has no {what}"),
            Reason::Compile => f.write_str("the driver refused the generated shader"),
            Reason::NoReference(why) => {
                write!(f, "a program draws nothing to the reference image: {why}")
            }
            Reason::Parted(what) => write!(f, "views are made before {what}"),
        }
    }
}

/// How the views are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Method {
    /// The call goes to the driver once, as it is.
    Once,
    /// The call once per view.
    Replay,
    /// One instanced draw.
    Instanced,
    /// One draw through a geometry shader.
    Geometry,
}

/// One draw, decided.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// How.
    pub method: Method,
    /// What the draw is.
    pub class: Class,
    /// The shift of the views; none for what is the same in all of them.
    pub shear: Option<Shear>,
    /// It goes by a variant of the program's own shaders.
    pub variant: bool,
    /// Under a variant, what has a w of 1 in clip space.
    pub flat: Flat,
    /// Why not by the strategy asked for.
    pub reason: Option<Reason>,
}

/// What vertices are whose w is 1 in clip space: the vertex stage of a program can draw the scene with them, or what has no depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flat {
    /// The same in all views.
    Still,
    /// Shifted as a whole, such as the HUD.
    By(Shear),
    /// A part of the scene like any other.
    Scene,
}

/// What a plan needs to know beside the state.
#[derive(Clone, Copy, Debug)]
pub struct Capabilities {
    /// What the user asked for, or `auto` has come to.
    pub strategy: Strategy,
    /// Instancing, clip distances and compatibility shaders are there.
    pub instanced: bool,
    /// Geometry shaders too.
    pub geometry: bool,
    /// The program has passes that have to meet in every pixel, and replayed draws would not meet the others.
    pub together: bool,
}

/// Decides one draw.
pub fn plan(
    kind: Kind,
    state: &State,
    rig: &Rig,
    capabilities: &Capabilities,
    classed: &Classed,
) -> Plan {
    let class = classed.class;
    if class == Class::OffScreen {
        return Plan {
            method: Method::Once,
            class,
            shear: None,
            variant: false,
            flat: Flat::Still,
            reason: None,
        };
    }
    let shear = if matches!(kind, Kind::Clear { .. } | Kind::Accum) {
        None
    } else {
        let p = &state.projection;
        match class {
            Class::Scene => match classed.focal {
                None => rig.shear(p),
                Some(focal) => rig.shear_about(p, focal),
            },
            Class::Sky => rig.sky(p),
            Class::Flat => rig.at_depth(p, classed.depth * magnified(state)),
            Class::OffScreen => None,
        }
    };
    let (method, reason) = match method(kind, state, capabilities) {
        Ok(m) => (m, None),
        Err(r) => (Method::Replay, r),
    };
    Plan {
        method,
        class,
        shear,
        variant: false,
        flat: Flat::Still,
        reason,
    }
}

/// What a shift of the window's is in a small viewport of it: a picture in the picture stands where the display around it does.
fn magnified(state: &State) -> f64 {
    match state.viewport_kind() {
        Viewport::Main => 1.0,
        Viewport::Inset => f64::from(state.window.width) / f64::from(state.viewport[2].max(1)),
    }
}

fn method(
    kind: Kind,
    state: &State,
    capabilities: &Capabilities,
) -> Result<Method, Option<Reason>> {
    let wish = match capabilities.strategy {
        // `auto` is in force as one of the others, and what no view is made of is drawn in each.
        Strategy::Replay
        | Strategy::Auto
        | Strategy::DepthImage
        | Strategy::Occlusion
        | Strategy::Hybrid => {
            return Err(None);
        }
        Strategy::Geometry => Method::Geometry,
        Strategy::Instanced => Method::Instanced,
    };
    match kind {
        Kind::Clear { .. } | Kind::Pixels | Kind::Accum => return Err(None),
        _ if capabilities.together => {
            return Err(Some(Reason::Kind(
                "draws of a program whose passes have to meet in every pixel (GL_EQUAL)",
            )));
        }
        Kind::List => return Err(Some(Reason::Kind("display lists"))),
        Kind::Other => {
            return Err(Some(Reason::Kind(
                "rectangles, evaluators, multi-draws and instanced draws",
            )));
        }
        Kind::Begin(_) if wish == Method::Instanced => {
            return Err(Some(Reason::Kind("immediate-mode draws under `instanced`")));
        }
        _ => {}
    }
    if state.program != 0 || state.pipeline != 0 {
        return Err(Some(Reason::Program));
    }
    match wish {
        Method::Instanced if !capabilities.instanced => Err(Some(Reason::Driver(
            "instancing with clip distances in compatibility shaders (GLSL 1.50)",
        ))),
        Method::Geometry if !capabilities.geometry => Err(Some(Reason::Driver(
            "geometry shaders in compatibility contexts (GLSL 1.50)",
        ))),
        m => Ok(m),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Camera;
    use crate::state::Window;

    #[test]
    fn a_picture_in_the_picture_stands_where_the_display_does() {
        let window = Window {
            es: false,
            width: 640,
            height: 480,
            double_buffered: true,
            stereo: false,
            bits: [8, 8, 8, 0, 24, 8],
            samples: 0,
            srgb_capable: false,
            srgb: false,
            float: false,
            accumulation: [0; 4],
            names_back: true,
            default_buffer: 0,
            default_read: 0,
        };
        let mut state = State::new(window, true);
        state.projection[0] = 2.0;
        let rig = Rig::new(5, Camera::Auto, None);
        let capabilities = Capabilities {
            strategy: Strategy::Replay,
            instanced: false,
            geometry: false,
            together: false,
        };
        let classed = Classed {
            class: Class::Flat,
            depth: 0.25,
            focal: None,
            why: class::Why::Orthographic,
        };
        let mut pixels = |width: i32, height: i32| {
            state.viewport = [16, 16, width, height];
            let plan = plan(Kind::Begin(7), &state, &rig, &capabilities, &classed);
            plan.shear.expect("a shift").separation(1.0) * f64::from(width) / 2.0
        };
        let whole = pixels(640, 480);
        assert!((pixels(64, 48) - whole).abs() < 1e-9, "an inset");
        // Half of a split screen has its own scene.
        assert!((pixels(320, 480) - whole / 2.0).abs() < 1e-9);
    }
}

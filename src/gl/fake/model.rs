//! What the driver keeps: values by where they belong and by the name that glGet has for them.

use super::limits;
use crate::gl::consts as c;
use crate::gl::{FramebufferName, ProgramName, RenderbufferName, TextureName, VertexArrayName};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::OnceLock;

/// What a value belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scope {
    /// The context.
    Context,
    /// One of several of the context: a viewport, a draw buffer, a binding point, an image unit, a target of queries.
    Index(u32),
    /// A texture unit, counted from 0.
    Unit(u32),
    /// A light of fixed function, from GL_LIGHT0.
    Light(u32),
    /// GL_FRONT or GL_BACK of the material.
    Face(u32),
    /// A vertex array object; 0 is the context's own.
    VertexArray(VertexArrayName),
    /// A framebuffer object, or the window.
    Framebuffer(FramebufferName),
    /// A texture.
    Texture(TextureName),
    /// A level of a texture.
    Level(TextureName, i32),
    /// A renderbuffer.
    Renderbuffer(RenderbufferName),
    /// A program: the values of its uniforms, by location.
    Program(ProgramName),
}

impl Scope {
    /// The kind and the name of the object that it is part of.
    fn object(self) -> Option<(&'static str, u32)> {
        match self {
            Scope::Context | Scope::Index(_) | Scope::Unit(_) => None,
            Scope::Light(_) | Scope::Face(_) => None,
            Scope::VertexArray(name) => Some(("VertexArrays", name.0)),
            Scope::Framebuffer(name) => Some(("Framebuffers", name.0)),
            Scope::Texture(name) | Scope::Level(name, _) => Some(("Textures", name.0)),
            Scope::Renderbuffer(name) => Some(("Renderbuffers", name.0)),
            Scope::Program(name) => Some(("Programs", name.0)),
        }
    }
}

impl fmt::Display for Scope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Scope::Context => Ok(()),
            Scope::Index(at) => write!(f, " of index {at}"),
            Scope::Unit(at) => write!(f, " of texture unit {at}"),
            Scope::Light(light) => write!(f, " of light {}", light.wrapping_sub(c::LIGHT0)),
            Scope::Face(face) => write!(f, " of the {} face", name_of(*face)),
            Scope::VertexArray(name) => write!(f, " of vertex array {name}"),
            Scope::Framebuffer(name) => write!(f, " of framebuffer {name}"),
            Scope::Texture(name) => write!(f, " of texture {name}"),
            Scope::Level(name, level) => write!(f, " of level {level} of texture {name}"),
            Scope::Renderbuffer(name) => write!(f, " of renderbuffer {name}"),
            Scope::Program(name) => write!(f, " of program {name}"),
        }
    }
}

/// Where a value is kept.
pub(super) type Key = (Scope, u32);

/// The values at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    pub(super) values: BTreeMap<Key, Vec<f64>>,
    /// Objects that the program made; what happens to others is not its business.
    pub(super) owned: BTreeSet<(&'static str, u32)>,
}

impl Snapshot {
    /// A value; what a new context has where no command has set it, and nothing for what is not known at all.
    pub fn get(&self, scope: Scope, name: u32) -> Vec<f64> {
        let stored = self.values.get(&(scope, name)).cloned();
        stored.unwrap_or_else(|| limits::default(name).unwrap_or_default())
    }

    /// The first element of a value as a name or an enumerant; 0 where there is none.
    pub fn int(&self, scope: Scope, name: u32) -> u32 {
        self.get(scope, name).first().map_or(0, |&v| v as u32)
    }

    /// A value of the context, of viewport 0, or of the active texture unit.
    pub fn value(&self, name: u32) -> Vec<f64> {
        self.get(self.scope(name), name)
    }

    /// Whether a capability is enabled.
    pub fn is_enabled(&self, capability: u32) -> bool {
        self.value(capability) == [1.0]
    }

    /// Where glGet finds a value.
    pub(super) fn scope(&self, name: u32) -> Scope {
        let int = |name| self.int(Scope::Context, name);
        match name {
            _ if limits::indices(name) > 0 => Scope::Index(0),
            _ if limits::is_of_unit(name) => {
                Scope::Unit(int(c::ACTIVE_TEXTURE).wrapping_sub(c::TEXTURE0))
            }
            c::DRAW_BUFFER | c::DRAW_BUFFER0..=c::DRAW_BUFFER15 => {
                Scope::Framebuffer(FramebufferName(int(c::DRAW_FRAMEBUFFER_BINDING)))
            }
            c::READ_BUFFER => Scope::Framebuffer(FramebufferName(int(c::READ_FRAMEBUFFER_BINDING))),
            c::ELEMENT_ARRAY_BUFFER_BINDING => {
                Scope::VertexArray(VertexArrayName(int(c::VERTEX_ARRAY_BINDING)))
            }
            _ => Scope::Context,
        }
    }

    /// What is not as it was: a sentence for each value of the context and of the program's own objects.
    pub fn differences(&self, after: &Snapshot) -> Vec<String> {
        let keys: BTreeSet<&Key> = self.values.keys().chain(after.values.keys()).collect();
        let own = |scope: Scope| match scope.object() {
            None => true,
            Some((_, 0)) => true,
            Some(object) => self.owned.contains(&object),
        };
        let mut sentences = Vec::new();
        for &&(scope, name) in keys.iter().filter(|key| own(key.0)) {
            let (was, is) = (self.get(scope, name), after.get(scope, name));
            if was != is {
                sentences.push(format!(
                    "{}{scope} was {was:?} and is {is:?}",
                    name_of(name)
                ));
            }
        }
        sentences
    }
}

/// The name of an enumerant as `consts.rs` has it, else its number.
pub(super) fn name_of(value: u32) -> String {
    static NAMES: OnceLock<BTreeMap<u32, &'static str>> = OnceLock::new();
    let names = NAMES.get_or_init(|| {
        let line = |line: &'static str| {
            let (name, value) = line.strip_prefix("pub const ")?.split_once(": u32 = 0x")?;
            let value = u32::from_str_radix(value.trim_end_matches(';'), 16).ok()?;
            Some((value, name))
        };
        // Of several names for one number the first counts.
        let lines: Vec<_> = include_str!("../consts.rs").lines().collect();
        lines.into_iter().rev().filter_map(line).collect()
    });
    match names.get(&value) {
        Some(name) => format!("GL_{name}"),
        None => format!("0x{value:04X}"),
    }
}

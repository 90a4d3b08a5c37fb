//! Names of objects: what glGen* and glCreate* make, glDelete* deletes and glIs* knows.

use super::memory::{Kind, address, read, write};
use super::{Arg, Call, Driver, Scope};
use crate::gl::{FramebufferName, consts as c};
use std::collections::{BTreeMap, BTreeSet};

/// Objects by kind, which is how glGen* calls it.
#[derive(Debug, Default)]
pub(super) struct Objects {
    alive: BTreeMap<&'static str, BTreeSet<u32>>,
    last: BTreeMap<&'static str, u32>,
}

/// Kinds of objects, how glIs* calls one, and what the name of one that is bound is kept as.
const KINDS: &[(&str, &str, &[u32])] = &[
    (
        "Textures",
        "Texture",
        &[
            c::TEXTURE_BINDING_1D,
            c::TEXTURE_BINDING_2D,
            c::TEXTURE_BINDING_3D,
            c::TEXTURE_BINDING_CUBE_MAP,
            c::TEXTURE_BINDING_RECTANGLE,
            c::TEXTURE_BINDING_1D_ARRAY,
            c::TEXTURE_BINDING_2D_ARRAY,
            c::TEXTURE_BINDING_CUBE_MAP_ARRAY,
            c::TEXTURE_BINDING_2D_MULTISAMPLE,
            c::TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY,
        ],
    ),
    (
        "Framebuffers",
        "Framebuffer",
        &[c::DRAW_FRAMEBUFFER_BINDING, c::READ_FRAMEBUFFER_BINDING],
    ),
    ("Renderbuffers", "Renderbuffer", &[c::RENDERBUFFER_BINDING]),
    (
        "Buffers",
        "Buffer",
        &[
            c::ARRAY_BUFFER_BINDING,
            c::ELEMENT_ARRAY_BUFFER_BINDING,
            c::UNIFORM_BUFFER_BINDING,
            c::PIXEL_PACK_BUFFER_BINDING,
            c::PIXEL_UNPACK_BUFFER_BINDING,
            c::COPY_READ_BUFFER,
        ],
    ),
    ("VertexArrays", "VertexArray", &[c::VERTEX_ARRAY_BINDING]),
    ("Queries", "Query", &[c::CURRENT_QUERY]),
    ("Samplers", "Sampler", &[c::SAMPLER_BINDING]),
    (
        "ProgramPipelines",
        "ProgramPipeline",
        &[c::PROGRAM_PIPELINE_BINDING],
    ),
    ("Lists", "List", &[]),
    ("Programs", "Program", &[]),
];

/// A kind by the rest of a command's name, in the plural or the singular.
fn kind(rest: &str) -> Option<&'static str> {
    let rest = ["ARB", "EXT", "OES", "APPLE"]
        .iter()
        .find_map(|vendor| rest.strip_suffix(vendor))
        .unwrap_or(rest);
    let found = KINDS
        .iter()
        .find(|(many, one, _)| *many == rest || *one == rest)?;
    Some(found.0)
}

impl Driver {
    /// A new name of a kind.
    pub(super) fn generate(&mut self, kind: &'static str) -> u32 {
        let last = self.objects.last.entry(kind).or_default();
        *last += 1;
        let name = *last;
        self.create(kind, name);
        name
    }

    /// There is an object of this name, perhaps one that was never asked for.
    pub(super) fn create(&mut self, kind: &'static str, name: u32) {
        if name == 0 || !self.objects.alive.entry(kind).or_default().insert(name) {
            return;
        }
        let last = self.objects.last.entry(kind).or_default();
        *last = (*last).max(name);
        if self.by_program {
            self.state.owned.insert((kind, name));
        }
        if kind == "Framebuffers" {
            let scope = Scope::Framebuffer(FramebufferName(name));
            for point in [c::DRAW_BUFFER, c::DRAW_BUFFER0, c::READ_BUFFER] {
                self.put(scope, point, &[c::COLOR_ATTACHMENT0.into()]);
            }
        }
    }

    /// Whether there is an object of this name.
    pub(super) fn exists(&self, kind: &str, name: u32) -> bool {
        let names = self.objects.alive.get(kind);
        names.is_some_and(|names| names.contains(&name))
    }

    /// How many objects of a kind there are.
    pub(super) fn alive(&self, kind: &str) -> usize {
        self.objects.alive.get(kind).map_or(0, BTreeSet::len)
    }

    fn delete(&mut self, kind: &'static str, name: u32) {
        let names = self.objects.alive.entry(kind).or_default();
        if name == 0 || !names.remove(&name) {
            return;
        }
        self.state.owned.remove(&(kind, name));
        let bindings = KINDS.iter().find(|known| known.0 == kind);
        let bindings = bindings.map_or(&[][..], |known| known.2);
        let of = |scope: Scope| match scope {
            Scope::Framebuffer(of) => kind == "Framebuffers" && of.0 == name,
            Scope::Texture(of) | Scope::Level(of, _) => kind == "Textures" && of.0 == name,
            Scope::Renderbuffer(of) => kind == "Renderbuffers" && of.0 == name,
            Scope::VertexArray(of) => kind == "VertexArrays" && of.0 == name,
            Scope::Program(of) => kind == "Programs" && of.0 == name,
            _ => false,
        };
        self.state.values.retain(|(scope, _), _| !of(*scope));
        for ((_, key), value) in &mut self.state.values {
            if bindings.contains(key) && *value == [f64::from(name)] {
                *value = vec![0.0];
            }
        }
        if kind == "Buffers" {
            self.buffers.remove(&name);
        }
    }

    /// Commands that make, delete or look for names; none for others.
    pub(super) fn names(&mut self, call: &mut Call) -> Option<i64> {
        let command = call.name.strip_prefix("gl")?;
        match command {
            "GenLists" => {
                let count = call.int(0).max(0);
                let names: Vec<u32> = (0..count).map(|_| self.generate("Lists")).collect();
                return Some(names.first().copied().unwrap_or(0).into());
            }
            "DeleteLists" => {
                let first = call.int(0) as u32;
                (0..call.int(1) as u32).for_each(|at| self.delete("Lists", first + at));
                return Some(0);
            }
            "CreateProgram" | "CreateShader" => {
                let name = self.generate("Programs");
                self.shaders.create(name, call.int(0) as u32);
                return Some(name.into());
            }
            "DeleteProgram" | "DeleteShader" => {
                let name = call.int(0) as u32;
                // One that is in use lives on until it is not.
                if self.state.int(Scope::Context, c::CURRENT_PROGRAM) != name {
                    self.delete("Programs", name);
                }
                return Some(0);
            }
            "IsShader" => return Some(self.exists("Programs", call.int(0) as u32).into()),
            _ => {}
        }
        let verb = ["Gen", "Create", "Delete", "Is"];
        let (verb, rest) = verb
            .iter()
            .find_map(|verb| Some((*verb, command.strip_prefix(verb)?)))?;
        let kind = kind(rest)?;
        if verb == "Is" {
            return Some(self.exists(kind, call.int(0) as u32).into());
        }
        let count = call.int(0).max(0) as usize;
        let place = address(call.args.last());
        if verb == "Delete" {
            let names = read(place, Kind::U32, count);
            names
                .iter()
                .for_each(|&name| self.delete(kind, name as u32));
            call.args[1] = Arg::Data(names);
        } else {
            let names: Vec<f64> = (0..count).map(|_| self.generate(kind).into()).collect();
            write(place, Kind::U32, &names);
        }
        Some(0)
    }
}

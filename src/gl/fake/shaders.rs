//! Shaders and programs: they compile and link, and their uniforms, inputs and outputs are those that their texts declare.

use super::memory::{Kind, address, put_string, read, string, strings, write};
use super::{Arg, Call, Driver, Scope};
use crate::gl::{ProgramName, consts as c};
use std::collections::HashMap;

/// A uniform or an attribute that a text declares.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Declared {
    /// With `[0]` where it is an array.
    name: String,
    kind: u32,
    size: u32,
    location: u32,
}

#[derive(Clone, Debug, Default)]
struct Program {
    attached: Vec<u32>,
    uniforms: Vec<Declared>,
    attributes: Vec<Declared>,
    /// What the fragment shader writes under names of its own; each has the location after that of the one before.
    outputs: Vec<Declared>,
    blocks: Vec<String>,
    linked: bool,
}

#[derive(Clone, Debug, Default)]
struct Shader {
    kind: u32,
    text: String,
    compiled: bool,
}

/// All of a context.
#[derive(Debug, Default)]
pub(super) struct Shaders {
    shaders: HashMap<u32, Shader>,
    programs: HashMap<u32, Program>,
    /// Texts with these words do not compile.
    pub(super) refused: Option<String>,
}

const LOG: &str = "refused by the test";

/// The enumerant of a type of GLSL; that of a sampler for what else there is.
fn kind(word: &str) -> u32 {
    const KINDS: &[(&str, u32)] = &[
        ("float", c::FLOAT),
        ("vec2", 0x8B50),
        ("vec3", 0x8B51),
        ("vec4", 0x8B52),
        ("int", c::INT),
        ("ivec2", 0x8B53),
        ("ivec3", 0x8B54),
        ("ivec4", 0x8B55),
        ("uint", c::UNSIGNED_INT),
        ("uvec2", 0x8DC6),
        ("uvec3", 0x8DC7),
        ("uvec4", 0x8DC8),
        ("bool", c::BOOL),
        ("mat2", 0x8B5A),
        ("mat3", 0x8B5B),
        ("mat4", c::FLOAT_MAT4),
    ];
    const SAMPLER_2D: u32 = 0x8B5E;
    let found = KINDS.iter().find(|(name, _)| *name == word);
    found.map_or(SAMPLER_2D, |(_, kind)| *kind)
}

/// A text in words and signs, without comments and directives.
fn words(text: &str) -> Vec<String> {
    let lines = text.lines().map(|line| line.split("//").next());
    let code = lines.flatten().filter(|l| !l.trim_start().starts_with('#'));
    let mut words: Vec<String> = Vec::new();
    let mut joins = false;
    for sign in code.flat_map(|line| line.chars().chain(['\n'])) {
        let part = sign.is_ascii_alphanumeric() || sign == '_';
        match words.last_mut() {
            Some(word) if part && joins => word.push(sign),
            _ if !sign.is_whitespace() => words.push(sign.into()),
            _ => {}
        }
        joins = part;
    }
    words
}

/// What a text declares with one of some words: types and names, with the lengths of arrays; a block has none.
fn declared(text: &str, by: &[&str]) -> Vec<(String, String, Option<u32>)> {
    let words = words(text);
    let at = |at: usize| words.get(at).map_or("", String::as_str);
    let mut found = Vec::new();
    for start in (0..words.len()).filter(|&start| by.contains(&at(start))) {
        let mut next = start + 1;
        while ["highp", "mediump", "lowp"].contains(&at(next)) {
            next += 1;
        }
        if at(next + 1) == "{" {
            found.push((String::new(), at(next).to_owned(), None));
            continue;
        }
        let word = at(next);
        // `uniform vec4 a, b;` declares two; a comma after `in` is one between parameters.
        let lists = at(start) == "uniform";
        loop {
            let array = (at(next + 2) == "[").then(|| at(next + 3).parse().unwrap_or(1));
            let more = lists && at(next + 2) == ",";
            if more || [";", "[", "="].contains(&at(next + 2)) {
                found.push((word.to_owned(), at(next + 1).to_owned(), array));
            }
            if !more {
                break;
            }
            next += 2;
        }
    }
    found
}

impl Shaders {
    pub(super) fn create(&mut self, name: u32, kind: u32) {
        let shader = Shader {
            kind,
            ..Shader::default()
        };
        self.shaders.insert(name, shader);
        self.programs.insert(name, Program::default());
    }

    fn link(&mut self, name: u32) {
        let Some(mut program) = self.programs.remove(&name) else {
            return;
        };
        program.uniforms.clear();
        program.attributes.clear();
        program.outputs.clear();
        program.blocks.clear();
        let shaders: Vec<&Shader> = program
            .attached
            .iter()
            .filter_map(|shader| self.shaders.get(shader))
            .collect();
        let add = |list: &mut Vec<Declared>, (word, name, array): (String, String, Option<u32>)| {
            let name = match array {
                Some(_) => format!("{name}[0]"),
                None => name,
            };
            let next = list.last().map_or(0, |last| last.location + last.size);
            if list.iter().all(|known| known.name != name) {
                list.push(Declared {
                    kind: kind(&word),
                    name,
                    size: array.unwrap_or(1),
                    location: next,
                });
            }
        };
        for shader in &shaders {
            for uniform in declared(&shader.text, &["uniform"]) {
                match uniform.0.is_empty() {
                    true if !program.blocks.contains(&uniform.1) => program.blocks.push(uniform.1),
                    true => {}
                    false => add(&mut program.uniforms, uniform),
                }
            }
            if shader.kind == c::VERTEX_SHADER {
                let inputs = declared(&shader.text, &["in", "attribute"]);
                inputs
                    .into_iter()
                    .for_each(|input| add(&mut program.attributes, input));
            }
            if shader.kind == c::FRAGMENT_SHADER {
                let outputs = declared(&shader.text, &["out"]).into_iter();
                // NVIDIA's driver tells of this one too.
                let built_in = shader.text.contains("gl_FragColor");
                let built_in =
                    built_in.then(|| ("vec4".to_owned(), "gl_FragColor".to_owned(), None));
                outputs
                    .chain(built_in)
                    .for_each(|output| add(&mut program.outputs, output));
            }
        }
        program.linked = shaders.iter().all(|shader| shader.compiled);
        self.programs.insert(name, program);
    }

    /// Where a uniform or an element of one is; -1 where there is no such one.
    pub(super) fn location(&self, program: u32, name: &str) -> i32 {
        let uniforms = self.programs.get(&program).map(|p| &p.uniforms);
        place(uniforms.map_or(&[], Vec::as_slice), name)
    }
}

/// The length of the longest name, with its final 0.
fn longest(list: &[Declared]) -> f64 {
    let lengths = list.iter().map(|known| known.name.len() + 1);
    lengths.max().unwrap_or(0) as f64
}

fn place(all: &[Declared], name: &str) -> i32 {
    let (stem, at) = match name.strip_suffix(']').and_then(|n| n.split_once('[')) {
        Some((stem, at)) => (stem, at.parse().unwrap_or(0)),
        None => (name, 0),
    };
    let is = |known: &&Declared| known.name.trim_end_matches("[0]") == stem && at < known.size;
    let found = all.iter().find(is);
    found.map_or(-1, |known| (known.location + at) as i32)
}

impl Driver {
    /// Commands about shaders and programs; none for others.
    pub(super) fn programs(&mut self, call: &mut Call) -> Option<i64> {
        if let Some(rest) = call.name.strip_prefix("glUniform")
            && rest.starts_with(|first: char| first.is_ascii_digit() || first == 'M')
        {
            self.set_uniform(rest, call);
            return Some(0);
        }
        let name = call.int(0) as u32;
        let place_of = |at: usize| address(call.args.get(at));
        match call.name {
            "glShaderSource" => {
                let text = strings(call.int(1) as usize, place_of(2), place_of(3));
                let text = String::from_utf8_lossy(&text).into_owned();
                if let Some(shader) = self.shaders.shaders.get_mut(&name) {
                    shader.text = text.clone();
                }
                call.args.truncate(2);
                call.args.push(Arg::Text(text));
            }
            "glCompileShader" => {
                let refused = self.shaders.refused.clone();
                if let Some(shader) = self.shaders.shaders.get_mut(&name) {
                    shader.compiled = refused.is_none_or(|words| !shader.text.contains(&words));
                }
            }
            "glAttachShader" => {
                let shader = call.int(1) as u32;
                let program = self.shaders.programs.get_mut(&name)?;
                program.attached.push(shader);
            }
            "glLinkProgram" => self.shaders.link(name),
            "glGetShaderiv" => {
                let shader = self.shaders.shaders.get(&name)?;
                let value = match call.int(1) as u32 {
                    c::COMPILE_STATUS => shader.compiled.into(),
                    c::SHADER_TYPE => shader.kind.into(),
                    c::SHADER_SOURCE_LENGTH => shader.text.len() as f64 + 1.0,
                    _ => 0.0,
                };
                write(place_of(2), Kind::I32, &[value]);
            }
            "glGetShaderSource" => {
                let text = &self.shaders.shaders.get(&name)?.text;
                put_string(text, call.int(1), place_of(2), place_of(3));
            }
            "glGetShaderInfoLog" => {
                let failed = !self.shaders.shaders.get(&name)?.compiled;
                let log = if failed { LOG } else { "" };
                put_string(log, call.int(1), place_of(2), place_of(3));
            }
            "glGetProgramInfoLog" => put_string("", call.int(1), place_of(2), place_of(3)),
            "glGetUniformLocation" => {
                let wanted = string(place_of(1));
                let location = self.shaders.location(name, &wanted);
                call.args[1] = Arg::Text(wanted);
                return Some(location.into());
            }
            "glGetAttribLocation" => {
                let program = self.shaders.programs.get(&name)?;
                return Some(place(&program.attributes, &string(place_of(1))).into());
            }
            "glGetFragDataLocation" => {
                let program = self.shaders.programs.get(&name)?;
                return Some(place(&program.outputs, &string(place_of(1))).into());
            }
            "glGetProgramiv" => {
                let value = self.program_parameter(name, call.int(1) as u32);
                write(place_of(2), Kind::I32, &[value]);
            }
            "glGetAttachedShaders" => {
                let attached = &self.shaders.programs.get(&name)?.attached;
                let all: Vec<f64> = attached.iter().map(|&name| name.into()).collect();
                write(place_of(2), Kind::I32, &[all.len() as f64]);
                write(place_of(3), Kind::U32, &all);
            }
            "glGetActiveUniform" | "glGetActiveAttrib" => {
                let program = self.shaders.programs.get(&name)?;
                let list = match call.name {
                    "glGetActiveUniform" => &program.uniforms,
                    _ => &program.attributes,
                };
                let known = list.get(call.int(1) as usize)?;
                put_string(&known.name, call.int(2), place_of(3), place_of(6));
                write(place_of(4), Kind::I32, &[known.size.into()]);
                write(place_of(5), Kind::U32, &[known.kind.into()]);
            }
            "glGetActiveUniformsiv" => {
                // No uniform of a block is active by itself.
                write(place_of(4), Kind::I32, &[-1.0]);
            }
            "glGetUniformBlockIndex" => {
                let wanted = string(place_of(1));
                let blocks = &self.shaders.programs.get(&name)?.blocks;
                let at = blocks.iter().position(|block| *block == wanted);
                return Some(at.map_or(u32::MAX.into(), |at| at as i64));
            }
            "glGetActiveUniformBlockName" => {
                let blocks = &self.shaders.programs.get(&name)?.blocks;
                let block = blocks.get(call.int(1) as usize)?;
                put_string(block, call.int(2), place_of(3), place_of(4));
            }
            "glGetActiveUniformBlockiv" => write(place_of(3), Kind::I32, &[0.0]),
            // Of outputs alone.
            "glGetProgramInterfaceiv" => {
                let outputs = &self.shaders.programs.get(&name)?.outputs;
                let value = match call.int(2) as u32 {
                    c::MAX_NAME_LENGTH => longest(outputs),
                    _ => outputs.len() as f64,
                };
                write(place_of(3), Kind::I32, &[value]);
            }
            "glGetProgramResourceName" => {
                let outputs = &self.shaders.programs.get(&name)?.outputs;
                let known = outputs.get(call.int(2) as usize)?;
                put_string(&known.name, call.int(3), place_of(4), place_of(5));
            }
            get if get.starts_with("glGetUniform") && get.ends_with('v') => {
                let key = (Scope::Program(ProgramName(name)), call.int(1) as u32);
                let values = self.state.values.get(&key).cloned();
                write(
                    place_of(2),
                    Kind::of(get),
                    &values.unwrap_or_else(|| vec![0.0]),
                );
            }
            _ => return None,
        }
        Some(0)
    }

    fn program_parameter(&self, name: u32, parameter: u32) -> f64 {
        let Some(program) = self.shaders.programs.get(&name) else {
            return 0.0;
        };
        match parameter {
            c::LINK_STATUS => program.linked.into(),
            c::ATTACHED_SHADERS => program.attached.len() as f64,
            c::ACTIVE_UNIFORMS => program.uniforms.len() as f64,
            c::ACTIVE_UNIFORM_MAX_LENGTH => longest(&program.uniforms),
            c::ACTIVE_ATTRIBUTES => program.attributes.len() as f64,
            c::ACTIVE_ATTRIBUTE_MAX_LENGTH => longest(&program.attributes),
            c::ACTIVE_UNIFORM_BLOCKS => program.blocks.len() as f64,
            _ => 0.0,
        }
    }

    /// glUniform*, of which `rest` follows that: sizes, the letter of the type, and `v` where the values lie in memory.
    fn set_uniform(&mut self, rest: &str, call: &mut Call) {
        let matrix = rest.starts_with("Matrix");
        let rest = rest.trim_start_matches("Matrix").trim_end_matches("ARB");
        let digits = |text: &str| -> Vec<usize> {
            let digits = text.chars().filter_map(|sign| sign.to_digit(10));
            digits.map(|digit| digit as usize).collect()
        };
        let size = match digits(rest).as_slice() {
            [side] if matrix => side * side,
            sides => sides.iter().product(),
        };
        let values = match rest.ends_with('v') {
            true => {
                let count = call.int(1).max(0) as usize * size;
                read(address(call.args.last()), Kind::of(rest), count)
            }
            false => call.args.iter().skip(1).map(Arg::number).collect(),
        };
        let program = ProgramName(self.state.int(Scope::Context, c::CURRENT_PROGRAM));
        let first = call.int(0);
        if first >= 0 && !program.is_zero() {
            for (at, element) in (first as u32..).zip(values.chunks(size.max(1))) {
                self.put(Scope::Program(program), at, element);
            }
        }
        if rest.ends_with('v') {
            call.args.pop();
            call.args.push(Arg::Data(values));
        }
    }
}

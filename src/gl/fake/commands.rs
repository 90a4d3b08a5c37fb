//! What commands do to the state.

use super::super::api::NO_LIST;
use super::limits::{self, BUFFERS, TEXTURES, more as m};
use super::memory::{Kind, address, read};
use super::{Arg, Call, Drawn, Driver, Scope, Snapshot, model};
use crate::gl::{TextureName, consts as c};

/// A value that a command sets: its name, the first of the arguments that are it, and how many there are.
type Set = (u32, usize, usize);

/// Commands whose arguments are values of the state.
const SETS: &[(&str, &[Set])] = &[
    ("glViewport", &[(c::VIEWPORT, 0, 4)]),
    ("glScissor", &[(c::SCISSOR_BOX, 0, 4)]),
    ("glDepthRange", &[(c::DEPTH_RANGE, 0, 2)]),
    ("glDepthRangef", &[(c::DEPTH_RANGE, 0, 2)]),
    ("glDepthFunc", &[(c::DEPTH_FUNC, 0, 1)]),
    ("glDepthMask", &[(c::DEPTH_WRITEMASK, 0, 1)]),
    ("glColorMask", &[(c::COLOR_WRITEMASK, 0, 4)]),
    ("glStencilMask", &[(c::STENCIL_WRITEMASK, 0, 1)]),
    (
        "glStencilFunc",
        &[
            (m::STENCIL_FUNC, 0, 1),
            (m::STENCIL_REF, 1, 1),
            (m::STENCIL_VALUE_MASK, 2, 1),
        ],
    ),
    (
        "glStencilOp",
        &[
            (m::STENCIL_FAIL, 0, 1),
            (m::STENCIL_PASS_DEPTH_FAIL, 1, 1),
            (m::STENCIL_PASS_DEPTH_PASS, 2, 1),
        ],
    ),
    ("glBlendFunc", &[(m::BLEND_SRC, 0, 1), (m::BLEND_DST, 1, 1)]),
    ("glLogicOp", &[(m::LOGIC_OP_MODE, 0, 1)]),
    ("glClearColor", &[(m::COLOR_CLEAR_VALUE, 0, 4)]),
    ("glClearDepth", &[(c::DEPTH_CLEAR_VALUE, 0, 1)]),
    ("glClearDepthf", &[(c::DEPTH_CLEAR_VALUE, 0, 1)]),
    ("glClearStencil", &[(m::STENCIL_CLEAR_VALUE, 0, 1)]),
    ("glClearAccum", &[(c::ACCUM_CLEAR_VALUE, 0, 4)]),
    ("glLineWidth", &[(c::LINE_WIDTH, 0, 1)]),
    ("glPointSize", &[(c::POINT_SIZE, 0, 1)]),
    (
        "glPolygonOffset",
        &[
            (c::POLYGON_OFFSET_FACTOR, 0, 1),
            (c::POLYGON_OFFSET_UNITS, 1, 1),
        ],
    ),
    (
        "glPolygonOffsetClamp",
        &[
            (c::POLYGON_OFFSET_FACTOR, 0, 1),
            (c::POLYGON_OFFSET_UNITS, 1, 1),
            (c::POLYGON_OFFSET_CLAMP, 2, 1),
        ],
    ),
    ("glCullFace", &[(c::CULL_FACE_MODE, 0, 1)]),
    ("glFrontFace", &[(c::FRONT_FACE, 0, 1)]),
    ("glShadeModel", &[(c::SHADE_MODEL, 0, 1)]),
    ("glProvokingVertex", &[(c::PROVOKING_VERTEX, 0, 1)]),
    (
        "glClipControl",
        &[(c::CLIP_ORIGIN, 0, 1), (c::CLIP_DEPTH_MODE, 1, 1)],
    ),
    ("glMatrixMode", &[(c::MATRIX_MODE, 0, 1)]),
    ("glActiveTexture", &[(c::ACTIVE_TEXTURE, 0, 1)]),
    ("glClientActiveTexture", &[(c::CLIENT_ACTIVE_TEXTURE, 0, 1)]),
    ("glUseProgram", &[(c::CURRENT_PROGRAM, 0, 1)]),
    (
        "glBindProgramPipeline",
        &[(c::PROGRAM_PIPELINE_BINDING, 0, 1)],
    ),
    ("glBindVertexArray", &[(c::VERTEX_ARRAY_BINDING, 0, 1)]),
    ("glBindRenderbuffer", &[(c::RENDERBUFFER_BINDING, 1, 1)]),
    ("glReadBuffer", &[(c::READ_BUFFER, 0, 1)]),
    ("glColor4f", &[(c::CURRENT_COLOR, 0, 4)]),
    ("glNormal3f", &[(c::CURRENT_NORMAL, 0, 3)]),
    ("glSecondaryColor3f", &[(c::CURRENT_SECONDARY_COLOR, 0, 3)]),
    ("glFogCoordf", &[(c::CURRENT_FOG_COORD, 0, 1)]),
    ("glEdgeFlag", &[(c::EDGE_FLAG, 0, 1)]),
    ("glListBase", &[(c::LIST_BASE, 0, 1)]),
    ("glRenderMode", &[(c::RENDER_MODE, 0, 1)]),
    ("glNewList", &[(c::LIST_INDEX, 0, 1), (c::LIST_MODE, 1, 1)]),
    (
        "glColorMaterial",
        &[
            (c::COLOR_MATERIAL_FACE, 0, 1),
            (c::COLOR_MATERIAL_PARAMETER, 1, 1),
        ],
    ),
    ("glBeginConditionalRender", &[(m::QUERY_WAIT, 0, 1)]),
];

/// Commands whose first argument names the value, and whose second one is it.
const NAMED: &[&str] = &[
    "glPixelStorei",
    "glPixelStoref",
    "glFogi",
    "glFogf",
    "glLightModeli",
    "glPointParameterf",
    "glPatchParameteri",
];

/// Bits of glPushAttrib, with what they keep. The rest of the attributes goes with all bits only.
const GROUPS: &[(u32, &[u32])] = &[
    (
        c::CURRENT_BIT,
        &[
            c::CURRENT_COLOR,
            c::CURRENT_SECONDARY_COLOR,
            c::CURRENT_NORMAL,
            c::CURRENT_TEXTURE_COORDS,
            c::CURRENT_FOG_COORD,
            c::CURRENT_RASTER_POSITION,
            c::EDGE_FLAG,
        ],
    ),
    (
        c::LIGHTING_BIT,
        &[
            c::LIGHTING,
            c::COLOR_MATERIAL,
            c::COLOR_MATERIAL_FACE,
            c::COLOR_MATERIAL_PARAMETER,
            c::SHADE_MODEL,
        ],
    ),
];

/// What no glPushAttrib keeps.
const NO_ATTRIBUTES: &[u32] = &[
    c::CURRENT_PROGRAM,
    c::PROGRAM_PIPELINE_BINDING,
    c::VERTEX_ARRAY_BINDING,
    c::DRAW_FRAMEBUFFER_BINDING,
    c::READ_FRAMEBUFFER_BINDING,
    c::RENDERBUFFER_BINDING,
    c::SAMPLER_BINDING,
    c::CLIENT_ACTIVE_TEXTURE,
    c::CURRENT_QUERY,
    c::ATTRIB_STACK_DEPTH,
    c::MODELVIEW_MATRIX,
    c::PROJECTION_MATRIX,
    c::TEXTURE_MATRIX,
    c::MODELVIEW_STACK_DEPTH,
    c::PROJECTION_STACK_DEPTH,
    c::TEXTURE_STACK_DEPTH,
    c::LIST_INDEX,
    c::LIST_MODE,
];

fn is_attribute(key: model::Key, mask: u32) -> bool {
    let (scope, name) = key;
    let part = |&(bit, names): &(u32, &[u32])| {
        let faces = bit == c::LIGHTING_BIT && matches!(scope, Scope::Light(_) | Scope::Face(_));
        mask & bit != 0 && (faces || names.contains(&name))
    };
    let context = matches!(
        scope,
        Scope::Context | Scope::Index(_) | Scope::Unit(_) | Scope::Light(_) | Scope::Face(_)
    );
    let pixels = |first: u32| (first..first + 6).contains(&name);
    let kept = !NO_ATTRIBUTES.contains(&name)
        && BUFFERS.iter().all(|&(_, binding)| binding != name)
        && !pixels(c::PACK_SWAP_BYTES)
        && !pixels(c::UNPACK_SWAP_BYTES);
    GROUPS.iter().any(part) || mask == c::ALL_ATTRIB_BITS && context && kept
}

/// Whether a command makes pixels.
fn draws(call: &Call) -> bool {
    let name = call.name;
    if name == "glCallList" && call.int(0) == i64::from(NO_LIST) {
        return false;
    }
    let draws = name.starts_with("glDraw") && !name.starts_with("glDrawBuffer");
    let others = [
        "glClear",
        "glEnd",
        "glCallList",
        "glCallLists",
        "glBlitFramebuffer",
        "glBitmap",
    ];
    draws
        || others.contains(&name)
        || name.starts_with("glMultiDraw")
        || name.starts_with("glClearBuffer")
}

impl Driver {
    /// Records a command, does what it does to the state, and answers it.
    pub(super) fn execute(&mut self, mut call: Call) -> i64 {
        let answer = self.answer(&mut call);
        if draws(&call) {
            let state = self.snapshot();
            let call = call.clone();
            self.draws.push(Drawn { call, state });
        }
        self.calls.push(call);
        answer
    }

    fn answer(&mut self, call: &mut Call) -> i64 {
        // What is compiled into a list does nothing yet.
        let compiles = self.state.int(Scope::Context, c::LIST_MODE) == c::COMPILE;
        if compiles && !call.asks() && call.name != "glEndList" && call.name != "glGetError" {
            return 0;
        }
        if let Some(answer) = self.names(call) {
            return answer;
        }
        if let Some(answer) = self.programs(call) {
            return answer;
        }
        if let Some(answer) = self.stores(call) {
            return answer;
        }
        if let Some(answer) = self.ask(call) {
            return answer;
        }
        self.change(call);
        0
    }

    /// The state, with what every context has.
    pub(super) fn snapshot(&self) -> Snapshot {
        self.state.clone()
    }

    /// Sets a value of the context, and all of those that are counted.
    pub(super) fn set(&mut self, name: u32, values: &[f64]) {
        match limits::indices(name) {
            0 => self.put(self.state.scope(name), name, values),
            count => (0..count).for_each(|at| self.put(Scope::Index(at), name, values)),
        }
    }

    pub(super) fn put(&mut self, scope: Scope, name: u32, values: &[f64]) {
        self.state.values.insert((scope, name), values.to_vec());
    }

    fn change(&mut self, call: &mut Call) {
        let name = call.name;
        if let Some((_, sets)) = SETS.iter().find(|(known, _)| *known == name) {
            for &(value, first, count) in *sets {
                let values: Vec<f64> = (first..first + count).map(|at| call.number(at)).collect();
                self.set(value, &values);
            }
        }
        let (first, second) = (call.int(0) as u32, call.int(1) as u32);
        match name {
            _ if NAMED.contains(&name) => self.set(first, &[call.number(1)]),
            "glEnable" => self.set(first, &[1.0]),
            "glDisable" => self.set(first, &[0.0]),
            "glEnablei" => self.put(Scope::Index(second), first, &[1.0]),
            "glDisablei" => self.put(Scope::Index(second), first, &[0.0]),
            "glColorMaski" => {
                let mask: Vec<f64> = (1..5).map(|at| call.number(at)).collect();
                self.put(Scope::Index(first), c::COLOR_WRITEMASK, &mask);
            }
            "glViewportIndexedf" => {
                let place: Vec<f64> = (1..5).map(|at| call.number(at)).collect();
                self.put(Scope::Index(first), c::VIEWPORT, &place);
            }
            "glScissorIndexed" => {
                let place: Vec<f64> = (1..5).map(|at| call.number(at)).collect();
                self.put(Scope::Index(first), c::SCISSOR_BOX, &place);
            }
            "glPolygonMode" => {
                let mut modes = self.state.get(Scope::Context, c::POLYGON_MODE);
                for (face, mode) in [c::FRONT, c::BACK].into_iter().zip(&mut modes) {
                    if first == face || first == c::FRONT_AND_BACK {
                        *mode = second.into();
                    }
                }
                self.put(Scope::Context, c::POLYGON_MODE, &modes);
            }
            "glDrawBuffer" => self.draw_to(&[first.into()]),
            "glDrawBuffers" => {
                let buffers = read(
                    address(call.args.get(1)),
                    Kind::U32,
                    call.int(0).max(0) as usize,
                );
                self.draw_to(&buffers);
                call.args = vec![Arg::Data(buffers)];
            }
            "glBindTexture" => {
                if let Some(&(_, binding, _)) = TEXTURES.iter().find(|known| known.0 == first) {
                    self.bind_texture(first, second, binding);
                }
            }
            "glBindBuffer" => {
                if let Some(&(_, binding)) = BUFFERS.iter().find(|known| known.0 == first) {
                    self.create("Buffers", second);
                    self.set(binding, &[second.into()]);
                }
            }
            "glBindBufferBase" | "glBindBufferRange" if first == c::UNIFORM_BUFFER => {
                let buffer = call.number(2);
                let start = call.args.get(3).map_or(0.0, Arg::number);
                self.put(Scope::Context, c::UNIFORM_BUFFER_BINDING, &[buffer]);
                self.put(Scope::Index(second), c::UNIFORM_BUFFER_BINDING, &[buffer]);
                self.put(Scope::Index(second), c::UNIFORM_BUFFER_START, &[start]);
            }
            "glTextureView" => {
                let target = call.number(1);
                self.put(
                    Scope::Texture(TextureName(first)),
                    m::TEXTURE_TARGET,
                    &[target],
                );
            }
            "glBindSampler" => {
                self.create("Samplers", second);
                self.put(Scope::Unit(first), c::SAMPLER_BINDING, &[second.into()]);
            }
            "glBindFramebuffer" => {
                self.create("Framebuffers", second);
                for (target, binding) in [
                    (c::DRAW_FRAMEBUFFER, c::DRAW_FRAMEBUFFER_BINDING),
                    (c::READ_FRAMEBUFFER, c::READ_FRAMEBUFFER_BINDING),
                ] {
                    if [target, c::FRAMEBUFFER].contains(&first) {
                        self.put(Scope::Context, binding, &[second.into()]);
                    }
                }
            }
            "glBeginQuery" => self.put(Scope::Index(first), c::CURRENT_QUERY, &[second.into()]),
            "glEndQuery" => self.put(Scope::Index(first), c::CURRENT_QUERY, &[0.0]),
            "glEndConditionalRender" => self.put(Scope::Context, m::QUERY_WAIT, &[0.0]),
            "glEndList" => {
                self.set(c::LIST_INDEX, &[0.0]);
                self.set(c::LIST_MODE, &[0.0]);
            }
            "glMultiTexCoord4f" => {
                let unit = Scope::Unit(first.wrapping_sub(c::TEXTURE0));
                let place: Vec<f64> = (1..5).map(|at| call.number(at)).collect();
                self.put(unit, c::CURRENT_TEXTURE_COORDS, &place);
            }
            "glMaterialfv" => {
                let count = if second == c::SHININESS { 1 } else { 4 };
                let values = read(address(call.args.get(2)), Kind::F32, count);
                for face in [c::FRONT, c::BACK] {
                    if first == face || first == c::FRONT_AND_BACK {
                        self.put(Scope::Face(face), second, &values);
                    }
                }
                call.args[2] = Arg::Data(values);
            }
            "glTexEnvf" | "glTexEnvi" => {
                let unit = self.state.scope(c::SAMPLER_BINDING);
                self.put(unit, second, &[call.number(2)]);
            }
            "glBitmap" => {
                let mut place = self.state.get(Scope::Context, c::CURRENT_RASTER_POSITION);
                for (at, by) in [(0, 4), (1, 5)] {
                    place[at] += call.number(by);
                }
                self.put(Scope::Context, c::CURRENT_RASTER_POSITION, &place);
            }
            "glWindowPos2i" => {
                let place = [call.number(0), call.number(1), 0.0, 1.0];
                self.put(Scope::Context, c::CURRENT_RASTER_POSITION, &place);
            }
            _ if self.matrix(call) => {}
            "glPushAttrib" => {
                self.attributes.push((first, self.state.values.clone()));
                let depth = self.attributes.len() as f64;
                self.put(Scope::Context, c::ATTRIB_STACK_DEPTH, &[depth]);
            }
            "glPopAttrib" => {
                let Some((mask, saved)) = self.attributes.pop() else {
                    return;
                };
                let values = &mut self.state.values;
                values.retain(|key, _| !is_attribute(*key, mask));
                let kept = saved
                    .into_iter()
                    .filter(|(key, _)| is_attribute(*key, mask));
                values.extend(kept);
                let depth = self.attributes.len() as f64;
                self.put(Scope::Context, c::ATTRIB_STACK_DEPTH, &[depth]);
            }
            _ => {}
        }
    }

    /// A texture keeps the target that it is first bound at.
    fn bind_texture(&mut self, target: u32, name: u32, binding: u32) {
        self.create("Textures", name);
        let own = (Scope::Texture(TextureName(name)), m::TEXTURE_TARGET);
        if name != 0
            && *self.state.values.entry(own).or_insert(vec![target.into()]) != [f64::from(target)]
        {
            return self.errors.push_back(c::INVALID_OPERATION);
        }
        self.set(binding, &[name.into()]);
    }

    fn draw_to(&mut self, buffers: &[f64]) {
        let drawn = self.state.scope(c::DRAW_BUFFER);
        for at in 0..8 {
            let buffer = buffers.get(at as usize).copied().unwrap_or(c::NONE.into());
            self.put(drawn, c::DRAW_BUFFER0 + at, &[buffer]);
        }
        let first = buffers.first().copied().unwrap_or(c::NONE.into());
        self.put(drawn, c::DRAW_BUFFER, &[first]);
    }

    /// Commands on the current matrix and its stack; false for others.
    fn matrix(&mut self, call: &mut Call) -> bool {
        let mode = self.state.int(Scope::Context, c::MATRIX_MODE);
        let (top, depth) = match mode {
            c::PROJECTION => (c::PROJECTION_MATRIX, c::PROJECTION_STACK_DEPTH),
            c::TEXTURE => (c::TEXTURE_MATRIX, c::TEXTURE_STACK_DEPTH),
            _ => (c::MODELVIEW_MATRIX, c::MODELVIEW_STACK_DEPTH),
        };
        let stack = self.matrices.entry(mode).or_default();
        match call.name {
            "glLoadIdentity" => self.set(top, &limits::default(top).unwrap_or_default()),
            "glLoadMatrixf" | "glLoadMatrixd" => {
                let kind = match call.name {
                    "glLoadMatrixf" => Kind::F32,
                    _ => Kind::F64,
                };
                let matrix = read(address(call.args.first()), kind, 16);
                self.set(top, &matrix);
                call.args = vec![Arg::Data(matrix)];
            }
            "glPushMatrix" => {
                stack.push(self.state.value(top));
                let deep = stack.len() as f64 + 1.0;
                self.set(depth, &[deep]);
            }
            "glPopMatrix" => {
                if let Some(matrix) = stack.pop() {
                    let deep = stack.len() as f64 + 1.0;
                    self.set(top, &matrix);
                    self.set(depth, &[deep]);
                }
            }
            _ => return false,
        }
        true
    }
}

//! Commands that display lists compile: what each changes. Called after the driver's own, with the same arguments.
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::Shadow;
use super::change::Change;
use super::key::Key;
use super::matrices::Operation;
use super::rectangles::INDICES;
use super::values::{floats, one, read};
use crate::gl::bindings::texture_binding;
use crate::gl::consts as c;
use crate::gl::list_names::list_names;
use crate::gl::real::Ptr;

macro_rules! changes {
    ($($name:ident($($arg:ident: $kind:ty),*) = $change:expr;)*) => {$(
        pub(in crate::gl) unsafe fn $name(&mut self, $($arg: $kind),*) {
            self.change($change);
        }
    )*};
}

impl Shadow {
    changes! {
        glBegin(mode: u32) = Change::Begin(mode);
        glEnd() = Change::End;
        glEnable(cap: u32) = Change::Enable(cap, true);
        glDisable(cap: u32) = Change::Enable(cap, false);
        glEnablei(cap: u32, index: u32) = Change::EnableAt(cap, index, true);
        glDisablei(cap: u32, index: u32) = Change::EnableAt(cap, index, false);
        glDepthMask(mask: u8) = Change::Put(Key::Value(c::DEPTH_WRITEMASK), one((mask != 0).into()));
        glDepthFunc(func: u32) = Change::Put(
            Key::Value(c::DEPTH_FUNC),
            one(func).filter(|_| (c::NEVER..=c::ALWAYS).contains(&func))
        );
        glClearAccum(r: f32, g: f32, b: f32, a: f32) = Change::Put(
            Key::Value(c::ACCUM_CLEAR_VALUE),
            floats([r, g, b, a].map(|v| v.clamp(-1.0, 1.0)))
        );
        glColorMask(r: u8, g: u8, b: u8, a: u8) = Change::ColorMask([r, g, b, a].map(|v| (v != 0).into()));
        glStencilMask(mask: u32) = Change::Put(Key::Value(c::STENCIL_WRITEMASK), one(mask));
        glStencilMaskSeparate(_face: u32, _mask: u32) = Change::Put(Key::Value(c::STENCIL_WRITEMASK), None);
        glActiveStencilFaceEXT(_face: u32) = Change::Put(Key::Value(c::STENCIL_WRITEMASK), None);
        glActiveTexture(texture: u32) = Change::ActiveTexture(texture);
        glShadeModel(mode: u32) = Change::Put(
            Key::Value(c::SHADE_MODEL),
            one(mode).filter(|_| [c::FLAT, c::SMOOTH].contains(&mode))
        );
        glProvokingVertex(mode: u32) = Change::Put(
            Key::Value(c::PROVOKING_VERTEX),
            one(mode).filter(|_| [c::FIRST_VERTEX_CONVENTION, c::LAST_VERTEX_CONVENTION].contains(&mode))
        );
        glCullFace(mode: u32) = Change::Put(
            Key::Value(c::CULL_FACE_MODE),
            one(mode).filter(|_| [c::FRONT, c::BACK, c::FRONT_AND_BACK].contains(&mode))
        );
        glFrontFace(mode: u32) = Change::Put(
            Key::Value(c::FRONT_FACE),
            one(mode).filter(|_| [c::CW, c::CCW].contains(&mode))
        );
        glListBase(base: u32) = Change::Put(Key::Value(c::LIST_BASE), one(base));
        glClampColor(target: u32, _clamp: u32) = Change::Put(Key::Value(target), None);
        glUseProgram(program: u32) = Change::Bind(Key::Value(c::CURRENT_PROGRAM), program);
        glMatrixMode(mode: u32) = Change::MatrixMode(mode);
        glPushMatrix() = Change::PushMatrix;
        glPopMatrix() = Change::PopMatrix;
        glLoadIdentity() = Change::Matrix(Operation::Identity);
        glTranslatef(x: f32, y: f32, z: f32) = Change::Matrix(Operation::Translate([x, y, z]));
        glTranslated(x: f64, y: f64, z: f64) = Change::Matrix(Operation::Translate([x, y, z].map(|v| v as f32)));
        glScalef(x: f32, y: f32, z: f32) = Change::Matrix(Operation::Scale([x, y, z]));
        glScaled(x: f64, y: f64, z: f64) = Change::Matrix(Operation::Scale([x, y, z].map(|v| v as f32)));
        glRotatef(angle: f32, x: f32, y: f32, z: f32) = Change::Matrix(Operation::Rotate([angle, x, y, z]));
        glRotated(angle: f64, x: f64, y: f64, z: f64) = Change::Matrix(Operation::Rotate([angle, x, y, z].map(|v| v as f32)));
        glPushAttrib(mask: u32) = Change::PushAttrib(mask);
        glPopAttrib() = Change::PopAttrib;
        glCallList(list: u32) = Change::CallList(list);
    }

    pub(in crate::gl) unsafe fn glViewport(&mut self, x: i32, y: i32, width: i32, height: i32) {
        if width < 0 || height < 0 {
            return;
        }
        // The driver may cut what is beyond its limits.
        let within = [x, y].iter().all(|v| v.abs() <= 4096) && width.max(height) <= 8192;
        let value = within.then_some([x, y, width, height].map(|v| v as u32));
        self.change(Change::Put(Key::Value(c::VIEWPORT), value));
        if value.is_none() {
            (0..INDICES).for_each(|at| self.change(Change::Put(Key::At(c::VIEWPORT, at), None)));
        }
    }

    pub(in crate::gl) unsafe fn glScissor(&mut self, x: i32, y: i32, width: i32, height: i32) {
        if width >= 0 && height >= 0 {
            let value = [x, y, width, height].map(|v| v as u32);
            self.change(Change::Put(Key::Value(c::SCISSOR_BOX), Some(value)));
        }
    }

    pub(in crate::gl) unsafe fn glDepthRange(&mut self, n: f64, f: f64) {
        let value = floats([n, f].map(|v| v.clamp(0.0, 1.0) as f32));
        self.change(Change::Put(Key::Value(c::DEPTH_RANGE), value));
    }

    pub(in crate::gl) unsafe fn glDepthRangef(&mut self, n: f32, f: f32) {
        // SAFETY: no pointers.
        unsafe { self.glDepthRange(n.into(), f.into()) };
    }

    pub(in crate::gl) unsafe fn glClearDepth(&mut self, depth: f64) {
        let value = floats([depth.clamp(0.0, 1.0) as f32]);
        self.change(Change::Put(Key::Value(c::DEPTH_CLEAR_VALUE), value));
    }

    pub(in crate::gl) unsafe fn glClearDepthf(&mut self, d: f32) {
        // SAFETY: no pointers.
        unsafe { self.glClearDepth(d.into()) };
    }

    pub(in crate::gl) unsafe fn glPolygonMode(&mut self, face: u32, mode: u32) {
        let known = face == c::FRONT_AND_BACK && [c::POINT, c::LINE, c::FILL].contains(&mode);
        let value = known.then_some([mode, mode, 0, 0]);
        self.change(Change::Put(Key::Value(c::POLYGON_MODE), value));
    }

    pub(in crate::gl) unsafe fn glColorMaski(&mut self, index: u32, r: u8, g: u8, b: u8, a: u8) {
        let mask = [r, g, b, a].map(|v| (v != 0).into());
        self.change(Change::Put(Key::At(c::COLOR_WRITEMASK, index), Some(mask)));
        if index == 0 {
            self.change(Change::Put(Key::Value(c::COLOR_WRITEMASK), Some(mask)));
        }
        if self.compiling.is_some() {
            // Mesa 22.3 does not execute it while it compiles it.
            self.put(Key::At(c::COLOR_WRITEMASK, index), None);
            self.put(Key::Value(c::COLOR_WRITEMASK), None);
        }
    }

    pub(in crate::gl) unsafe fn glClipControl(&mut self, origin: u32, depth: u32) {
        let known = [c::LOWER_LEFT, c::UPPER_LEFT].contains(&origin)
            && [c::ZERO_TO_ONE, c::NEGATIVE_ONE_TO_ONE].contains(&depth);
        for (name, value) in [(c::CLIP_DEPTH_MODE, depth), (c::CLIP_ORIGIN, origin)] {
            let value = one(value).filter(|_| known);
            self.change(Change::Put(Key::Value(name), value));
        }
    }

    pub(in crate::gl) unsafe fn glLineWidth(&mut self, width: f32) {
        // A core profile may refuse wide lines.
        let value = floats([width]).filter(|_| width == 1.0);
        self.change(Change::Put(Key::Value(c::LINE_WIDTH), value));
    }

    pub(in crate::gl) unsafe fn glPointSize(&mut self, size: f32) {
        let value = floats([size]).filter(|_| size > 0.0);
        self.change(Change::Put(Key::Value(c::POINT_SIZE), value));
    }

    pub(in crate::gl) unsafe fn glPointParameterfv(&mut self, pname: u32, params: Ptr) {
        if pname != c::POINT_DISTANCE_ATTENUATION {
            // SAFETY: one value has this name.
            let param = unsafe { read::<f32, 1>(params) };
            return self.point_parameter(pname, param.map(|[param]| param));
        }
        // SAFETY: three values have this name.
        let value = unsafe { read::<f32, 3>(params) }.and_then(floats);
        self.change(Change::Put(Key::Value(pname), value));
    }

    pub(in crate::gl) unsafe fn glPointParameterf(&mut self, pname: u32, param: f32) {
        self.point_parameter(pname, Some(param));
    }

    pub(in crate::gl) unsafe fn glPointParameteri(&mut self, pname: u32, param: i32) {
        let origin = pname == c::POINT_SPRITE_COORD_ORIGIN;
        self.point_parameter(pname, origin.then_some(param as f32));
    }

    pub(in crate::gl) unsafe fn glPointParameteriv(&mut self, pname: u32, _params: Ptr) {
        self.point_parameter(pname, None);
    }

    /// Sets a parameter of one value, or one that is not known.
    fn point_parameter(&mut self, pname: u32, param: Option<f32>) {
        let value = match pname {
            // A name as a number, which floats hold.
            c::POINT_SPRITE_COORD_ORIGIN => param
                .map(|param| param as u32)
                .filter(|origin| [c::LOWER_LEFT, c::UPPER_LEFT].contains(origin))
                .and_then(one),
            _ => param
                .filter(|param| *param >= 0.0)
                .and_then(|param| floats([param])),
        };
        self.change(Change::Put(Key::Value(pname), value));
    }

    pub(in crate::gl) unsafe fn glBindTexture(&mut self, target: u32, texture: u32) {
        if let Some(binding) = texture_binding(target) {
            self.change(Change::BindTexture(binding, texture));
        }
    }

    pub(in crate::gl) unsafe fn glCallLists(&mut self, n: i32, kind: u32, lists: Ptr) {
        // SAFETY: the program's array.
        let Some(names) = (unsafe { list_names(n, kind, lists) }) else {
            return self.change(Change::ForgetAll);
        };
        if self.values.known(Key::Value(c::LIST_BASE)).is_none() {
            let base = self.integer(c::LIST_BASE);
            self.answered(Key::Value(c::LIST_BASE), [base, 0, 0, 0]);
        }
        self.change(Change::CallLists(names.into()));
    }
}

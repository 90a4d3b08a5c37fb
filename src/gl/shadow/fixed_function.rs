//! Commands of fixed function: lights, materials, fog, texture environments, matrices.
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::Shadow;
use super::change::Change;
use super::key::Key;
use super::matrices::{Mode, Operation};
use super::values::{enumerant, floats, one, read};
use crate::gl::consts as c;
use crate::gl::real::Ptr;

impl Shadow {
    pub(in crate::gl) unsafe fn glColorMaterial(&mut self, face: u32, mode: u32) {
        let known = [c::FRONT, c::BACK, c::FRONT_AND_BACK].contains(&face)
            && [
                c::EMISSION,
                c::AMBIENT,
                c::DIFFUSE,
                c::SPECULAR,
                c::AMBIENT_AND_DIFFUSE,
            ]
            .contains(&mode);
        self.change(Change::ColorMaterial(known.then_some([face, mode])));
    }

    pub(in crate::gl) unsafe fn glFogi(&mut self, pname: u32, param: i32) {
        self.change(Change::Put(
            Key::Value(pname),
            enumerant(pname, param as u32),
        ));
    }

    pub(in crate::gl) unsafe fn glFogf(&mut self, pname: u32, param: f32) {
        self.change(Change::Put(
            Key::Value(pname),
            enumerant(pname, param as u32),
        ));
    }

    pub(in crate::gl) unsafe fn glFogfv(&mut self, pname: u32, _params: Ptr) {
        self.change(Change::Put(Key::Value(pname), None));
    }

    pub(in crate::gl) unsafe fn glFogiv(&mut self, pname: u32, _params: Ptr) {
        self.change(Change::Put(Key::Value(pname), None));
    }

    pub(in crate::gl) unsafe fn glLightModeli(&mut self, pname: u32, param: i32) {
        let value = match pname {
            c::LIGHT_MODEL_COLOR_CONTROL => enumerant(pname, param as u32),
            _ => one((param != 0).into()),
        };
        self.change(Change::Put(Key::Value(pname), value));
    }

    pub(in crate::gl) unsafe fn glLightModelf(&mut self, pname: u32, param: f32) {
        // SAFETY: no pointers.
        unsafe { self.glLightModeli(pname, param as i32) };
    }

    pub(in crate::gl) unsafe fn glLightModeliv(&mut self, pname: u32, _params: Ptr) {
        self.change(Change::Put(Key::Value(pname), None));
    }

    pub(in crate::gl) unsafe fn glLightModelfv(&mut self, pname: u32, _params: Ptr) {
        self.change(Change::Put(Key::Value(pname), None));
    }

    pub(in crate::gl) unsafe fn glLightf(&mut self, light: u32, pname: u32, param: f32) {
        let fits = match pname {
            c::SPOT_CUTOFF => (0.0..=90.0).contains(&param) || param == 180.0,
            _ => param >= 0.0,
        };
        let value = floats([param]).filter(|_| fits);
        self.change(Change::Put(Key::Light(light, pname), value));
    }

    pub(in crate::gl) unsafe fn glLighti(&mut self, light: u32, pname: u32, param: i32) {
        // SAFETY: no pointers.
        unsafe { self.glLightf(light, pname, param as f32) };
    }

    pub(in crate::gl) unsafe fn glLightfv(&mut self, light: u32, pname: u32, params: Ptr) {
        match pname {
            c::POSITION => {
                // A modelview matrix without perspective leaves w as it is. Where it has one, or is not known, the driver is asked.
                // SAFETY: a position has four values.
                let w = unsafe { read::<f32, 4>(params) }.map(|[.., w]| w);
                let value = w.filter(|_| self.modelview_is_affine());
                let value = value.and_then(|w| floats([0.0, 0.0, 0.0, w]));
                self.change(Change::Put(Key::Light(light, pname), value));
            }
            c::SPOT_CUTOFF
            | c::CONSTANT_ATTENUATION
            | c::LINEAR_ATTENUATION
            | c::QUADRATIC_ATTENUATION => {
                // SAFETY: one value.
                match unsafe { read::<f32, 1>(params) } {
                    // SAFETY: no pointers.
                    Some([value]) => unsafe { self.glLightf(light, pname, value) },
                    None => self.change(Change::Put(Key::Light(light, pname), None)),
                }
            }
            _ => self.change(Change::Put(Key::Light(light, pname), None)),
        }
    }

    pub(in crate::gl) unsafe fn glLightiv(&mut self, light: u32, pname: u32, _params: Ptr) {
        self.change(Change::Put(Key::Light(light, pname), None));
    }

    /// Whether the modelview matrix leaves w as it is, now and not only when a list is called.
    fn modelview_is_affine(&mut self) -> bool {
        let top = self.matrices.top(Mode::Modelview, None);
        self.compiling.is_none()
            && top.is_some_and(|top| {
                let m = top.numbers;
                [m[3], m[7], m[11], m[15]] == [0.0, 0.0, 0.0, 1.0]
            })
    }

    pub(in crate::gl) unsafe fn glMaterialfv(&mut self, face: u32, pname: u32, params: Ptr) {
        let value = match pname {
            // SAFETY: one value has this name, three the next, and four the others.
            c::SHININESS => unsafe { read::<f32, 1>(params) }
                .filter(|[v]| (0.0..=128.0).contains(v))
                .and_then(floats),
            c::COLOR_INDEXES => return,
            // SAFETY: as above.
            _ => unsafe { read::<f32, 4>(params) }.and_then(floats),
        };
        self.set_material(face, pname, value);
    }

    pub(in crate::gl) unsafe fn glMaterialf(&mut self, face: u32, pname: u32, param: f32) {
        let value = floats([param]).filter(|_| (0.0..=128.0).contains(&param));
        self.set_material(face, pname, value);
    }

    pub(in crate::gl) unsafe fn glMateriali(&mut self, face: u32, pname: u32, param: i32) {
        // SAFETY: no pointers.
        unsafe { self.glMaterialf(face, pname, param as f32) };
    }

    pub(in crate::gl) unsafe fn glMaterialiv(&mut self, face: u32, pname: u32, _params: Ptr) {
        self.set_material(face, pname, None);
    }

    fn set_material(&mut self, face: u32, pname: u32, value: Option<[u32; 4]>) {
        let faces: &[u32] = match face {
            c::FRONT => &[c::FRONT],
            c::BACK => &[c::BACK],
            _ => &[c::FRONT, c::BACK],
        };
        let value = value.filter(|_| [c::FRONT, c::BACK, c::FRONT_AND_BACK].contains(&face));
        let names: &[u32] = match pname {
            c::AMBIENT_AND_DIFFUSE => &[c::AMBIENT, c::DIFFUSE],
            ref other => std::slice::from_ref(other),
        };
        for &face in faces {
            for &name in names {
                self.change(Change::Put(Key::Material(face, name), value));
            }
        }
    }

    pub(in crate::gl) unsafe fn glTexEnvi(&mut self, target: u32, pname: u32, param: i32) {
        if target == c::TEXTURE_ENV {
            let value = enumerant(pname, param as u32);
            self.change(Change::PutUnit(Key::TexEnv, pname, value));
        }
    }

    pub(in crate::gl) unsafe fn glTexEnvf(&mut self, target: u32, pname: u32, param: f32) {
        // SAFETY: no pointers.
        unsafe { self.glTexEnvi(target, pname, param as i32) };
    }

    pub(in crate::gl) unsafe fn glTexEnviv(&mut self, target: u32, pname: u32, _params: Ptr) {
        if target == c::TEXTURE_ENV {
            self.change(Change::PutUnit(Key::TexEnv, pname, None));
        }
    }

    pub(in crate::gl) unsafe fn glTexEnvfv(&mut self, target: u32, pname: u32, params: Ptr) {
        // SAFETY: forwarded.
        unsafe { self.glTexEnviv(target, pname, params) };
    }

    pub(in crate::gl) unsafe fn glTexGeni(&mut self, coord: u32, pname: u32, param: i32) {
        if pname == c::TEXTURE_GEN_MODE {
            // Coordinates have different modes.
            let value = enumerant(pname, param as u32)
                .filter(|_| {
                    [c::OBJECT_LINEAR as i32, c::EYE_LINEAR as i32].contains(&param)
                        || coord != c::S + 3
                })
                .filter(|_| param != c::SPHERE_MAP as i32 || coord <= c::S + 1);
            self.change(Change::PutUnit(Key::TexGen, coord, value));
        }
    }

    pub(in crate::gl) unsafe fn glTexGenf(&mut self, coord: u32, pname: u32, param: f32) {
        // SAFETY: no pointers.
        unsafe { self.glTexGeni(coord, pname, param as i32) };
    }

    pub(in crate::gl) unsafe fn glTexGend(&mut self, coord: u32, pname: u32, param: f64) {
        // SAFETY: no pointers.
        unsafe { self.glTexGeni(coord, pname, param as i32) };
    }

    pub(in crate::gl) unsafe fn glTexGeniv(&mut self, coord: u32, pname: u32, _params: Ptr) {
        if pname == c::TEXTURE_GEN_MODE {
            self.change(Change::PutUnit(Key::TexGen, coord, None));
        }
    }

    pub(in crate::gl) unsafe fn glTexGenfv(&mut self, coord: u32, pname: u32, params: Ptr) {
        // SAFETY: forwarded.
        unsafe { self.glTexGeniv(coord, pname, params) };
    }

    pub(in crate::gl) unsafe fn glTexGendv(&mut self, coord: u32, pname: u32, params: Ptr) {
        // SAFETY: forwarded.
        unsafe { self.glTexGeniv(coord, pname, params) };
    }

    pub(in crate::gl) unsafe fn glLoadMatrixf(&mut self, m: Ptr) {
        // SAFETY: a matrix.
        if let Some(m) = unsafe { read::<f32, 16>(m) } {
            self.change(Change::Matrix(Operation::Load(m)));
        }
    }

    pub(in crate::gl) unsafe fn glLoadMatrixd(&mut self, m: Ptr) {
        // SAFETY: a matrix.
        if let Some(m) = unsafe { read::<f64, 16>(m) } {
            let m = m.map(|v| v as f32);
            self.change(Change::Matrix(Operation::Load(m)));
        }
    }

    pub(in crate::gl) unsafe fn glMultMatrixf(&mut self, m: Ptr) {
        // SAFETY: a matrix.
        if let Some(m) = unsafe { read::<f32, 16>(m) } {
            self.change(Change::Matrix(Operation::Multiply(m)));
        }
    }

    pub(in crate::gl) unsafe fn glMultMatrixd(&mut self, m: Ptr) {
        // SAFETY: a matrix.
        if let Some(m) = unsafe { read::<f64, 16>(m) } {
            let m = m.map(|v| v as f32);
            self.change(Change::Matrix(Operation::Multiply(m)));
        }
    }

    pub(in crate::gl) unsafe fn glLoadTransposeMatrixf(&mut self, m: Ptr) {
        // SAFETY: a matrix.
        if let Some(m) = unsafe { read::<f32, 16>(m) } {
            let m = std::array::from_fn(|at| m[at % 4 * 4 + at / 4]);
            self.change(Change::Matrix(Operation::Load(m)));
        }
    }

    pub(in crate::gl) unsafe fn glLoadTransposeMatrixd(&mut self, m: Ptr) {
        // SAFETY: a matrix.
        if let Some(m) = unsafe { read::<f64, 16>(m) } {
            let m = std::array::from_fn(|at| m[at % 4 * 4 + at / 4] as f32);
            self.change(Change::Matrix(Operation::Load(m)));
        }
    }

    pub(in crate::gl) unsafe fn glMultTransposeMatrixf(&mut self, m: Ptr) {
        // SAFETY: a matrix.
        if let Some(m) = unsafe { read::<f32, 16>(m) } {
            let m = std::array::from_fn(|at| m[at % 4 * 4 + at / 4]);
            self.change(Change::Matrix(Operation::Multiply(m)));
        }
    }

    pub(in crate::gl) unsafe fn glMultTransposeMatrixd(&mut self, m: Ptr) {
        // SAFETY: a matrix.
        if let Some(m) = unsafe { read::<f64, 16>(m) } {
            let m = std::array::from_fn(|at| m[at % 4 * 4 + at / 4] as f32);
            self.change(Change::Matrix(Operation::Multiply(m)));
        }
    }

    pub(in crate::gl) unsafe fn glFrustum(
        &mut self,
        l: f64,
        r: f64,
        b: f64,
        t: f64,
        n: f64,
        f: f64,
    ) {
        if n > 0.0 && f > 0.0 && n != f && l != r && b != t {
            let sides = [l, r, b, t, n, f].map(|v| v as f32);
            self.change(Change::Matrix(Operation::Frustum(sides)));
        }
    }

    pub(in crate::gl) unsafe fn glOrtho(&mut self, l: f64, r: f64, b: f64, t: f64, n: f64, f: f64) {
        if n != f && l != r && b != t {
            let sides = [l, r, b, t, n, f].map(|v| v as f32);
            self.change(Change::Matrix(Operation::Ortho(sides)));
        }
    }
}

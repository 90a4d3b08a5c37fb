//! The material while it follows the colour (GL_COLOR_MATERIAL).
//!
//! Of commands that set the colour one by one, each followed parameter has the colour at once (OpenGL 4.6 compatibility profile, 12.2.3). After
//! lists and glPopAttrib only the driver knows it: Mesa 22.3 takes the first colour of a list, and none that is restored.

use super::Shadow;
use super::change::COLOURS;
use super::key::{self, COLOR, Key};
use crate::gl::consts as c;

impl Shadow {
    /// GL_COLOR_MATERIAL is switched; `before`: whether it was on, where that is known.
    pub(super) fn color_material(&mut self, before: Option<bool>, on: bool) {
        match (before, on) {
            (Some(false), false) | (Some(true), true) => {}
            (Some(false), true) => {
                self.forget_followers();
                self.followers_have_colour = true;
            }
            (Some(true), false) if self.followers_have_colour => {
                let colour = self.values.known(COLOR);
                self.set_followers(colour);
            }
            _ => {
                self.forget_followers();
                self.followers_have_colour = false;
            }
        }
    }

    /// A command has set a value of its own, which may be the colour.
    pub(super) fn colour_may_be_set(&mut self, key: Key) {
        self.followers_have_colour |= key == COLOR;
    }

    /// A command sets a parameter of the material, which has no effect on one that follows the colour.
    pub(super) fn material(&mut self, face: u32, name: u32, value: Option<[u32; 4]>) {
        let off = self.values.known(Key::Cap(c::COLOR_MATERIAL)) == Some([0; 4]);
        let parameter = self.values.known(Key::Value(c::COLOR_MATERIAL_PARAMETER));
        let free = parameter.is_some_and(|[parameter, ..]| !key::drives(parameter, name));
        let sure = off || free || name == c::SHININESS;
        self.put(Key::Material(face, name), value.filter(|_| sure));
    }

    /// Forgets the parameters of the material that follow the colour while GL_COLOR_MATERIAL is on.
    pub(super) fn forget_followers(&mut self) {
        self.set_followers(None);
    }

    fn set_followers(&mut self, colour: Option<[u32; 4]>) {
        let [followed, parameter] =
            [c::COLOR_MATERIAL_FACE, c::COLOR_MATERIAL_PARAMETER].map(|name| {
                let known = self.values.known(Key::Value(name));
                let [value, ..] = known.unwrap_or_else(|| {
                    let value = [self.integer(name), 0, 0, 0];
                    self.answered(Key::Value(name), value);
                    value
                });
                value
            });
        for face in [c::FRONT, c::BACK] {
            for name in COLOURS {
                if [face, c::FRONT_AND_BACK].contains(&followed) && key::drives(parameter, name) {
                    self.put(Key::Material(face, name), colour);
                }
            }
        }
    }

    pub(super) fn forget_followers_if_any(&mut self) {
        if self.values.known(Key::Cap(c::COLOR_MATERIAL)) != Some([0; 4]) {
            self.forget_followers();
        }
    }
}

//! The material while it follows the colour (GL_COLOR_MATERIAL).
//!
//! Of commands that set the colour one by one, each followed parameter has the colour at once (OpenGL 4.6 compatibility profile, 12.2.3). After
//! lists and glPopAttrib only the driver knows it: in Mesa 22.3 followed parameters have the first colour of a list, or what glMaterial sets
//! in it, and no colour that is restored.

use super::Shadow;
use super::key::{self, COLOR, Key};
use crate::gl::consts as c;

/// Parameters of a material that may follow the colour.
const COLOURS: [u32; 4] = [c::AMBIENT, c::DIFFUSE, c::SPECULAR, c::EMISSION];
/// Which of them do.
const SETTINGS: [u32; 2] = [c::COLOR_MATERIAL_FACE, c::COLOR_MATERIAL_PARAMETER];

impl Shadow {
    /// GL_COLOR_MATERIAL is switched; `before`: whether it was on, where that is known.
    pub(super) fn switch_color_material(&mut self, before: Option<bool>, on: bool) {
        match (before, on) {
            (Some(false), false) | (Some(true), true) => {}
            (Some(false), true) => {
                self.set_followers(None);
                self.followers_have_colour = true;
            }
            (Some(true), false) if self.followers_have_colour => {
                let colour = self.values.known(COLOR);
                self.set_followers(colour);
            }
            _ => {
                self.set_followers(None);
                self.followers_have_colour = false;
            }
        }
    }

    /// glColorMaterial; none where its arguments may be wrong.
    pub(super) fn set_color_material(&mut self, settings: Option<[u32; 2]>) {
        for (at, name) in SETTINGS.into_iter().enumerate() {
            let value = settings.map(|settings| [settings[at], 0, 0, 0]);
            self.put(Key::Value(name), value);
        }
        if self.values.known(Key::Cap(c::COLOR_MATERIAL)) != Some([0; 4]) {
            // They follow from now on. Those that have followed until now are unknown already.
            self.set_followers(None);
        }
    }

    /// A command sets a parameter of the material, without effect where it follows the colour.
    pub(super) fn put_material(&mut self, face: u32, name: u32, value: Option<[u32; 4]>) {
        let off = self.values.known(Key::Cap(c::COLOR_MATERIAL)) == Some([0; 4]);
        let settings = SETTINGS.map(|name| self.values.known(Key::Value(name)));
        let follows = match settings {
            [Some([faces, ..]), Some([parameter, ..])] => {
                key::drives([faces, parameter], face, name)
            }
            _ => COLOURS.contains(&name),
        };
        self.put(Key::Material(face, name), value.filter(|_| off || !follows));
    }

    /// A command has set a current value of its own: where that is the colour, the followers have it.
    pub(super) fn current_is_set(&mut self, key: Key) {
        self.followers_have_colour |= key == COLOR;
    }

    /// Only the driver knows what follows the colour, if something does.
    pub(super) fn forget_followers(&mut self) {
        self.followers_have_colour = false;
        if self.values.known(Key::Cap(c::COLOR_MATERIAL)) != Some([0; 4]) {
            self.set_followers(None);
        }
    }

    /// Asks for the settings that are not known.
    pub(super) fn set_followers(&mut self, colour: Option<[u32; 4]>) {
        let settings = SETTINGS.map(|name| {
            let known = self.values.known(Key::Value(name));
            let value = known.unwrap_or_else(|| {
                let value = [self.integer(name), 0, 0, 0];
                self.answered(Key::Value(name), value);
                value
            });
            value[0]
        });
        for face in [c::FRONT, c::BACK] {
            for name in COLOURS {
                if key::drives(settings, face, name) {
                    self.put(Key::Material(face, name), colour);
                }
            }
        }
    }

    pub(super) fn forget_material(&mut self) {
        for face in [c::FRONT, c::BACK] {
            for name in COLOURS.into_iter().chain([c::SHININESS]) {
                self.put(Key::Material(face, name), None);
            }
        }
    }
}

//! The arrays of generic attributes: which are on, and which advance by instances. Both belong to the vertex array object that is bound.
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::Shadow;
use super::key::Key;
use crate::gl::consts as c;

impl Shadow {
    /// A command changes attributes of a vertex array object that it names.
    pub(in crate::gl) unsafe fn attributes_by_name(&mut self) {
        self.forget_attributes();
    }

    /// A command gives attributes to binding points. Commands that are not followed take attributes back from there, so from now on only the driver
    /// knows which advance by instances.
    pub(in crate::gl) unsafe fn binding_points(&mut self) {
        self.binding_points = true;
        self.forget_attributes();
    }

    pub(in crate::gl) unsafe fn glEnableVertexAttribArray(&mut self, index: u32) {
        self.attribute_on();
        self.set_attribute(c::VERTEX_ATTRIB_ARRAY_ENABLED, index, true);
    }

    pub(in crate::gl) unsafe fn glDisableVertexAttribArray(&mut self, index: u32) {
        self.set_attribute(c::VERTEX_ATTRIB_ARRAY_ENABLED, index, false);
    }

    pub(in crate::gl) unsafe fn glVertexAttribDivisor(&mut self, index: u32, divisor: u32) {
        self.set_attribute(c::VERTEX_ATTRIB_ARRAY_DIVISOR, index, divisor != 0);
    }

    pub(super) fn forget_attributes(&mut self) {
        let keys = self.values.iter().map(|(key, _)| key);
        let keys = keys.filter(|key| matches!(key, Key::Attributes(..)));
        let keys: Vec<Key> = keys.collect();
        keys.into_iter().for_each(|key| self.put(key, None));
    }

    /// Sets the bit of an attribute, in the vertex array object that is bound.
    fn set_attribute(&mut self, name: u32, index: u32, on: bool) {
        let array = self.values.known(Key::Value(c::VERTEX_ARRAY_BINDING));
        let Some([array, ..]) = array.filter(|_| !self.inside) else {
            return self.forget_attributes();
        };
        let key = Key::Attributes(name, array);
        // An attribute that the driver does not have is refused.
        if let Some([bits, ..]) = self.values.known(key)
            && index < self.constant(c::MAX_VERTEX_ATTRIBS).min(u32::BITS)
        {
            let bit = 1 << index;
            let bits = if on { bits | bit } else { bits & !bit };
            self.put(key, Some([bits, 0, 0, 0]));
        }
    }
}

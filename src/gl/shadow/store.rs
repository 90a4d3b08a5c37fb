//! The values of a context, by their keys. Those that each draw of each view sets have places of their own.

use super::Entry;
use super::key::Key;
use crate::gl::consts as c;
use rustc_hash::FxHashMap;

/// Values with places of their own.
const PLACES: usize = 19;

/// What is kept of all values.
#[derive(Debug, Default)]
pub(super) struct Store {
    placed: [Option<Entry>; PLACES],
    others: FxHashMap<Key, Entry>,
}

/// The place of a value that has one.
#[inline]
fn place(key: Key) -> Option<usize> {
    Some(match key {
        Key::Value(c::VIEWPORT) => 0,
        Key::Value(c::SCISSOR_BOX) => 1,
        Key::Value(c::DEPTH_RANGE) => 2,
        Key::Value(c::DEPTH_WRITEMASK) => 3,
        Key::Value(c::DEPTH_FUNC) => 4,
        Key::Value(c::COLOR_WRITEMASK) => 5,
        Key::Value(c::ACTIVE_TEXTURE) => 6,
        Key::Value(c::CURRENT_PROGRAM) => 7,
        Key::Value(c::VERTEX_ARRAY_BINDING) => 8,
        Key::Cap(c::SCISSOR_TEST) => 9,
        Key::Cap(c::DEPTH_TEST) => 10,
        Key::Cap(c::BLEND) => 11,
        Key::Cap(c::LIGHTING) => 12,
        Key::Cap(c::COLOR_MATERIAL) => 13,
        Key::Unit(c::TEXTURE_BINDING_2D, 0) => 14,
        Key::UnitCap(c::TEXTURE_2D, 0) => 15,
        Key::Value(c::CURRENT_COLOR) => 16,
        Key::Value(c::CURRENT_NORMAL) => 17,
        Key::Unit(c::CURRENT_TEXTURE_COORDS, 0) => 18,
        _ => return None,
    })
}

/// The keys of the places, in their order.
const KEYS: [Key; PLACES] = [
    Key::Value(c::VIEWPORT),
    Key::Value(c::SCISSOR_BOX),
    Key::Value(c::DEPTH_RANGE),
    Key::Value(c::DEPTH_WRITEMASK),
    Key::Value(c::DEPTH_FUNC),
    Key::Value(c::COLOR_WRITEMASK),
    Key::Value(c::ACTIVE_TEXTURE),
    Key::Value(c::CURRENT_PROGRAM),
    Key::Value(c::VERTEX_ARRAY_BINDING),
    Key::Cap(c::SCISSOR_TEST),
    Key::Cap(c::DEPTH_TEST),
    Key::Cap(c::BLEND),
    Key::Cap(c::LIGHTING),
    Key::Cap(c::COLOR_MATERIAL),
    Key::Unit(c::TEXTURE_BINDING_2D, 0),
    Key::UnitCap(c::TEXTURE_2D, 0),
    Key::Value(c::CURRENT_COLOR),
    Key::Value(c::CURRENT_NORMAL),
    Key::Unit(c::CURRENT_TEXTURE_COORDS, 0),
];

impl Store {
    #[inline]
    pub(super) fn get(&self, key: Key) -> Option<&Entry> {
        match place(key) {
            Some(place) => self.placed[place].as_ref(),
            None => self.others.get(&key),
        }
    }

    /// The value that is known of a key.
    #[inline]
    pub(super) fn known(&self, key: Key) -> Option<[u32; 4]> {
        self.get(key)?.value
    }

    /// The entry of a key, made where there is none.
    #[inline]
    pub(super) fn entry(&mut self, key: Key) -> &mut Entry {
        match place(key) {
            Some(place) => self.placed[place].get_or_insert_default(),
            None => self.others.entry(key).or_default(),
        }
    }

    /// All entries, with their keys.
    pub(super) fn iter(&self) -> impl Iterator<Item = (Key, &Entry)> {
        let placed = KEYS.into_iter().zip(&self.placed);
        let placed = placed.filter_map(|(key, entry)| Some((key, entry.as_ref()?)));
        placed.chain(self.others.iter().map(|(key, entry)| (*key, entry)))
    }

    pub(super) fn clear(&mut self) {
        self.placed = [None; PLACES];
        self.others.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_keys_are_in_the_same_order() {
        for (at, key) in KEYS.into_iter().enumerate() {
            assert_eq!(place(key), Some(at), "{key:?}");
        }
    }
}

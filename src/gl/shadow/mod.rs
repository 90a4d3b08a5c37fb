//! The state of the context that is current, kept from the calls that set it, so that the driver is asked for each value once: a driver that
//! works on a thread of its own has to catch up before it can answer.
//!
//! All calls to the driver, the program's and the layer's, go through [`super::Real`], which tells the shadow of those that set state. A value
//! that cannot be told from the call, such as one that the driver may refuse, is unknown until the driver has been asked. So a wrong call of
//! the program costs a question, and never a picture.

mod arrays;
mod ask;
mod change;
mod client_arrays;
mod color_material;
mod commands;
mod current;
mod fixed_function;
mod key;
mod lists;
mod matrices;
mod objects;
mod own_names;
mod rectangles;
mod stack;
mod store;
mod subroutines;
mod uniforms;
mod values;

use super::consts as c;
use super::real::Real;
pub(super) use ask::are_capabilities_indexed;
pub(super) use ask::{
    attributes, block_bindings, coordinates, floats_at, has_extension, is_enabled, is_enabled_at,
    is_uniform_unchanged, keep_uniform, light, material, matrix, storage_bindings, tex_env,
    tex_gen, uniform, uniform_changes, value, value_at,
};
use change::{Change, Summary};
use client_arrays::ClientArrays;
use core::cell::{Cell, RefCell};
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use key::Key;
pub(super) use key::{Form, UNITS, drives};
use lists::CompiledLists;
use matrices::Matrices;
use own_names::OwnNames;
pub use own_names::{are_textures_taken, is_own_texture};
pub(super) use own_names::{texture_left, texture_taken, texture_used};
use rustc_hash::{FxHashMap, FxHashSet};
use stack::Stack;
use store::Store;
use subroutines::Subroutines;
pub use subroutines::forget_subroutines;
pub(super) use subroutines::subroutines_of;
use uniforms::UniformValues;

/// Objects that were deleted by any context: their names may become those of others.
static DELETED: AtomicU64 = AtomicU64::new(0);

/// What is kept of the state that the contexts of a share group have in common.
#[derive(Clone, Debug, Default)]
pub struct Shared {
    lists: CompiledLists,
    uniforms: UniformValues,
    own_names: OwnNames,
}

/// What is kept of a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Entry {
    /// Up to four integers or the bits of floats; none where the driver has to be asked.
    value: Option<[u32; 4]>,
    /// The depth of the attribute stack for which the value before was saved.
    level: usize,
}

/// The display list that is being compiled.
#[derive(Debug)]
struct Compiling {
    list: u32,
    executes: bool,
    /// The list base at its beginning, where it is known.
    base: Option<u32>,
    changes: Vec<Change>,
    /// The current values that it changes, by [`key::current_bit`].
    currents: u32,
    /// The bits of the attributes that it has popped while it was compiled and executed.
    popped: u32,
    /// It has evaluators.
    evaluates: bool,
}

/// The state of one context, as far as it is known.
/// More than 12 fields: one for each kind of state that the driver keeps apart.
/// More than 25 methods: one for each command that sets state.
#[derive(Debug)]
pub(super) struct Shadow {
    real: &'static Real,
    values: Store,
    constants: FxHashMap<u32, [u32; 4]>,
    extensions: FxHashMap<String, bool>,
    /// Names that the driver has bound, by the name of the binding.
    confirmed: FxHashSet<(u32, u32)>,
    /// [`DELETED`] when that was last compared.
    deleted: u64,
    attribs: Stack,
    client: Stack,
    client_arrays: ClientArrays,
    matrices: Matrices,
    compiling: Option<Compiling>,
    lists: CompiledLists,
    uniforms: UniformValues,
    own_names: OwnNames,
    bytes: current::Bytes,
    subroutines: Subroutines,
    /// Between glBegin and glEnd, where the driver refuses most calls.
    inside: bool,
    /// Some capability was set by its index. Until then, none is kept by its index.
    indexed: bool,
    /// Some viewport or scissor rectangle was set by its index. Until then, none is kept by its index.
    rectangles_by_index: bool,
    /// Some attributes were given to binding points. From then on, only the driver knows which attributes advance by instances.
    binding_points: bool,
    /// A command of its own has set the colour last, so that a material that follows it has it.
    followers_have_colour: bool,
    /// While transform feedback is on, the driver may refuse other programs.
    feedback: bool,
}

/// The shadow of a context. It belongs to the record of the context.
#[derive(Debug)]
pub struct ContextShadow {
    shadow: RefCell<Shadow>,
    /// Something else than calls of this context has changed its state.
    changed: AtomicBool,
}

thread_local! {
    static CURRENT: Cell<*const ContextShadow> = const { Cell::new(core::ptr::null()) };
}

impl ContextShadow {
    /// For a context that shares objects with those of the same `shared`. Nothing is known of it yet.
    #[must_use]
    pub fn new(real: &'static Real, shared: Shared) -> Self {
        let shadow = Shadow {
            real,
            values: Store::default(),
            constants: FxHashMap::default(),
            extensions: FxHashMap::default(),
            confirmed: FxHashSet::default(),
            deleted: DELETED.load(Relaxed),
            attribs: Stack::default(),
            client: Stack::default(),
            client_arrays: ClientArrays::default(),
            matrices: Matrices::default(),
            compiling: None,
            lists: shared.lists,
            uniforms: shared.uniforms,
            own_names: shared.own_names,
            bytes: current::Bytes::default(),
            subroutines: Subroutines::default(),
            inside: false,
            indexed: false,
            rectangles_by_index: false,
            binding_points: false,
            followers_have_colour: false,
            feedback: false,
        };
        ContextShadow {
            shadow: RefCell::new(shadow),
            changed: AtomicBool::new(false),
        }
    }

    /// Something else than calls of this context has changed its state, on whatever thread.
    pub fn changed(&self) {
        self.changed.store(true, Relaxed);
    }

    /// The calls of this thread are noted here from now on.
    ///
    /// # Safety
    /// The shadow lives at this place until [`no_shadow`] or another shadow takes over on this thread.
    pub unsafe fn make_current(&self) {
        CURRENT.with(|current| current.set(self));
    }
}

/// The calls of this thread are noted nowhere.
pub fn no_shadow() {
    CURRENT.with(|current| current.set(core::ptr::null()));
}

/// The window system has filled display lists of the current context, which change nothing but the raster position.
pub fn lists_of_bitmaps(first: u32, count: u32) {
    noted(|s| {
        for list in first..first.saturating_add(count) {
            s.lists.compiled(list, Vec::new(), Summary::default());
        }
    });
}

fn with<R>(work: impl FnOnce(&mut Shadow) -> R) -> Option<R> {
    let current = CURRENT.with(Cell::get);
    if current.is_null() {
        return None;
    }
    // SAFETY: it lives while it is current (contract of `make_current`).
    let shadow = unsafe { &*current };
    let Ok(mut kept) = shadow.shadow.try_borrow_mut() else {
        // The call comes from within a question.
        shadow.changed();
        uniforms::unseen();
        return None;
    };
    if shadow.changed.load(Relaxed) {
        shadow.changed.store(false, Relaxed);
        kept.forget_unseen();
        kept.indexed = true;
        kept.binding_points = true;
    }
    Some(work(&mut kept))
}

/// The driver has got a call that may set state.
#[inline]
pub(super) fn noted(note: impl FnOnce(&mut Shadow)) {
    with(note);
}

/// The same for a call that may set state of objects, which other contexts share.
#[inline]
pub(super) fn noted_shared(note: impl FnOnce(&mut Shadow)) {
    if with(note).is_none() {
        uniforms::unseen();
    }
}

impl Shadow {
    /// The active texture unit, counted from 0, if it is known.
    fn unit(&self) -> Option<u32> {
        let known = self.values.known(Key::Value(c::ACTIVE_TEXTURE));
        known.map(|[unit, ..]| unit.wrapping_sub(c::TEXTURE0))
    }

    /// Asks for the active texture unit if it is not known.
    fn active_unit(&mut self) {
        if self.unit().is_none() {
            let unit = self.integer(c::ACTIVE_TEXTURE);
            self.answered(Key::Value(c::ACTIVE_TEXTURE), [unit, 0, 0, 0]);
        }
    }

    /// Asks the driver for one integer.
    fn integer(&self, name: u32) -> u32 {
        let mut answer = [0u32; 4];
        // SAFETY: the context is current, and no name that is asked for here has more than four values.
        unsafe { self.real.glGetIntegerv(name, answer.as_mut_ptr().cast()) };
        answer[0]
    }

    /// A limit of the context.
    fn constant(&mut self, name: u32) -> u32 {
        if let Some([value, ..]) = self.constants.get(&name) {
            return *value;
        }
        let value = self.integer(name);
        self.constants.insert(name, [value, 0, 0, 0]);
        value
    }

    /// The driver has answered. That is no change, so nothing is saved of it.
    fn answered(&mut self, key: Key, value: [u32; 4]) {
        self.values.entry(key).value = Some(value);
        self.bytes.compare(key, value);
        if let Some(binding) = key.binding()
            && value[0] != 0
        {
            self.catch_up_with_deletions();
            self.confirmed.insert((binding, value[0]));
        }
    }

    /// Forgets which names the driver takes, where another context has deleted objects.
    fn catch_up_with_deletions(&mut self) {
        let now = DELETED.load(Relaxed);
        if std::mem::replace(&mut self.deleted, now) != now {
            self.confirmed.clear();
        }
    }

    /// Sets a value; none where it is not known. What was there before is saved for glPopAttrib.
    fn put(&mut self, key: Key, value: Option<[u32; 4]>) {
        let stack = match key.is_of_client() {
            true => &mut self.client,
            false => &mut self.attribs,
        };
        let entry = self.values.entry(key);
        if value.is_some() && entry.value == value {
            return;
        }
        stack.save(key, entry);
        entry.value = value;
    }

    /// The stack that saves a value.
    fn stack_of(&mut self, key: Key) -> &mut Stack {
        match key.is_of_client() {
            true => &mut self.client,
            false => &mut self.attribs,
        }
    }

    /// Binds an object, which the driver may refuse.
    fn bind(&mut self, key: Key, name: u32) {
        self.catch_up_with_deletions();
        let binding = key.binding().unwrap_or_default();
        let used = [c::CURRENT_PROGRAM, c::PROGRAM_PIPELINE_BINDING].contains(&binding);
        let sure =
            !(used && self.feedback) && (name == 0 || self.confirmed.contains(&(binding, name)));
        self.put(key, sure.then_some([name, 0, 0, 0]));
    }

    /// Objects are deleted, which unbinds them in this context; `of` tells which bindings are meant.
    fn deleted(&mut self, names: &[u32], of: impl Fn(u32) -> bool) {
        self.catch_up_with_deletions();
        self.deleted = DELETED.fetch_add(1, Relaxed) + 1;
        let is = |name: u32| name != 0 && names.contains(&name);
        self.confirmed
            .retain(|&(binding, name)| !(of(binding) && is(name)));
        let bound: Vec<Key> = self
            .values
            .iter()
            .filter(|(key, entry)| {
                let bound = entry.value.is_none_or(|[name, ..]| is(name));
                bound && key.binding().is_some_and(&of)
            })
            .map(|(key, _)| key)
            .collect();
        for key in bound {
            self.put(key, None);
        }
        self.attribs.taint_bindings();
        self.client.taint_bindings();
    }

    fn forget_all(&mut self) {
        self.values.clear();
        self.confirmed.clear();
        self.matrices = Matrices::default();
        self.attribs.forget();
        self.client.forget();
        self.followers_have_colour = false;
    }

    /// Calls that are not followed may have changed the state.
    fn forget_unseen(&mut self) {
        self.forget_all();
        self.client_arrays.any();
    }

    /// GL_ATTRIB_STACK_DEPTH, asked for once.
    fn attrib_depth(&mut self) -> Option<usize> {
        let pushed = self.attribs.len();
        if self.attribs.base.is_none() {
            let depth = self.integer(c::ATTRIB_STACK_DEPTH) as usize;
            self.attribs.base = Some(depth.saturating_sub(pushed));
        }
        self.attribs.base.map(|base| base + pushed)
    }
}

#[cfg(test)]
mod tests;

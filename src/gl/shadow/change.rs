//! Changes of the state: what calls make at once, and what display lists make when they are called.

use super::key::{self, Key};
use super::matrices::Operation;
use super::{Compiling, Shadow};
use crate::gl::consts as c;

/// The most changes of a display list that are kept. One that has more makes everything unknown.
const MOST: usize = 4096;
/// Changes of a list before another one that may be of the same value.
const LATELY: usize = 16;
const LIST_BASE: Key = Key::Value(c::LIST_BASE);
/// Lists within lists that are followed; GL_MAX_LIST_NESTING is at least 64.
const NESTING: usize = 64;

/// One change.
#[derive(Clone, Debug)]
pub(super) enum Change {
    /// A value; none where only the driver knows it.
    Put(Key, Option<[u32; 4]>),
    /// A value of the active texture unit; `fn` makes its key.
    PutUnit(fn(u32, u32) -> Key, u32, Option<[u32; 4]>),
    /// A value whose binding the driver may refuse.
    Bind(Key, u32),
    /// A texture is bound to the active unit: the name of the binding.
    BindTexture(u32, u32),
    /// glBegin, with its mode.
    Begin(u32),
    End,
    Enable(u32, bool),
    EnableAt(u32, u32, bool),
    ActiveTexture(u32),
    ColorMask([u32; 4]),
    /// Face and parameter; none where the driver may refuse them.
    ColorMaterial(Option<[u32; 2]>),
    MatrixMode(u32),
    Matrix(Operation),
    PushMatrix,
    PopMatrix,
    PushAttrib(u32),
    PopAttrib,
    CallList(u32),
    /// Names without the list base.
    CallLists(Box<[u32]>),
    ForgetMatrices,
    ForgetUniforms,
    ForgetAll,
}

/// What a display list may do, with the lists that it calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Summary {
    /// The current values that it may set, by [`key::current_bit`].
    pub(super) currents: u32,
    /// It may set any parameter of the material, or which ones follow the colour.
    pub(super) material: bool,
    /// It may set the parameters of the material that follow the colour.
    pub(super) followers: bool,
    /// It may begin a primitive that it does not end.
    pub(super) open: bool,
    /// It may have evaluators.
    pub(super) evaluates: bool,
}

impl Summary {
    /// Of a list of which nothing is known.
    pub(super) const ANYTHING: Summary = Summary {
        currents: u32::MAX,
        material: true,
        followers: true,
        open: true,
        evaluates: true,
    };

    /// Of these changes. `called` tells of lists that they call, with the list base where it is known; `base` is that when the list is called.
    pub(super) fn of(
        changes: &[Change],
        base: Option<u32>,
        called: impl Fn(&Change, Option<u32>) -> Summary,
    ) -> Summary {
        let mut all = Summary::default();
        let mut base = base;
        for change in changes {
            match change {
                Change::Put(LIST_BASE, value) => base = value.map(|[base, ..]| base),
                Change::Put(key, _) => {
                    let bit = key::current_bit(*key).map_or(0, |bit| 1 << bit);
                    all.currents |= bit;
                    all.material |= matches!(key, Key::Material(..));
                    all.followers |= bit == key::COLOR_BIT;
                }
                Change::Begin(_) => all.open = true,
                Change::End => all.open = false,
                Change::Enable(..) => all.followers = true,
                Change::ColorMaterial(_) => all.material = true,
                Change::PopAttrib => {
                    all.followers = true;
                    base = None;
                }
                Change::CallList(_) | Change::CallLists(_) | Change::ForgetAll => {
                    let called = called(change, base);
                    all.currents |= called.currents;
                    all.material |= called.material;
                    all.followers |= called.followers;
                    all.open |= called.open;
                    all.evaluates |= called.evaluates;
                    // The list may have set it.
                    base = None;
                }
                _ => {}
            }
        }
        all
    }
}

impl Compiling {
    /// Notes a change. One of a value that was changed just before takes the place of that: lists may give each vertex a material.
    fn note(&mut self, change: &Change) {
        if matches!(change, Change::End) && self.leave_out_begin() {
            return;
        }
        if let Change::Put(key, _) = change
            && let Some(bit) = key::current_bit(*key)
        {
            return self.note_current(*key, bit);
        }
        if let Change::Put(key, _) = change {
            let before = self.changes.iter_mut().rev().take(LATELY);
            let puts = before.take_while(|before| matches!(before, Change::Put(..)));
            for earlier in puts {
                if matches!(earlier, Change::Put(other, _) if other == key) {
                    *earlier = change.clone();
                    return;
                }
            }
        }
        if self.changes.len() < MOST {
            self.changes.push(change.clone());
        } else {
            self.changes.clear();
            self.changes.push(Change::ForgetAll);
        }
    }

    /// Notes a current value, once. What it is after the list, only the driver knows: Mesa 22.3 sets some again, later.
    fn note_current(&mut self, key: Key, bit: u32) {
        if self.currents & 1 << bit == 0 {
            self.currents |= 1 << bit;
            self.changes.push(Change::Put(key, None));
        }
    }

    /// Mesa 22.3 loses a material within a primitive if an evaluator follows.
    fn forget_materials(&mut self) {
        for change in &mut self.changes {
            if let Change::Put(Key::Material(..), value) = change {
                *value = None;
            }
        }
    }

    /// Leaves out a primitive that changes nothing but the material and current values, which may be set outside as well.
    fn leave_out_begin(&mut self) -> bool {
        let outside = |change: &Change| match change {
            Change::Put(Key::Material(..), _) => false,
            Change::Put(key, _) => key::current_bit(*key).is_none(),
            _ => true,
        };
        let last = self.changes.iter().rposition(outside);
        let begin = last.filter(|&at| matches!(self.changes[at], Change::Begin(_)));
        let Some(begin) = begin else {
            return false;
        };
        let within: Vec<Change> = self.changes.drain(begin..).skip(1).collect();
        // The current values are noted already.
        let noted = std::mem::take(&mut self.currents);
        within.iter().for_each(|change| self.note(change));
        self.currents |= noted;
        true
    }
}

impl Shadow {
    /// A call that display lists compile.
    pub(super) fn change(&mut self, change: Change) {
        match &mut self.compiling {
            Some(list) => {
                list.note(&change);
                if list.executes {
                    self.apply(&change, 0);
                }
            }
            None => self.apply(&change, 0),
        }
    }

    /// A call that is made at once, also while a display list is compiled.
    pub(super) fn change_now(&mut self, change: &Change) {
        self.apply(change, 0);
    }

    /// A call that drivers compile into display lists or not.
    pub(super) fn change_now_or_later(&mut self, change: Change) {
        match self.compiling.is_some() {
            true => self.apply(&Change::ForgetAll, 0),
            false => self.apply(&change, 0),
        }
    }

    pub(super) fn begin_list(&mut self, list: u32, executes: bool) {
        self.compiling = Some(Compiling {
            list,
            executes,
            base: self.values.known(LIST_BASE).map(|[base, ..]| base),
            changes: Vec::new(),
            currents: 0,
            popped: 0,
            evaluates: false,
        });
    }

    pub(super) fn end_list(&mut self) {
        let Some(list) = &self.compiling else { return };
        // Which lists it will call is not known before it is called itself.
        let called = |change: &Change, base| self.summary_of(change, base);
        let mut summary = Summary::of(&list.changes, None, called);
        summary.evaluates |= list.evaluates;
        let executed = list.executes.then(|| self.executed(list));
        // Lists that it calls begin nothing as long as it is not executed.
        let own = || Summary::of(&list.changes, None, |_, _| Summary::default());
        let open = executed.unwrap_or_else(own).open;
        // The driver refuses it between a glBegin and a glEnd of the list.
        if open && self.integer(c::LIST_INDEX) != 0 {
            return;
        }
        if let Some(mut list) = self.compiling.take() {
            if summary.evaluates {
                list.forget_materials();
            }
            self.lists.compiled(list.list, list.changes, summary);
            if let Some(executed) = executed {
                self.forget_executed(executed);
            }
        }
    }

    /// What a list has done while it was compiled.
    fn executed(&self, list: &Compiling) -> Summary {
        let called = |change: &Change, base| self.summary_of(change, base);
        let all = Summary::of(&list.changes, list.base, called);
        // What was restored may be which parameters follow the colour.
        let material = all.material || list.popped & c::LIGHTING_BIT != 0;
        Summary { material, ..all }
    }

    /// What the lists that a change calls may do.
    fn summary_of(&self, change: &Change, base: Option<u32>) -> Summary {
        match *change {
            Change::CallList(list) => self.lists.summary(list),
            Change::CallLists(ref names) => {
                let Some(base) = base else {
                    return Summary::ANYTHING;
                };
                let of = |&name: &u32| Change::CallList(name.wrapping_add(base));
                let all: Vec<Change> = names.iter().map(of).collect();
                Summary::of(&all, None, |change, base| self.summary_of(change, base))
            }
            _ => Summary::ANYTHING,
        }
    }

    /// After a list that was executed while it was compiled: drivers execute its vertices at the end, or later.
    fn forget_executed(&mut self, summary: Summary) {
        if summary.material {
            self.forget_material();
        }
        if summary.followers {
            self.set_followers(None);
        }
        if summary.material || summary.followers {
            self.followers_have_colour = false;
        }
        self.forget_currents(summary.currents);
    }

    fn apply(&mut self, change: &Change, depth: usize) {
        if self.inside {
            return self.apply_inside(change, depth);
        }
        match *change {
            Change::Put(Key::Material(face, name), value) => self.put_material(face, name, value),
            Change::Put(key, value) => {
                self.put(key, value);
                self.current_is_set(key);
                if self.rectangles_by_index && value.is_some() {
                    self.spread(key, value);
                }
            }
            Change::PutUnit(key, name, value) => match self.unit() {
                Some(unit) => self.put(key(name, unit), value),
                None => self.forget_all(),
            },
            Change::Bind(key, name) => self.bind(key, name),
            Change::BindTexture(binding, name) => match self.unit() {
                Some(unit) => self.bind(Key::Unit(binding, unit), name),
                None => self.forget_all(),
            },
            Change::Begin(mode) => self.inside = mode <= c::PATCHES,
            Change::End => {}
            Change::Enable(cap, on) => self.enable(cap, on),
            Change::EnableAt(cap, unit, on) if key::is_of_unit(cap) => {
                self.put(Key::UnitCap(cap, unit), Some([on.into(), 0, 0, 0]));
            }
            Change::EnableAt(cap, index, on) => {
                if !std::mem::replace(&mut self.indexed, true) {
                    self.attribs.indices_begin();
                    for cap in key::INDEXED {
                        (0..16).for_each(|index| self.put(Key::CapAt(cap, index), None));
                    }
                }
                self.put(Key::CapAt(cap, index), Some([on.into(), 0, 0, 0]));
                if index == 0 {
                    self.put(Key::Cap(cap), Some([on.into(), 0, 0, 0]));
                }
            }
            Change::ActiveTexture(unit) => {
                let most = self.constant(c::MAX_COMBINED_TEXTURE_IMAGE_UNITS).max(2);
                let known = unit.wrapping_sub(c::TEXTURE0) < most;
                let value = known.then_some([unit, 0, 0, 0]);
                self.put(Key::Value(c::ACTIVE_TEXTURE), value);
            }
            Change::ColorMaterial(settings) => self.set_color_material(settings),
            Change::ColorMask(mask) => {
                self.put(Key::Value(c::COLOR_WRITEMASK), Some(mask));
                for index in 0..8 {
                    self.put(Key::At(c::COLOR_WRITEMASK, index), Some(mask));
                }
            }
            Change::MatrixMode(mode) => match mode {
                c::MODELVIEW | c::PROJECTION | c::TEXTURE => self.matrices.mode_is(mode),
                _ => self.matrices.mode_is_unknown(),
            },
            Change::Matrix(ref operation) => self.operate(operation),
            Change::PushMatrix => self.push_matrix(depth),
            Change::PopMatrix => self.pop_matrix(),
            Change::PushAttrib(mask) => self.push_attrib(mask, depth),
            Change::PopAttrib => self.pop_attrib(),
            Change::CallList(list) => self.call_list(list, depth),
            Change::CallLists(ref names) => match self.values.known(Key::Value(c::LIST_BASE)) {
                Some([base, ..]) => names
                    .iter()
                    .for_each(|name| self.call_list(name.wrapping_add(base), depth)),
                None => self.forget_all(),
            },
            Change::ForgetMatrices => self.matrices.forget_stacks(),
            Change::ForgetUniforms => self.uniforms.forget_all(),
            Change::ForgetAll => self.forget_unseen(),
        }
    }

    /// Between glBegin and glEnd the driver refuses most calls, but is the judge of that.
    fn apply_inside(&mut self, change: &Change, depth: usize) {
        match *change {
            Change::Put(Key::Material(face, name), value) => self.put_material(face, name, value),
            Change::Put(key, value) if key::current_bit(key).is_some() => {
                self.put(key, value);
                self.current_is_set(key);
            }
            Change::Put(key, _) | Change::Bind(key, _) => self.put(key, None),
            Change::Enable(cap, _) if !key::is_of_unit(cap) => {
                self.client_arrays.capability_on(cap);
                self.put(Key::Cap(cap), None);
            }
            Change::CallList(list) => self.call_list(list, depth),
            Change::Begin(_) => {}
            Change::End => self.inside = false,
            Change::ForgetAll => self.forget_unseen(),
            _ => self.forget_all(),
        }
    }

    fn enable(&mut self, cap: u32, on: bool) {
        if on {
            self.client_arrays.capability_on(cap);
        }
        let value = Some([u32::from(on), 0, 0, 0]);
        if key::is_of_unit(cap) {
            let units = self.constant(c::MAX_TEXTURE_UNITS);
            return match self.unit() {
                Some(unit) => {
                    // Further units have no fixed function, so the driver refuses it.
                    let value = value.filter(|_| unit < units);
                    self.put(Key::UnitCap(cap, unit), value);
                }
                None => self.forget_all(),
            };
        }
        let before = self.values.known(Key::Cap(cap));
        self.put(Key::Cap(cap), value);
        if self.indexed && key::is_indexed(cap) {
            (0..16).for_each(|index| self.put(Key::CapAt(cap, index), value));
        }
        if cap == c::COLOR_MATERIAL {
            self.switch_color_material(before.map(|[on, ..]| on != 0), on);
        }
    }

    fn operate(&mut self, operation: &Operation) {
        match (self.matrices.mode(), self.matrices.current()) {
            (None, _) => self.matrices.forget_stacks(),
            (_, None) => {}
            (_, Some(stack)) => {
                let unit = self.unit();
                self.matrices.operate(stack, unit, operation);
            }
        }
    }

    /// `depth`: lists within lists that it is called in.
    fn push_matrix(&mut self, depth: usize) {
        let unit = self.unit();
        let Some(stack) = self.matrices.current() else {
            return self.matrices.forget_stacks();
        };
        let (limit, name) = stack.depths();
        // The driver has made all calls of a list already, so its answer would be of later.
        if self.matrices.depth(stack, unit).is_none() && depth == 0 {
            // The driver has pushed already, if it could.
            let now = self.integer(name);
            self.matrices.depth_is(stack, unit, now.saturating_sub(1));
        }
        match self.matrices.depth(stack, unit) {
            Some(depth) if depth < self.constant(limit) => self.matrices.push(stack, unit),
            // It is full, and the driver has refused.
            Some(_) => {}
            None => self.matrices.forget_stacks(),
        }
    }

    /// After a list that may have pushed what only the driver knows the depth of: the next one finds that known.
    fn depths_after_list(&mut self, changes: &[Change]) {
        let calls = |change: &Change| matches!(change, Change::CallList(_) | Change::CallLists(_));
        let pushes = |change: &Change| matches!(change, Change::PushAttrib(_)) || calls(change);
        if self.attribs.base.is_none() && changes.iter().any(pushes) {
            self.attrib_depth();
        }
        let pushes = |change: &Change| matches!(change, Change::PushMatrix) || calls(change);
        let unit = self.unit();
        if let Some(stack) = self.matrices.current()
            && self.matrices.depth(stack, unit).is_none()
            && changes.iter().any(pushes)
        {
            let (_, name) = stack.depths();
            let now = self.integer(name);
            self.matrices.depth_is(stack, unit, now);
        }
    }

    fn pop_matrix(&mut self) {
        let unit = self.unit();
        match self.matrices.current() {
            Some(stack) => self.matrices.pop(stack, unit),
            None => self.matrices.forget_stacks(),
        }
    }

    /// `depth`: lists within lists that it is called in.
    fn push_attrib(&mut self, mask: u32, depth: usize) {
        let most = self.constant(c::MAX_ATTRIB_STACK_DEPTH) as usize;
        if self.attribs.base.is_none() {
            if depth > 0 {
                // The driver has made all calls of the list already, so its answer would be of later. What is popped is unknown.
                return;
            }
            // The driver has pushed already.
            let depth = self.integer(c::ATTRIB_STACK_DEPTH) as usize;
            let below = depth.saturating_sub(1 + self.attribs.len());
            self.attribs.base = Some(below);
        }
        let below = self.attribs.base.unwrap_or_default();
        if below + self.attribs.len() < most {
            let client = key::bits::CLIENT_PIXELS | key::bits::CLIENT_ARRAYS;
            self.attribs.push(mask & !client, self.matrices.mode());
        }
    }

    fn pop_attrib(&mut self) {
        let pushed = self.attribs.pop();
        if let Some(list) = &mut self.compiling {
            list.popped |= pushed.as_ref().map_or(u32::MAX, |pushed| pushed.mask);
        }
        let Some(pushed) = pushed else {
            if self.attribs.base != Some(0) {
                // It was pushed before anything was known.
                self.forget_all();
            }
            return;
        };
        if pushed.mask & c::TRANSFORM_BIT != 0 {
            match pushed.mode {
                Some(mode) => self.matrices.mode_is(mode),
                None => self.matrices.mode_is_unknown(),
            }
        }
        self.restore(pushed);
    }

    /// Puts back the values that a glPopAttrib restores.
    pub(super) fn restore(&mut self, pushed: super::stack::Pushed) {
        let lighting = pushed.mask & (c::LIGHTING_BIT | c::CURRENT_BIT | key::bits::ENABLE) != 0;
        if lighting {
            self.forget_followers();
        }
        for (key, before) in pushed.before {
            let (sure, maybe) = key.saved_with();
            let lost = pushed.deleted && key.binding().is_some();
            let now = self.values.get(key).copied().unwrap_or_default();
            let value = match (pushed.mask & sure != 0, pushed.mask & maybe != 0) {
                (true, _) if !lost => before.value,
                (false, false) => now.value,
                _ => None,
            };
            // What is not as it was before the pop may have to be saved for the next one.
            let mut entry = before;
            if value != before.value {
                self.stack_of(key).save(key, &mut entry);
            }
            entry.value = value;
            *self.values.entry(key) = entry;
        }
        if pushed.before_indices {
            // Also those that were saved: they were those of before the first command by an index.
            self.forget_indices(pushed.mask);
        }
        self.followers_have_colour = false;
        if lighting {
            // A driver may let the material follow the colour that it restores.
            self.forget_followers();
        }
    }

    /// What glPopAttrib restores by index, only the driver knows.
    fn forget_indices(&mut self, mask: u32) {
        let keys = self.values.iter().map(|(key, _)| key);
        let restored = |key: &Key| {
            let (sure, maybe) = key.saved_with();
            key.is_by_index() && mask & (sure | maybe) != 0
        };
        let keys: Vec<Key> = keys.filter(restored).collect();
        keys.into_iter().for_each(|key| self.put(key, None));
    }

    fn call_list(&mut self, list: u32, depth: usize) {
        if depth >= NESTING {
            return;
        }
        match self.lists.changes(list) {
            Some(changes) => {
                changes
                    .iter()
                    .for_each(|change| self.apply(change, depth + 1));
                // Within a primitive nothing can be asked.
                if depth == 0 && !self.inside {
                    self.depths_after_list(&changes);
                }
            }
            // It does not exist, or only the driver knows it.
            None => self.forget_unseen(),
        }
        // Mesa 22.3 lets a list set what follows the colour.
        self.followers_have_colour = false;
    }
}

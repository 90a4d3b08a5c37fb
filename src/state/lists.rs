//! The contents of the program's display lists: runs of commands. Each is compiled into a list of the driver by itself, so that
//! changes of state are executed once and draws once per view.
//!
//! Under the name of the program's list, the driver has a list that calls the runs in order. Whoever calls that directly (another
//! list, a context without a layer, selection) thus executes the whole list.

use super::Shaders;
use super::{Effect, Immediate, TextureWrite, Touch};
use crate::gl::{
    BufferName, Fence, FramebufferName, ListName, ProgramName, QueryName, TextureName, consts as c,
};
use std::collections::HashMap;
use std::sync::Arc;

/// The kind of a run of commands, by which it is executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Run {
    /// Not decided yet: executed once, but may become part of a run that draws.
    Open,
    /// Changes state on which the views depend, or which would change again if the run were sent once per view: executed once.
    State,
    /// Primitives, with state that can be restored between two views.
    Draw,
    /// Clears.
    Clear,
    /// glClear with the accumulation buffer: its mask is in [`Segment::names`].
    ClearAll,
    /// glAccum: its arguments are in [`Segment::names`].
    Accum,
    /// Pixels and bitmaps at the raster position.
    Raster,
    /// Reads from the framebuffer.
    Read,
    /// glCopyPixels.
    Copy,
    /// glCallList of another list, whose contents are looked up at the time of the call.
    List(ListName),
    /// glDrawBuffer and glDrawBuffers: 0 or 1, and the program's names of the buffers, are in [`Segment::names`].
    DrawBuffers,
    /// glReadBuffer.
    ReadBuffer(u32),
    /// glCallLists: the names are in [`Segment::names`], without the list base.
    Lists,
    /// glBlitFramebuffer: its arguments are in [`Segment::names`].
    Blit,
    /// A command that writes to a texture.
    Texture(TextureWrite),
    /// glBeginQuery of a target and a query.
    BeginQuery(u32, QueryName),
    /// glEndQuery of a target.
    EndQuery(u32),
}

impl Run {
    /// Whether it suffices to call the driver's list, where nothing is drawn to framebuffer 0.
    pub fn is_plain(self) -> bool {
        !matches!(
            self,
            Run::List(_)
                | Run::Lists
                | Run::DrawBuffers
                | Run::ReadBuffer(_)
                | Run::Blit
                | Run::Texture(_)
                | Run::ClearAll
                | Run::Accum
                | Run::BeginQuery(..)
                | Run::EndQuery(_)
        )
    }

    /// Whether a command of the kind `next` belongs to the run.
    fn takes(self, next: Run) -> bool {
        match (self, next) {
            (Run::Open | Run::State | Run::Draw, Run::Open) => true,
            (Run::Open, Run::State | Run::Draw) => true,
            (alone, _) if !alone.is_plain() => false,
            (a, b) => a == b,
        }
    }
}

/// One run of a list.
#[derive(Clone, Debug)]
pub struct Segment {
    /// Its kind.
    pub run: Run,
    /// The driver's list with its commands.
    pub name: ListName,
    /// State groups that are stale after it.
    pub touch: Touch,
    /// The names of glCallLists, the buffers of glDrawBuffers, the arguments of glBlitFramebuffer, glClear and glAccum.
    pub names: Arc<[u32]>,
    /// Its effect on the current values.
    pub immediate: Immediate,
    /// A run that draws has nothing but primitives and current values.
    pub primitives: bool,
    /// It may draw lines or points.
    pub lines_or_points: bool,
    /// Number of levels of the attribute stack that it pops without having pushed them.
    pub pops: u32,
    /// Masks of the levels that it pushes and does not pop.
    pub pushes: Vec<u32>,
    /// The primitive that it leaves open (glBegin without glEnd).
    pub opens: Option<u32>,
    /// It begins within a primitive and ends it (glEnd without glBegin).
    pub closes: bool,
    /// Its name is the program's own: the driver has filled the list by itself.
    pub borrowed: bool,
}

impl Segment {
    /// Whether it leaves primitives and the attribute stack as they were.
    pub fn is_balanced(&self) -> bool {
        self.pops == 0 && self.pushes.is_empty() && self.opens.is_none() && !self.closes
    }
}

/// The runs of one list.
pub type Body = Arc<[Segment]>;

/// Objects of the layer that stay in the share group when their context is destroyed; another context deletes them.
#[derive(Debug, Default)]
pub struct Orphans {
    /// Framebuffer objects, which some drivers share although the specification does not ask for it.
    pub framebuffers: Vec<FramebufferName>,
    /// Textures.
    pub textures: Vec<TextureName>,
    /// Programs.
    pub programs: Vec<ProgramName>,
    /// Buffer objects.
    pub buffers: Vec<BufferName>,
    /// Sync objects.
    pub fences: Vec<Fence>,
}

/// The display lists and programs of one share group, and the orphaned objects of its destroyed contexts.
#[derive(Debug)]
pub struct Lists {
    /// Objects of the layer whose context is destroyed.
    pub orphans: Orphans,
    /// The programs of the share group.
    pub shaders: Shaders,
    bodies: HashMap<ListName, Body>,
    spare: Vec<ListName>,
    /// Bodies of lists that are deleted or have others now, which a thread may still be calling.
    replaced: Vec<Body>,
    next: u32,
    highest: u32,
}

/// The first name for a run; further ones follow downwards. No program numbers its lists there, neither from 1 on nor by negative numbers.
const TOP: u32 = 0xBFFF_FFFF;
/// The largest name that Mesa gives.
const LARGEST: u32 = u32::MAX - 1;

impl Default for Lists {
    fn default() -> Self {
        Lists {
            orphans: Orphans::default(),
            shaders: Shaders::default(),
            bodies: HashMap::new(),
            spare: Vec::new(),
            replaced: Vec::new(),
            next: TOP,
            highest: 0,
        }
    }
}

impl Lists {
    /// The runs of a list; `None` if it was not compiled under the layer.
    pub fn body(&self, list: ListName) -> Option<Body> {
        self.bodies.get(&list).cloned()
    }

    /// A name for a run. `taken` says whether the driver knows a name already.
    pub fn name(&mut self, mut taken: impl FnMut(ListName) -> bool) -> ListName {
        if let Some(name) = self.spare.pop() {
            return name;
        }
        while taken(ListName(self.next)) {
            self.next -= 1;
        }
        self.next -= 1;
        ListName(self.next + 1)
    }

    /// Gives back a name that no run uses any more.
    pub fn spare(&mut self, name: ListName) {
        self.spare.push(name);
    }

    /// Number of names that runs use.
    pub fn held(&self) -> u32 {
        TOP - self.next - self.spare.len() as u32
    }

    /// Whether a name is that of a run, not one of the program's.
    pub fn owns(&self, name: ListName) -> bool {
        (self.next + 1..=TOP).contains(&name.0) && !self.bodies.contains_key(&name)
    }

    /// The first of `count` names that glGenLists would give without the layer, as Mesa chooses them: above the highest name that the program
    /// has used, or else the first gap that is large enough. None if there is none, or it would meet the names of runs.
    pub fn free(&self, count: u32) -> Option<ListName> {
        let fits = |first: u32| {
            let last = first.checked_add(count - 1)?;
            let apart = last <= self.next || first > TOP;
            (apart && last <= LARGEST).then_some(ListName(first))
        };
        if LARGEST - count > self.highest {
            return fits(self.highest + 1);
        }
        let mut first = 1u32;
        let mut used: Vec<u32> = self.bodies.keys().map(|name| name.0).collect();
        used.sort_unstable();
        for name in used {
            if name.checked_sub(first).is_some_and(|gap| gap >= count) {
                break;
            }
            first = name.checked_add(1)?;
        }
        fits(first)
    }

    /// Gives the program names for glGenLists, in the place of those from `first` on, which the driver has chosen. Nobody else gets them.
    pub fn claim(&mut self, first: ListName, count: u32) -> ListName {
        let names = self.free(count).unwrap_or(first);
        self.generated(names, count);
        names
    }

    /// Those of some names that the program does not have.
    pub fn unclaimed(&self, first: ListName, count: u32) -> Vec<ListName> {
        let names = (first.0..first.0.saturating_add(count)).map(ListName);
        names
            .filter(|name| !self.bodies.contains_key(name))
            .collect()
    }

    /// Notes names that the program has got from glGenLists; their lists are empty.
    pub fn generated(&mut self, first: ListName, count: u32) {
        let last = first.0.saturating_add(count - 1);
        self.used(ListName(last));
        let empty = Body::default();
        self.bodies
            .extend((first.0..=last).map(|name| (ListName(name), empty.clone())));
    }

    /// Notes lists that the driver has filled with a bitmap each (glXUseXFont); returns the names of the runs that they had before.
    pub fn bitmaps(&mut self, first: ListName, count: u32) -> Vec<ListName> {
        let names = (first.0..first.0.saturating_add(count)).map(ListName);
        let bitmap = |name| Segment {
            run: Run::Raster,
            borrowed: true,
            primitives: false,
            ..fresh(name)
        };
        names
            .flat_map(|name| self.define(name, [bitmap(name)].into()))
            .collect()
    }

    fn used(&mut self, name: ListName) {
        self.highest = self.highest.max(name.0);
    }

    /// Notes a list that has been compiled; returns the names of the runs that nothing calls any more.
    pub fn define(&mut self, list: ListName, body: Body) -> Vec<ListName> {
        self.used(list);
        let old = self.bodies.insert(list, body);
        self.release(old)
    }

    /// Notes that lists are deleted; returns the names of their runs.
    pub fn delete(&mut self, first: ListName, count: u32) -> Vec<ListName> {
        let range = first.0..first.0.saturating_add(count);
        let gone: Vec<ListName> = if count as usize > self.bodies.len() {
            let known = self.bodies.keys().copied();
            known.filter(|l| range.contains(&l.0)).collect()
        } else {
            range.map(ListName).collect()
        };
        gone.into_iter()
            .flat_map(|list| {
                let old = self.bodies.remove(&list);
                self.release(old)
            })
            .collect()
    }

    /// Returns the names of the runs that nothing calls any more. Another thread may be calling the list that is redefined: its runs are kept
    /// until a later call.
    fn release(&mut self, body: Option<Body>) -> Vec<ListName> {
        self.replaced.extend(body.filter(|body| !body.is_empty()));
        let unused = self
            .replaced
            .extract_if(.., |body| Arc::strong_count(body) == 1);
        let unused: Vec<Body> = unused.collect();
        let runs = unused.iter().flat_map(|body| body.iter());
        runs.filter(|s| !s.borrowed).map(|s| s.name).collect()
    }
}

/// When the driver executes the commands that are compiled into the open run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// When the run has ended, or never.
    Later,
    /// At once (GL_COMPILE_AND_EXECUTE).
    Now,
    /// At once in the program's own view, and in the others when the run has ended.
    Own,
}

impl Start {
    /// The mode of glNewList.
    pub fn mode(self) -> u32 {
        match self {
            Start::Later => c::COMPILE,
            Start::Now | Start::Own => c::COMPILE_AND_EXECUTE,
        }
    }
}

/// A list between glNewList and glEndList.
///
/// With GL_COMPILE_AND_EXECUTE the driver itself executes the commands that it compiles, for the program's own view: it treats
/// incomplete primitives and invalid calls differently than in a list that is called.
#[derive(Debug)]
pub struct Compiling {
    /// The program's name for it.
    pub list: ListName,
    /// The mode that the program gave.
    pub mode: u32,
    /// The list is between glBegin and glEnd, where a run cannot end.
    pub between: bool,
    /// It enables GL_FRAMEBUFFER_SRGB.
    pub enables_srgb: bool,
    /// When the open run is executed.
    pub start: Start,
    closed: Vec<Segment>,
    open: Segment,
    used: bool,
    matrix_mode: Option<u32>,
    matrices: u32,
    mode_begun: u32,
}

/// A command in a list, as far as it matters for runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// A command that decides the kind of its run.
    Of(Run),
    /// glBegin.
    Begin(u32),
    /// glEnd.
    End,
    /// A vertex or a current value.
    Immediate(Effect),
    /// glMatrixMode.
    MatrixMode(u32),
    /// Changes the current matrix.
    Matrix,
    /// glPushMatrix.
    PushMatrix,
    /// glPopMatrix.
    PopMatrix,
    /// glPushAttrib.
    PushAttrib(u32),
    /// glPopAttrib.
    PopAttrib,
}

fn fresh(name: ListName) -> Segment {
    Segment {
        run: Run::Open,
        name,
        touch: Touch::NONE,
        names: Arc::default(),
        immediate: Immediate::default(),
        primitives: true,
        lines_or_points: false,
        pops: 0,
        pushes: Vec::new(),
        opens: None,
        closes: false,
        borrowed: false,
    }
}

impl Compiling {
    /// glNewList. `name` is the driver's list of the first run.
    pub fn new(list: ListName, mode: u32, name: ListName) -> Self {
        Compiling {
            list,
            mode,
            between: false,
            enables_srgb: false,
            start: match mode {
                c::COMPILE_AND_EXECUTE => Start::Now,
                _ => Start::Later,
            },
            closed: Vec::new(),
            open: fresh(name),
            used: false,
            matrix_mode: None,
            matrices: 0,
            mode_begun: 0,
        }
    }

    /// For a command that is about to be compiled: how to begin a new run for it ([`Compiling::split`]), or `None` if it belongs to the
    /// open one.
    pub fn needs_split(&self, command: Command) -> Option<Start> {
        let run = self.kind(command);
        let start = match run {
            _ if !self.executes() => Start::Later,
            Run::Open if self.start == Start::Own && matches!(command, Command::Immediate(_)) => {
                Start::Own
            }
            Run::Open | Run::State => Start::Now,
            Run::Draw => Start::Own,
            _ => Start::Later,
        };
        let empty = self.open.run == Run::Open && !self.used;
        let fits = self.start == start && (empty || self.open.run.takes(run)) && !self.open.closes;
        (!self.between && !fits).then_some(start)
    }

    /// The driver has ended the open run's list and begun another one.
    pub fn split(&mut self, name: ListName) {
        let closed = std::mem::replace(&mut self.open, fresh(name));
        self.close(closed);
        (self.used, self.matrices) = (false, 0);
    }

    fn close(&mut self, mut segment: Segment) {
        if !segment.pushes.is_empty() {
            // Rectangles that stay on the attribute stack must be the program's own.
            segment.touch = segment.touch | Touch::RECTS;
        }
        if self.between {
            segment.opens = Some(self.mode_begun);
        }
        self.closed.push(segment);
    }

    /// The bits of the last glPushAttrib of the open run that is not popped yet.
    pub fn pushed(&self) -> Option<u32> {
        self.open.pushes.last().copied()
    }

    /// Whether the program wants the commands executed as well (GL_COMPILE_AND_EXECUTE).
    pub fn executes(&self) -> bool {
        self.mode == c::COMPILE_AND_EXECUTE
    }

    /// Whether something has been compiled into the open run.
    pub fn used(&self) -> bool {
        self.used
    }

    /// The driver's list of the open run.
    pub fn name(&self) -> ListName {
        self.open.name
    }

    /// The run that was closed last.
    pub fn last(&self) -> Option<&Segment> {
        self.closed.last()
    }

    /// Notes a command that is compiled into the open run, and the state that it touches. Returns the state that it touches in this
    /// list, whose matrix mode may be known.
    pub fn note(&mut self, command: Command, touch: Touch) -> Touch {
        let run = self.kind(command);
        let command = match command {
            // Programs may switch arrays between the primitives of a list, so that its elements set different values.
            Command::Immediate(Effect::ELEMENT) => Command::Immediate(Effect::UNKNOWN),
            other => other,
        };
        // A list that begins within a primitive has nothing but vertices before the glEnd.
        let inside = self.closed.is_empty() && self.open.run == Run::Open && self.open.primitives;
        if !self.between && run != Run::Open {
            self.open.run = run;
        }
        self.used = true;
        self.open.primitives &= matches!(
            command,
            Command::Begin(_) | Command::End | Command::Immediate(_) | Command::Of(Run::Draw)
        );
        let touch = match command {
            Command::Matrix | Command::PopMatrix => match self.matrix_mode {
                None => Touch::MATRIX,
                Some(c::MODELVIEW) => Touch::MODELVIEW,
                Some(_) => Touch::DSA_MATRIX,
            },
            _ => touch,
        };
        self.open.touch = self.open.touch | touch;
        self.open.lines_or_points |= match command {
            Command::Begin(mode) => mode <= c::LINE_STRIP,
            // The mode in which arrays are drawn is not known here.
            Command::Of(Run::Draw) => true,
            _ => false,
        };
        match command {
            Command::MatrixMode(mode) => self.matrix_mode = Some(mode),
            Command::PushMatrix => self.matrices += 1,
            Command::PopMatrix => self.matrices = self.matrices.saturating_sub(1),
            Command::PushAttrib(mask) => self.open.pushes.push(mask),
            Command::PopAttrib => {
                if self.open.pushes.pop().is_none() {
                    self.open.pops += 1;
                }
            }
            Command::Begin(mode) if !self.between => {
                // A mode that does not exist begins nothing.
                self.between = mode <= c::PATCHES;
                self.mode_begun = mode;
            }
            Command::End if self.between => self.between = false,
            Command::End => self.open.closes = inside && !self.executes(),
            Command::Immediate(effect) => self.open.immediate.note(effect),
            // The vertices of the draw use the current values from before it.
            Command::Of(Run::Draw) => self.open.immediate.note(Effect::VERTEX),
            Command::Of(_) | Command::Matrix | Command::Begin(_) => {}
        }
        touch
    }

    /// Sets the [`Segment::names`] of the open run.
    pub fn note_names(&mut self, names: &[u32]) {
        self.open.names = names.into();
    }

    /// glEndList: closes the last run.
    pub fn finish(&mut self) {
        self.split(ListName::ZERO);
    }

    /// All runs, after [`Compiling::finish`].
    pub fn body(&self) -> Body {
        self.closed.as_slice().into()
    }

    fn kind(&self, command: Command) -> Run {
        let free = |balanced: bool| if balanced { Run::Open } else { Run::State };
        // Where the list sets no mode, it is the one at the time of the call: nearly always the modelview.
        let modelview = self.matrix_mode.is_none_or(|m| m == c::MODELVIEW);
        match command {
            Command::Of(run) => run,
            Command::Begin(_) => Run::Draw,
            // Without a glBegin it is an error.
            Command::End => Run::Open,
            Command::MatrixMode(_) => Run::State,
            Command::Matrix | Command::PushMatrix => free(modelview),
            Command::PopMatrix => free(modelview && self.matrices > 0),
            Command::PushAttrib(_) | Command::Immediate(_) => Run::Open,
            Command::PopAttrib => free(!self.open.pushes.is_empty()),
        }
    }
}

#[cfg(test)]
mod tests;

//! What is in the program's display lists: runs of commands, each compiled into a driver's list of its own, so that state is set
//! once and drawing happens once per view.
//!
//! A list of the program stays whole in the driver as well: under its own name it calls its runs in order. Whoever calls it by
//! itself (another list, a context without a layer, selection) gets all of it.

use super::Shaders;
use super::{Effect, Immediate, Touch};
use crate::gl::{Fence, consts as c};
use std::collections::HashMap;
use std::sync::Arc;

/// What a run of commands does, and so how it is executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Run {
    /// Nothing that decides it: executed once, but may become part of a run that draws.
    Open,
    /// Changes state that a sending per view would change again, or that the views depend on: executed once.
    State,
    /// Primitives, with any state that can be put back between two views.
    Draw,
    /// Clears.
    Clear,
    /// glClear with the accumulation buffer: its mask is in [`Segment::names`].
    ClearAll,
    /// glAccum: its arguments are in [`Segment::names`].
    Accum,
    /// Pictures at the raster position.
    Raster,
    /// Reads from the framebuffer.
    Read,
    /// glCopyPixels.
    Copy,
    /// glCallList of another list, known when it is called.
    List(u32),
    /// glDrawBuffer and glDrawBuffers: 0 or 1, and the program's names of the buffers, are in [`Segment::names`].
    DrawBuffers,
    /// glReadBuffer.
    ReadBuffer(u32),
    /// glCallLists: the names are in [`Segment::names`], without the list base.
    Lists,
    /// glBlitFramebuffer: its arguments are in [`Segment::names`].
    Blit,
    /// glBeginQuery of a target and a query.
    BeginQuery(u32, u32),
    /// glEndQuery of a target.
    EndQuery(u32),
}

impl Run {
    /// Whether the driver's own list does what the run is to do, where nothing is drawn to framebuffer 0.
    pub fn is_plain(self) -> bool {
        !matches!(
            self,
            Run::List(_)
                | Run::Lists
                | Run::DrawBuffers
                | Run::ReadBuffer(_)
                | Run::Blit
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
    /// What it does.
    pub run: Run,
    /// The driver's list that holds it.
    pub name: u32,
    /// State groups that are stale after it.
    pub touch: Touch,
    /// The names of glCallLists, the buffers of glDrawBuffers, the arguments of glBlitFramebuffer, glClear and glAccum.
    pub names: Arc<[u32]>,
    /// What it does to the current values.
    pub immediate: Immediate,
    /// Of a run that draws: nothing but primitives and current values.
    pub primitives: bool,
    /// There may be lines or points among them.
    pub thin: bool,
    /// Levels of attributes that it pops and has not pushed.
    pub pops: u32,
    /// The masks of those that it pushes and leaves.
    pub pushes: Vec<u32>,
    /// The primitive that it leaves open (glBegin without glEnd).
    pub opens: Option<u32>,
    /// It begins within a primitive and ends that (glEnd without glBegin).
    pub closes: bool,
}

impl Segment {
    /// Whether it leaves primitives and the attribute stack as they were.
    pub fn is_balanced(&self) -> bool {
        self.pops == 0 && self.pushes.is_empty() && self.opens.is_none() && !self.closes
    }
}

/// The runs of one list.
pub type Body = Arc<[Segment]>;

/// What a context has made that its share group keeps when the context is destroyed: to be deleted by another one.
#[derive(Debug, Default)]
pub struct Orphans {
    /// Framebuffer objects, which drivers share although they need not.
    pub framebuffers: Vec<u32>,
    /// Textures.
    pub textures: Vec<u32>,
    /// Programs.
    pub programs: Vec<u32>,
    /// Buffer objects.
    pub buffers: Vec<u32>,
    /// Sync objects.
    pub fences: Vec<Fence>,
}

/// The display lists of one share group, and what is left of its destroyed contexts.
#[derive(Debug)]
pub struct Lists {
    /// Names of ours without a context.
    pub orphans: Orphans,
    /// Its programs.
    pub shaders: Shaders,
    bodies: HashMap<u32, Body>,
    spare: Vec<u32>,
    next: u32,
    highest: u32,
}

/// The first name of ours.
const TOP: u32 = u32::MAX - 1;

impl Default for Lists {
    fn default() -> Self {
        Lists {
            orphans: Orphans::default(),
            shaders: Shaders::default(),
            bodies: HashMap::new(),
            spare: Vec::new(),
            // From the top downwards, where no program numbers its lists.
            next: TOP,
            highest: 0,
        }
    }
}

impl Lists {
    /// The runs of a list; `None` if it was not compiled under the layer.
    pub fn body(&self, list: u32) -> Option<Body> {
        self.bodies.get(&list).cloned()
    }

    /// A name for a run. `taken` says whether the driver knows a name already.
    pub fn name(&mut self, mut taken: impl FnMut(u32) -> bool) -> u32 {
        if let Some(name) = self.spare.pop() {
            return name;
        }
        while taken(self.next) {
            self.next -= 1;
        }
        self.next -= 1;
        self.next + 1
    }

    /// A name that is of no use any more.
    pub fn spare(&mut self, name: u32) {
        self.spare.push(name);
    }

    /// How many names of ours are in use.
    pub fn held(&self) -> u32 {
        TOP - self.next - self.spare.len() as u32
    }

    /// Whether a name is one of ours.
    pub fn owns(&self, name: u32) -> bool {
        (self.next + 1..=TOP).contains(&name) && !self.bodies.contains_key(&name)
    }

    /// Where glGenLists would go on without us: above the highest name that the program has used (measured on Mesa 22.3).
    pub fn free(&self, count: u32) -> Option<u32> {
        let first = self.highest + 1;
        (self.next - first >= count).then_some(first)
    }

    /// The program has these names from glGenLists.
    pub fn generated(&mut self, first: u32, count: u32) {
        let last = first.saturating_add(count - 1);
        self.used(last);
        let empty = Body::default();
        self.bodies
            .extend((first..=last).map(|name| (name, empty.clone())));
    }

    fn used(&mut self, name: u32) {
        self.highest = self.highest.max(name.min(TOP - 1));
    }

    /// A list has been compiled; answers the names of the runs that nothing calls any more.
    pub fn define(&mut self, list: u32, body: Body) -> Vec<u32> {
        self.used(list);
        let old = self.bodies.insert(list, body);
        self.release(old)
    }

    /// Lists are deleted; answers the names of their runs.
    pub fn delete(&mut self, first: u32, count: u32) -> Vec<u32> {
        let range = first..first.saturating_add(count);
        let gone: Vec<u32> = if count as usize > self.bodies.len() {
            let known = self.bodies.keys().copied();
            known.filter(|l| range.contains(l)).collect()
        } else {
            range.collect()
        };
        gone.into_iter()
            .flat_map(|list| {
                let old = self.bodies.remove(&list);
                self.release(old)
            })
            .collect()
    }

    fn release(&mut self, body: Option<Body>) -> Vec<u32> {
        let names: Vec<u32> = body.iter().flat_map(|b| b.iter().map(|s| s.name)).collect();
        self.spare.extend(&names);
        names
    }
}

/// When the driver executes what is compiled into the open run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// When the run has ended, or never.
    Later,
    /// At once (GL_COMPILE_AND_EXECUTE).
    Now,
    /// At once, in the program's own view; in the others when the run has ended.
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
/// With GL_COMPILE_AND_EXECUTE the driver itself executes what it compiles, for the program's own view: what it makes of incomplete
/// primitives and of wrong calls is not what it makes of a list that is called.
#[derive(Debug)]
pub struct Compiling {
    /// The program's name for it.
    pub list: u32,
    /// The mode that the program gave.
    pub mode: u32,
    /// Between glBegin and glEnd in it: a run cannot end here.
    pub between: bool,
    /// It enables GL_FRAMEBUFFER_SRGB.
    pub enables_srgb: bool,
    /// How the open run was begun.
    pub start: Start,
    closed: Vec<Segment>,
    open: Segment,
    used: bool,
    matrix_mode: Option<u32>,
    matrices: u32,
    mode_begun: u32,
}

/// A command in a list, as far as it decides about runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Of the kind of a run.
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

fn fresh(name: u32) -> Segment {
    Segment {
        run: Run::Open,
        name,
        touch: Touch::NONE,
        names: Arc::default(),
        immediate: Immediate::default(),
        primitives: true,
        thin: false,
        pops: 0,
        pushes: Vec::new(),
        opens: None,
        closes: false,
    }
}

impl Compiling {
    /// glNewList. `name` is the driver's list of the first run.
    pub fn new(list: u32, mode: u32, name: u32) -> Self {
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

    /// Decides on a command that is about to be compiled; how another run has to be begun for it, if the open one must be ended
    /// first ([`Compiling::split`]).
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
    pub fn split(&mut self, name: u32) {
        let closed = std::mem::replace(&mut self.open, fresh(name));
        self.close(closed);
        (self.used, self.matrices) = (false, 0);
    }

    fn close(&mut self, mut segment: Segment) {
        if !segment.pushes.is_empty() {
            // What stays pushed must be the program's own rectangles.
            segment.touch = segment.touch | Touch::RECTS;
        }
        if self.between {
            segment.opens = Some(self.mode_begun);
        }
        self.closed.push(segment);
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
    pub fn name(&self) -> u32 {
        self.open.name
    }

    /// The run that was closed last.
    pub fn last(&self) -> Option<&Segment> {
        self.closed.last()
    }

    /// Takes note of a command that is compiled into the open run, and of what it touches; answers what that is in this list.
    pub fn note(&mut self, command: Command, touch: Touch) -> Touch {
        let run = self.kind(command);
        // A list that begins within a primitive: nothing but vertices, and the end.
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
        self.open.thin |= match command {
            Command::Begin(mode) => mode <= c::LINE_STRIP,
            // Which mode arrays are drawn in is not known here.
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
            // Its vertices use the current values as they are before it.
            Command::Of(Run::Draw) => self.open.immediate.note(Effect::VERTEX),
            Command::Of(_) | Command::Matrix | Command::Begin(_) => {}
        }
        touch
    }

    /// The names of glCallLists, just compiled into the open run.
    pub fn note_names(&mut self, names: &[u32]) {
        self.open.names = names.into();
    }

    /// glEndList: closes the last run.
    pub fn finish(&mut self) {
        self.split(0);
    }

    /// All runs, after [`Compiling::finish`].
    pub fn body(&self) -> Body {
        self.closed.as_slice().into()
    }

    fn kind(&self, command: Command) -> Run {
        let free = |balanced: bool| if balanced { Run::Open } else { Run::State };
        // Unknown: the mode is that of the time of the call, nearly always the modelview.
        let modelview = self.matrix_mode.is_none_or(|m| m == c::MODELVIEW);
        match command {
            Command::Of(run) => run,
            Command::Begin(_) => Run::Draw,
            // Alone it is an error.
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

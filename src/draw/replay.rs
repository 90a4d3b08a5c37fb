//! Replay: sends the draw itself again for each view, with P_i and the tile's viewport and scissor. Needs no shader.

use super::current::Current;
use super::pixel_size::{PixelSizeGuard, Units};
use crate::atlas::{Grid, Surface, Tiles};
use crate::gl::{Gl, consts as c};
use crate::plan::{Rig, Shear};
use crate::state::{Effect, Indexed, State};
use crate::view::ViewIndex;

/// The state that a draw changes, and that its second sending would start from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReplayHazard {
    /// The draw changes no state that it depends on, so it can be sent again as it is.
    None,
    /// The draw sets current values that its first vertices have used.
    Current(Effect),
    /// The draw may change any state, as a display list may.
    Anything {
        /// It may change viewport or scissor.
        rects: bool,
        /// It may change the projection or the matrix mode.
        projection: bool,
        /// Current values that its first vertices have used: glPopAttrib alone does not restore them (see [`Current`]).
        current: Effect,
    },
    /// It draws at the raster position, in window pixels, and may move it. With a shift, the position was placed under a projection with that
    /// shift, and moves with a point of the scene.
    Raster(Option<Shear>),
    /// It is a clear: without a scissor, one call clears all tiles of a layer.
    Clear,
}

/// Sends the draw once per view, the program's own view last, so that the state is as after the program's own call. `call` sends the draw
/// for a view; a clear is sent once per layer.
///
/// `keeps_state`: the draw changes the state for the program. Otherwise all state is as before the call, also after the program's own view.
///
/// Returns false if the draw could not be sent for the other views, because the attribute stack is full.
#[allow(
    clippy::too_many_arguments,
    reason = "the parts of one draw; a struct of them would be built for this call alone"
)]
pub fn replay(
    gl: &Gl,
    surface: &mut dyn Surface,
    state: &State,
    rig: &Rig,
    shear: Option<Shear>,
    hazard: ReplayHazard,
    keeps_state: bool,
    call: &mut dyn FnMut(ViewIndex),
) -> bool {
    let tiles = surface.tiles();
    let own = tiles.own();
    if hazard == ReplayHazard::Clear && !state.rectangles.scissor_test {
        for row in (0..tiles.rows).rev().filter(|&row| tiles.draws_row(row)) {
            surface.bind_row(gl, row);
            call(own);
        }
        return true;
    }
    let saves = hazard.saves();
    if saves != 0 && stack_is_full(gl) {
        if keeps_state {
            call(own);
        }
        return false;
    }
    let sending = Sending::begin(gl, state, rig, tiles, shear, hazard);
    for view in tiles.order() {
        let x = surface.enter(gl, view);
        sending.enter_tile(view, x);
        if view == own && keeps_state {
            sending.own(call);
        } else {
            sending.send_undone(view, x, call);
        }
        if view == own {
            sending.end(keeps_state);
        }
    }
    true
}

fn stack_is_full(gl: &Gl) -> bool {
    gl.get_integer(c::ATTRIB_STACK_DEPTH) >= gl.get_integer(c::MAX_ATTRIB_STACK_DEPTH)
}

impl ReplayHazard {
    /// The attribute groups that are pushed around each sending, except the program's own.
    fn saves(self) -> u32 {
        match self {
            ReplayHazard::None | ReplayHazard::Clear => 0,
            // It is not known which values an array element or an evaluator sets.
            ReplayHazard::Current(e) if e.has(Effect::UNKNOWN) || e.has(Effect::ATTRIB) => {
                c::CURRENT_BIT | c::LIGHTING_BIT
            }
            ReplayHazard::Current(_) => 0,
            ReplayHazard::Raster(_) => c::CURRENT_BIT,
            ReplayHazard::Anything { .. } => c::ALL_ATTRIB_BITS,
        }
    }

    /// Whether it draws and changes current values at most, so that the matrix mode and the scissor test are set once for all views.
    fn is_draw_alone(self) -> bool {
        match self {
            ReplayHazard::Current(effects) => !effects.has(Effect::UNKNOWN),
            other => other == ReplayHazard::None,
        }
    }
}

/// A draw while it is sent for the views.
struct Sending<'a> {
    gl: &'a Gl,
    state: &'a State,
    rig: &'a Rig,
    tiles: Tiles,
    hazard: ReplayHazard,
    saves: u32,
    projection: Projection<'a>,
    raster: Option<Raster>,
    current: Current,
    pixel_sizes: PixelSizeGuard,
}

impl<'a> Sending<'a> {
    fn begin(
        gl: &'a Gl,
        state: &'a State,
        rig: &'a Rig,
        tiles: Tiles,
        shear: Option<Shear>,
        hazard: ReplayHazard,
    ) -> Self {
        let saves = hazard.saves();
        if saves != 0 {
            gl.flush_current();
        }
        let units = match hazard {
            ReplayHazard::Anything { .. } => Units::All,
            _ => Units::Enabled,
        };
        let pixel_sizes = PixelSizeGuard::enter(gl, state, &tiles.grid, units);
        let current = match hazard {
            ReplayHazard::Current(e) | ReplayHazard::Anything { current: e, .. } => {
                Current::take(gl, e, saves != 0)
            }
            _ => Current::default(),
        };
        let raster = match hazard {
            ReplayHazard::Raster(Some(shear)) => Some(Raster::at(gl, state, shear)),
            _ => None,
        };
        let mut projection = Projection::new(gl, state, shear, tiles.grid);
        if hazard.is_draw_alone() {
            projection.select();
        }
        let sending = Sending {
            gl,
            state,
            rig,
            tiles,
            hazard,
            saves,
            projection,
            raster,
            current,
            pixel_sizes,
        };
        if hazard.is_draw_alone() && sending.beside() {
            enable_scissor(gl, state, &sending.tiles);
        }
        sending
    }

    /// Whether each tile needs a viewport of its own.
    fn beside(&self) -> bool {
        self.tiles.columns > 1 || !self.tiles.grid.is_full()
    }

    /// Whether the draw may change the viewport for the program: in the own view, by a list with viewport or scissor.
    fn is_free(&self, view: ViewIndex) -> bool {
        let rects = matches!(self.hazard, ReplayHazard::Anything { rects: true, .. });
        view == self.tiles.own() && rects
    }

    /// Whether the own view may get P_i. A list that changes the projection has to start from the program's own, even where no view stands in
    /// the middle.
    fn keeps_projection(&self) -> bool {
        !matches!(
            self.hazard,
            ReplayHazard::Anything {
                projection: true,
                ..
            }
        )
    }

    fn enter_tile(&self, view: ViewIndex, x: i32) {
        if self.beside() && !self.is_free(view) {
            if !self.hazard.is_draw_alone() {
                enable_scissor(self.gl, self.state, &self.tiles);
            }
            let noted = !self.hazard.is_draw_alone();
            set_rectangles(self.gl, self.state, &self.tiles, view, x, noted);
        } else if self.beside() {
            self.state.rectangles.put(self.gl);
        }
    }

    fn load_projection(&self, view: ViewIndex) {
        if self.keeps_projection() || view != self.tiles.own() {
            self.projection.load(self.rig.position(view));
        } else {
            self.projection.restore();
        }
    }

    /// Sends the program's own view, whose changes of the state remain.
    fn own(&self, call: &mut dyn FnMut(ViewIndex)) {
        let own = self.tiles.own();
        let place = self.rig.position(own);
        self.load_projection(own);
        self.current.put(self.gl);
        match &self.raster {
            Some(raster) => raster.own(self.gl, place, &mut || call(own)),
            None => call(own),
        }
    }

    /// Sends a view and undoes its changes of the state.
    fn send_undone(&self, view: ViewIndex, x: i32, call: &mut dyn FnMut(ViewIndex)) {
        let gl = self.gl;
        if self.saves != 0 {
            gl.push_attrib(self.saves);
        }
        self.load_projection(view);
        match self.hazard {
            ReplayHazard::Raster(_) => {
                let place = self.rig.position(view);
                let shift = self.raster.map_or(Some(0.0), |r| r.shift(place));
                if let Some(shift) = shift {
                    gl.move_raster(x as f32 + shift, 0.0);
                    call(view);
                }
            }
            ReplayHazard::Anything { .. } => self.anything(view, x, call),
            _ => {
                self.current.put(gl);
                call(view);
            }
        }
        if self.saves != 0 {
            gl.pop_attrib();
        }
    }

    /// Sends a list, which may leave matrices and attributes on the stacks. Pixels and bitmaps in it, before it sets a raster position, lie at
    /// the program's, so that is moved to the tile; it is saved with the attributes.
    fn anything(&self, view: ViewIndex, x: i32, call: &mut dyn FnMut(ViewIndex)) {
        let gl = self.gl;
        let stack = Stack::take(gl, self.state.matrices.mode);
        let attribs = gl.get_integer(c::ATTRIB_STACK_DEPTH);
        self.current.put(gl);
        if x != 0 {
            gl.move_raster(x as f32, 0.0);
        }
        call(view);
        let left = gl.get_integer(c::ATTRIB_STACK_DEPTH);
        (attribs..left).for_each(|_| gl.pop_attrib());
        if let Some(stack) = &stack {
            stack.put(gl);
        }
    }

    /// Restores the state after the program's own view; `keeps_state` as for [`replay`].
    fn end(&self, keeps_state: bool) {
        let own = self.tiles.own();
        if self.beside() && !self.is_free(own) {
            self.state.rectangles.put(self.gl);
        }
        let moved = self.rig.position(own) != 0.0 || self.projection.is_slanted();
        if !keeps_state || self.keeps_projection() && moved {
            self.projection.restore();
        }
        self.projection.leave();
        if !keeps_state {
            self.current.put(self.gl);
        }
        self.pixel_sizes.leave(self.gl);
    }
}

/// Sets up the program's own view for a command that the driver executes first; [`others`] ends it.
pub fn enter_own(
    gl: &Gl,
    surface: &mut dyn Surface,
    state: &State,
    rig: &Rig,
    shear: Option<Shear>,
) {
    let tiles = surface.tiles();
    let x = surface.enter(gl, tiles.own());
    if tiles.columns > 1 || !tiles.grid.is_full() {
        set_tile_viewport(gl, state, &tiles, tiles.own(), x);
    }
    let projection = Projection::new(gl, state, shear, tiles.grid);
    if rig.position(tiles.own()) != 0.0 || projection.is_slanted() {
        projection.load(rig.position(tiles.own()));
    }
}

/// After [`enter_own`]: sends the other views, if `wanted`, and restores the program's state.
pub fn others(
    gl: &Gl,
    surface: &mut dyn Surface,
    state: &State,
    rig: &Rig,
    shear: Option<Shear>,
    wanted: bool,
    call: &mut dyn FnMut(ViewIndex),
) {
    let tiles = surface.tiles();
    let (own, beside) = (tiles.own(), tiles.columns > 1 || !tiles.grid.is_full());
    let projection = Projection::new(gl, state, shear, tiles.grid);
    for view in tiles.order().filter(|&v| wanted && v != own) {
        let x = surface.enter(gl, view);
        if beside {
            set_tile_viewport(gl, state, &tiles, view, x);
        }
        projection.load(rig.position(view));
        call(view);
    }
    surface.enter(gl, own);
    if beside {
        state.rectangles.put(gl);
    }
    projection.restore();
}

/// Sets the program's viewport and scissor in the tile of a view, which begins at `offset` pixels; the scissor is cut to the tile.
pub fn set_tile_viewport(gl: &Gl, state: &State, tiles: &Tiles, view: ViewIndex, offset: i32) {
    enable_scissor(gl, state, tiles);
    set_rectangles(gl, state, tiles, view, offset, true);
}

/// Turns the scissor test on, which keeps draws in their tiles. With several rectangles, [`set_rectangles`] does.
fn enable_scissor(gl: &Gl, state: &State, tiles: &Tiles) {
    let several = state.rectangles.are_several() && tiles.grid.is_full();
    if !several && !state.rectangles.scissor_test {
        gl.enable(c::SCISSOR_TEST);
    }
}

/// [`set_tile_viewport`] while the scissor test is on. `noted`: something may ask for the rectangles before the program's are set again.
fn set_rectangles(
    gl: &Gl,
    state: &State,
    tiles: &Tiles,
    view: ViewIndex,
    offset: i32,
    noted: bool,
) {
    if state.rectangles.are_several() && tiles.grid.is_full() {
        for (index, own) in (0..).zip(&state.rectangles.indexed) {
            let [x, y, w, h] = own.viewport;
            let scissor = own.scissor_test.then_some(own.scissor);
            let placed = Indexed {
                viewport: [x + offset as f32, y, w, h],
                scissor: cut_by(scissor, tiles, view, offset),
                scissor_test: true,
            };
            placed.put(gl, index);
        }
        return;
    }
    let scissor = cut(state, tiles, view, offset);
    if !tiles.grid.is_full() {
        gl.viewport_f(tiles.grid.viewport(view, offset, state.rectangles.viewport));
    } else {
        let [x, y, w, h] = state.rectangles.viewport;
        match noted {
            true => gl.viewport(x + offset, y, w, h),
            false => gl.viewport_of_view([x + offset, y, w, h]),
        }
    }
    match (noted, scissor) {
        (true, [x, y, w, h]) => gl.scissor(x, y, w, h),
        (false, scissor) => gl.scissor_of_view(scissor),
    }
}

/// The scissor rectangle of a tile, in pixels of the atlas: the whole tile, or the program's scissor in it.
pub fn cut(state: &State, tiles: &Tiles, view: ViewIndex, offset: i32) -> [i32; 4] {
    let rectangles = &state.rectangles;
    let scissor = rectangles.scissor_test.then_some(rectangles.scissor);
    cut_by(scissor, tiles, view, offset)
}

/// [`cut`] for one of the program's scissor rectangles.
fn cut_by(scissor: Option<[i32; 4]>, tiles: &Tiles, view: ViewIndex, offset: i32) -> [i32; 4] {
    let size = [tiles.width as i32, tiles.height as i32];
    let Some([x, y, w, h]) = scissor else {
        return [offset, 0, size[0], size[1]];
    };
    let [[x0, x1], [y0, y1]] = [(x, w, 0), (y, h, 1)].map(|(from, length, axis)| {
        let ends = [from, from.saturating_add(length)];
        let ends = if tiles.grid.is_full() {
            ends
        } else {
            tiles.grid.texels(view, axis, ends[0], ends[1])
        };
        ends.map(|end| end.clamp(0, size[axis]))
    });
    [x0 + offset, y0, (x1 - x0).max(0), (y1 - y0).max(0)]
}

/// A raster position that moves with a point of the scene.
#[derive(Clone, Copy)]
struct Raster {
    shear: Shear,
    /// Window x, relative to the viewport, and clip-space w.
    x: f64,
    w: f64,
    /// Width of the viewport in pixels.
    width: f64,
}

/// Movements of the raster position are rounded to this fraction of a pixel, because they are differences of two single-precision sums.
const STEPS: f32 = 1024.0;

impl Raster {
    fn at(gl: &Gl, state: &State, shear: Shear) -> Raster {
        let [x, _, _, w] = gl.get_floats::<4>(c::CURRENT_RASTER_POSITION);
        let [left, _, width, _] = state.rectangles.viewport;
        Raster {
            shear,
            x: f64::from(x) - f64::from(left),
            w: f64::from(w),
            width: f64::from(width),
        }
    }

    /// Shift of the raster position in the view at a place, in pixels; `None` where it leaves the viewport, which makes the position
    /// invalid.
    fn shift(&self, place: f64) -> Option<f32> {
        let clip = self.shear.separation(place) * (self.w - self.shear.conv);
        let shift = clip / self.w * self.width / 2.0;
        let inside = place == 0.0 || (0.0..=self.width).contains(&(self.x + shift));
        (inside && shift.is_finite()).then_some(shift as f32)
    }

    /// Sends the program's own view: the movement by the draw is kept, the shift of the view is undone.
    fn own(&self, gl: &Gl, place: f64, call: &mut dyn FnMut()) {
        let shift = self.shift(place);
        if shift == Some(0.0) {
            return call();
        }
        let x = || gl.get_floats::<1>(c::CURRENT_RASTER_POSITION)[0];
        let y = || gl.get_floats::<2>(c::CURRENT_RASTER_POSITION)[1];
        gl.push_attrib(c::CURRENT_BIT);
        gl.move_raster(shift.unwrap_or(2.0 * self.width as f32), 0.0);
        let before = [x(), y()];
        call();
        let moved = [x() - before[0], y() - before[1]].map(|d| (d * STEPS).round() / STEPS);
        gl.pop_attrib();
        if moved != [0.0; 2] {
            gl.move_raster(moved[0], moved[1]);
        }
    }
}

/// The matrix stack that a list works on: that of the matrix mode in which it is called.
struct Stack {
    mode: u32,
    depth_name: u32,
    depth: i32,
    top: [f32; 16],
}

impl Stack {
    fn take(gl: &Gl, mode: u32) -> Option<Stack> {
        let (top, depth_name) = match mode {
            c::MODELVIEW => (c::MODELVIEW_MATRIX, c::MODELVIEW_STACK_DEPTH),
            c::PROJECTION => (c::PROJECTION_MATRIX, c::PROJECTION_STACK_DEPTH),
            c::TEXTURE => (c::TEXTURE_MATRIX, c::TEXTURE_STACK_DEPTH),
            _ => return None,
        };
        Some(Stack {
            mode,
            depth_name,
            depth: gl.get_integer(depth_name),
            top: gl.get_matrix(top),
        })
    }

    /// Restores depth, top and matrix mode.
    fn put(&self, gl: &Gl) {
        gl.matrix_mode(self.mode);
        let now = gl.get_integer(self.depth_name);
        (self.depth..now).for_each(|_| gl.pop_matrix());
        (now..self.depth).for_each(|_| gl.push_matrix());
        gl.load_matrix(&self.top);
    }
}

struct Projection<'a> {
    gl: &'a Gl,
    state: &'a State,
    shear: Option<Shear>,
    grid: Grid,
    /// The matrix mode is GL_PROJECTION until [`Projection::leave`].
    selected: bool,
}

impl<'a> Projection<'a> {
    fn new(gl: &'a Gl, state: &'a State, shear: Option<Shear>, grid: Grid) -> Self {
        Projection {
            gl,
            state,
            shear,
            grid,
            selected: false,
        }
    }

    /// Sets the matrix mode for all that is loaded until [`Projection::leave`].
    fn select(&mut self) {
        self.selected = self.loads() && self.state.matrices.mode != c::PROJECTION;
        if self.selected {
            self.gl.matrix_mode(c::PROJECTION);
        }
    }

    /// Restores the matrix mode after [`Projection::select`].
    fn leave(&self) {
        if self.selected {
            self.gl.matrix_mode(self.state.matrices.mode);
        }
    }

    /// Whether it loads anything: not for a flat draw in upright tiles.
    fn loads(&self) -> bool {
        self.shear.is_some() || self.is_slanted()
    }

    /// Whether slanted tiles need another projection than P_i.
    fn is_slanted(&self) -> bool {
        self.grid.shear != 0.0
    }

    /// Loads P_i of the view at a place, slanted if the tiles are; loads nothing for a flat draw in upright tiles. Restores the matrix mode.
    fn load(&self, place: f64) {
        let p = &self.state.matrices.projection;
        let p = match &self.shear {
            Some(shear) => shear.projection(p, place),
            None if self.is_slanted() => *p,
            None => return,
        };
        let p = match self.is_slanted() {
            true => self.grid.slant(self.state.rectangles.viewport, &p),
            false => p,
        };
        match self.selected {
            true => self.gl.load_matrix_of_view(&p),
            false => self.put(&p),
        }
    }

    /// Loads the program's own projection again.
    fn restore(&self) {
        if self.loads() {
            self.put(&self.state.matrices.projection);
        }
    }

    fn put(&self, p: &[f32; 16]) {
        let mode = self.state.matrices.mode;
        let switch = !self.selected && mode != c::PROJECTION;
        if switch {
            self.gl.matrix_mode(c::PROJECTION);
        }
        self.gl.load_matrix(p);
        if switch {
            self.gl.matrix_mode(mode);
        }
    }
}

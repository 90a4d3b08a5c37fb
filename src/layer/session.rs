//! A context's settings and capabilities, and the group that shares its objects: all that holds for as long as the context is under the
//! layer.

use super::{Member, OnScreen, Panel, Support, auto};
use crate::config::{Config, Live, Profile, Strategy};
use crate::control::Ramp;
use crate::display::{Display, Kind, Placement};
use crate::gl::Gl;
use crate::plan::decide::has_depths_of_replay;
use std::sync::Arc;

/// A context's settings and support.
#[derive(Debug)]
pub(super) struct Session {
    pub(super) config: &'static Config,
    pub(super) support: Support,
    /// The strategy in force: the one that the user has asked for, or that `auto` uses now.
    pub(super) strategy: Strategy,
    pub(super) group: Arc<Member>,
    /// The values that the user may change while the program runs.
    pub(super) live: Live,
    /// The way to the cameras of a preset, until they have arrived.
    pub(super) ramp: Option<Ramp>,
    /// The rules for the program's draws, as the user's file last had them.
    pub(super) profile: Arc<Profile>,
    /// Position of the window; none where the window system does not report it.
    pub(super) on_screen: Option<OnScreen>,
    pub(super) panel: Panel,
    /// Where the pointer is, in pixels of the window from its left and lower edge, once something asks for it.
    pub(super) pointer: Option<[i32; 2]>,
    /// The display with other numbers of its lens sheet, once they have been changed.
    fitted: Option<Display>,
    pub(super) auto: Option<auto::Auto>,
}

impl Session {
    /// For a context that was just made current; `program` is the name of the program's file.
    pub(super) fn new(
        gl: &Gl,
        config: &'static Config,
        support: Support,
        group: Arc<Member>,
        program: Option<&str>,
    ) -> Self {
        let all: Vec<Strategy> = [
            (Strategy::Replay, true),
            (Strategy::Instanced, support.instanced() || support.layers()),
            (Strategy::Geometry, support.geometry()),
            (Strategy::Splats, support.point_quads() && !gl.is_es()),
        ]
        .into_iter()
        .filter_map(|(strategy, there)| there.then_some(strategy))
        .collect();
        let auto = auto::Auto::new(gl, config, program, &all);
        Session {
            config,
            support,
            strategy: auto.as_ref().map_or(config.strategy, auto::Auto::strategy),
            group,
            live: Live::new(config),
            ramp: None,
            profile: Arc::new(config.profile.clone()),
            on_screen: None,
            panel: Panel::default(),
            pointer: None,
            fitted: None,
            auto,
        }
    }

    /// The strategy that the user has chosen, or that `auto` uses now. [`Session::strategy`] is another one while a proof replays.
    pub(super) fn chosen(&self) -> Strategy {
        let auto = self.auto.as_ref();
        auto.map_or(self.config.strategy, auto::Auto::strategy)
    }

    /// The display, with the numbers of its lens sheet in force.
    pub(super) fn display(&self) -> &Display {
        self.fitted.as_ref().unwrap_or(&self.config.display)
    }

    /// Puts other values in force.
    pub(super) fn adopt(&mut self, live: Live) {
        if let Some(lens) = live.lens
            && live.lens != self.live.lens
        {
            let config = self.config;
            let display = self.fitted.get_or_insert_with(|| config.display.clone());
            display.set_lens(lens);
        }
        self.live = live;
    }

    /// Sets the position of the window; none where the window system does not report it.
    pub(super) fn moved(&mut self, on_screen: Option<OnScreen>) {
        self.on_screen = on_screen;
    }

    /// Place on the panel of the picture of a window of this size, all in pixels.
    pub(super) fn placement(&self, window: (u32, u32)) -> Placement {
        match (self.panel.size, &self.config.panel) {
            (Some((width, height)), Some(config)) => match self.display().kind {
                Kind::Wall(_) => Placement::full_screen(width, height),
                _ => config.fit.place(window, (width, height)),
            },
            _ => self.window_placement(window),
        }
    }

    /// Pixels of the panel over which the picture of a window of this size is spread, from its left to its right.
    pub(super) fn picture_width(&self, window: (u32, u32)) -> u32 {
        match (&self.display().kind, self.panel.size, &self.config.panel) {
            (Kind::Wall(wall), Some(_), Some(config)) => wall.picture_width(window, config.fit),
            _ => self.placement(window).width,
        }
    }

    /// Place of the picture of a window of this size on the screen, all in pixels. Where the window system does not report it, the picture is
    /// taken to be the whole screen.
    pub(super) fn window_placement(&self, (width, height): (u32, u32)) -> Placement {
        let whole = Placement::full_screen(width, height);
        let at = self.on_screen.map(|on_screen| Placement {
            screen_width: on_screen.screen.0,
            screen_height: on_screen.screen.1,
            x: on_screen.at.0,
            y: on_screen.at.1,
            ..whole
        });
        at.unwrap_or(whole)
    }

    /// Whether amplified draws have exactly the depths of replayed ones.
    pub(super) fn same_depths(&self) -> bool {
        let distances = self.config.clip.is_some();
        has_depths_of_replay(self.strategy, self.support.layers(), distances)
    }
}

//! A context's settings and capabilities, and the group that shares its objects: all that holds for as long as the context is under the
//! layer.

use super::{Member, OnScreen, Support, auto};
use crate::config::{Config, Live, Strategy};
use crate::display::Display;
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
    /// Position of the window; none where the window system does not report it.
    pub(super) on_screen: Option<OnScreen>,
    /// The display with other numbers of its lens sheet, once they have been changed.
    pub(super) fitted: Option<Display>,
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
            on_screen: None,
            fitted: None,
            auto,
        }
    }

    /// Whether amplified draws have exactly the depths of replayed ones.
    pub(super) fn same_depths(&self) -> bool {
        let distances = self.config.clip.is_some();
        has_depths_of_replay(self.strategy, self.support.layers(), distances)
    }
}

//! Which panel `manyview run` shows on.
#![forbid(unsafe_code)]

use super::error::CommandError;
use manyview::config::{Config, OptionId, Origin, PanelWindow, Settings};
use manyview::display::{Display, Kind};
use manyview::plugged::{Chosen, Panel, Plugged};
use manyview::window::{PanelServer, WindowError, monitor_for};

/// What is shown where there is no panel.
const ANAGLYPH: &str = "anaglyph";

/// Without a display and an output, takes the panel that is set up or plugged in, else an anaglyph. Returns the line that says so, for when the program is started.
pub(super) fn choose(settings: &mut Settings) -> Result<Option<String>, CommandError> {
    let given = |id| settings.get(id).is_some();
    if given(OptionId::Display) || given(OptionId::Output) || is_one_view(settings) {
        return Ok(None);
    }
    if let Some(chosen) = Chosen::read()? {
        let origin = Origin::File(Chosen::place()?);
        if let Some(monitor) = chosen.panel {
            give_window(settings, monitor, origin.clone());
        }
        settings.set(OptionId::Display, chosen.display, origin);
        return Ok(None);
    }
    let said = match Plugged::find().panel() {
        Panel::Calibrated {
            file,
            name,
            monitor,
        } => {
            let place = match &monitor {
                Some(monitor) => format!("monitor {monitor}"),
                None => "the program's own window".to_owned(),
            };
            if let Some(monitor) = monitor {
                give_window(settings, monitor, Origin::Default);
            }
            settings.set(OptionId::Display, file.to_string_lossy(), Origin::Default);
            return Ok(Some(format!(
                "shows on {name}, which is plugged in, in {place}"
            )));
        }
        Panel::Uncalibrated(name) => format!(
            "{name} is plugged in and its calibration is not found, so this is an anaglyph for red-cyan glasses; mount the drive that \
             the device has, or copy its visual.json and give it with --display"
        ),
        Panel::None => "no panel is plugged in or set up, so this is an anaglyph for red-cyan glasses; `manyview displays` says how a panel is set up".to_owned(),
    };
    settings.set(OptionId::Output, ANAGLYPH, Origin::Default);
    Ok(Some(said))
}

/// One view needs no panel: it stays in the program's window, as it is.
fn is_one_view(settings: &Settings) -> bool {
    let views = settings.field(OptionId::Views);
    views.is_some_and(|(_, views)| views == "1")
}

/// Sets the monitor of the panel's window, unless the user has.
fn give_window(settings: &mut Settings, monitor: String, origin: Origin) {
    if settings.get(OptionId::Panel).is_none() {
        settings.set(OptionId::Panel, monitor, origin);
    }
}

/// Opens the panel's own window, if one is wanted: on the monitor that is named, else on the one that the display says it is, else by its size.
pub(super) fn open(config: &Config) -> Result<Option<PanelServer>, WindowError> {
    let Some(panel) = &config.panel else {
        return Ok(None);
    };
    if let Kind::Wall(wall) = &config.display.kind {
        return PanelServer::open_wall(wall).map(Some);
    }
    let monitor = monitor(panel, &config.display);
    PanelServer::open(monitor.as_deref(), config.display.facts.screen).map(Some)
}

/// Pixels of the panel: those of its description, else of the monitor on which its window would be opened.
pub(super) fn size(config: &Config) -> Result<Option<(u32, u32)>, WindowError> {
    let Some(panel) = &config.panel else {
        return Ok(None);
    };
    if let Kind::Wall(wall) = &config.display.kind {
        return Ok(Some(wall.sheet()));
    }
    let screen = config.display.facts.screen;
    if let (None, Some(screen)) = (&panel.monitor, screen) {
        return Ok(Some(screen));
    }
    let monitor = monitor(panel, &config.display);
    Ok(Some(monitor_for(monitor.as_deref(), screen)?.size))
}

/// The monitor that is named, else the one that the display says it is.
fn monitor(panel: &PanelWindow, display: &Display) -> Option<String> {
    panel.monitor.clone().or_else(|| {
        let plugged = Plugged::find();
        let found = plugged.monitor_of(display)?;
        Some(found.monitor.name.clone())
    })
}

//! Wakes an idle program: a request waits for the next frame, which a program that draws only on demand may never show.
//!
//! The X server is asked to tell all windows of the program that they were uncovered. Toolkits then draw them anew; a program that draws all the
//! time, or has no use for the event, goes on as before.
#![forbid(unsafe_code)]

use std::path::Path;
use x11rb::connection::{Connection, RequestConnection};
use x11rb::protocol::res::{self, ClientIdMask, ClientIdSpec, ConnectionExt as _};
use x11rb::protocol::xproto::{
    ConnectionExt as _, EXPOSE_EVENT, EventMask, ExposeEvent, MapState, Window,
};

/// The most windows that are looked at.
const WINDOWS: usize = 10_000;

/// Makes a process draw its windows anew. None where that is not possible: it has no windows of an X server, or the server does not tell whose windows
/// they are.
pub fn wake(pid: u32) -> Option<()> {
    // Both run as the same user, but not always on the same display.
    let theirs = display_of(pid);
    let (connection, _) = x11rb::connect(theirs.as_deref()).ok()?;
    connection
        .extension_information(res::X11_EXTENSION_NAME)
        .ok()??;
    connection.res_query_version(1, 2).ok()?.reply().ok()?;
    let clients = connection.res_query_clients().ok()?.reply().ok()?.clients;
    let all = ClientIdSpec {
        client: 0,
        mask: ClientIdMask::LOCAL_CLIENT_PID,
    };
    let ids = connection.res_query_client_ids(&[all]).ok()?.reply().ok()?;
    let ids = ids.ids.iter().filter(|id| id.value.first() == Some(&pid));
    let own: Vec<_> = ids
        .filter_map(|id| {
            clients
                .iter()
                .find(|client| id.spec.client & !client.resource_mask == client.resource_base)
        })
        .collect();
    let roots = connection.setup().roots.iter().map(|screen| screen.root);
    let mut windows: Vec<Window> = roots.collect();
    let mut next = 0;
    while let Some(&window) = windows.get(next) {
        next += 1;
        if own
            .iter()
            .any(|client| window & !client.resource_mask == client.resource_base)
        {
            expose(&connection, window);
        }
        // A window may be gone by now.
        if windows.len() < WINDOWS
            && let Ok(tree) = connection.query_tree(window)
            && let Ok(tree) = tree.reply()
        {
            windows.extend(tree.children);
        }
    }
    connection.flush().ok()
}

/// Tells a window that it was uncovered, if it can be seen.
fn expose(connection: &impl Connection, window: Window) -> Option<()> {
    let about = connection
        .get_window_attributes(window)
        .ok()?
        .reply()
        .ok()?;
    let size = connection.get_geometry(window).ok()?.reply().ok()?;
    let event = ExposeEvent {
        response_type: EXPOSE_EVENT,
        sequence: 0,
        window,
        x: 0,
        y: 0,
        width: size.width,
        height: size.height,
        count: 0,
    };
    if about.map_state == MapState::VIEWABLE {
        let sent = connection.send_event(false, window, EventMask::EXPOSURE, event);
        sent.ok()?.ignore_error();
    }
    Some(())
}

/// The X display of a process.
fn display_of(pid: u32) -> Option<String> {
    let environment =
        std::fs::read(Path::new("/proc").join(pid.to_string()).join("environ")).ok()?;
    let mut variables = environment.split(|byte| *byte == 0);
    let display = variables.find_map(|variable| variable.strip_prefix(b"DISPLAY="))?;
    String::from_utf8(display.to_vec()).ok()
}

//! A user at an X server, who presses keys and looks at windows.

use image::{Rgb, RgbImage};
use x11rb::connection::Connection;
use x11rb::protocol::randr::{ConnectionExt as _, MonitorInfo};
use x11rb::protocol::xproto::{
    AtomEnum, BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ChangeWindowAttributesAux,
    ConfigureWindowAux, ConnectionExt as _, CreateWindowAux, ImageFormat, InputFocus,
    KEY_PRESS_EVENT, KEY_RELEASE_EVENT, MOTION_NOTIFY_EVENT, MapState, PropMode, Window,
    WindowClass,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

pub(crate) const SHIFT: u32 = 0xffe1;
pub(crate) const CONTROL: u32 = 0xffe3;
pub(crate) const ALT: u32 = 0xffe9;

pub(crate) struct User {
    pub(crate) connection: RustConnection,
    pub(crate) root: Window,
    keysyms: Vec<u32>,
    per_code: usize,
}

impl User {
    pub(crate) fn at(display: &str) -> Self {
        let (connection, screen) = RustConnection::connect(Some(display)).expect("an X server");
        let setup = connection.setup();
        let root = setup.roots[screen].root;
        let codes = setup.max_keycode - setup.min_keycode + 1;
        let mapping = connection.get_keyboard_mapping(setup.min_keycode, codes);
        let mapping = mapping.expect("sent").reply().expect("a keyboard");
        User {
            root,
            keysyms: mapping.keysyms,
            per_code: mapping.keysyms_per_keycode.into(),
            connection,
        }
    }

    fn code(&self, keysym: u32) -> u8 {
        let mut first = self.keysyms.iter().step_by(self.per_code);
        let at = first.position(|&found| found == keysym).expect("the key");
        self.connection.setup().min_keycode + at as u8
    }

    /// Presses keys in their order and releases them.
    pub(crate) fn press(&self, keys: &[u32]) {
        let codes: Vec<_> = keys.iter().map(|&key| self.code(key)).collect();
        let down = codes.iter().map(|&code| (KEY_PRESS_EVENT, code));
        let up = codes.iter().rev().map(|&code| (KEY_RELEASE_EVENT, code));
        for (kind, code) in down.chain(up) {
            self.send(kind, code);
        }
        self.connection.sync().expect("a server");
    }

    /// Presses a key without releasing it, or releases it.
    pub(crate) fn hold(&self, key: u32, down: bool) {
        let kind = if down {
            KEY_PRESS_EVENT
        } else {
            KEY_RELEASE_EVENT
        };
        self.send(kind, self.code(key));
        self.connection.sync().expect("a server");
    }

    fn send(&self, kind: u8, code: u8) {
        let sent = self
            .connection
            .xtest_fake_input(kind, code, 0, self.root, 0, 0, 0);
        sent.expect("sent").check().expect("XTEST");
    }

    /// Moves the pointer to a place of the screen.
    pub(crate) fn point(&self, at: [i16; 2]) {
        self.mouse(MOTION_NOTIFY_EVENT, 0, at);
        self.connection.sync().expect("a server");
    }

    fn mouse(&self, kind: u8, detail: u8, [x, y]: [i16; 2]) {
        let sent = self
            .connection
            .xtest_fake_input(kind, detail, 0, self.root, x, y, 0);
        sent.expect("sent").check().expect("XTEST");
    }

    /// Moves the mouse from one place of the screen to another with its left button down.
    pub(crate) fn drag(&self, from: [i16; 2], to: [i16; 2]) {
        self.mouse(MOTION_NOTIFY_EVENT, 0, from);
        self.mouse(BUTTON_PRESS_EVENT, 1, from);
        self.mouse(MOTION_NOTIFY_EVENT, 0, to);
        self.mouse(BUTTON_RELEASE_EVENT, 1, to);
        self.connection.sync().expect("a server");
    }

    /// The children of the root window that can be seen: the server gives no picture, and no keyboard focus, of others.
    pub(crate) fn windows(&self) -> Vec<Window> {
        let tree = self.connection.query_tree(self.root).expect("sent").reply();
        let mut all = tree.expect("a tree").children;
        all.retain(|window| {
            let asked = self.connection.get_window_attributes(*window);
            let about = asked.expect("sent").reply();
            about.is_ok_and(|about| about.map_state == MapState::VIEWABLE)
        });
        all
    }

    /// Opens a window in another one and maps it.
    pub(crate) fn open(&self, parent: Window) -> Window {
        let id = self.connection.generate_id().expect("an id");
        let about = CreateWindowAux::new().override_redirect(1);
        let class = WindowClass::COPY_FROM_PARENT;
        let made = self
            .connection
            .create_window(0, id, parent, 200, 200, 9, 9, 0, class, 0, &about);
        made.expect("sent").check().expect("a window");
        self.connection
            .map_window(id)
            .expect("sent")
            .check()
            .expect("mapped");
        id
    }

    /// Fills a window with a colour.
    pub(crate) fn paint(&self, window: Window, colour: u32) {
        let about = ChangeWindowAttributesAux::new().background_pixel(colour);
        let set = self.connection.change_window_attributes(window, &about);
        set.expect("sent").check().expect("set");
        let cleared = self.connection.clear_area(false, window, 0, 0, 0, 0);
        cleared.expect("sent").check().expect("cleared");
    }

    /// Gives a window the keyboard focus.
    pub(crate) fn focus(&self, window: Window) {
        let (to, now) = (InputFocus::PARENT, x11rb::CURRENT_TIME);
        let given = self.connection.set_input_focus(to, window, now);
        given.expect("sent").check().expect("focus");
    }

    /// Adds a monitor to the screen: a name, left, top, width and height.
    pub(crate) fn add_monitor(&self, name: &str, place: [i16; 4]) {
        self.add_output(name, place, Vec::new());
    }

    /// Adds the monitor that the screen's only output drives, and gives the output an EDID.
    pub(crate) fn plug_in(&self, name: &str, place: [i16; 4], edid: &[u8]) {
        let asked = self.connection.randr_get_screen_resources(self.root);
        let output = asked.expect("sent").reply().expect("outputs").outputs[0];
        let atom = self.connection.intern_atom(false, b"EDID").expect("sent");
        let (atom, length) = (atom.reply().expect("a name").atom, edid.len() as u32);
        let (kind, mode) = (AtomEnum::INTEGER.into(), PropMode::REPLACE);
        let set = self
            .connection
            .randr_change_output_property(output, atom, kind, 8, mode, length, edid);
        set.expect("sent").check().expect("a property");
        self.add_output(name, place, vec![output]);
    }

    fn add_output(&self, name: &str, [x, y, width, height]: [i16; 4], outputs: Vec<u32>) {
        let atom = self.connection.intern_atom(false, name.as_bytes());
        let monitor = MonitorInfo {
            name: atom.expect("sent").reply().expect("a name").atom,
            primary: false,
            automatic: false,
            x,
            y,
            width: width.unsigned_abs(),
            height: height.unsigned_abs(),
            width_in_millimeters: 300,
            height_in_millimeters: 200,
            outputs,
        };
        let added = self.connection.randr_set_monitor(self.root, monitor);
        added.expect("sent").check().expect("a monitor");
    }

    /// The window with the keyboard focus.
    pub(crate) fn focused(&self) -> Window {
        let asked = self.connection.get_input_focus().expect("sent");
        asked.reply().expect("a focus").focus
    }

    /// Destroys another program's window, as a server does that takes it away.
    pub(crate) fn destroy(&self, window: Window) {
        let destroyed = self.connection.destroy_window(window).expect("sent");
        destroyed.check().expect("destroyed");
    }

    /// The child of the root window with this name.
    pub(crate) fn window(&self, name: &str) -> Option<Window> {
        let atom = self.connection.intern_atom(false, b"_NET_WM_NAME");
        let atom = atom.expect("sent").reply().expect("a name").atom;
        let named = |window: &Window| {
            [AtomEnum::WM_NAME.into(), atom]
                .into_iter()
                .any(|property| {
                    let cookie = self.connection.get_property(
                        false,
                        *window,
                        property,
                        AtomEnum::ANY,
                        0,
                        99,
                    );
                    let value = cookie.expect("sent").reply();
                    value.is_ok_and(|found| found.value == name.as_bytes())
                })
        };
        self.windows().into_iter().find(named)
    }

    /// Moves a window as a window manager does.
    pub(crate) fn move_to(&self, window: Window, [x, y]: [i16; 2]) {
        let to = ConfigureWindowAux::new().x(i32::from(x)).y(i32::from(y));
        let moved = self.connection.configure_window(window, &to);
        moved.expect("sent").check().expect("moved");
    }

    /// Gives a window left, top, width and height, as a window manager does.
    pub(crate) fn put(&self, window: Window, [x, y, width, height]: [i16; 4]) {
        let to = ConfigureWindowAux::new()
            .x(i32::from(x))
            .y(i32::from(y))
            .width(u32::from(width.unsigned_abs()))
            .height(u32::from(height.unsigned_abs()));
        let placed = self.connection.configure_window(window, &to);
        placed.expect("sent").check().expect("placed");
    }

    /// Left and top of a child of the root window, in pixels of the screen.
    pub(crate) fn place(&self, window: Window) -> [i16; 2] {
        let asked = self.connection.get_geometry(window).expect("sent");
        let about = asked.reply().expect("a window");
        [about.x, about.y]
    }

    /// The pixels of a window.
    pub(crate) fn picture(&self, window: Window) -> RgbImage {
        let about = self
            .connection
            .get_geometry(window)
            .expect("sent")
            .reply()
            .expect("a window");
        let (width, height) = (about.width, about.height);
        let cookie =
            self.connection
                .get_image(ImageFormat::Z_PIXMAP, window, 0, 0, width, height, !0);
        let data = cookie.expect("sent").reply().expect("a picture").data;
        RgbImage::from_fn(width.into(), height.into(), |x, y| {
            let at = 4 * (y as usize * usize::from(width) + x as usize);
            Rgb([data[at + 2], data[at + 1], data[at]])
        })
    }
}

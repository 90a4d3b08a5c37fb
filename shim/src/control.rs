//! The socket for `manyview ctl`. It is served once per frame, on the thread that shows the frame. Nothing here waits.
//!
//! The descriptors live in the program's table; see [`crate::socket`].

use crate::live::{self, free};
use crate::socket::{self, Checked};
use crate::switch::{config, say};
use manyview_core::control::{self, Answer, ControlError, Lines, place};
use manyview_core::layer::{Layer, Pictured, Wanted};
use std::io::Read;
use std::os::fd::AsRawFd;
use std::os::unix::fs::MetadataExt;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

/// The most clients at the same time.
const CLIENTS: usize = 8;
/// The most connections accepted per frame. A connection that has ended by the next frame leaves room for another one.
const ACCEPTED: usize = CLIENTS;
/// Bytes of unread answers of a client, above which its further requests wait.
const UNREAD: usize = 64 * 1024;

/// The socket of this process.
pub(crate) enum State {
    /// No frame has been shown yet, or the last context is gone.
    Unopened,
    Open(Server),
    /// Closed for good.
    Closed,
}

pub(crate) struct Server {
    listener: Checked<UnixListener>,
    path: PathBuf,
    /// Device and inode of the socket's file.
    file: Option<(u64, u64)>,
    /// The process that opened the socket. After fork, a child has our memory and our descriptors, and must not answer.
    pid: u32,
    user: u32,
    clients: Vec<Client>,
    /// What a client waits for and the next frame is to give.
    wanted: Option<Wanted>,
}

struct Client {
    stream: Checked<UnixStream>,
    lines: Lines,
    answers: Vec<u8>,
    /// The client waits for a picture.
    waits: bool,
    /// The client sends no more, or has sent a line that is too long.
    done: bool,
}

static STATE: Mutex<State> = Mutex::new(State::Unopened);

fn wanted() -> bool {
    config().is_some_and(|config| config.control)
}

/// Before a frame is shown: gives the layer the picture that a client waits for.
pub(crate) fn before(layer: &mut Layer) {
    if !wanted() {
        return;
    }
    if let Some(mut state) = free(&STATE)
        && let State::Open(server) = &mut *state
        && server.pid == std::process::id()
        && let Some(wanted) = server.wanted.take()
    {
        layer.picture(wanted);
    }
}

/// After a frame was shown: serves the clients, so that changes apply to the whole next frame.
pub(crate) fn after(layer: &mut Layer) {
    if !wanted() {
        return;
    }
    let Some(mut state) = free(&STATE) else {
        return;
    };
    if let State::Unopened = *state {
        *state = match Server::open() {
            Ok(server) => State::Open(server),
            Err(error) => {
                say(&error.to_string());
                layer.note(error.to_string());
                State::Closed
            }
        };
    }
    if let State::Open(server) = &mut *state
        && !(server.pid == std::process::id() && server.serve(layer))
    {
        *state = State::Closed;
    }
}

/// Removes the socket. With `next` as [`State::Unopened`] it may be opened again.
pub(crate) fn close(next: State) {
    if !wanted() {
        return;
    }
    let Some(mut state) = free(&STATE) else {
        return;
    };
    if let State::Open(server) = &*state
        && server.pid == std::process::id()
        && server.file.is_some()
        && server.file == file(&server.path)
    {
        let _ = std::fs::remove_file(&server.path);
    }
    // A socket that is closed for good stays closed.
    if let State::Open(_) | State::Unopened = *state {
        *state = next;
    }
}

/// Device and inode of a path; links are not followed.
fn file(path: &std::path::Path) -> Option<(u64, u64)> {
    let about = std::fs::symlink_metadata(path).ok()?;
    Some((about.dev(), about.ino()))
}

impl Server {
    fn open() -> Result<Server, ControlError> {
        // SAFETY: cannot fail.
        let user = unsafe { libc::geteuid() };
        let given = config().map_or(&[][..], |config| &config.sockets);
        let folder = place::choose(given, |name| std::env::var_os(name), user)?;
        let pid = std::process::id();
        let path = place::free_socket(&folder, pid);
        let failed = |error: std::io::Error| ControlError::Socket {
            path: path.clone(),
            reason: error.kind().to_string(),
        };
        // The socket gets its final name only when it listens and is closed to others, because `ctl` removes sockets that do not listen.
        let growing = path.with_extension("new");
        // A dead process with our number may have left one.
        let _ = std::fs::remove_file(&growing);
        let listener = UnixListener::bind(&growing).map_err(failed)?;
        let ready = place::close_to_others(&growing)
            .and_then(|()| listener.set_nonblocking(true))
            // The program may have closed stdin, stdout or stderr. A copy gets a number above those of the three.
            .and_then(|()| Checked::new(listener.try_clone()?))
            .and_then(|listener| {
                std::fs::rename(&growing, &path)?;
                Ok(listener)
            });
        let listener = ready.map_err(|error| {
            let _ = std::fs::remove_file(&growing);
            failed(error)
        })?;
        Ok(Server {
            listener,
            file: file(&path),
            path,
            pid,
            user,
            clients: Vec::new(),
            wanted: None,
        })
    }

    /// Serves all clients once. Returns whether the socket is still ours.
    fn serve(&mut self, layer: &mut Layer) -> bool {
        if !self.accept() {
            return false;
        }
        match layer.pictured() {
            None => {}
            Some(Pictured::Later(wanted)) => self.wanted = Some(wanted),
            Some(Pictured::Done(outcome)) => {
                if let Some(client) = self.clients.iter_mut().find(|c| c.waits) {
                    client.waits = false;
                    client.answer(outcome.into());
                }
            }
        }
        let mut clients = std::mem::take(&mut self.clients);
        for at in 0..clients.len() {
            let busy = clients.iter().any(|c| c.waits);
            if let Some(client) = clients.get_mut(at) {
                self.listen(client, layer, busy);
            }
        }
        clients.retain_mut(|client| client.send() && !client.is_done());
        if !clients.iter().any(|c| c.waits) {
            self.wanted = None;
        }
        self.clients = clients;
        true
    }

    /// Accepts waiting connections. False if the socket is not ours any more.
    fn accept(&mut self) -> bool {
        for _ in 0..ACCEPTED {
            let Some(listener) = self.listener.get() else {
                return false;
            };
            let Ok((stream, _)) = listener.accept() else {
                break;
            };
            if !place::may_talk(peer(&stream), self.user) {
                continue;
            }
            // A copy, as in `open`.
            let ready = stream.set_nonblocking(true);
            let Ok(stream) = ready.and_then(|()| Checked::new(stream.try_clone()?)) else {
                continue;
            };
            let mut client = Client {
                stream,
                lines: Lines::default(),
                answers: Vec::new(),
                waits: false,
                done: false,
            };
            if self.clients.len() < CLIENTS {
                self.clients.push(client);
            } else {
                client.answer(Err(ControlError::Crowded(CLIENTS)).into());
                client.send();
            }
        }
        true
    }

    /// Executes the requests that a client has sent since the last frame. `busy`: some client waits for a picture.
    fn listen(&mut self, client: &mut Client, layer: &mut Layer, mut busy: bool) {
        client.receive();
        while !client.waits
            && client.answers.len() < UNREAD
            && let Some(line) = client.lines.take()
        {
            // After a line that is too long, the beginning of the next one is not known.
            client.done |= line.is_err();
            let (before, profile) = (layer.live(), Arc::clone(layer.profile()));
            let outcome =
                line.and_then(|line| control::order(&line))
                    .and_then(|order| match order {
                        control::Order::Capture(..) | control::Order::Explain(_) if busy => {
                            Err(ControlError::Busy)
                        }
                        order => layer.control(order),
                    });
            match outcome {
                Ok(Ok(answer)) => client.answer(answer),
                Ok(Err(wanted)) => {
                    self.wanted = Some(wanted);
                    (client.waits, busy) = (true, true);
                }
                Err(error) => {
                    let last = error == ControlError::TooLong;
                    client.answer(Err(error).into());
                    if last {
                        break;
                    }
                }
            }
            live::changed(layer, before);
            live::profile_changed(layer, &profile);
        }
    }
}

impl Client {
    fn answer(&mut self, answer: Answer) {
        self.answers
            .extend_from_slice(control::line(&answer).as_bytes());
    }

    fn receive(&mut self) {
        let mut bytes = [0; Lines::MAX + 1];
        let room = self.lines.room();
        if self.done || room == 0 {
            return;
        }
        let Some(mut stream) = self.stream.get() else {
            self.done = true;
            return;
        };
        match stream.read(&mut bytes[..room]) {
            Ok(0) => self.done = true,
            Ok(count) => self.lines.push(&bytes[..count]),
            Err(error) => self.done = error.kind() != std::io::ErrorKind::WouldBlock,
        }
    }

    /// Sends as much of the answers as the client takes. False if the connection has failed.
    fn send(&mut self) -> bool {
        let Some(stream) = self.stream.get() else {
            return false;
        };
        if self.answers.is_empty() {
            return true;
        }
        match socket::send(stream, &self.answers) {
            Ok(count) => {
                self.answers.drain(..count.min(self.answers.len()));
                true
            }
            Err(error) => error.kind() == std::io::ErrorKind::WouldBlock,
        }
    }

    fn is_done(&self) -> bool {
        self.done && !self.waits && self.answers.is_empty()
    }
}

/// The user ID of the process at the other end.
fn peer(stream: &UnixStream) -> Option<u32> {
    let mut about = libc::ucred {
        pid: 0,
        uid: 0,
        gid: 0,
    };
    let mut size = size_of::<libc::ucred>() as libc::socklen_t;
    // SAFETY: our socket, and a structure of the size that is given.
    let known = unsafe {
        libc::getsockopt(
            stream.as_raw_fd(),
            libc::SOL_SOCKET,
            libc::SO_PEERCRED,
            (&raw mut about).cast(),
            &raw mut size,
        )
    };
    (known == 0).then_some(about.uid)
}

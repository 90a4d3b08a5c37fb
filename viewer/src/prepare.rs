//! Makes nodes ready to be drawn, in threads: gathers their points, and gives them normals and sizes.

use crate::load::{LoadError, Loading};
use crate::normals;
use crate::octree::Id;
use crate::vertex::Vertex;
use std::collections::{HashSet, VecDeque};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;

/// The points of a node.
#[derive(Debug)]
pub struct Ready {
    /// Its number.
    pub id: Id,
    /// The node's version that they are of.
    pub version: u32,
    /// With normals and sizes.
    pub points: Vec<Vertex>,
    /// The radius that points of nodes above it have here at most: 0 where it is a leaf whose file has radii; none where it has too few points to tell.
    pub radius: Option<f32>,
}

/// The radius of disks that cover a surface, of the side of cells that have one each.
const COVER: f32 = 0.75;

/// Fewer points do not tell how dense a surface is: they may be a corner of it, or a thin slice.
const FEW: usize = 128;

#[derive(Debug, Default)]
struct Queue {
    wanted: VecDeque<Id>,
    /// Those that a thread has.
    taken: HashSet<Id>,
    closed: bool,
}

/// The threads.
#[derive(Debug)]
pub struct Preparation {
    queue: Arc<(Mutex<Queue>, Condvar)>,
    done: Receiver<Ready>,
}

impl Preparation {
    /// Starts so many threads.
    #[must_use]
    pub fn start(loading: &Loading, threads: usize) -> Self {
        let queue: Arc<(Mutex<Queue>, Condvar)> = Arc::default();
        let (sender, done) = channel();
        for _ in 0..threads.max(1) {
            let (loading, queue, sender) = (loading.clone(), queue.clone(), sender.clone());
            thread::spawn(move || work(&loading, &queue, &sender));
        }
        Self { queue, done }
    }

    /// Says which nodes are wanted, the most urgent first, in place of those that were and are not begun.
    pub fn want(&self, nodes: impl IntoIterator<Item = Id>) {
        let (queue, more) = &*self.queue;
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        queue.wanted.clear();
        let nodes = nodes.into_iter();
        let new: Vec<_> = nodes.filter(|id| !queue.taken.contains(id)).collect();
        queue.wanted.extend(new);
        more.notify_all();
    }

    /// A node that is ready.
    #[must_use]
    pub fn take(&self) -> Option<Ready> {
        let ready = self.done.try_recv().ok()?;
        let mut queue = self.queue.0.lock().unwrap_or_else(PoisonError::into_inner);
        queue.taken.remove(&ready.id);
        Some(ready)
    }

    /// Whether nothing is wanted.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        let queue = self.queue.0.lock().unwrap_or_else(PoisonError::into_inner);
        queue.wanted.is_empty() && queue.taken.is_empty()
    }
}

impl Drop for Preparation {
    fn drop(&mut self) {
        let (queue, more) = &*self.queue;
        queue.lock().unwrap_or_else(PoisonError::into_inner).closed = true;
        more.notify_all();
    }
}

fn work(loading: &Loading, queue: &(Mutex<Queue>, Condvar), done: &Sender<Ready>) {
    let (queue, more) = queue;
    loop {
        let mut own = queue.lock().unwrap_or_else(PoisonError::into_inner);
        let id = loop {
            if own.closed {
                return;
            }
            match own.wanted.pop_front() {
                Some(id) => break id,
                None => own = more.wait(own).unwrap_or_else(PoisonError::into_inner),
            }
        };
        own.taken.insert(id);
        drop(own);
        let Some(ready) = prepare(loading, id) else {
            return;
        };
        if done.send(ready).is_err() {
            return;
        }
    }
}

fn prepare(loading: &Loading, id: Id) -> Option<Ready> {
    let tree = loading.tree()?;
    let node = tree.node(id);
    let (version, spacing, is_leaf) = (node.version, node.spacing(), node.is_leaf());
    let about = tree.points_about(id);
    drop(tree);
    // Points that cannot be read back are not drawn.
    let (mut points, own) = about.unwrap_or_else(|error| {
        loading.progress.fail(LoadError::Store(error));
        Default::default()
    });
    let guessed = normals::complete(&mut points, own, spacing);
    let radius = told(guessed, points.len(), is_leaf, spacing);
    points.truncate(own);
    Some(Ready {
        id,
        version,
        points,
        radius,
    })
}

/// The radius that a node tells ([`Ready::radius`]), with so many points and surroundings.
fn told(guessed: Option<f32>, points: usize, is_leaf: bool, spacing: f32) -> Option<f32> {
    match guessed {
        Some(guessed) => (points >= FEW).then_some(guessed),
        None if is_leaf => Some(0.0),
        None => Some(COVER * spacing),
    }
}

#[cfg(test)]
mod tests {
    use super::{Loading, prepare};
    use crate::read::{Cloud, Part, Point, ReadError, Up};
    use glam::DVec3;
    use std::thread::sleep;
    use std::time::Duration;

    struct Plane {
        side: u32,
        radius: Option<f32>,
    }

    impl Part for Plane {
        fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
            let places = (0..self.side).flat_map(|x| (0..self.side).map(move |y| (x, y)));
            let point = |(x, y): (u32, u32)| Point {
                radius: self.radius,
                ..Point::at(DVec3::new(x.into(), y.into(), 0.0))
            };
            give(&mut places.map(point).collect());
            Ok(())
        }
    }

    /// The radius that the root of a plane of points tells.
    fn root(side: u32, radius: Option<f32>) -> Option<f32> {
        let cloud = Cloud {
            points: None,
            up: Up::Z,
            parts: vec![Box::new(Plane { side, radius })],
        };
        let loading = Loading::start(cloud, 1 << 26);
        while !loading.progress.is_done() {
            sleep(Duration::from_millis(1));
        }
        prepare(&loading, 0).expect("a root").radius
    }

    #[test]
    fn a_node_tells_how_large_its_points_are() {
        // A leaf, whose points are one apart.
        let leaf = root(20, None).expect("a radius");
        assert!((1.0..2.0).contains(&leaf), "{leaf}");
        assert_eq!(root(5, None), None, "too few");
        assert_eq!(root(20, Some(3.0)), Some(0.0), "the file's");
        // An inner node, whose points are as far apart as its cells.
        let inner = root(200, Some(3.0)).expect("a radius");
        assert!(inner > 3.0, "{inner}");
    }
}

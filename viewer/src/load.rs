//! Reads a file into the tree, in threads.

use crate::extent::extent;
use crate::octree::Octree;
use crate::read::{Cloud, Part, Point, ReadError};
use crate::vertex::Vertex;
use glam::DVec3;
use std::io;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;

/// Why a file is not read to its end.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Points that do not fit into memory.
    #[error("the temporary file for points that do not fit into memory: {0}")]
    Store(#[from] io::Error),
}

/// What is known of a file that is being read.
#[derive(Debug, Default)]
pub struct Progress {
    /// Points that the file says it has.
    pub expected: Option<u64>,
    /// Points that were read.
    read: AtomicU64,
    /// Points that are nowhere ([`Vertex::new`]).
    skipped: AtomicU64,
    /// Threads that read.
    readers: AtomicU32,
    stop: AtomicBool,
    error: Mutex<Option<LoadError>>,
}

impl Progress {
    /// How much of the file was read, 0 to 1; none where nobody knows.
    #[must_use]
    pub fn share(&self) -> Option<f32> {
        let expected = self.expected.filter(|&expected| expected > 0)?;
        Some(self.read.load(Ordering::Relaxed) as f32 / expected as f32)
    }

    /// Points that were left out.
    #[must_use]
    pub fn skipped(&self) -> u64 {
        self.skipped.load(Ordering::Relaxed)
    }

    /// Whether nothing more comes.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.readers.load(Ordering::Acquire) == 0
    }

    /// The first fault, once.
    pub fn take_error(&self) -> Option<LoadError> {
        lock(&self.error).take()
    }

    /// Tells of a fault, after which nothing more is read.
    pub fn fail(&self, error: LoadError) {
        self.stop.store(true, Ordering::Relaxed);
        lock(&self.error).get_or_insert(error);
    }
}

/// A file that is read into a tree.
#[derive(Clone, Debug)]
pub struct Loading {
    /// How far it is.
    pub progress: Arc<Progress>,
    tree: Arc<OnceLock<Mutex<Octree>>>,
}

impl Loading {
    /// Starts to read a file. The tree holds so many bytes of points in memory.
    #[must_use]
    pub fn start(cloud: Cloud, memory: u64) -> Self {
        let loading = Self {
            progress: Arc::new(Progress {
                expected: cloud.points,
                readers: AtomicU32::new(cloud.parts.len() as u32),
                ..Progress::default()
            }),
            tree: Arc::default(),
        };
        for part in cloud.parts {
            let loading = loading.clone();
            thread::spawn(move || {
                if let Err(error) = loading.read(part, memory) {
                    loading.progress.fail(error);
                }
                let readers = &loading.progress.readers;
                if readers.fetch_sub(1, Ordering::AcqRel) == 1
                    && let Some(mut tree) = loading.tree()
                {
                    tree.finish();
                }
            });
        }
        loading
    }

    /// The tree, once there are points.
    #[must_use]
    pub fn tree(&self) -> Option<MutexGuard<'_, Octree>> {
        self.tree.get().map(lock)
    }

    fn read(&self, mut part: Box<dyn Part>, memory: u64) -> Result<(), LoadError> {
        let (mut vertices, mut fault) = (Vec::new(), None);
        let read = part.read(&mut |points| {
            self.progress
                .read
                .fetch_add(points.len() as u64, Ordering::Relaxed);
            match self.insert(points, &mut vertices, memory) {
                Ok(()) => !self.progress.stop.load(Ordering::Relaxed),
                Err(error) => {
                    fault = Some(error);
                    false
                }
            }
        });
        // What was read is kept, also of a part that ends with a fault.
        fault.map_or(Ok(()), |error| Err(LoadError::Store(error)))?;
        Ok(read?)
    }

    fn insert(
        &self,
        points: &mut Vec<Point>,
        vertices: &mut Vec<Vertex>,
        memory: u64,
    ) -> io::Result<()> {
        if self.tree.get().is_none()
            && let Some((origin, size)) = start(points)
        {
            // Of two threads that make one, the first one's is kept.
            let _ = self
                .tree
                .set(Mutex::new(Octree::new(origin, size, memory)?));
        }
        vertices.clear();
        if let Some(origin) = self.tree().map(|tree| tree.origin()) {
            vertices.extend(points.iter().filter_map(|point| Vertex::new(point, origin)));
        }
        let skipped = points.len() - vertices.len();
        self.progress
            .skipped
            .fetch_add(skipped as u64, Ordering::Relaxed);
        points.clear();
        for some in vertices.chunks(AT_ONCE) {
            if let Some(mut tree) = self.tree() {
                tree.insert(some)?;
            }
        }
        Ok(())
    }
}

/// So many points go into the tree before others may use it: a frame never waits long.
const AT_ONCE: usize = 4096;

/// Where the tree begins and how large it is, by the first points: about the middle of most of them, because a stray one may be anywhere. None where no point is
/// anywhere.
fn start(points: &[Point]) -> Option<(DVec3, f32)> {
    let is_somewhere = |place: &DVec3| Vertex::new(&Point::at(*place), DVec3::ZERO).is_some();
    let places = points.iter().map(|point| point.place).filter(is_somewhere);
    let first = places.clone().next()?;
    let (middle, radius) = extent(places.map(|place| (place - first).as_vec3()), FAR);
    Some((first + middle.as_dvec3(), 2.0 * radius))
}

/// The share of the first points at each end of an axis that may be far away.
const FAR: f32 = 0.02;

/// A thread that has panicked leaves the points as they were.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::Loading;
    use crate::read::{Cloud, Part, Point, ReadError, Up};
    use glam::DVec3;
    use std::thread::sleep;
    use std::time::{Duration, Instant};

    struct Given(Vec<DVec3>);

    impl Part for Given {
        fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
            give(&mut self.0.iter().map(|&place| Point::at(place)).collect());
            Ok(())
        }
    }

    fn loaded(places: Vec<DVec3>) -> Loading {
        let cloud = Cloud {
            points: Some(places.len() as u64),
            up: Up::Z,
            parts: vec![Box::new(Given(places))],
        };
        let loading = Loading::start(cloud, 1 << 26);
        let limit = Instant::now() + Duration::from_secs(10);
        while !loading.progress.is_done() {
            assert!(Instant::now() < limit, "it does not end");
            sleep(Duration::from_millis(2));
        }
        loading
    }

    #[test]
    fn places_too_far_for_sums_of_squares_are_left_out() {
        let near = (0..1000).map(|n| DVec3::new(f64::from(n), 0.0, 0.0));
        let bad = [3e38, -3e38, 1e300, f64::NAN, f64::INFINITY, 1e19];
        let far = bad.map(|x| DVec3::new(x, -x, 1.0));
        let loading = loaded(near.chain(far).collect());
        let tree = loading.tree().expect("points");
        assert_eq!((tree.count(), loading.progress.skipped()), (1000, 6));
    }

    /// Scans of maps have places of millions of metres, and some have a first point without a place.
    #[test]
    fn a_stray_first_point_does_not_cost_the_others_their_precision() {
        let scan = (0..1000).map(|n| DVec3::new(5e6 + f64::from(n) * 0.001, 4e6, 300.0));
        let loading = loaded(std::iter::once(DVec3::ZERO).chain(scan).collect());
        let tree = loading.tree().expect("points");
        let apart = (tree.origin() - DVec3::new(5e6, 4e6, 300.0)).length();
        assert!(apart < 10.0, "{apart}");
    }
}

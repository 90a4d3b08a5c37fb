//! Where a program with shaders of its own has its camera: in a matrix, in four vectors, or in none, so that it is measured.

use super::blocks::BlockReader;
use crate::gl::{BlockPlace, Gl, ProgramName};
use crate::plan::camera::Lying;
use crate::plan::{camera, clip_form, orthographic};
use crate::state::{Matrices, block_change, uniform_change};

/// Where a program has its camera.
#[derive(Clone, Copy, Debug)]
enum CameraPlace {
    /// In a matrix, numbered as in [`Matrices::values`].
    Matrix(usize),
    /// In four vectors of an array: the number of the array, that of the first vector, and how they lie.
    Vectors((usize, usize), Lying),
    /// In none: by the w of its vertices (see [`crate::plan::clip_form`]).
    Measured,
}

impl CameraPlace {
    /// The matrix there, column-major.
    fn value(
        self,
        matrices: &Matrices,
        gl: &Gl,
        program: ProgramName,
        in_block: &mut dyn FnMut(BlockPlace) -> Option<[f32; 16]>,
    ) -> Option<[f32; 16]> {
        match self {
            CameraPlace::Matrix(at) => matrices.value(gl, program, at, in_block),
            CameraPlace::Vectors(at, lying) => {
                let four = matrices.four_vectors(gl, program, at)?;
                Some(lying.matrix(four))
            }
            CameraPlace::Measured => None,
        }
    }
}

/// The camera of a program.
#[derive(Clone, Copy, Debug)]
struct Camera {
    /// Its matrix among those of the program; `matrix` is the value, column-major.
    at: CameraPlace,
    matrix: [f32; 16],
    /// See [`camera::equivalent`].
    projection: [f32; 16],
}

impl Camera {
    fn is_measured(&self) -> bool {
        matches!(self.at, CameraPlace::Measured)
    }
}

/// State of the search for a program's camera.
#[derive(Debug)]
pub(super) struct CameraSearch {
    /// The last camera that was found among its matrices, or measured.
    found: Option<Camera>,
    /// None of its matrices has a perspective now.
    lost: bool,
    /// Where none has, the matrix by which an orthographic scene is measured (see [`orthographic::among`]).
    oblique: Option<[f32; 16]>,
    /// [`uniform_change`] and [`block_change`] at the last search; without matrices in blocks the latter is 0.
    seen: [u64; 2],
    measuring: Measuring,
    /// It was told that none was found.
    told: bool,
}

/// When the w of vertices is measured: with the first draws, then after twice as many each time, as the planes of a camera seldom change.
#[derive(Debug, Default)]
struct Measuring {
    /// Draws that wait for the next measurement, and that there have been.
    wait: u32,
    since: u32,
    /// Nothing can be measured.
    refused: bool,
    /// Positions in clip space of the last draws, as long as they tell no camera: all of a draw may lie at one distance.
    vertices: Vec<[f32; 4]>,
}

/// Draws between two measurements, at the most.
const LONGEST_WAIT: u32 = 4096;
/// Draws between two measurements from which on a camera that was not found is told.
const IN_VAIN: u32 = 16;
/// Positions that are kept of a draw, and of all.
const SAMPLES: usize = 32;
const KEPT: usize = 8 * SAMPLES;

impl Default for CameraSearch {
    /// Nothing has been looked at.
    fn default() -> Self {
        CameraSearch {
            found: None,
            lost: true,
            oblique: None,
            seen: [0; 2],
            measuring: Measuring::default(),
            told: false,
        }
    }
}

impl CameraSearch {
    /// Looks for the camera among the matrices, where they may have changed. `aspect` is that of the picture, width over height; `blocks` reads matrices in uniform blocks.
    pub(super) fn look(
        &mut self,
        gl: &Gl,
        program: ProgramName,
        matrices: &Matrices,
        aspect: f64,
        blocks: &mut BlockReader,
    ) {
        let places = matrices.in_blocks();
        let change = match places {
            [] => [uniform_change(), 0],
            _ => [uniform_change(), block_change()],
        };
        let changed = std::mem::replace(&mut self.seen, change) != change;
        if !changed && (places.is_empty() || !blocks.are_live(program, places)) {
            return;
        }
        let in_block = &mut |place| blocks.matrix(program, place);
        let measured = self.is_measured();
        // The camera mostly is in the same matrix as before, and has only moved.
        let mut search = self.found.is_none() || measured;
        if let Some(found) = self.found.as_mut()
            && let Some(matrix) = found.at.value(matrices, gl, program, in_block)
        {
            match camera::equivalent(&matrix) {
                _ if matrix == found.matrix => self.lost = false,
                Some(projection) => {
                    (found.matrix, found.projection, self.lost) = (matrix, projection, false);
                }
                None => search = true,
            }
        }
        if search {
            let values = matrices.values(gl, program, in_block);
            let found = camera::among(&values, aspect).and_then(|(at, projection)| {
                let matrix = *values.get(at)?;
                Some(Camera {
                    at: CameraPlace::Matrix(at),
                    matrix,
                    projection,
                })
            });
            let found = found.or_else(|| {
                let arrays = matrices.vectors(gl, program).enumerate();
                camera_among_vectors(arrays, aspect)
            });
            self.lost = found.is_none() && !measured;
            self.oblique = orthographic::among(&values).filter(|_| self.lost);
            self.found = found.or(self.found);
        }
    }

    /// Whether none of the matrices has a perspective now, nor has what was measured, so that the last camera is used.
    pub(super) fn is_lost(&self) -> bool {
        self.lost
    }

    /// The matrix of the orthographic scene that is drawn; none where the matrices have a perspective, or show nothing obliquely.
    pub(super) fn oblique(&self) -> Option<[f32; 16]> {
        self.oblique.filter(|_| self.lost)
    }

    /// The camera's matrix, column-major, where it is one of the program's and has a perspective now.
    pub(super) fn present(&self) -> Option<[f32; 16]> {
        let found = self
            .found
            .filter(|found| !self.lost && !found.is_measured());
        found.map(|camera| camera.matrix)
    }

    /// The matrix of the last camera, as the program has it and as a pure projection (see [`camera::equivalent`]); both are column-major.
    pub(super) fn projections(&self) -> Option<[[f32; 16]; 2]> {
        self.found.map(|camera| [camera.matrix, camera.projection])
    }

    /// Whether the camera comes from the w of vertices.
    pub(super) fn is_measured(&self) -> bool {
        self.found.is_some_and(|camera| camera.is_measured())
    }

    /// Whether the matrices have no camera, and it is time to measure the w of vertices. Each question counts a draw.
    pub(super) fn is_unmeasured(&mut self) -> bool {
        let measuring = &mut self.measuring;
        if measuring.refused || self.found.is_some_and(|camera| !camera.is_measured()) {
            return false;
        }
        measuring.since = measuring.since.saturating_add(1);
        measuring.since > measuring.wait
    }

    /// Whether w was measured for some time, or cannot be, and no camera was found.
    pub(super) fn is_in_vain(&self) -> bool {
        let measuring = &self.measuring;
        self.found.is_none() && (measuring.refused || measuring.wait >= IN_VAIN)
    }

    /// Whether it is the first time that this is asked, to tell that none was found.
    pub(super) fn is_first_telling(&mut self) -> bool {
        !std::mem::replace(&mut self.told, true)
    }

    /// Nothing can be measured.
    pub(super) fn refuse(&mut self) {
        self.measuring.refused = true;
    }

    /// Looks for the camera by the positions of a draw's vertices in clip space, and those of the draws before it. `aspect` as for [`CameraSearch::look`]. Returns whether it is the
    /// first that is found.
    pub(super) fn measure(&mut self, vertices: &[[f32; 4]], aspect: f64) -> bool {
        let measuring = &mut self.measuring;
        measuring.wait = (2 * measuring.wait).clamp(1, LONGEST_WAIT);
        measuring.since = 0;
        let found = clip_form::camera(vertices, aspect).or_else(|| {
            let step = (vertices.len() / SAMPLES).max(1);
            let kept = &mut measuring.vertices;
            kept.extend(vertices.iter().step_by(step).take(SAMPLES));
            kept.drain(..kept.len().saturating_sub(KEPT));
            clip_form::camera(kept, aspect)
        });
        let Some(matrix) = found else {
            return false;
        };
        measuring.vertices.clear();
        (self.lost, self.oblique) = (false, None);
        let before = self.found.replace(Camera {
            at: CameraPlace::Measured,
            matrix,
            projection: matrix,
        });
        before.is_none()
    }
}

/// The camera among arrays of vectors, which have numbers, for the aspect of the window.
fn camera_among_vectors(
    mut arrays: impl Iterator<Item = (usize, Vec<[f32; 4]>)>,
    aspect: f64,
) -> Option<Camera> {
    arrays.find_map(|(array, vectors)| {
        let (first, lying, projection) = camera::among_vectors(&vectors, aspect)?;
        let four = vectors.get(first..)?.first_chunk()?;
        Some(Camera {
            at: CameraPlace::Vectors((array, first), lying),
            matrix: lying.matrix(*four),
            projection,
        })
    })
}

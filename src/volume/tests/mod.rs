//! Volumes against a voxeliser that shares no code with them; dithering, stacks and views of volumes.

mod program;
mod shown;
mod surfaces;

use super::*;

/// A small display, quick to fill.
const SMALL: RotatingScreen = RotatingScreen {
    radius: 5.0,
    slices: 40,
    turn: Turn::Half,
    pixels: 128,
    viewer: 50.0,
};

const GREY: [u8; 3] = [128; 3];

fn triangle(corners: [[f32; 3]; 3]) -> Triangle {
    corners.map(|at| Vertex { at, colour: GREY })
}

fn volume(screen: &RotatingScreen, corners: [[f32; 3]; 3]) -> Volume {
    Volume::of_triangles(screen, &[triangle(corners)]).unwrap()
}

/// Half plane, row and column of all voxels.
fn cells(volume: &Volume) -> Vec<[u32; 3]> {
    let columns = volume.screen().columns();
    let planes = (0..).zip(volume.half_planes());
    let cells = planes.flat_map(|(half_plane, voxels)| {
        let cell = move |voxel: &Voxel| [half_plane, voxel.at / columns, voxel.at % columns];
        voxels.iter().map(cell)
    });
    cells.collect()
}

/// A volume of some voxels.
fn of_cells(screen: &RotatingScreen, cells: &[[u32; 3]], colour: [u8; 3]) -> Volume {
    let mut half_planes = vec![Vec::new(); screen.half_planes() as usize];
    for &[half_plane, row, column] in cells {
        let at = row * screen.columns() + column;
        half_planes[half_plane as usize].push(Voxel { at, colour });
    }
    for voxels in &mut half_planes {
        voxels.sort_by_key(|voxel: &Voxel| voxel.at);
    }
    Volume {
        screen: *screen,
        half_planes,
    }
}

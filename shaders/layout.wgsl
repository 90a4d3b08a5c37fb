// Whole views beside each other: quilt, side by side, or a single view (a grid of one cell).
//
// Cells are numbered from the bottom left, to the right, then upwards, as in a Looking Glass quilt; in one row that is
// from left to right. In one column they are numbered from the top. Cells past the last view are black. A pixel belongs
// to the cell that contains its centre.

@fragment
fn arrange(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    // The centre of the pixel and the width of a cell, in units of 1 / (2 · picture · grid) of the picture.
    let centre = (2u * at + 1u) * u.grid;
    let width = 2u * u.picture;
    let cell = centre / width;
    let row = select(u.grid.y - 1u - cell.y, cell.y, u.cells_from_top != 0u);
    let view = u.first + row * u.grid.x + cell.x;
    if view >= u.views {
        return vec4<f32>(0.0, 0.0, 0.0, 1.0);
    }
    return vec4<f32>(colour(view, centre - cell * width, width), 1.0);
}

// A single view of the picture's size.
@fragment
fn whole(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return vec4<f32>(texel(u.first, top_down(position)), 1.0);
}

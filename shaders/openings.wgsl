// For the next frame, where the program's own draws are to be let into a view that is made; and before that frame, everything else shut.

// Cells of the picture, and the one that is drawn: as the textures, rows go as those of the views.
fn cells() -> vec2<i32> {
    return (vec2<i32>(u.tile) + CELL - 1) / CELL;
}

fn cell_at(position: vec4<f32>) -> vec2<i32> {
    let at = vec2<u32>(position.xy);
    return vec2<i32>(vec2<u32>(at.x, texel_row(at.y, u32(cells().y))));
}

// Cells with a hole in their middle. One ray for sixteen pixels: a narrower hole is seldom missed in all cells along an edge, and is hardly
// seen where it is filled.
@fragment
fn holes(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let middle = cell_at(position) * CELL + CELL / 2;
    let at = min(middle, vec2<i32>(u.tile) - 1);
    let seen = see(u.aim.x, f32(at.x) + 0.5, at.y, range_of(u32(at.x), at.y));
    return vec4<f32>(select(0.0, 1.0, seen.hole), 0.0, 0.0, 1.0);
}

// And the cells around them: until the next frame holes move.
@fragment
fn widen(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let own = cell_at(position);
    let last = cells() - 1;
    var open = 0.0;
    for (var y = max(own.y - 1, 0); y <= min(own.y + 1, last.y); y++) {
        for (var x = max(own.x - 1, 0); x <= min(own.x + 1, last.x); x++) {
            open = max(open, textureLoad(open_texture, vec2<i32>(x, y), 0, 0).r);
        }
    }
    return vec4<f32>(open, 0.0, 0.0, 1.0);
}

struct Shut {
    @builtin(frag_depth) depth: f32,
}

// As near as anything can be, so that nothing is drawn there.
@fragment
fn shut(@builtin(position) position: vec4<f32>) -> Shut {
    let at = vec2<u32>(position.xy);
    let x = i32(position.x - u.aim.y);
    if is_open(i32(u.aim.x), vec2<i32>(x, i32(texel_row(min(at.y, u.tile.y - 1u), u.tile.y)))) {
        discard;
    }
    // Depths that are moved away are moved to smaller ones where nearer is larger.
    return Shut(select(0.0, 1.0, u.lever.w < 0.0));
}

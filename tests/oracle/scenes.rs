//! The demos, each with the arguments that are compared.

/// One demo with one set of arguments.
pub(crate) struct Scene {
    pub(crate) demo: &'static str,
    /// Further arguments of the demo.
    pub(crate) arguments: &'static [&'static str],
    /// Frames that are compared. More than one where the frames draw by different means. Few, because a long history of immediate mode
    /// crosses the end of Mesa's 512 KiB vertex buffer, and a primitive that is split there may differ by 1 LSB.
    pub(crate) frames: u32,
    /// The frame from which on frames are compared, counted from 0: later than the first where a frame is drawn by what the one before was.
    pub(crate) from: u32,
    /// The oracle's picture is that of the window, not the one that the demo reads back.
    pub(crate) window: bool,
}

impl Scene {
    /// Its programs transform vertices themselves: a variant shifts them after the program's own product, the oracle before it.
    pub(crate) fn has_shaders(&self) -> bool {
        ["shade", "passes", "crowd", "relief"].contains(&self.demo)
    }

    /// A geometry shader creates grass.
    pub(crate) fn has_blades(&self) -> bool {
        self.demo == "relief" && !self.arguments.contains(&"core")
    }
}

/// The scene of this name. `examples/README.md` says what each exercises.
pub(crate) fn scene(name: &str) -> Scene {
    let scene = |demo, arguments, frames| Scene {
        demo,
        arguments,
        frames,
        from: 0,
        window: false,
    };
    let multisampled = |demo| Scene {
        demo,
        arguments: &["--samples", "4"],
        frames: 1,
        from: 0,
        window: true,
    };
    match name {
        "gears" => scene("gears", &[], 1),
        "lists" => scene("lists", &[], 2),
        "echo" => scene("echo", &[], 3),
        "blur" => scene("blur", &[], 3),
        "teapot" => scene("teapot", &[], 1),
        "room" => scene("room", &[], 1),
        // One fog mode per frame.
        "fogtexgen" => scene("fogtexgen", &[], 3),
        "points" => scene("points", &[], 1),
        "clip" => scene("clip", &[], 1),
        "mirror" => scene("mirror", &[], 1),
        "mesh" => scene("mesh", &["--triangles", "10000"], 1),
        "mesh_vbo" => scene("mesh", &["--triangles", "10000", "--vbo"], 1),
        // Enough calls for the layer to compile them into a list.
        "mesh_immediate" => scene("mesh", &["--triangles", "1000", "--immediate"], 1),
        "mesh_list" => scene("mesh", &["--triangles", "10000", "--list"], 1),
        "fill" => scene("fill", &["--overdraw", "6", "--textured"], 1),
        "prims" => scene("prims", &[], 1),
        "arrays" => scene("arrays", &[], 1),
        "immediate" => scene("immediate", &[], 1),
        "sky" => scene("sky", &[], 1),
        "sky_far_off" => scene("sky", &["--far-off"], 1),
        "sky_cleared" => Scene {
            from: 1,
            ..scene("sky", &["--cleared", "--sun"], 2)
        },
        "field" => scene("field", &[], 1),
        "shade" => scene("shade", &[], 1),
        "shade_toon" => scene("shade", &["--toon"], 1),
        "shade_combined" => scene("shade", &["--combined"], 1),
        "shade_block" => scene("shade", &["--glsl", "330"], 1),
        // The camera of the scene is known after the first frame.
        "shade_sky" => Scene {
            from: 1,
            ..scene("shade", &["--sky"], 2)
        },
        "shade_sky_block" => scene("shade", &["--sky", "--glsl", "330"], 1),
        "shade_box" => scene("shade", &["--box"], 2),
        "shade_box_combined" => scene("shade", &["--box", "--combined"], 1),
        "shade_box_block" => scene("shade", &["--box", "--glsl", "330"], 2),
        "isometric" => scene("isometric", &[], 2),
        "shade_orthographic" => scene("shade", &["--orthographic"], 2),
        "shade_orthographic_block" => scene("shade", &["--orthographic", "--glsl", "330"], 1),
        "passes" => scene("passes", &["--depth-blit"], 2),
        "passes_depth" => scene("passes", &["--from-depth"], 2),
        "passes_samples" => scene("passes", &["--samples-inside", "4", "--mipmap"], 1),
        "passes_copies" => {
            let arguments = &["--copy", "--screen-blit", "--profile", "core"];
            scene("passes", arguments, 2)
        }
        // OpenGL ES: GLSL 1.00 with uniforms, or one matrix; 3.00 with a block.
        "shade_es2" => scene("shade", &["--profile", "es2"], 1),
        "shade_es2_combined" => scene("shade", &["--profile", "es2", "--combined", "--toon"], 1),
        "shade_es3" => scene("shade", &["--profile", "es3", "--glsl", "330"], 1),
        "shade_es2_sky" => Scene {
            from: 1,
            ..scene("shade", &["--profile", "es2", "--sky"], 2)
        },
        "shade_es3_sky" => {
            let arguments = &["--profile", "es3", "--sky", "--glsl", "330"];
            scene("shade", arguments, 1)
        }
        "shade_es3_box" => {
            let arguments = &["--profile", "es3", "--box", "--glsl", "330"];
            scene("shade", arguments, 1)
        }
        "shade_es2_srgb" => scene("shade", &["--profile", "es2", "--srgb"], 1),
        "passes_es3" => scene("passes", &["--profile", "es3", "--depth-blit"], 2),
        "passes_es3_depth" => scene("passes", &["--profile", "es3", "--from-depth"], 2),
        "passes_es3_samples" => {
            let arguments = &["--profile", "es3", "--samples-inside", "4", "--mipmap"];
            scene("passes", arguments, 1)
        }
        "passes_es3_copies" => {
            let arguments = &["--profile", "es3", "--copy", "--screen-blit"];
            scene("passes", arguments, 2)
        }
        "crowd" => scene("crowd", &["--multi"], 2),
        "echo_listed" => scene("echo", &["--listed"], 2),
        "crowd_indirect" => {
            let arguments = &["--indirect", "--pulled", "--persistent"];
            scene("crowd", arguments, 2)
        }
        "relief" => scene("relief", &["--profile", "core"], 1),
        "relief_geometry" => scene("relief", &["--geometry"], 1),
        "relief_both" => scene("relief", &["--both"], 1),
        "relief_points" => scene("relief", &["--points", "--profile", "core"], 1),
        // Long enough to reach its scene.
        "menu" => scene("menu", &[], 14),
        // Errors at the end of the first frame show in the second.
        "gears_unread" => scene("gears", &["--unread"], 2),
        "gears_samples_unread" => Scene {
            demo: "gears",
            arguments: &["--samples", "4", "--unread"],
            frames: 1,
            from: 0,
            window: true,
        },
        "teapot_srgb" => scene("teapot", &["--srgb"], 1),
        "room_srgb" => scene("room", &["--srgb"], 1),
        "shade_es2_samples" => Scene {
            demo: "shade",
            arguments: &["--profile", "es2", "--samples", "4"],
            frames: 1,
            from: 0,
            window: true,
        },
        "teapot_samples" => multisampled("teapot"),
        "room_samples" => multisampled("room"),
        _ => panic!("no scene {name}"),
    }
}

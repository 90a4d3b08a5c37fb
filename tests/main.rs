//! All tests but the unit tests, in one program: each file of this folder holds those of one subject, and a folder of the same name its parts.
//! `cargo test --release --test all -- oracle::` runs those of one file.
#![forbid(unsafe_code)]

mod answers;
mod auto;
mod bench;
mod both;
mod budget;
mod calibrate;
mod calibrate_glass;
mod calibrate_page;
mod calibrate_rough;
mod cases;
mod classes;
mod cli;
mod clip_form;
mod comfort;
mod conditions;
mod control;
mod docs;
mod doctor;
mod drawables;
mod drivers;
mod eyes;
mod faults;
mod fixed;
mod fixed_fragments;
mod fixed_shaders;
mod fixed_text;
mod follow;
mod front;
mod hard;
mod harm;
mod hosts;
mod interpose;
mod keys;
mod keys_wayland;
mod launch_ways;
mod launches;
mod layering;
mod limits;
mod looks;
mod memory;
mod mono;
mod notices;
mod occlusion;
#[allow(
    dead_code,
    unreachable_pub,
    missing_docs,
    reason = "it is a simulator of its own, of which a test uses a part"
)]
mod optics;
mod oracle;
mod osd;
mod outputs;
mod overhead_ways;
mod pace;
mod packages;
mod panel;
mod panel_programs;
mod panel_wayland;
mod panel_ways;
mod passes;
mod passthrough;
mod piglit;
mod plugged;
mod points;
mod programs;
mod prove;
mod quad;
mod quilts;
mod random;
mod recorded;
mod release;
mod robust;
mod sampling;
mod shaded;
mod shaders;
mod show;
mod simulate;
mod soak;
mod splats;
mod support;
mod synthesis;
mod viewer;
mod volume;
mod volume_cost;
mod wall;
mod wall_photos;
mod weave_cost;
mod windows;

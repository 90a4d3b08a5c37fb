//! How a frame is drawn.

/// What is the same for all nodes of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// By how much points are larger.
    pub scale: f32,
    /// How much of the file was read, 0 to 1, where a bar shall say so.
    pub progress: Option<f32>,
}

//! Textures of numbers.

use glow::HasContext;

/// A 2D texture whose texels are read as they are, which it leaves bound. It is deleted with the context.
///
/// # Errors
/// The driver has no memory.
///
/// # Safety
/// The context is current on this thread.
pub(super) unsafe fn texture(gl: &glow::Context) -> Result<glow::Texture, String> {
    // SAFETY: forwarded.
    unsafe {
        let texture = gl.create_texture()?;
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        for name in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, name, glow::NEAREST as i32);
        }
        Ok(texture)
    }
}

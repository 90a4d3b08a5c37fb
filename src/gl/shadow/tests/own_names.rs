//! Names of the layer's own textures in a share group.

use super::*;

#[test]
fn a_name_that_the_program_takes_is_not_deleted() {
    let fake = Fake::new().window(64, 32);
    let shared = Shared::default();
    let [first, second] = [0; 2].map(|_| ContextShadow::new(fake.real(), shared.clone()));
    let other = shadow(&fake);
    let gl = fake.gl();
    let [kept, taken] = current(&first, || [gl.gen_texture(), gl.gen_texture()]);
    current(&second, || {
        assert!(is_own_texture(kept) && is_own_texture(taken));
        assert!(!are_textures_taken());
        gl.free_texture(taken);
        assert!(is_own_texture(kept) && !is_own_texture(taken));
    });
    current(&other, || {
        assert!(!is_own_texture(kept) && !are_textures_taken());
    });
    current(&first, || {
        assert!(are_textures_taken() && !is_own_texture(taken));
        fake.forget();
        gl.delete_texture(taken);
        assert_eq!(fake.count("glDeleteTextures"), 0, "it is the program's");
        gl.delete_texture(kept);
        assert_eq!(fake.count("glDeleteTextures"), 1);
    });
}

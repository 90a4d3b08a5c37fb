//! The fake driver answers as a driver does where the layer looks.

use super::*;
use crate::gl::TextureName;

#[test]
fn calls_are_recorded_in_order_with_their_arguments() {
    let fake = Fake::new();
    let gl = fake.gl();
    gl.viewport(1, 2, 3, 4);
    gl.use_program(ProgramName(7));
    gl.load_matrix(&[0.5; 16]);
    gl.draw_buffers(&[c::BACK, c::NONE]);
    assert_eq!(
        fake.lines("gl*"),
        [
            "glViewport(1, 2, 3, 4)",
            "glUseProgram(7)",
            &format!("glLoadMatrixf({:?})", [0.5; 16]),
            "glDrawBuffers([1029.0, 0.0])",
        ]
    );
    assert_eq!((fake.count("glUse*"), fake.count("glUse")), (1, 0));
    fake.forget();
    assert!(fake.calls().is_empty());
    assert_eq!(fake.value(c::CURRENT_PROGRAM), [7.0]);
}

#[test]
fn what_is_set_is_answered() {
    let fake = Fake::new().window(640, 480);
    let gl = fake.gl();
    assert_eq!(gl.get_integers(c::VIEWPORT), [0, 0, 640, 480]);
    gl.viewport(-1, 2, 30, 40);
    gl.viewport_indexed_f(2, 0.5, 0.25, 8.0, 4.0);
    assert_eq!(gl.get_integers(c::VIEWPORT), [-1, 2, 30, 40]);
    let viewports = [1, 2].map(|at| gl.get_integers_indexed::<4>(c::VIEWPORT, at)[2]);
    assert_eq!(viewports, [30, 8]);
    gl.enable(c::DEPTH_TEST);
    gl.enablei(c::BLEND, 3);
    assert!(gl.is_enabled(c::DEPTH_TEST) && !gl.is_enabled(c::BLEND));
    assert!(gl.is_enabledi(c::BLEND, 3));
    gl.active_texture(c::TEXTURE0 + 3);
    gl.bind_texture(c::TEXTURE_2D, TextureName(9));
    gl.active_texture(c::TEXTURE0);
    assert_eq!(gl.get_integer(c::TEXTURE_BINDING_2D), 0);
    assert_eq!(
        fake.state().get(Scope::Unit(3), c::TEXTURE_BINDING_2D),
        [9.0]
    );
    gl.matrix_mode(c::PROJECTION);
    gl.push_matrix();
    gl.load_matrix(&[2.0; 16]);
    assert_eq!(gl.get_matrix(c::PROJECTION_MATRIX), [2.0; 16]);
    assert_eq!(gl.get_integer(c::PROJECTION_STACK_DEPTH), 2);
    gl.pop_matrix();
    assert_eq!(gl.get_floats::<2>(c::PROJECTION_MATRIX), [1.0, 0.0]);
}

#[test]
fn a_test_chooses_version_and_extensions() {
    let fake = Fake::new().version(3, 2).extensions(["GL_ARB_a", "GL_b"]);
    let gl = fake.gl();
    assert_eq!((gl.version(), gl.is_es()), ((3, 2), false));
    assert!(gl.has_extension("GL_ARB_a") && !gl.has_extension("GL_ARB"));
    let fake = fake.version(2, 1);
    assert!(fake.gl().has_extension("GL_b"), "by the one string");
    let fake = fake.es(3, 1);
    assert_eq!((fake.gl().version(), fake.gl().is_es()), ((3, 1), true));
}

#[test]
fn a_missing_command_is_not_called() {
    let fake = Fake::new().without("glPolygonOffsetClamp");
    fake.gl().polygon_offset_clamp(1.0, 1.0, 1.0);
    fake.gl().polygon_offset(1.0, 1.0);
    assert_eq!(fake.lines("gl*"), ["glPolygonOffset(1.0, 1.0)"]);
}

#[test]
fn names_live_until_they_are_deleted() {
    let fake = Fake::new();
    let gl = fake.gl();
    let (a, b) = (gl.gen_texture(), gl.gen_texture());
    assert_ne!(a, b);
    gl.bind_texture(c::TEXTURE_2D, a);
    gl.delete_texture(a);
    assert_eq!(gl.get_integer(c::TEXTURE_BINDING_2D), 0);
    assert!(gl.is_texture(a) == 0 && gl.is_texture(b) != 0);
    let chosen = TextureName(40);
    gl.bind_texture(c::TEXTURE_2D, chosen);
    assert!(gl.is_texture(chosen) != 0 && gl.gen_texture() == TextureName(41));
    // A texture keeps the target that it was bound at first.
    gl.bind_texture(c::TEXTURE_3D, chosen);
    assert_eq!(gl.get_error(), c::INVALID_OPERATION);
    assert_eq!(gl.get_integer(c::TEXTURE_BINDING_3D), 0);
}

#[test]
fn programs_have_the_uniforms_that_they_declare() {
    let fake = Fake::new();
    let gl = fake.gl();
    let text = "#version 150\nuniform vec4 rows[3]; // uniform int no;\nuniform highp sampler2D map;\nin vec2 at;\nvoid main() {}";
    let shader = gl.compile(c::VERTEX_SHADER, text).expect("compiles");
    let program = gl.link(&[shader]).expect("links");
    let actives = gl.active_uniforms(program);
    let told: Vec<_> = actives.iter().map(|a| (a.name.to_str(), a.size)).collect();
    assert_eq!(told, [(Ok("rows[0]"), 3), (Ok("map"), 1)]);
    assert_eq!(gl.active_attributes(program).len(), 1);
    let location = |name| gl.uniform_location(program, name);
    assert_eq!((location(c"rows[2]"), location(c"map")), (2, 3));
    assert_eq!((location(c"no"), location(c"rows[3]")), (-1, -1));
    gl.use_program(program);
    gl.uniform_4fv(0, &[[1.0; 4], [2.0; 4]]);
    assert_eq!(fake.uniform(program, "rows[1]"), [2.0; 4]);
    fake.refuse_shaders("vec5");
    assert!(gl.compile(c::VERTEX_SHADER, "vec5 x;").is_err());
}

#[test]
fn a_framebuffer_tells_what_is_attached() {
    let fake = Fake::new();
    let gl = fake.gl();
    gl.bind_framebuffer(c::FRAMEBUFFER, gl.gen_framebuffer());
    let (target, color) = (c::FRAMEBUFFER, c::COLOR_ATTACHMENT0);
    gl.framebuffer_texture_layer(target, color, gl.gen_texture(), 0, 2);
    gl.framebuffer_texture(target, c::DEPTH_STENCIL_ATTACHMENT, gl.gen_texture(), 0);
    let told = gl.attachments(c::DRAW_FRAMEBUFFER);
    let told: Vec<_> = told.iter().map(|a| (a.point, a.layer, a.layered)).collect();
    assert_eq!(
        told,
        [
            (c::COLOR_ATTACHMENT0, 2, false),
            (c::DEPTH_ATTACHMENT, 0, true),
            (c::STENCIL_ATTACHMENT, 0, true)
        ]
    );
    assert_eq!(gl.get_integer(c::READ_BUFFER) as u32, c::COLOR_ATTACHMENT0);
    fake.set_framebuffer_status(0x8CDD);
    assert_eq!(gl.check_framebuffer_status(c::FRAMEBUFFER), 0x8CDD);
    fake.raise(c::INVALID_ENUM);
    let errors = [gl.get_error(), gl.get_error()];
    assert_eq!(errors, [c::INVALID_ENUM, c::NO_ERROR]);
}

#[test]
fn attributes_come_back_by_their_groups() {
    let fake = Fake::new();
    let gl = fake.gl();
    let before = fake.state();
    gl.push_attrib(c::CURRENT_BIT);
    gl.color_4f(0.5, 0.5, 0.5, 0.5);
    gl.enable(c::FOG);
    gl.pop_attrib();
    assert_eq!(fake.value(c::CURRENT_COLOR), [1.0; 4]);
    assert!(fake.state().is_enabled(c::FOG));
    gl.disable(c::FOG);
    gl.push_attrib(c::ALL_ATTRIB_BITS);
    gl.enable(c::FOG);
    gl.viewport(1, 1, 1, 1);
    gl.use_program(ProgramName(3));
    gl.pop_attrib();
    gl.use_program(ProgramName::ZERO);
    fake.assert_restored(&before);
}

#[test]
fn buffers_hold_what_is_put_there() {
    let fake = Fake::new();
    let gl = fake.gl();
    gl.bind_buffer(c::PIXEL_PACK_BUFFER, gl.gen_buffer());
    gl.buffer_data_empty(c::PIXEL_PACK_BUFFER, 64);
    let mut floats = [1.0f32; 4];
    gl.get_buffer_floats(c::PIXEL_PACK_BUFFER, 0, &mut floats);
    assert_eq!(floats, [0.0; 4]);
}

#[test]
fn a_difference_is_told_in_a_sentence() {
    let fake = Fake::new();
    let ours = fake.gl().gen_texture();
    let theirs = fake.program(|gl| {
        let texture = gl.gen_texture();
        gl.bind_texture(c::TEXTURE_2D, texture);
        gl.bind_texture(c::TEXTURE_2D, TextureName::ZERO);
        texture
    });
    let before = fake.state();
    let gl = fake.gl();
    let differences = || before.differences(&fake.state());
    gl.bind_texture(c::TEXTURE_2D, ours);
    gl.tex_parameteri(c::TEXTURE_2D, c::TEXTURE_MAX_LEVEL, 0);
    gl.bind_texture(c::TEXTURE_2D, TextureName::ZERO);
    assert_eq!(differences(), [""; 0], "a texture of ours");
    gl.bind_texture(c::TEXTURE_2D, theirs);
    gl.tex_parameteri(c::TEXTURE_2D, c::TEXTURE_MAX_LEVEL, 0);
    gl.viewport_indexed_f(3, 0.0, 0.0, 8.0, 8.0);
    assert_eq!(
        differences(),
        [
            "GL_VIEWPORT of index 3 was [0.0, 0.0, 64.0, 48.0] and is [0.0, 0.0, 8.0, 8.0]",
            "GL_TEXTURE_BINDING_2D of texture unit 0 was [0.0] and is [2.0]",
            "GL_TEXTURE_MAX_LEVEL of texture 2 was [1000.0] and is [0.0]",
        ]
    );
}

#[test]
fn the_calls_of_the_program_are_not_those_of_the_layer() {
    let fake = Fake::new();
    fake.program(|gl| gl.get_integer(c::VIEWPORT));
    assert!(fake.calls().is_empty() && fake.asked().is_empty());
    fake.gl().get_integer(c::DEPTH_FUNC);
    fake.gl().get_integer(c::DEPTH_FUNC);
    let asked = [("glGetIntegerv GL_DEPTH_FUNC".to_owned(), 2)];
    assert_eq!(fake.asked(), asked);
    fake.assert_asks_nothing(|| fake.gl().get_error());
}

#[test]
#[should_panic(expected = "does not know")]
fn a_question_without_an_answer_fails() {
    let fake = Fake::new();
    fake.gl().get_integer(0xDEAD);
}

#[test]
fn each_thread_has_a_driver_of_its_own() {
    let fake = Fake::new();
    fake.gl().depth_func(c::EQUAL);
    let other = std::thread::spawn(|| {
        let fake = Fake::new();
        fake.value(c::DEPTH_FUNC)
    });
    assert_eq!(other.join().expect("ends"), [513.0]);
    assert_eq!(fake.value(c::DEPTH_FUNC), [f64::from(c::EQUAL)]);
    assert_eq!(fake.draws().len(), 0);
}

//! Whether a vertex shader puts all vertices at the far end of the depths, as skies are drawn: with z equal to w.

use super::scan::{Kind, Scan};

/// Tokens of a statement that is read, so that time is linear in the length of the source.
const LONGEST: usize = 512;

/// Whether the last value of `gl_Position` has z equal to w, by its text: `gl_Position = p.xyww`, `gl_Position = vec4(p.xy, p.w, p.w)`,
/// `gl_Position.z = gl_Position.w`. False where an `if` or `#if` decides.
pub(super) fn is_at_far_end(scan: &Scan) -> bool {
    let (mut braces, mut conditions) = (0_usize, 0_usize);
    let mut far = false;
    for (at, token) in scan.tokens.iter().enumerate() {
        if token.directive {
            if scan.is(at, b'#') {
                match &*scan.name(at + 1) {
                    b"if" | b"ifdef" | b"ifndef" => conditions += 1,
                    b"endif" => conditions = conditions.saturating_sub(1),
                    _ => {}
                }
            }
            continue;
        }
        match token.kind {
            Kind::Mark(b'{') => braces += 1,
            Kind::Mark(b'}') => braces = braces.saturating_sub(1),
            Kind::Name if *scan.name(at) == *b"gl_Position" => {
                // Statements of `main` that are not under a condition.
                let always = braces == 1 && conditions == 0 && starts_statement(scan, at);
                far = match written(scan, at) {
                    None => far,
                    Some(to_far) => to_far && always,
                };
            }
            _ => {}
        }
    }
    far
}

/// Whether a statement starts at a token: not one without braces after `if (…)` or `else`.
fn starts_statement(scan: &Scan, at: usize) -> bool {
    let directive = |at: &usize| scan.tokens.get(*at).is_none_or(|token| token.directive);
    let before = (0..at).rev().find(|at| !directive(at));
    before.is_some_and(|before| [b';', b'{', b'}'].iter().any(|&mark| scan.is(before, mark)))
}

/// Whether the token, `gl_Position`, gets a z equal to w; none where it keeps its z and w.
fn written(scan: &Scan, at: usize) -> Option<bool> {
    let part = match scan.is(at + 1, b'.') {
        true => Some(scan.name(at + 2)),
        false => None,
    };
    let operator = at + if part.is_some() { 3 } else { 1 };
    let is = |at: usize, mark: u8| scan.is(at, mark);
    let compound = [b'+', b'-', b'*', b'/']
        .iter()
        .any(|&mark| is(operator, mark))
        && is(operator + 1, b'=');
    let assigned = is(operator, b'=') && !is(operator + 1, b'=');
    let touches = part
        .as_ref()
        .is_none_or(|part| part.iter().any(|c| b"zwbapq".contains(c)));
    if !touches || !assigned && !compound {
        return None;
    }
    let Some(end) = (operator..operator + LONGEST).find(|&at| is(at, b';')) else {
        return Some(false);
    };
    let words: Vec<Vec<u8>> = (operator + 1..end).map(|at| word(scan, at)).collect();
    let words: Vec<&[u8]> = words.iter().map(Vec::as_slice).collect();
    Some(
        assigned
            && match part.as_deref() {
                Some(b"z") => words == [&b"gl_Position"[..], b".", b"w"],
                Some(_) => false,
                None => match words[..] {
                    [.., b".", b"xyww"] => true,
                    [
                        b"vec4",
                        b"(",
                        a,
                        b".",
                        b"xy",
                        b",",
                        b,
                        b".",
                        b"w",
                        b",",
                        c,
                        b".",
                        b"w",
                        b")",
                    ] => a == b && b == c,
                    [b"vec4", b"(", a, b".", b"xy", b",", b, b".", b"ww", b")"] => a == b,
                    _ => false,
                },
            },
    )
}

/// The text of a token.
fn word(scan: &Scan, at: usize) -> Vec<u8> {
    scan.tokens
        .get(at)
        .map_or(Vec::new(), |token| scan.text(token).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(main: &str) -> bool {
        let text = format!(
            "#version 330\nin vec3 at;\nuniform mat4 m;\nvoid main()\n{{\n    vec4 p = m * vec4(at, 1.0);\n{main}\n}}\n"
        );
        is_at_far_end(&Scan::new(text.as_bytes()))
    }

    #[test]
    fn the_last_value_of_the_position_counts() {
        for far in [
            "gl_Position = p.xyww;",
            "gl_Position = (m * vec4(at, 1.0)).xyww;",
            "gl_Position = vec4(p.xy, p.w, p.w);",
            "gl_Position = vec4(p.xy, p.ww);",
            "gl_Position = p; gl_Position.z = gl_Position.w;",
            "gl_Position = p; /* far */ gl_Position . z = gl_Position.w;",
            "gl_Position = p.xyww; gl_Position.y = -gl_Position.y;",
            "gl_Position = p.xyww; gl_Position.xy *= 2.0;",
            "#ifdef NONE\nfloat n;\n#endif\ngl_Position = p.xyww;",
        ] {
            assert!(of(far), "{far}");
        }
        let long = format!("gl_Position = (p{}).xyww;", " * 1.0".repeat(LONGEST));
        assert!(!of(&long), "not read to its end");
        for near in [
            "gl_Position = p;",
            "gl_Position = p.xyzw;",
            "gl_Position = p.xyww; gl_Position = p;",
            "gl_Position = p.xyww; gl_Position.z *= 0.5;",
            "gl_Position = p.xyww * 2.0;",
            "if (at.x > 0.0) gl_Position = p.xyww; else gl_Position = p;",
            "gl_Position = p; if (at.x > 0.0) { gl_Position = p.xyww; }",
            "gl_Position = p;\n#ifdef SKY\ngl_Position = p.xyww;\n#endif",
            "gl_Position = p; gl_Position.z = p.z;",
            "gl_Position = vec4(p.xy, at.x, p.w);",
            "if (gl_Position.z == gl_Position.w) gl_Position = p;",
        ] {
            assert!(!of(near), "{near}");
        }
    }
}

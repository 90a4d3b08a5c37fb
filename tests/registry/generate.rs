//! Generates `src/gl/table.rs` and `shim/src/entry.rs` from the Khronos registry and `src/gl/commands.list`, and fails when the committed
//! files differ from the output. `BLESS=1 cargo test -p manyview-registry` writes them. The registry is Debian's package `khronos-api`.

#![cfg(test)]

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

mod emit;

fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// One command as the registry or a `sig` line declares it.
#[derive(Clone, Debug)]
pub struct Command {
    pub name: String,
    pub class: String,
    /// The method of the shadow that gets its arguments, `itself` for that of its name, or none.
    pub note: String,
    /// It may set state of objects that contexts share.
    pub shared: bool,
    pub base: String,
    pub ret: String,
    pub params: Vec<Param>,
}

#[derive(Clone, Debug)]
pub struct Param {
    pub name: String,
    /// Rust type across the C ABI.
    pub ty: String,
    /// Number of elements behind a pointer, where the registry has a constant, and their C type.
    pub len: Option<usize>,
    pub pointee: String,
}

fn scalar(c: &str) -> &'static str {
    match c {
        "GLenum" | "GLbitfield" | "GLuint" | "GLhandleARB" => "u32",
        "GLint" | "GLsizei" | "GLclampx" | "GLfixed" => "i32",
        "GLboolean" | "GLubyte" => "u8",
        "GLbyte" | "GLchar" => "i8",
        "GLshort" => "i16",
        "GLushort" | "GLhalfNV" => "u16",
        "GLfloat" | "GLclampf" => "f32",
        "GLdouble" | "GLclampd" => "f64",
        "GLintptr" | "GLsizeiptr" | "GLintptrARB" | "GLsizeiptrARB" => "isize",
        "GLint64" | "GLint64EXT" => "i64",
        "GLuint64" | "GLuint64EXT" => "u64",
        "void" => "()",
        "GLvdpauSurfaceNV" => "isize",
        // Vendor types of commands that are not in the list; a listed one would fail to compile.
        _ => "UnknownType",
    }
}

/// The commands of gl.xml by name, with the name of the command each is an alias of.
fn registry() -> BTreeMap<String, Command> {
    let path = "/usr/share/khronos-api/gl.xml";
    let xml = std::fs::read_to_string(path)
        .unwrap_or_else(|e| panic!("{path}: {e}; install the package khronos-api (make packages)"));
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..Default::default()
    };
    let doc = roxmltree::Document::parse_with_options(&xml, options).expect("gl.xml parses");
    let mut all = BTreeMap::new();
    let text = |n: roxmltree::Node| {
        n.descendants()
            .filter_map(|d| if d.is_text() { d.text() } else { None })
            .collect::<String>()
    };
    for command in doc
        .descendants()
        .filter(|n| n.has_tag_name("command") && n.children().any(|c| c.has_tag_name("proto")))
    {
        let child = |n: roxmltree::Node, tag| n.children().find(|c| c.has_tag_name(tag)).map(text);
        let proto = command
            .children()
            .find(|c| c.has_tag_name("proto"))
            .expect("a prototype");
        let name = child(proto, "name").expect("a name");
        let full = text(proto);
        let ret = full.strip_suffix(&name).unwrap_or(&full).trim().to_string();
        let ret = if ret.contains('*') || ret == "GLsync" {
            "Ptr".into()
        } else {
            scalar(&ret).to_string()
        };
        let alias = command
            .children()
            .find(|c| c.has_tag_name("alias"))
            .and_then(|a| a.attribute("name"))
            .unwrap_or(&name);
        let params = command
            .children()
            .filter(|c| c.has_tag_name("param"))
            .map(|p| {
                let name = child(p, "name").expect("a parameter name");
                let full = text(p);
                let pointee = child(p, "ptype").unwrap_or_else(|| "void".into());
                let pointer = full.contains('*')
                    || full.contains('[')
                    || [
                        "GLsync",
                        "GLDEBUGPROC",
                        "GLDEBUGPROCARB",
                        "GLDEBUGPROCAMD",
                        "GLDEBUGPROCKHR",
                        "GLVULKANPROCNV",
                        "GLeglImageOES",
                        "GLeglClientBufferEXT",
                    ]
                    .contains(&pointee.as_str());
                let ty = if pointer { "Ptr" } else { scalar(&pointee) };
                let name = if ["type", "ref", "in", "box"].contains(&name.as_str()) {
                    format!("{name}_")
                } else {
                    name
                };
                Param {
                    name,
                    ty: ty.into(),
                    len: p.attribute("len").and_then(|l| l.parse().ok()),
                    pointee,
                }
            })
            .collect();
        let c = Command {
            name: name.clone(),
            class: String::new(),
            note: String::new(),
            shared: false,
            base: alias.to_string(),
            ret,
            params,
        };
        all.insert(name, c);
    }
    all
}

/// The commands of the list with their classes, aliases added, in the order of the list.
fn listed(registry: &BTreeMap<String, Command>) -> Vec<Command> {
    let list =
        std::fs::read_to_string(root().join("src/gl/commands.list")).expect("src/gl/commands.list");
    let mut out: Vec<Command> = Vec::new();
    let mut take = |c: &Command, class: &str, base: &str| {
        if !out.iter().any(|o| o.name == c.name) {
            out.push(Command {
                class: class.into(),
                base: base.into(),
                ..c.clone()
            });
        }
    };
    let lines = list.lines().map(str::trim);
    let lines = lines.filter(|l| !l.is_empty() && !l.starts_with('#'));
    let (notes, lines): (Vec<_>, Vec<_>) =
        lines.partition(|line| line.starts_with("note") || line.starts_with("shared"));
    for line in lines {
        let (class, rest) = line.split_once(' ').expect("a class and names");
        if class == "sig" {
            let (class, sig) = rest.split_once(' ').expect("a class and a signature");
            let c = signature(sig);
            take(&c, class, &c.name);
            continue;
        }
        for pattern in rest.split_whitespace() {
            let re = Pattern::new(pattern);
            let mut hits = registry.values().filter(|c| re.matches(&c.name)).peekable();
            assert!(
                hits.peek().is_some(),
                "no command of the registry matches `{pattern}`"
            );
            for base in hits {
                take(base, class, &base.name);
                if class != "call" {
                    // Aliases may form a chain; the base of the family counts.
                    for alias in registry.values().filter(|c| {
                        c.base == base.name
                            || c.name == base.base
                            || (base.base == c.base && c.name != base.name)
                    }) {
                        take(alias, class, &base.name);
                    }
                }
            }
        }
    }
    for line in notes {
        let (note, rest) = line.split_once(' ').expect("a note and names");
        let note = note.split_once(':').map_or("itself", |(_, method)| method);
        for pattern in rest.split_whitespace() {
            let re = Pattern::new(pattern);
            let mut found = false;
            for c in out
                .iter_mut()
                .filter(|c| re.matches(&c.name) || re.matches(&c.base))
            {
                c.note = note.into();
                c.shared = line.starts_with("shared");
                found = true;
            }
            assert!(found, "no command of the list matches `{pattern}`");
        }
    }
    out
}

fn signature(sig: &str) -> Command {
    let (head, ret) = sig.split_once(" -> ").unwrap_or((sig, "()"));
    let (name, args) = head.split_once('(').expect("a parameter list");
    let params = args
        .trim_end_matches(')')
        .split(", ")
        .filter(|a| !a.is_empty())
        .map(|a| {
            let (n, t) = a.split_once(": ").expect("name: type");
            Param {
                name: n.into(),
                ty: t.into(),
                len: None,
                pointee: String::new(),
            }
        })
        .collect();
    Command {
        name: name.into(),
        class: String::new(),
        note: String::new(),
        shared: false,
        base: name.into(),
        ret: ret.into(),
        params,
    }
}

/// The constructs of regular expressions that the list uses: classes, groups of alternatives, `?`.
struct Pattern(Vec<String>);

impl Pattern {
    fn new(p: &str) -> Self {
        Pattern(expand(p))
    }
    fn matches(&self, name: &str) -> bool {
        self.0.iter().any(|n| n == name)
    }
}

/// Every name that a pattern stands for.
fn expand(p: &str) -> Vec<String> {
    let chars: Vec<char> = p.chars().collect();
    let mut out = vec![String::new()];
    let mut i = 0;
    while i < chars.len() {
        let (mut options, next) = match chars[i] {
            '[' => {
                let end = i + chars[i..]
                    .iter()
                    .position(|&c| c == ']')
                    .expect("a closing ]");
                let mut set = Vec::new();
                let mut j = i + 1;
                while j < end {
                    if j + 2 < end && chars[j + 1] == '-' {
                        set.extend((chars[j]..=chars[j + 2]).map(String::from));
                        j += 3;
                    } else {
                        set.push(chars[j].to_string());
                        j += 1;
                    }
                }
                (set, end + 1)
            }
            '(' => {
                let end = i + chars[i..]
                    .iter()
                    .position(|&c| c == ')')
                    .expect("a closing )");
                let inner: String = chars[i + 1..end].iter().collect();
                (inner.split('|').flat_map(expand).collect(), end + 1)
            }
            c => (vec![c.to_string()], i + 1),
        };
        i = next;
        if chars.get(i) == Some(&'?') {
            options.push(String::new());
            i += 1;
        }
        out = out
            .iter()
            .flat_map(|o| options.iter().map(move |x| format!("{o}{x}")))
            .collect();
    }
    out
}

#[test]
fn generated_tables_are_current() {
    let registry = registry();
    let commands = listed(&registry);
    let mut stale = String::new();
    for (path, text) in [
        ("src/gl/table.rs", emit::table(&commands)),
        ("shim/src/entry.rs", emit::entry(&commands)),
    ] {
        let file = root().join(path);
        let old = std::fs::read_to_string(&file).unwrap_or_default();
        if old != text {
            if std::env::var_os("BLESS").is_some() {
                std::fs::write(&file, &text).expect("writing the table");
            } else {
                writeln!(stale, "{path}").expect("a string");
            }
        }
    }
    assert!(
        stale.is_empty(),
        "not what the registry gives (BLESS=1 cargo test -p manyview-registry writes them):\n{stale}"
    );
}

#[test]
fn patterns_stand_for_names() {
    assert_eq!(
        expand("glA[1-3](x|y)?"),
        [
            "glA1x", "glA1y", "glA1", "glA2x", "glA2y", "glA2", "glA3x", "glA3y", "glA3"
        ]
    );
}

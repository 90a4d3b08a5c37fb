//! Limits on the size of the source's parts, and no circular imports between files. Tests and generated files are left out.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// Fields of a type, unless "More than 12 fields: …" stands in its documentation.
const FIELDS: usize = 12;
/// Methods of a type, unless "More than 25 methods: …" stands in its documentation.
const METHODS: usize = 25;
/// Lines of a function in the path of a draw.
const LINES: usize = 70;
/// The path of a draw.
const PATH: [&str; 4] = ["src/draw", "src/layer", "src/plan", "src/state"];
/// Generated from the Khronos registry.
const GENERATED: [&str; 2] = ["src/gl/table.rs", "shim/src/entry.rs"];

/// A module, by the names from the root of its crate.
type Module = Vec<String>;

/// The files of a crate, parsed.
fn parsed(root: &str) -> BTreeMap<PathBuf, syn::File> {
    let base = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = BTreeMap::new();
    let mut folders = vec![base.join(root)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder").flatten() {
            let path = entry.path();
            let short = path.strip_prefix(base).expect("below").to_owned();
            let is_test = path
                .file_stem()
                .is_some_and(|name| name == "tests" || name.to_string_lossy().ends_with("_tests"));
            if is_test || GENERATED.iter().any(|file| Path::new(file) == short) {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("UTF-8");
                found.insert(short, syn::parse_file(&text).expect("Rust"));
            }
        }
    }
    assert!(found.len() > 10, "{root} has Rust files");
    found
}

fn sources() -> BTreeMap<PathBuf, syn::File> {
    let mut all = parsed("src");
    all.extend(parsed("shim/src"));
    all.extend(parsed("viewer/src"));
    all
}

/// Whether an item is compiled for tests only.
fn of_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute
                .parse_args::<syn::Path>()
                .is_ok_and(|of| of.is_ident("test"))
    })
}

/// The documentation of an item.
fn documentation(attributes: &[syn::Attribute]) -> String {
    let lines = attributes.iter().filter_map(|attribute| {
        let syn::Meta::NameValue(pair) = &attribute.meta else {
            return None;
        };
        match &pair.value {
            syn::Expr::Lit(syn::ExprLit {
                lit: syn::Lit::Str(text),
                ..
            }) if pair.path.is_ident("doc") => Some(text.value()),
            _ => None,
        }
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The measures of a source.
#[derive(Default)]
struct Measured {
    /// The first folder or file below the crate's, which tells types of one name apart.
    place: String,
    file: String,
    types: BTreeMap<(String, String), Type>,
    methods: BTreeMap<(String, String), usize>,
    long: Vec<String>,
}

struct Type {
    file: String,
    fields: usize,
    documentation: String,
}

impl Measured {
    fn of(sources: &BTreeMap<PathBuf, syn::File>) -> Self {
        let mut measured = Measured::default();
        for (path, file) in sources {
            measured.file = path.display().to_string();
            let is_crate = path.starts_with("shim") || path.starts_with("viewer");
            let depth = if is_crate { 3 } else { 2 };
            let place: PathBuf = path.iter().take(depth).collect();
            measured.place = place.with_extension("").display().to_string();
            measured.visit_file(file);
        }
        measured
    }

    fn add(&mut self, name: &syn::Ident, fields: usize, attributes: &[syn::Attribute]) {
        let key = (self.place.clone(), name.to_string());
        let (file, documentation) = (self.file.clone(), documentation(attributes));
        self.types.insert(
            key,
            Type {
                file,
                fields,
                documentation,
            },
        );
    }

    fn measure(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let lines = block.span().end().line - signature.span().start().line + 1;
        if lines > LINES && PATH.iter().any(|folder| self.file.starts_with(folder)) {
            let line = format!("{}: {} has {lines} lines", self.file, signature.ident);
            self.long.push(line);
        }
    }
}

impl<'ast> Visit<'ast> for Measured {
    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        if !of_tests(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_struct(&mut self, item: &'ast syn::ItemStruct) {
        self.add(&item.ident, item.fields.len(), &item.attrs);
    }

    fn visit_item_enum(&mut self, item: &'ast syn::ItemEnum) {
        self.add(&item.ident, 0, &item.attrs);
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if of_tests(&item.attrs) {
            return;
        }
        if let (None, syn::Type::Path(of)) = (&item.trait_, &*item.self_ty)
            && let Some(name) = of.path.segments.last()
        {
            let functions = item
                .items
                .iter()
                .filter(|inner| matches!(inner, syn::ImplItem::Fn(f) if !of_tests(&f.attrs)));
            let key = (self.place.clone(), name.ident.to_string());
            *self.methods.entry(key).or_default() += functions.count();
        }
        visit::visit_item_impl(self, item);
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        if !of_tests(&item.attrs) {
            self.measure(&item.sig, &item.block);
            visit::visit_item_fn(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.measure(&item.sig, &item.block);
        visit::visit_impl_item_fn(self, item);
    }
}

/// Describes a type that breaks a limit: it has more than `most` without a reason in its documentation, or a reason that it does not need.
fn judge(of: &Type, name: &str, count: usize, most: usize, what: &str) -> Option<String> {
    let reason = of
        .documentation
        .contains(&format!("More than {most} {what}:"));
    match (count > most, reason) {
        (true, false) => Some(format!("{}: {name} has {count} {what}", of.file)),
        (false, true) => Some(format!(
            "{}: {name} has {count} {what} and needs no reason",
            of.file
        )),
        _ => None,
    }
}

#[test]
fn types_are_small() {
    let measured = Measured::of(&sources());
    let mut wrong = Vec::new();
    for (key, of) in &measured.types {
        let methods = measured.methods.get(key).copied().unwrap_or_default();
        wrong.extend(judge(of, &key.1, of.fields, FIELDS, "fields"));
        wrong.extend(judge(of, &key.1, methods, METHODS, "methods"));
    }
    assert!(measured.types.len() > 100 && measured.methods.len() > 100);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn functions_in_the_path_of_a_draw_are_short() {
    let measured = Measured::of(&sources());
    assert!(measured.long.is_empty(), "{}", measured.long.join("\n"));
}

#[test]
fn what_is_too_large_is_found() {
    let text = format!(
        "struct Wide {{ {} }} impl Wide {{ fn long() {{ {} }} }} #[cfg(test)] mod tests {{ fn f() {{ {} }} }}",
        (0..13).map(|n| format!("f{n}: u8,")).collect::<String>(),
        "\n".repeat(70),
        "\n".repeat(70),
    );
    let file = syn::parse_file(&text).expect("Rust");
    let measured = Measured::of(&BTreeMap::from([("src/draw/wide.rs".into(), file)]));
    assert_eq!(measured.long, ["src/draw/wide.rs: long has 71 lines"]);
    let key = ("src/draw".to_owned(), "Wide".to_owned());
    let wide = &measured.types[&key];
    assert!(judge(wide, "Wide", wide.fields, FIELDS, "fields").is_some());
    assert!(judge(wide, "Wide", FIELDS, FIELDS, "fields").is_none());
    assert_eq!(measured.methods[&key], 1);
}

/// The module of a file.
fn module(path: &Path, root: &str) -> Module {
    let below = path.strip_prefix(root).expect("below the root");
    let mut parts: Module = below
        .with_extension("")
        .iter()
        .map(|part| part.to_string_lossy().into_owned())
        .collect();
    if parts
        .last()
        .is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str()))
    {
        parts.pop();
    }
    parts
}

/// The modules that a module names.
struct Named<'a> {
    own: Module,
    all: &'a BTreeSet<Module>,
    found: BTreeSet<Module>,
}

impl Named<'_> {
    /// Adds the deepest module of a path.
    fn name(&mut self, path: &[String]) {
        let mut at: Module = Vec::new();
        let mut rest = path;
        match path.first().map(String::as_str) {
            Some("crate") => rest = &path[1..],
            Some("self") => (at, rest) = (self.own.clone(), &path[1..]),
            Some("super") => {
                at.clone_from(&self.own);
                while let Some("super") = rest.first().map(String::as_str) {
                    at.pop();
                    rest = &rest[1..];
                }
            }
            _ => return,
        }
        for name in rest {
            at.push(name.clone());
            if !self.all.contains(&at) {
                at.pop();
                break;
            }
        }
        // An ancestor of a module contains it and is not an import.
        if !self.own.starts_with(&at) {
            self.found.insert(at);
        }
    }

    fn tree(&mut self, path: &mut Vec<String>, tree: &syn::UseTree) {
        match tree {
            syn::UseTree::Path(of) => {
                path.push(of.ident.to_string());
                self.tree(path, &of.tree);
                path.pop();
            }
            syn::UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.tree(path, tree));
            }
            syn::UseTree::Name(name) => {
                path.push(name.ident.to_string());
                self.name(path);
                path.pop();
            }
            syn::UseTree::Rename(name) => {
                path.push(name.ident.to_string());
                self.name(path);
                path.pop();
            }
            syn::UseTree::Glob(_) => self.name(path),
        }
    }
}

impl<'ast> Visit<'ast> for Named<'_> {
    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        if !of_tests(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        if !of_tests(&item.attrs) {
            self.tree(&mut Vec::new(), &item.tree);
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Vec<_> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.name(&names);
        visit::visit_path(self, path);
    }
}

/// Which modules each module of a crate names.
fn imports(files: &BTreeMap<PathBuf, syn::File>, root: &str) -> BTreeMap<Module, BTreeSet<Module>> {
    let all: BTreeSet<Module> = files.keys().map(|path| module(path, root)).collect();
    let of = |(path, file): (&PathBuf, &syn::File)| {
        let own = module(path, root);
        let mut named = Named {
            own: own.clone(),
            all: &all,
            found: BTreeSet::new(),
        };
        named.visit_file(file);
        (own, named.found)
    };
    files.iter().map(of).collect()
}

/// The modules that import themselves by way of others.
fn circles(imports: &BTreeMap<Module, BTreeSet<Module>>) -> Vec<String> {
    let reached = |from: &Module| {
        let mut reached: BTreeSet<&Module> = BTreeSet::new();
        let mut next: Vec<&Module> = imports[from].iter().collect();
        while let Some(module) = next.pop() {
            if reached.insert(module) {
                next.extend(imports.get(module).into_iter().flatten());
            }
        }
        reached
    };
    let circular = |module: &&Module| reached(module).contains(module);
    let names = |module: &Module| {
        let direct = imports[module]
            .iter()
            .filter(|other| reached(other).contains(module));
        let direct: Vec<_> = direct.map(|other| other.join("/")).collect();
        format!("{} uses {}", module.join("/"), direct.join(", "))
    };
    imports.keys().filter(circular).map(names).collect()
}

#[test]
fn files_import_each_other_one_way() {
    for root in ["src", "shim/src", "viewer/src"] {
        let mut files = parsed(root);
        // The other generated file, `src/gl/table.rs`, declares the methods of `Real` and is one with `src/gl/real.rs`.
        for generated in GENERATED.iter().filter(|_| root == "shim/src").skip(1) {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(generated);
            let text = fs::read_to_string(path).expect("UTF-8");
            files.insert(generated.into(), syn::parse_file(&text).expect("Rust"));
        }
        let mut imports = imports(&files, root);
        // The one exception: an exported function that a program looks up by name is found in the table of the exported functions
        // themselves, whose hooks reach everything.
        if let Some(exports) = imports.get_mut(&vec!["exports".to_owned()]) {
            assert!(exports.remove(&vec!["entry".to_owned()]));
        }
        let found = circles(&imports);
        assert!(found.is_empty(), "{root}: {}", found.join("\n"));
    }
}

#[test]
fn circles_are_found() {
    let file = |text: &str| syn::parse_file(text).expect("Rust");
    let files = BTreeMap::from([
        ("src/a/mod.rs".into(), file("mod b; mod c; use b::B;")),
        ("src/a/b.rs".into(), file("use super::{c::{C, D}, x};")),
        ("src/a/c.rs".into(), file("fn f() { super::d::g() }")),
        ("src/a/d.rs".into(), file("fn g(_: crate::a::b::B) {}")),
        ("src/e.rs".into(), file("use crate::a::b::B;")),
    ]);
    assert_eq!(
        circles(&imports(&files, "src")),
        ["a/b uses a/c", "a/c uses a/d", "a/d uses a/b"]
    );
}

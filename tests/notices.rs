//! Notices of the crates that the products contain, without which those may not be passed on. `make notices` writes THIRD-PARTY-NOTICES.txt from the
//! sources of the crates; the test fails when the file is not what comes out.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

const FILE: &str = "THIRD-PARTY-NOTICES.txt";
/// The machines that `make build` and `make build-32` build for.
const TARGETS: [&str; 2] = ["x86_64-unknown-linux-gnu", "i686-unknown-linux-gnu"];
/// How names of files with licences and notices begin, in capitals. A font has its licence under its own name.
const NAMES: [&str; 7] = [
    "LICENSE",
    "LICENCE",
    "COPYING",
    "COPYRIGHT",
    "NOTICE",
    "UFL",
    "OFL",
];
/// Licences that need not be passed on where the MIT licence may be chosen.
const OTHERS: [&str; 6] = ["APACHE", "BSL", "BOOST", "ZLIB", "UNLICENSE", "LGPL"];

const HEAD: &str = "\
Notices of third parties

manyview, libmanyview.so, manyview-probe and manyview-points contain the crates below. Under the names of crates, with the licences that they may be used under, are
the texts that the crates come with; of a crate with a choice of licences only those of the MIT licence, which is chosen. `make notices` writes this file.

They contain the Rust standard library as well, under the MIT licence; its authors are the contributors to the Rust project, https://www.rust-lang.org.
Charts of `manyview bench` are written in the Ubuntu font, copyright 2010, 2011 Canonical Ltd, under the Ubuntu Font Licence, from epaint_default_fonts.
";

/// Bytes of the shortest text of a licence. A shorter file is a link that was lost when the crate was packed.
const SHORTEST: usize = 100;

/// Told of crates that come without a text.
const MIT: &str = "\
Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the \"Software\"),
to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, publish, distribute, sublicense,
and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED \"AS IS\", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.
";

fn cargo(arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO"));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command.args(arguments).args(["--offline", "--locked"]);
    let output = command.output().expect("cargo runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Crates that the command, the library, the probe and the viewer are linked with, as name and version.
fn linked() -> BTreeSet<(String, String)> {
    let mut arguments = vec![
        "tree",
        "--prefix",
        "none",
        "--edges",
        "normal,no-proc-macro",
    ];
    arguments.extend([
        "-p",
        "manyview",
        "-p",
        "manyview-shim",
        "-p",
        "manyview-viewer",
    ]);
    for target in TARGETS {
        arguments.extend(["--target", target]);
    }
    let named = |line: &str| {
        let (name, rest) = line.split_once(" v")?;
        let version = rest.split(' ').next()?;
        (!name.starts_with("manyview")).then(|| (name.to_owned(), version.to_owned()))
    };
    cargo(&arguments).lines().filter_map(named).collect()
}

/// The texts in the folder of a crate, and in its folder of fonts.
fn texts(folder: &Path, licence: &str) -> BTreeSet<String> {
    let folders = [folder.to_owned(), folder.join("fonts")];
    let entries = folders
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).into_iter().flatten());
    let mut files: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    let name = |path: &Path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.to_ascii_uppercase()
    };
    files.retain(|path| path.is_file() && NAMES.iter().any(|begin| name(path).starts_with(begin)));
    if licence.contains("MIT") && files.iter().any(|path| name(path).contains("MIT")) {
        files.retain(|path| !OTHERS.iter().any(|other| name(path).contains(other)));
    }
    let text = |path| {
        std::fs::read_to_string(path)
            .expect("UTF-8")
            .replace("\r\n", "\n")
    };
    let texts = files
        .iter()
        .map(text)
        .map(|text| text.trim_matches('\n').to_owned());
    texts.filter(|text| text.len() > SHORTEST).collect()
}

/// What cargo tells of the crates of all targets. Those of other systems need not be there.
fn packages() -> Vec<Value> {
    let of = |target| {
        let words = [
            "metadata",
            "--format-version",
            "1",
            "--filter-platform",
            target,
        ];
        let mut all: Value = serde_json::from_str(&cargo(&words)).expect("JSON");
        let Value::Array(packages) = all["packages"].take() else {
            panic!("no crates");
        };
        packages
    };
    TARGETS.into_iter().flat_map(of).collect()
}

/// The notices of all crates, those with the same texts together.
fn notices() -> String {
    let packages = packages();
    let linked = linked();
    assert!(linked.len() > 50, "{linked:?}");
    let mut crates_by_text = BTreeMap::<_, BTreeSet<String>>::new();
    for package in packages.iter() {
        let field = |name: &str| package[name].as_str().unwrap_or_default().to_owned();
        if !linked.contains(&(field("name"), field("version"))) {
            continue;
        }
        let (licence, manifest) = (field("license"), field("manifest_path"));
        let folder = Path::new(&manifest).parent().expect("a folder");
        let mut all = texts(folder, &licence);
        if all.is_empty() {
            assert!(
                licence.contains("MIT"),
                "{manifest} has no text of its licence"
            );
            let authors = package["authors"]
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(Value::as_str);
            let mut authors = authors.collect::<Vec<_>>().join(", ");
            if authors.is_empty() {
                authors = format!("the authors of {}", field("name"));
            }
            all.insert(format!("Copyright (c) {authors}\n\n{}", MIT.trim_end()));
        }
        let line = format!("{} {} ({licence})", field("name"), field("version"));
        crates_by_text.entry(all).or_default().insert(line);
    }
    let mut groups: Vec<_> = crates_by_text
        .into_iter()
        .map(|(texts, crates)| (crates, texts))
        .collect();
    groups.sort();
    let mut all = HEAD.to_owned();
    for (crates, texts) in groups {
        let _ = write!(all, "\n{}\n", "=".repeat(80));
        crates.iter().for_each(|line| all += &format!("{line}\n"));
        texts
            .iter()
            .for_each(|text| all += &format!("{}\n{text}\n", "-".repeat(80)));
    }
    all
}

#[test]
fn every_crate_of_the_products_has_its_notice() {
    let notices = notices();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(FILE);
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&file, &notices).expect("written");
    }
    let kept = std::fs::read_to_string(&file).expect("THIRD-PARTY-NOTICES.txt");
    let first = notices
        .lines()
        .zip(kept.lines())
        .find(|(new, old)| new != old);
    assert!(
        notices == kept,
        "run make notices: the first line that differs is {first:?}"
    );
    for font in [
        "SIL OPEN FONT LICENSE",
        "UBUNTU FONT LICENCE",
        "Canonical Ltd",
    ] {
        assert!(notices.contains(font), "{font}");
    }
}

#[test]
fn notices_are_installed() {
    let makefile = include_str!("../Makefile");
    let install = makefile.split("\ninstall: ").nth(1).expect("a target");
    let install = install.split("\n\n").next().expect("its commands");
    assert!(install.contains(FILE), "{install}");
}

//! The Debian packages that `make deb` makes, unpacked to a folder as dpkg does to /: everything lies where the command and the loader look for it, for programs
//! of both classes. The package of i386 is there where `make build-32` has built its library.

use crate::support;
use crate::support::{bare, run, screen, target_folder};
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Where a program of a class finds the library by `LD_PRELOAD=/usr/$LIB/manyview/libmanyview.so`.
const WIDE: &str = "usr/lib/x86_64-linux-gnu/manyview/libmanyview.so";
const NARROW: &str = "usr/lib/i386-linux-gnu/manyview/libmanyview.so";

/// The packages, and the folder that they are unpacked to.
struct Packages {
    folder: TempDir,
    wide: PathBuf,
    narrow: Option<PathBuf>,
}

impl Packages {
    /// A path of the unpacked packages.
    fn path(&self, path: &str) -> PathBuf {
        self.folder.path().join("root").join(path)
    }

    /// The unpacked command, which gets no variables of the caller's that would lead it elsewhere.
    fn manyview(&self) -> Command {
        bare(self.path("usr/bin/manyview"))
    }

    fn all(&self) -> impl Iterator<Item = &PathBuf> {
        std::iter::once(&self.wide).chain(&self.narrow)
    }
}

/// Runs a program that has to succeed, and returns what it prints.
#[track_caller]
fn printed(command: &mut Command) -> String {
    let Output {
        status,
        stdout,
        stderr,
    } = command.output().expect("the program starts");
    let said = String::from_utf8_lossy(&stderr);
    assert!(status.success(), "{command:?}: {said}");
    String::from_utf8(stdout).expect("UTF-8")
}

/// Makes and unpacks them; none where the tools of Debian are missing.
fn make() -> Option<Packages> {
    for tool in ["dpkg-deb", "dpkg-shlibdeps"] {
        if Command::new(tool).arg("--version").output().is_err() {
            eprintln!("skipped: {tool} is missing (Debian package dpkg-dev)");
            return None;
        }
    }
    support::library();
    let folder = tempfile::tempdir().expect("a folder");
    let (out, root) = (folder.path().join("out"), folder.path().join("root"));
    let target = target_folder().parent().expect("a target folder");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("packaging/debian/build.sh");
    let mut build = bare("sh");
    build
        .arg(script)
        .arg(&out)
        .env("CARGO_TARGET_DIR", target)
        .env("BIN", target_folder());
    printed(&mut build);
    let package = |name: &str, architecture: &str| {
        let path = out.join(format!("{name}_{VERSION}_{architecture}.deb"));
        path.is_file().then_some(path)
    };
    let packages = Packages {
        wide: package("manyview", "amd64").expect("the package of the command"),
        narrow: package("libmanyview", "i386"),
        folder,
    };
    let has_narrow = target_folder().join("by-class/32/libmanyview.so").is_file();
    assert_eq!(packages.narrow.is_some(), has_narrow);
    for package in packages.all() {
        printed(Command::new("dpkg-deb").arg("-x").arg(package).arg(&root));
    }
    Some(packages)
}

/// A field of a package.
fn field(package: &Path, name: &str) -> String {
    let mut command = Command::new("dpkg-deb");
    let text = printed(command.arg("-f").arg(package).arg(name));
    text.trim().to_owned()
}

/// One test, because making the packages takes most of its time.
#[test]
#[ignore = "a minute: make test-long"]
fn the_debian_packages_are_right() {
    let Some(packages) = make() else { return };
    the_unpacked_command_finds_its_parts(&packages);
    programs_get_the_library_of_their_class(&packages);
    every_name_of_the_loader_leads_to_a_library_of_its_class(&packages);
    the_packages_have_what_belongs_to_them(&packages);
    the_packages_ask_for_what_they_are_linked_with(&packages);
    files_can_be_read_by_all_and_changed_by_their_owner_alone(&packages);
    lintian_finds_no_fault(&packages);
    appstream_finds_no_fault(&packages);
}

fn the_unpacked_command_finds_its_parts(packages: &Packages) {
    let told = printed(packages.manyview().arg("--version"));
    assert_eq!(told, format!("manyview {VERSION}\n"));
    let mut doctor = packages.manyview();
    let (code, told, stderr) = run(screen().give(doctor.args(["doctor", "--json"])));
    assert_eq!(code, 0, "{stderr}");
    let findings: serde_json::Value = serde_json::from_str(&told).expect("JSON");
    let library = packages.path("usr/lib/manyview/libmanyview.so");
    let library = library.canonicalize().expect("the library");
    assert_eq!(findings["library"]["Ok"], *library.to_str().expect("UTF-8"));
    for probe in findings["probes"].as_array().expect("probes") {
        // There is no OSMesa everywhere. A probe that was not found would not be listed.
        let missing = probe["error"].is_string();
        assert!(missing || probe["hooked"] == true, "{probe}");
    }
    assert!(!findings["probes"].as_array().expect("probes").is_empty());
    assert_eq!(findings["narrow"].is_string(), packages.narrow.is_some());
}

fn programs_get_the_library_of_their_class(packages: &Packages) {
    let mut command = packages.manyview();
    command.args(["run", "--display", "huebner8", "--", "sh", "-c"]);
    let (code, told, stderr) = run(command.arg("echo \"$LD_PRELOAD\""));
    // The loader tells of a library that it cannot load.
    assert_eq!((code, &*stderr), (0, ""));
    let end = match packages.narrow {
        Some(_) => "/usr/lib/manyview/by-class/$LIB/libmanyview.so\n",
        None => "/usr/lib/manyview/libmanyview.so\n",
    };
    assert!(told.ends_with(end), "{told}");
}

/// The class of an ELF file: 1 for 32 bits, 2 for 64; 0 for other files.
fn class(path: &Path) -> u8 {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    match bytes {
        bytes if bytes.starts_with(b"\x7fELF") => bytes[4],
        _ => 0,
    }
}

fn every_name_of_the_loader_leads_to_a_library_of_its_class(packages: &Packages) {
    let links = "usr/lib/manyview/by-class";
    let mut wide = vec![
        WIDE.to_owned(),
        "usr/lib/manyview/libmanyview.so".to_owned(),
    ];
    for name in ["64", "lib64", "lib/x86_64-linux-gnu"] {
        wide.push(format!("{links}/{name}/libmanyview.so"));
    }
    for path in wide {
        assert_eq!(class(&packages.path(&path)), 2, "{path}");
    }
    let mut narrow = vec![NARROW.to_owned()];
    for name in ["32", "lib32", "lib/i386-linux-gnu"] {
        narrow.push(format!("{links}/{name}/libmanyview.so"));
    }
    for path in narrow {
        let file = packages.path(&path);
        match packages.narrow {
            Some(_) => assert_eq!(class(&file), 1, "{path}"),
            // By a link that leads nowhere the command knows that there is none.
            None => assert!(!file.exists(), "{path}"),
        }
    }
    if packages.narrow.is_some() {
        // The layer looks for profiles beside its library, links of the library followed.
        let beside = packages.path(NARROW).canonicalize().expect("the library");
        let profiles = beside.with_file_name("profiles");
        assert!(profiles.join("quake3.toml").is_file());
        assert_eq!(class(&beside.with_file_name("manyview-probe")), 1);
    }
}

fn the_packages_have_what_belongs_to_them(packages: &Packages) {
    for path in [
        "usr/share/man/man1/manyview.1.gz",
        "usr/share/man/man1/manyview-run.1.gz",
        "usr/share/bash-completion/completions/manyview",
        "usr/share/zsh/vendor-completions/_manyview",
        "usr/share/fish/vendor_completions.d/manyview.fish",
        "usr/share/metainfo/io.github.manyview.manyview.metainfo.xml",
        "usr/share/doc/manyview/copyright",
        "usr/share/doc/manyview/changelog.gz",
        "usr/share/doc/manyview/THIRD-PARTY-NOTICES.txt",
    ] {
        assert!(packages.path(path).is_file(), "{path}");
    }
    let copyright = packages.path("usr/share/doc/manyview/copyright");
    let copyright = fs::read_to_string(copyright).expect("the copyright file");
    let licence = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("LICENSE"));
    let licence = licence.expect("LICENSE");
    let granted = licence.lines().skip_while(|l| !l.starts_with("Permission"));
    for line in granted.filter(|line| !line.is_empty()) {
        assert!(copyright.contains(&format!("\n {line}\n")), "{line}");
    }
    let completions = packages.path("usr/share/bash-completion/completions/manyview");
    printed(Command::new("bash").arg("-n").arg(completions));
}

fn the_packages_ask_for_what_they_are_linked_with(packages: &Packages) {
    let depends = field(&packages.wide, "Depends");
    // Rust's panics are unwound by libgcc.
    for name in ["libc6 (>= ", "libgcc-s1 (>= "] {
        assert!(depends.contains(name), "{depends}");
    }
    assert_eq!(field(&packages.wide, "Version"), VERSION);
    assert_eq!(field(&packages.wide, "Multi-Arch"), "foreign");
    if let Some(narrow) = &packages.narrow {
        let depends = field(narrow, "Depends");
        let command = format!("manyview (= {VERSION})");
        for name in ["libc6 (>= ", "libgcc-s1 (>= ", &command] {
            assert!(depends.contains(name), "{depends}");
        }
        assert_eq!(field(narrow, "Multi-Arch"), "same");
    }
}

/// The files and links below a folder.
fn below(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let each = paths.flat_map(|path| match path.is_dir() && !path.is_symlink() {
        true => below(&path),
        false => vec![path],
    });
    each.collect()
}

fn files_can_be_read_by_all_and_changed_by_their_owner_alone(packages: &Packages) {
    let files = below(&packages.path(""));
    let files = files.iter().filter(|path| !path.is_symlink());
    let modes: BTreeSet<_> = files
        .map(|path| {
            let metadata = path.metadata().expect("a file");
            assert!(metadata.size() > 0, "{} is empty", path.display());
            metadata.permissions().mode() & 0o7777
        })
        .collect();
    assert_eq!(modes, BTreeSet::from([0o644, 0o755]));
}

fn lintian_finds_no_fault(packages: &Packages) {
    for package in packages.all() {
        let mut lintian = Command::new("lintian");
        lintian.args(["--fail-on", "error,warning"]).arg(package);
        let Ok(output) = lintian.output() else {
            eprintln!("skipped: lintian is missing");
            return;
        };
        let told = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{}: {told}", package.display());
    }
}

fn appstream_finds_no_fault(packages: &Packages) {
    let file = packages.path("usr/share/metainfo/io.github.manyview.manyview.metainfo.xml");
    let extension = "packaging/flatpak/org.freedesktop.Platform.VulkanLayer.manyview.metainfo.xml";
    let extension = Path::new(env!("CARGO_MANIFEST_DIR")).join(extension);
    for file in [file, extension] {
        let text = fs::read_to_string(&file).expect("an entry");
        assert!(text.contains(&format!("<release version=\"{VERSION}\"")));
        let mut validate = Command::new("appstreamcli");
        let Ok(output) = validate.args(["validate", "--no-net"]).arg(&file).output() else {
            eprintln!("skipped: appstreamcli is missing (Debian package appstream)");
            return;
        };
        let told = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{told}");
    }
}

/// The version is written in files that Cargo does not read.
#[test]
fn the_version_is_the_same_in_all_packages() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("packaging/arch/PKGBUILD");
    let text = fs::read_to_string(file).expect("PKGBUILD");
    assert!(text.contains(&format!("\npkgver={VERSION}\n")));
}

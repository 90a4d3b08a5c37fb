//! What `make release` builds runs on systems as old as it says: no file asks for a newer version of the C library. A library that does is ignored by the
//! loader with one line, and the program runs without the layer.

use std::path::Path;

/// `make release` builds for this version, that of Debian 10 and RHEL 8.
const OLDEST: (u32, u32) = (2, 28);
/// The type of a section with the versions that a file needs (`SHT_GNU_verneed`).
const NEEDED: u32 = 0x6fff_fffe;
/// Bytes of the head of a 64-bit section.
const SECTION: usize = 64;

/// The little-endian number of `size` bytes at a place.
fn number(file: &[u8], at: usize, size: usize) -> usize {
    let bytes = file[at..at + size].iter().rev();
    bytes.fold(0, |number, byte| number << 8 | usize::from(*byte))
}

fn text(file: &[u8], at: usize) -> String {
    let bytes = file[at..].iter().take_while(|byte| **byte != 0);
    bytes.map(|byte| char::from(*byte)).collect()
}

/// The versions of other libraries' symbols that a 64-bit ELF file needs, such as `GLIBC_2.28` ("Symbol Versioning" of the Linux Standard Base).
fn needed(file: &[u8]) -> Vec<String> {
    assert!(
        file.starts_with(b"\x7fELF\x02\x01"),
        "64 bits, little-endian"
    );
    let (sections, count) = (number(file, 40, 8), number(file, 60, 2));
    let section = |index: usize| sections + index * SECTION;
    let place = |index: usize| number(file, section(index) + 24, 8);
    let mut versions = Vec::new();
    for index in (0..count).filter(|&i| number(file, section(i) + 4, 4) == NEEDED as usize) {
        let strings = place(number(file, section(index) + 40, 4));
        let mut library = place(index);
        for _ in 0..number(file, section(index) + 44, 4) {
            let mut version = library + number(file, library + 8, 4);
            for _ in 0..number(file, library + 2, 2) {
                versions.push(text(file, strings + number(file, version + 8, 4)));
                version += number(file, version + 12, 4);
            }
            library += number(file, library + 12, 4);
        }
    }
    versions
}

/// Whether this is a version of the C library's that the oldest one does not have. Those without a number, such as GLIBC_ABI_DT_RELR, are newer.
fn is_newer(version: &str) -> bool {
    let Some(version) = version.strip_prefix("GLIBC_") else {
        return false;
    };
    let mut parts = version.split('.').map(|part| part.parse().ok());
    match (parts.next().flatten(), parts.next().flatten()) {
        (Some(major), Some(minor)) => (major, minor) > OLDEST,
        _ => true,
    }
}

#[test]
fn a_file_says_which_versions_it_needs() {
    let own = std::fs::read("/proc/self/exe").expect("this program");
    let versions = needed(&own);
    // Every program of Rust's has symbols of both libraries.
    assert!(
        versions.iter().any(|v| v.starts_with("GLIBC_2.")),
        "{versions:?}"
    );
    assert!(
        versions.iter().any(|v| v.starts_with("GCC_")),
        "{versions:?}"
    );
}

#[test]
fn versions_are_compared_by_their_numbers() {
    let all = [
        "GLIBC_2.2.5",
        "GLIBC_2.28",
        "GLIBC_2.29",
        "GLIBC_2.100",
        "GLIBC_ABI_DT_RELR",
        "GCC_3.0",
    ];
    assert_eq!(all.map(is_newer), [false, false, true, true, true, false]);
}

/// `make release` runs it. `MANYVIEW_RELEASE` is the folder with the files.
#[test]
#[ignore = "of make release"]
fn release_needs_no_newer_c_library_than_it_says() {
    let folder = std::env::var_os("MANYVIEW_RELEASE").expect("MANYVIEW_RELEASE; run make release");
    for name in [
        "manyview",
        "libmanyview.so",
        "manyview-probe",
        "manyview-points",
    ] {
        let path = Path::new(&folder).join(name);
        let file =
            std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let versions = needed(&file);
        let newer: Vec<_> = versions.iter().filter(|v| is_newer(v)).collect();
        assert!(!versions.is_empty(), "{name} has no versions");
        assert!(newer.is_empty(), "{name} needs {newer:?}");
    }
}

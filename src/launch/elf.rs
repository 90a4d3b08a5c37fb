//! The parts of the ELF format that the launcher needs: class, machine, interpreter, needed libraries, symbols.
//!
//! Based on: System V ABI, gABI chapters 4 and 5. Little-endian 64-bit files are read in full, others by their class.
#![forbid(unsafe_code)]

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

const PT_LOAD: u32 = 1;
const PT_DYNAMIC: u32 = 2;
const PT_INTERP: u32 = 3;
const DT_NEEDED: u64 = 1;
const DT_STRTAB: u64 = 5;
const DT_RPATH: u64 = 15;
const DT_RUNPATH: u64 = 29;
const SHT_DYNSYM: u32 = 11;
const SHN_UNDEF: u16 = 0;
/// The most bytes read of a table. A larger table belongs to a broken file.
const MAX_TABLE: u64 = 16 * 1024 * 1024;

/// Facts about a program or library, from its file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Elf {
    /// 32 or 64.
    pub bits: u8,
    /// `e_machine`.
    pub machine: u16,
    /// The file names a dynamic loader.
    pub has_interpreter: bool,
    /// `DT_NEEDED`, in order.
    pub needed: Vec<String>,
    /// The folders of `DT_RUNPATH`, or else of `DT_RPATH`, in order.
    pub search: Vec<String>,
    /// Names of the dynamic symbols that the file defines.
    pub exports: Vec<String>,
}

impl Elf {
    /// Reads a file. `None` if it is not an ELF file, an error if it cannot be read.
    pub fn open(path: &Path) -> std::io::Result<Option<Self>> {
        let mut file = File::open(path)?;
        let mut head = Vec::new();
        file.by_ref().take(64).read_to_end(&mut head)?;
        if !head.starts_with(b"\x7fELF") {
            return Ok(None);
        }
        let bits = if head.get(4) == Some(&2) { 64 } else { 32 };
        let machine = u16_at(&head, 18);
        let mut elf = Self {
            bits,
            machine,
            ..Self::default()
        };
        if bits == 64 && head.get(5) == Some(&1) && head.len() == 64 {
            elf.read_segments(&mut file, &head)?;
            elf.read_symbols(&mut file, &head)?;
        }
        Ok(Some(elf))
    }

    /// True if 64-bit programs of this machine can load the file.
    #[must_use]
    pub fn is_native(&self) -> bool {
        let ours = match std::env::consts::ARCH {
            "x86_64" => 62,
            "aarch64" => 183,
            "riscv64" => 243,
            _ => self.machine,
        };
        self.bits == 64 && self.machine == ours
    }

    fn read_segments(&mut self, file: &mut File, head: &[u8]) -> std::io::Result<()> {
        let (offset, size, count) = (u64_at(head, 32), u16_at(head, 54), u16_at(head, 56));
        let table = read_at(file, offset, u64::from(size) * u64::from(count))?;
        let segments: Vec<_> = table.chunks_exact(usize::from(size).max(56)).collect();
        self.has_interpreter = segments
            .iter()
            .any(|segment| u32_at(segment, 0) == PT_INTERP);
        let Some(dynamic) = segments
            .iter()
            .find(|segment| u32_at(segment, 0) == PT_DYNAMIC)
        else {
            return Ok(());
        };
        let dynamic = read_at(file, u64_at(dynamic, 8), u64_at(dynamic, 32))?;
        let entries: Vec<_> = dynamic
            .chunks_exact(16)
            .map(|e| (u64_at(e, 0), u64_at(e, 8)))
            .collect();
        let Some((_, address)) = entries.iter().find(|(tag, _)| *tag == DT_STRTAB) else {
            return Ok(());
        };
        let loads = segments
            .iter()
            .filter(|segment| u32_at(segment, 0) == PT_LOAD);
        // The string table is given by its address in memory; the segment that holds the address gives the place in the file.
        let Some(strings) = loads.into_iter().find_map(|segment| {
            let (start, length) = (u64_at(segment, 16), u64_at(segment, 32));
            let inside = address
                .checked_sub(start)
                .filter(|inside| *inside < length)?;
            Some((u64_at(segment, 8) + inside, length - inside))
        }) else {
            return Ok(());
        };
        let strings = read_at(file, strings.0, strings.1)?;
        let all = |wanted: u64| {
            let tagged = entries.iter().filter(move |(tag, _)| *tag == wanted);
            tagged.filter_map(|(_, at)| string_at(&strings, *at))
        };
        self.needed = all(DT_NEEDED).collect();
        let search = all(DT_RUNPATH)
            .next()
            .or_else(|| all(DT_RPATH).next())
            .unwrap_or_default();
        self.search = search
            .split(':')
            .filter(|folder| !folder.is_empty())
            .map(str::to_owned)
            .collect();
        Ok(())
    }

    fn read_symbols(&mut self, file: &mut File, head: &[u8]) -> std::io::Result<()> {
        let (offset, size, count) = (u64_at(head, 40), u16_at(head, 58), u16_at(head, 60));
        if offset == 0 || size < 64 {
            return Ok(());
        }
        let table = read_at(file, offset, u64::from(size) * u64::from(count))?;
        let sections: Vec<_> = table.chunks_exact(usize::from(size)).collect();
        let Some(symbols) = sections
            .iter()
            .find(|section| u32_at(section, 4) == SHT_DYNSYM)
        else {
            return Ok(());
        };
        let Some(strings) = usize::try_from(u32_at(symbols, 40))
            .ok()
            .and_then(|link| sections.get(link))
        else {
            return Ok(());
        };
        let strings = read_at(file, u64_at(strings, 24), u64_at(strings, 32))?;
        let symbols = read_at(file, u64_at(symbols, 24), u64_at(symbols, 32))?;
        let defined = symbols
            .chunks_exact(24)
            .filter(|symbol| u16_at(symbol, 6) != SHN_UNDEF);
        self.exports = defined
            .filter_map(|symbol| string_at(&strings, u32_at(symbol, 0).into()))
            .collect();
        Ok(())
    }
}

fn read_at(file: &mut File, offset: u64, length: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.seek(SeekFrom::Start(offset))?;
    file.take(length.min(MAX_TABLE)).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn bytes_at<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    bytes
        .get(at..at + N)
        .and_then(|slice| slice.try_into().ok())
        .unwrap_or([0; N])
}

fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes(bytes_at(bytes, at))
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes_at(bytes, at))
}

fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes_at(bytes, at))
}

fn string_at(table: &[u8], at: u64) -> Option<String> {
    let tail = table.get(usize::try_from(at).ok()?..)?;
    let end = tail.iter().position(|byte| *byte == 0)?;
    std::str::from_utf8(&tail[..end]).ok().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_running_test() {
        let elf = Elf::open(&std::env::current_exe().unwrap())
            .unwrap()
            .unwrap();
        assert!(elf.is_native() && elf.has_interpreter, "{elf:?}");
        assert!(
            elf.needed.iter().any(|name| name.starts_with("libc.so")),
            "{:?}",
            elf.needed
        );
    }

    #[test]
    fn other_files_are_none_and_broken_ones_are_no_panic() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("f");
        std::fs::write(&path, "#!/bin/sh\n").unwrap();
        assert_eq!(Elf::open(&path).unwrap(), None);
        let whole = std::fs::read(std::env::current_exe().unwrap()).unwrap();
        for length in [4, 5, 20, 63, 64, 100, 200, 5000] {
            std::fs::write(&path, &whole[..length]).unwrap();
            assert!(Elf::open(&path).unwrap().is_some(), "{length} bytes");
        }
        let mut noise = whole[..4096].to_vec();
        noise[32..64].fill(0xff);
        std::fs::write(&path, noise).unwrap();
        assert!(Elf::open(&path).is_ok_and(|elf| elf.is_some()) || Elf::open(&path).is_err());
    }
}

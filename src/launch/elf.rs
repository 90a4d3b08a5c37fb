//! The parts of the ELF format that the launcher needs: class, machine, interpreter, needed libraries, symbols.
//!
//! Based on: System V ABI, gABI chapters 4 and 5. Little-endian files are read in full, others by their class.
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

/// The width of a program's pointers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
pub enum Class {
    /// 32 bits.
    #[serde(rename = "32")]
    Narrow,
    /// 64 bits.
    #[serde(rename = "64")]
    Wide,
}

impl Class {
    /// The number of bits.
    #[must_use]
    pub fn bits(self) -> u8 {
        match self {
            Class::Narrow => 32,
            Class::Wide => 64,
        }
    }
}

/// Where the parts of a table's entry are.
struct Entry {
    size: usize,
    offset: usize,
    length: usize,
    /// Of a segment; of a section the number of another one.
    address: usize,
}

/// Where the parts of a file of one class are, in bytes.
struct Layout {
    /// Bytes of an address.
    bytes: usize,
    /// Where the header has the place of the table, and its size and count.
    segments: (usize, usize),
    sections: (usize, usize),
    segment: Entry,
    section: Entry,
    /// Size of a symbol, and the place of its section.
    symbol: (usize, usize),
}

const WIDE: Layout = Layout {
    bytes: 8,
    segments: (32, 54),
    sections: (40, 58),
    segment: Entry {
        size: 56,
        offset: 8,
        length: 32,
        address: 16,
    },
    section: Entry {
        size: 64,
        offset: 24,
        length: 32,
        address: 40,
    },
    symbol: (24, 6),
};
const NARROW: Layout = Layout {
    bytes: 4,
    segments: (28, 42),
    sections: (32, 46),
    segment: Entry {
        size: 32,
        offset: 4,
        length: 16,
        address: 8,
    },
    section: Entry {
        size: 40,
        offset: 16,
        length: 20,
        address: 24,
    },
    symbol: (16, 14),
};

impl Layout {
    fn word(&self, bytes: &[u8], at: usize) -> u64 {
        match self.bytes {
            8 => u64_at(bytes, at),
            _ => u32_at(bytes, at).into(),
        }
    }
}

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
        let layout = if bits == 64 { &WIDE } else { &NARROW };
        if head.get(5) == Some(&1) && head.len() == 64 {
            elf.read_segments(&mut file, &head, layout)?;
            elf.read_symbols(&mut file, &head, layout)?;
        }
        Ok(Some(elf))
    }

    /// The programs of this machine that can load the file, by their class; none for those of other machines.
    #[must_use]
    pub fn class(&self) -> Option<Class> {
        let [ours, narrow] = match std::env::consts::ARCH {
            "x86_64" => [62, 3],
            "aarch64" => [183, 40],
            "riscv64" => [243, 243],
            _ => [self.machine; 2],
        };
        match self.bits {
            64 if self.machine == ours => Some(Class::Wide),
            32 if self.machine == narrow => Some(Class::Narrow),
            _ => None,
        }
    }

    fn read_segments(
        &mut self,
        file: &mut File,
        head: &[u8],
        layout: &Layout,
    ) -> std::io::Result<()> {
        let segment = &layout.segment;
        let word = |bytes: &[u8], at: usize| layout.word(bytes, at);
        let [size, count] = [0, 2].map(|more| u64::from(u16_at(head, layout.segments.1 + more)));
        let table = read_at(file, word(head, layout.segments.0), size * count)?;
        let size = usize::try_from(size).unwrap_or(0).max(segment.size);
        let segments: Vec<_> = table.chunks_exact(size).collect();
        self.has_interpreter = segments
            .iter()
            .any(|segment| u32_at(segment, 0) == PT_INTERP);
        let Some(dynamic) = segments
            .iter()
            .find(|segment| u32_at(segment, 0) == PT_DYNAMIC)
        else {
            return Ok(());
        };
        let place = |bytes: &[u8]| (word(bytes, segment.offset), word(bytes, segment.length));
        let (offset, length) = place(dynamic);
        let dynamic = read_at(file, offset, length)?;
        let entries: Vec<_> = dynamic
            .chunks_exact(2 * layout.bytes)
            .map(|e| (word(e, 0), word(e, layout.bytes)))
            .collect();
        let Some((_, address)) = entries.iter().find(|(tag, _)| *tag == DT_STRTAB) else {
            return Ok(());
        };
        let loads = segments
            .iter()
            .filter(|segment| u32_at(segment, 0) == PT_LOAD);
        // The string table is given by its address in memory; the segment that holds the address gives the place in the file.
        let Some(strings) = loads.into_iter().find_map(|segment| {
            let (offset, length) = place(segment);
            let inside = address
                .checked_sub(word(segment, layout.segment.address))
                .filter(|inside| *inside < length)?;
            Some((offset.checked_add(inside)?, length - inside))
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

    fn read_symbols(
        &mut self,
        file: &mut File,
        head: &[u8],
        layout: &Layout,
    ) -> std::io::Result<()> {
        let section = &layout.section;
        let offset = layout.word(head, layout.sections.0);
        let [size, count] = [0, 2].map(|more| u64::from(u16_at(head, layout.sections.1 + more)));
        let wide = usize::try_from(size).unwrap_or(0);
        if offset == 0 || wide < section.size {
            return Ok(());
        }
        let table = read_at(file, offset, size * count)?;
        let sections: Vec<_> = table.chunks_exact(wide).collect();
        let Some(symbols) = sections
            .iter()
            .find(|section| u32_at(section, 4) == SHT_DYNSYM)
        else {
            return Ok(());
        };
        let Some(strings) = usize::try_from(u32_at(symbols, section.address))
            .ok()
            .and_then(|link| sections.get(link))
        else {
            return Ok(());
        };
        let place = |bytes: &[u8]| {
            let word = |at| layout.word(bytes, at);
            (word(section.offset), word(section.length))
        };
        let [strings, symbols] = [place(strings), place(symbols)];
        let strings = read_at(file, strings.0, strings.1)?;
        let symbols = read_at(file, symbols.0, symbols.1)?;
        let defined = symbols
            .chunks_exact(layout.symbol.0)
            .filter(|symbol| u16_at(symbol, layout.symbol.1) != SHN_UNDEF);
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
        assert_eq!(elf.class(), Some(Class::Wide));
        assert!(elf.has_interpreter, "{elf:?}");
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

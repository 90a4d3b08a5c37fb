//! Redirects the GL calls of libraries that bypass the preload, because the program opened them with RTLD_DEEPBIND or for another
//! reason. Their calls then reach our functions, as they would without the flag.
//!
//! Every library has a table of the addresses that it calls. An entry for a name that we export was bound past us if it holds an
//! address in a GL library; an entry that is not bound yet is bound here. This runs at the first dlsym call of the program after
//! it has opened a library, and when a context is made current.

use crate::exports::export;
use crate::provider::{is_name_of_gl, own, symbol};
use crate::switch::{self, Mode};
use core::ffi::{CStr, c_char, c_void};
use core::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering::Relaxed};
use libc::dl_phdr_info;

/// The linker's count of loaded libraries when all were last checked.
static SEEN: AtomicU64 = AtomicU64::new(0);
static BUSY: AtomicBool = AtomicBool::new(false);

#[cfg(target_pointer_width = "32")]
use libc::{Elf32_Phdr as Phdr, Elf32_Sym as Symbol};
#[cfg(target_pointer_width = "64")]
use libc::{Elf64_Phdr as Phdr, Elf64_Sym as Symbol};

/// A relocation of the architecture: offset of the table's entry, and symbol and kind in one number.
#[repr(C)]
#[derive(Clone, Copy)]
struct Relocation {
    offset: usize,
    info: usize,
    #[cfg(not(target_arch = "x86"))]
    addend: isize,
}

#[cfg(target_pointer_width = "64")]
fn split(info: usize) -> (usize, usize) {
    (info >> 32, info & 0xffff_ffff)
}
#[cfg(target_pointer_width = "32")]
fn split(info: usize) -> (usize, usize) {
    (info >> 8, info & 0xff)
}

/// Kinds of relocations whose entry is just the address of the symbol: R_*_GLOB_DAT and R_*_JUMP_SLOT.
#[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
const KINDS: [usize; 2] = [6, 7];
#[cfg(target_arch = "aarch64")]
const KINDS: [usize; 2] = [1025, 1026];
#[cfg(not(any(target_arch = "x86_64", target_arch = "x86", target_arch = "aarch64")))]
const KINDS: [usize; 0] = [];

const PT_LOAD: u32 = 1;
const PT_DYNAMIC: u32 = 2;
const PT_GNU_RELRO: u32 = 0x6474_e552;
const DT_PLTRELSZ: usize = 2;
const DT_STRTAB: usize = 5;
const DT_SYMTAB: usize = 6;
const DT_RELA: (usize, usize) = (7, 8);
const DT_REL: (usize, usize) = (17, 18);
const DT_JMPREL: usize = 23;

/// Checks all libraries if some were loaded since the last time. Cheap otherwise.
pub(crate) fn rebind_new_libraries() {
    let mut added = 0u64;
    // SAFETY: the callback's argument is a u64 that lives across the call.
    unsafe { libc::dl_iterate_phdr(Some(count), (&raw mut added).cast()) };
    if SEEN.load(Relaxed) == added || BUSY.swap(true, Relaxed) {
        return;
    }
    let mut gl = Loaded::default();
    // SAFETY: the callback's argument is a Loaded that lives across the call.
    unsafe { libc::dl_iterate_phdr(Some(find), (&raw mut gl).cast()) };
    // Without GL no library is bound to it, and this may run so early that memory is not available.
    if gl.count > 0 && switch::mode() != Mode::Passive {
        // If another wrapper comes before ours, entries that are not bound yet must lead to it.
        let first = symbol(libc::RTLD_DEFAULT, c"glXSwapBuffers");
        gl.first = !first.is_null() && own(first);
        // SAFETY: as above.
        unsafe { libc::dl_iterate_phdr(Some(bind), (&raw mut gl).cast()) };
    }
    SEEN.store(added, Relaxed);
    BUSY.store(false, Relaxed);
}

/// The addresses of GL's libraries. They are found before any entry is bound, because the linker must not be asked inside dl_iterate_phdr.
#[derive(Default)]
struct Loaded {
    ranges: [(usize, usize); 16],
    count: usize,
    /// The linker finds our functions before all others.
    first: bool,
}

impl Loaded {
    fn holds(&self, address: usize) -> bool {
        let known = self.ranges.iter().take(self.count);
        known.into_iter().any(|r| (r.0..r.1).contains(&address))
    }
}

unsafe extern "C" fn count(info: *mut dl_phdr_info, _: usize, added: *mut c_void) -> i32 {
    // SAFETY: the dynamic linker's record, and the u64 of `rebind_new_libraries`.
    unsafe { *added.cast::<u64>() = (*info).dlpi_adds };
    1
}

unsafe extern "C" fn find(info: *mut dl_phdr_info, _: usize, gl: *mut c_void) -> i32 {
    // SAFETY: the dynamic linker's record, and the Loaded of `rebind_new_libraries`.
    let (library, gl) = unsafe { (Library::of(&*info), &mut *gl.cast::<Loaded>()) };
    if let Some(library) = library.filter(Library::is_gl)
        && let Some(range) = gl.ranges.get_mut(gl.count)
    {
        *range = library.range();
        gl.count += 1;
    }
    0
}

unsafe extern "C" fn bind(info: *mut dl_phdr_info, _: usize, gl: *mut c_void) -> i32 {
    // SAFETY: the dynamic linker's record, and the Loaded of `rebind_new_libraries`.
    let (library, gl) = unsafe { (Library::of(&*info), &*gl.cast::<Loaded>()) };
    if let Some(library) = library.filter(|l| !l.is_gl() && !l.file.starts_with(b"libmanyview")) {
        // SAFETY: the linker keeps a library loaded while this callback runs.
        unsafe { library.bind(gl) };
    }
    0
}

struct Library<'a> {
    /// File name without folders.
    file: &'a [u8],
    base: usize,
    headers: &'a [Phdr],
}

impl Library<'_> {
    /// `None` for the program itself, which has no name here and is always bound to the preload.
    ///
    /// # Safety
    /// The dynamic linker's record; the library lives as long as its callback runs.
    unsafe fn of(info: &dl_phdr_info) -> Option<Library<'_>> {
        if info.dlpi_name.is_null() || info.dlpi_phdr.is_null() {
            return None;
        }
        // SAFETY: the linker's string.
        let name = unsafe { CStr::from_ptr(info.dlpi_name) }.to_bytes();
        let file = name.rsplit(|&b| b == b'/').next().unwrap_or(name);
        (!file.is_empty()).then_some(Library {
            file,
            base: info.dlpi_addr as usize,
            // SAFETY: the linker's table of so many headers.
            headers: unsafe {
                core::slice::from_raw_parts(info.dlpi_phdr.cast::<Phdr>(), info.dlpi_phnum.into())
            },
        })
    }

    fn is_gl(&self) -> bool {
        is_name_of_gl(self.file)
    }

    /// The first address, and the end of the last segment.
    fn range(&self) -> (usize, usize) {
        let loads = self.headers.iter().filter(|h| h.p_type == PT_LOAD);
        let (mut start, mut end) = (usize::MAX, 0);
        for h in loads {
            start = start.min(self.base + h.p_vaddr as usize);
            end = end.max(self.base + h.p_vaddr as usize + h.p_memsz as usize);
        }
        (start, end)
    }

    /// Whether the linker has made an entry read-only after binding it (RELRO). It protects whole pages only; the library still writes to
    /// the rest.
    fn is_protected(&self, entry: usize, page: usize) -> bool {
        let whole = |address: usize| address & !(page - 1);
        self.headers.iter().any(|h| {
            let start = self.base + h.p_vaddr as usize;
            let end = whole(start + h.p_memsz as usize);
            h.p_type == PT_GNU_RELRO && (whole(start)..end).contains(&entry)
        })
    }

    fn holds(&self, address: usize) -> bool {
        self.headers.iter().any(|h| {
            let start = self.base + h.p_vaddr as usize;
            h.p_type == PT_LOAD && (start..start + h.p_memsz as usize).contains(&address)
        })
    }

    /// An address from the dynamic section, to which the linker has added the base on some architectures only.
    fn address(&self, value: usize) -> usize {
        if self.holds(value) {
            value
        } else {
            self.base + value
        }
    }

    /// # Safety
    /// The library is loaded and stays so during the call.
    unsafe fn bind(&self, gl: &Loaded) {
        let Some(dynamic) = self.headers.iter().find(|h| h.p_type == PT_DYNAMIC) else {
            return;
        };
        let section = (self.base + dynamic.p_vaddr as usize) as *const [usize; 2];
        let entries = dynamic.p_memsz as usize / size_of::<[usize; 2]>();
        // SAFETY: the segment holds so many pairs of tag and value.
        let section = unsafe { core::slice::from_raw_parts(section, entries) };
        let value = |tag| {
            section
                .iter()
                .take_while(|e| e[0] != 0)
                .find(|e| e[0] == tag)
                .map(|e| e[1])
        };
        let (Some(strings), Some(symbols)) = (value(DT_STRTAB), value(DT_SYMTAB)) else {
            return;
        };
        let names = (self.address(strings), self.address(symbols));
        let plain = if cfg!(target_arch = "x86") {
            DT_REL
        } else {
            DT_RELA
        };
        for (table, size) in [(DT_JMPREL, DT_PLTRELSZ), plain] {
            if let (Some(table), Some(size)) = (value(table), value(size)) {
                let table = self.address(table) as *const Relocation;
                // SAFETY: the section says where its relocations are, and how many bytes they have.
                let all =
                    unsafe { core::slice::from_raw_parts(table, size / size_of::<Relocation>()) };
                for relocation in all {
                    // SAFETY: of this library.
                    unsafe { self.redirect(relocation, names, gl) };
                }
            }
        }
    }

    /// # Safety
    /// A relocation of this library, and the addresses of its strings and symbols.
    unsafe fn redirect(
        &self,
        relocation: &Relocation,
        (strings, symbols): (usize, usize),
        gl: &Loaded,
    ) {
        let (symbol, kind) = split(relocation.info);
        let entry = self.base + relocation.offset;
        if !KINDS.contains(&kind) || !self.holds(entry) {
            return;
        }
        // SAFETY: an index into the symbols.
        let symbol = unsafe { &*(symbols as *const Symbol).add(symbol) };
        // A symbol that the library itself defines is left alone.
        if symbol.st_shndx != 0 {
            return;
        }
        // SAFETY: an offset into the strings.
        let name = unsafe { CStr::from_ptr((strings + symbol.st_name as usize) as *const c_char) };
        // dlsym is left alone, because another wrapper's may come before ours.
        let Some((_, ours)) = export(name.to_bytes()).filter(|_| name != c"dlsym") else {
            return;
        };
        let entry = entry as *mut usize;
        // SAFETY: an entry of the library's table.
        let bound = unsafe { entry.read_volatile() };
        let open = self.holds(bound) && gl.first;
        if gl.holds(bound) || open {
            // SAFETY: asks for a number.
            let page = unsafe { libc::sysconf(libc::_SC_PAGESIZE) }.max(1) as usize;
            let protected = self.is_protected(entry as usize, page);
            // SAFETY: as above.
            unsafe { write(entry, ours as usize, protected.then_some(page)) };
        }
    }
}

/// # Safety
/// `entry` is an entry of a loaded library's table; `protected`: the size of its page, if that is read-only.
unsafe fn write(entry: *mut usize, value: usize, protected: Option<usize>) {
    let set = |page: usize, access| {
        let start = (entry as usize & !(page - 1)) as *mut c_void;
        // SAFETY: the page of the library that holds the entry.
        unsafe { libc::mprotect(start, page, access) == 0 }
    };
    if let Some(page) = protected
        && !set(page, libc::PROT_READ | libc::PROT_WRITE)
    {
        return;
    }
    // SAFETY: aligned and writable; other threads read one address or the other, and both are good.
    unsafe { AtomicUsize::from_ptr(entry) }.store(value, Relaxed);
    if let Some(page) = protected {
        set(page, libc::PROT_READ);
    }
}

//! The arrays of glCallLists.

use super::consts as c;
use super::real::Ptr;

/// Names of display lists as glCallLists reads them, without the list base. None where the driver refuses the call.
///
/// # Safety
/// `lists` points to `n` elements of the type `kind`.
pub unsafe fn list_names(n: i32, kind: u32, lists: Ptr) -> Option<Vec<u32>> {
    let n = usize::try_from(n).ok()?;
    if lists.is_null() {
        return None;
    }
    let bytes = |size: usize| {
        // SAFETY: n elements of the type (caller), whose size this is; bytes are read unaligned.
        let all = unsafe { core::slice::from_raw_parts(lists.cast_const().cast::<u8>(), n * size) };
        all.chunks_exact(size)
    };
    let four = |b: &[u8]| [b[0], b[1], b[2], b[3]];
    Some(match kind {
        c::BYTE => bytes(1).map(|b| b[0] as i8 as u32).collect(),
        c::UNSIGNED_BYTE => bytes(1).map(|b| u32::from(b[0])).collect(),
        c::SHORT => bytes(2)
            .map(|b| i16::from_ne_bytes([b[0], b[1]]) as u32)
            .collect(),
        c::UNSIGNED_SHORT => bytes(2)
            .map(|b| u32::from(u16::from_ne_bytes([b[0], b[1]])))
            .collect(),
        c::INT | c::UNSIGNED_INT => bytes(4).map(|b| u32::from_ne_bytes(four(b))).collect(),
        c::FLOAT => bytes(4)
            .map(|b| f32::from_ne_bytes(four(b)) as i32 as u32)
            .collect(),
        c::TWO_BYTES => bytes(2)
            .map(|b| u32::from(b[0]) << 8 | u32::from(b[1]))
            .collect(),
        c::THREE_BYTES => bytes(3)
            .map(|b| u32::from_be_bytes([0, b[0], b[1], b[2]]))
            .collect(),
        c::FOUR_BYTES => bytes(4).map(|b| u32::from_be_bytes(four(b))).collect(),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(kind: u32, n: i32, bytes: &[u8]) -> Option<Vec<u32>> {
        // SAFETY: the tests give as many elements.
        unsafe { list_names(n, kind, bytes.as_ptr().cast_mut().cast()) }
    }

    #[test]
    fn names_are_read_by_their_type() {
        let bytes = [0xFF, 1, 2, 3, 4, 5, 6, 7];
        assert_eq!(names(c::BYTE, 2, &bytes), Some(vec![u32::MAX, 1]));
        assert_eq!(names(c::UNSIGNED_BYTE, 2, &bytes), Some(vec![0xFF, 1]));
        assert_eq!(names(c::TWO_BYTES, 2, &bytes), Some(vec![0xFF01, 0x203]));
        assert_eq!(names(c::THREE_BYTES, 1, &bytes), Some(vec![0xFF_0102]));
        assert_eq!(names(c::FOUR_BYTES, 1, &bytes), Some(vec![0xFF01_0203]));
        let native = (-2i16).to_ne_bytes();
        assert_eq!(names(c::SHORT, 1, &native), Some(vec![-2i32 as u32]));
        assert_eq!(names(c::UNSIGNED_SHORT, 1, &native), Some(vec![0xFFFE]));
        assert_eq!(
            names(c::UNSIGNED_INT, 1, &7u32.to_ne_bytes()),
            Some(vec![7])
        );
        assert_eq!(names(c::FLOAT, 1, &7.9f32.to_ne_bytes()), Some(vec![7]));
        assert_eq!(names(c::DOUBLE, 1, &bytes), None);
        assert_eq!(names(c::BYTE, -1, &bytes), None);
        // SAFETY: nothing is read.
        let none = unsafe { list_names(1, c::BYTE, core::ptr::null_mut()) };
        assert_eq!(none, None);
    }
}

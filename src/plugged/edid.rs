//! What a monitor says of itself: EDID 1.3 and 1.4 (VESA E-EDID, section 3), as far as it names the monitor.
#![forbid(unsafe_code)]

/// The first bytes of every EDID.
const HEADER: [u8; 8] = [0, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0];
/// Where the four descriptors of 18 bytes begin.
const DESCRIPTORS: [usize; 4] = [54, 72, 90, 108];
/// Tags of the descriptors that hold text.
const NAME: u8 = 0xfc;
const SERIAL: u8 = 0xff;

/// The name plate of a monitor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Edid {
    /// Three letters of the maker, as "ACR".
    pub maker: String,
    /// The monitor's name; empty where it has none.
    pub name: String,
    /// Its serial number as text; empty where it has none.
    pub serial: String,
}

impl Edid {
    /// Reads the first block; extensions are not needed. None where it is no EDID.
    #[must_use]
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let block = bytes.get(..128)?;
        if !block.starts_with(&HEADER) {
            return None;
        }
        let mut edid = Self {
            maker: maker(u16::from_be_bytes([block[8], block[9]])),
            ..Self::default()
        };
        for start in DESCRIPTORS {
            let descriptor = &block[start..start + 18];
            // Others are timings.
            if descriptor[..3] != [0; 3] {
                continue;
            }
            match descriptor[3] {
                NAME => edid.name = text(&descriptor[5..]),
                SERIAL => edid.serial = text(&descriptor[5..]),
                _ => {}
            }
        }
        Some(edid)
    }
}

/// Five bits a letter, 1 for A.
fn maker(packed: u16) -> String {
    let letter = |shift: u16| {
        let place = ((packed >> shift) & 31) as u8;
        char::from(if (1..=26).contains(&place) {
            b'@' + place
        } else {
            b'?'
        })
    };
    [10, 5, 0].map(letter).iter().collect()
}

/// A text ends with a line feed and is filled with spaces. It is shown in a terminal, so only printing letters are kept.
fn text(bytes: &[u8]) -> String {
    let letters = bytes.iter().take_while(|byte| **byte != b'\n');
    let letters = letters.filter(|byte| (b' '..=b'~').contains(byte));
    let text: String = letters.map(|byte| char::from(*byte)).collect();
    text.trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An EDID with a timing, a name and a serial number.
    fn block(name: &[u8], serial: &[u8]) -> Vec<u8> {
        let mut block = vec![0; 128];
        block[..8].copy_from_slice(&HEADER);
        block[8..10].copy_from_slice(&[0x31, 0x87]);
        block[54..57].copy_from_slice(&[0x1a, 0x36, 0x80]);
        for (start, tag, text) in [(72, NAME, name), (90, SERIAL, serial)] {
            block[start + 3] = tag;
            block[start + 5..start + 18].fill(b' ');
            block[start + 5..start + 5 + text.len()].copy_from_slice(text);
        }
        block
    }

    #[test]
    fn the_name_plate_is_read() {
        let edid = Edid::read(&block(b"LKG-E\n", b"LKG-E01234\n")).unwrap();
        let expected = (
            "LLG".to_owned(),
            "LKG-E".to_owned(),
            "LKG-E01234".to_owned(),
        );
        assert_eq!((edid.maker, edid.name, edid.serial), expected);
        let full = Edid::read(&block(b"THIRTEEN-LONG", b"\x1b[31m\n")).unwrap();
        assert_eq!(
            (full.name.as_str(), full.serial.as_str()),
            ("THIRTEEN-LONG", "[31m")
        );
    }

    #[test]
    fn what_is_no_edid_is_none() {
        let good = block(b"A", b"B");
        assert_eq!(Edid::read(&good[..127]), None);
        assert_eq!(Edid::read(&[]), None);
        assert_eq!(Edid::read(&[0; 128]), None);
    }
}

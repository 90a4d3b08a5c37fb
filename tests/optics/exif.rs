//! JPEG files, with or without a small EXIF segment.

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageResult, RgbImage};

/// A JPEG file. `focal` is the 35 mm focal length in mm that it claims; None writes no EXIF data.
pub fn jpeg(picture: &RgbImage, quality: u8, focal: Option<f64>) -> ImageResult<Vec<u8>> {
    let mut file = Vec::new();
    let encoder = JpegEncoder::new_with_quality(&mut file, quality);
    encoder.write_image(
        picture.as_raw(),
        picture.width(),
        picture.height(),
        ExtendedColorType::Rgb8,
    )?;
    if let Some(focal) = focal {
        // EXIF data directly follow the two bytes that start an image.
        file.splice(2..2, segment(focal));
    }
    Ok(file)
}

/// An APP1 segment with the tags Orientation, FocalLength and FocalLengthIn35mmFilm.
fn segment(focal: f64) -> Vec<u8> {
    const SHORT: u16 = 3;
    const LONG: u16 = 4;
    const RATIONAL: u16 = 5;
    const EXIF_AT: u32 = 8 + 2 + 2 * 12 + 4;
    const RATIONAL_AT: u32 = EXIF_AT + 2 + 2 * 12 + 4;
    let entry = |tag: u16, kind: u16, value: u32| {
        let mut bytes = [0; 12];
        bytes[0..2].copy_from_slice(&tag.to_le_bytes());
        bytes[2..4].copy_from_slice(&kind.to_le_bytes());
        bytes[4..8].copy_from_slice(&1u32.to_le_bytes());
        bytes[8..12].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    let directory = |entries: &[[u8; 12]]| {
        let mut bytes = (entries.len() as u16).to_le_bytes().to_vec();
        bytes.extend(entries.as_flattened());
        bytes.extend([0; 4]);
        bytes
    };
    let mut tiff = b"II*\0\x08\0\0\0".to_vec();
    tiff.extend(directory(&[
        entry(0x0112, SHORT, 1),
        entry(0x8769, LONG, EXIF_AT),
    ]));
    let whole = focal.round().max(1.0) as u32;
    tiff.extend(directory(&[
        entry(0x920a, RATIONAL, RATIONAL_AT),
        entry(0xa405, SHORT, whole),
    ]));
    // A phone's sensor is about seven times smaller than film.
    tiff.extend(((focal / 7.0 * 1000.0).round() as u32).to_le_bytes());
    tiff.extend(1000u32.to_le_bytes());
    let mut bytes = vec![0xff, 0xe1];
    bytes.extend((tiff.len() as u16 + 8).to_be_bytes());
    bytes.extend(b"Exif\0\0");
    bytes.extend(tiff);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_open_with_and_without_exif_data() {
        let picture = RgbImage::from_fn(64, 48, |x, y| image::Rgb([x as u8 * 4, y as u8 * 5, 90]));
        for focal in [None, Some(26.0)] {
            let file = jpeg(&picture, 85, focal).expect("an encoder that writes to memory");
            assert_eq!(file[..2], [0xff, 0xd8]);
            let back = image::load_from_memory(&file)
                .expect("a file just written")
                .to_rgb8();
            assert_eq!(back.dimensions(), (64, 48));
            assert_eq!(file.windows(4).any(|w| w == b"Exif"), focal.is_some());
        }
    }

    /// The length field counts itself and all that follows it; the 35 mm tag holds 26.
    #[test]
    fn segment_is_well_formed() {
        let segment = segment(26.0);
        assert_eq!(
            usize::from(u16::from_be_bytes([segment[2], segment[3]])),
            segment.len() - 2
        );
        let tag = segment
            .windows(12)
            .find(|w| w[..2] == 0xa405u16.to_le_bytes())
            .expect("the tag");
        assert_eq!(tag[8..12], 26u32.to_le_bytes());
    }
}

//! A quilt cut into its views: the way back from [`reference::arrange`](super::reference::arrange).
#![forbid(unsafe_code)]

use crate::display::{QuiltError, QuiltName};
use image::{RgbImage, imageops};

/// A quilt's views.
#[derive(Clone, Debug)]
pub struct Cut {
    /// In order: view 0 from the bottom left, to the right, then upwards.
    pub views: Vec<RgbImage>,
    /// The name of the file has columns and rows in the wrong order.
    pub swapped: bool,
}

/// Cuts a quilt. Where its size is no multiple of its columns and rows, the size of a view is rounded down, and the pixels left over
/// lie on the right and on top.
pub fn cut(quilt: &RgbImage, name: QuiltName) -> Result<Cut, QuiltError> {
    let ((columns, rows), swapped) = name.grid(quilt.dimensions())?;
    let (width, height) = (quilt.width() / columns, quilt.height() / rows);
    let views = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let views = views.map(|(column, row)| {
        let top = quilt.height() - (row + 1) * height;
        imageops::crop_imm(quilt, column * width, top, width, height).to_image()
    });
    Ok(Cut {
        views: views.collect(),
        swapped,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interleave::{Layout, reference};
    use image::Rgb;

    fn name(text: &str) -> QuiltName {
        QuiltName::read(text).unwrap().unwrap()
    }

    #[test]
    fn what_is_arranged_is_cut_again() {
        let views: Vec<_> = (0..6u8)
            .map(|v| RgbImage::from_fn(4, 2, |x, y| Rgb([v, x as u8, y as u8])))
            .collect();
        let layout = Layout::quilt(6, None);
        let quilt = reference::arrange(&views, layout, layout.native_size(6, (4, 2))).unwrap();
        let Cut {
            views: got,
            swapped,
        } = cut(&quilt, name("_qs3x2a2")).unwrap();
        assert!(got == views && !swapped);
        let other = cut(&quilt, name("_qs2x3a2")).unwrap();
        assert!(other.views == views && other.swapped);
    }

    #[test]
    fn what_is_left_over_lies_to_the_right_and_on_top() {
        let quilt = RgbImage::from_fn(8, 7, |x, y| Rgb([x as u8, y as u8, 0]));
        let views = cut(&quilt, name("_qs3x2")).unwrap().views;
        let corners: Vec<_> = views.iter().map(|v| v.get_pixel(0, 0).0).collect();
        assert_eq!(views[5].dimensions(), (2, 3));
        let expected = [[0, 4], [2, 4], [4, 4], [0, 1], [2, 1], [4, 1]];
        assert_eq!(corners, expected.map(|[x, y]| [x, y, 0]));
    }
}

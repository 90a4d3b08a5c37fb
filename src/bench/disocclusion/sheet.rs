//! A sheet of pictures to look at.

use super::outcome::worst;
use super::{Experiment, Frame, IMAGES, Images, View};
use crate::model::Surface;
use image::{RgbImage, imageops};

/// One scene, from left to right: [`IMAGES`] in the size of the picture, the frame of each at the worst viewpoint of the occlusion camera, with
/// the missing samples in white, and the truth there.
#[must_use]
pub fn sheet(
    experiment: &Experiment,
    scene: &[Surface],
    images: &Images,
    views: &[View],
) -> Option<RgbImage> {
    let name = views.first()?.scene;
    let view = worst(views, name, IMAGES[1])?;
    let at = [view.right, view.up, view.farther];
    let truth = experiment.draw(&experiment.camera(at), scene);
    let mut pictures = images
        .all
        .each_ref()
        .map(|image| image.picture().picture)
        .to_vec();
    for image in &images.all {
        pictures.push(Frame::of(experiment, &truth, &experiment.seen(image, at))?.marked());
    }
    pictures.push(truth.picture().picture);
    let [w, h] = experiment.size;
    let mut sheet = RgbImage::new(w * pictures.len() as u32, h);
    for (number, picture) in (0..).zip(&pictures) {
        let picture = imageops::thumbnail(picture, w, h);
        imageops::replace(&mut sheet, &picture, number * i64::from(w), 0);
    }
    Some(sheet)
}

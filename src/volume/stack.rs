//! Slices as a folder of pictures.
//!
//! `slice-000.png` is the plane through the x axis as the viewer sees it; from picture to picture the screen turns with its right side towards the viewer.
//! Each channel of a pixel is 0 or 255. `display.toml` is the [`RotatingScreen`], and makes the folder a stack.

use super::dither::{Lit, Slices};
use super::fragments::by_number;
use super::{RotatingScreen, VolumeError};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageFormat, RgbImage};
use std::fs;
use std::path::Path;

const DISPLAY: &str = "display.toml";

fn name(slice: u32) -> String {
    format!("slice-{slice:03}.png")
}

fn is_slice(name: &str) -> bool {
    let number = name
        .strip_prefix("slice-")
        .and_then(|rest| rest.strip_suffix(".png"));
    number.is_some_and(|n| n.len() >= 3 && n.bytes().all(|byte| byte.is_ascii_digit()))
}

/// The display of the stack in a folder.
fn display(folder: &Path) -> Result<RotatingScreen, String> {
    let text =
        fs::read_to_string(folder.join(DISPLAY)).map_err(|error| format!("{DISPLAY}: {error}"))?;
    let screen: RotatingScreen = toml::from_str(&text)
        .map_err(|error| format!("{DISPLAY}: {}", error.message().lines().collect::<String>()))?;
    screen.check().map_err(|error| error.to_string())?;
    Ok(screen)
}

impl Slices {
    /// Checks that a stack can be written there, before one is made.
    pub fn check_folder(folder: &Path) -> Result<(), VolumeError> {
        let checked = names(folder).map_err(|reason| VolumeError::Write {
            folder: folder.to_owned(),
            reason,
        });
        checked.map(|_| ())
    }

    /// Writes a stack into a folder that does not exist, that is empty, or that holds only another stack, which is replaced.
    pub fn write(&self, folder: &Path) -> Result<(), VolumeError> {
        let no = |reason: String| VolumeError::Write {
            folder: folder.to_owned(),
            reason,
        };
        make_room(folder).map_err(no)?;
        let text = toml::to_string(&self.screen).map_err(|error| no(error.to_string()))?;
        fs::write(folder.join(DISPLAY), text).map_err(|error| no(format!("{DISPLAY}: {error}")))?;
        let written = by_number(self.screen.slices, || {
            |slice: u32| {
                let name = name(slice);
                let bytes = encoded(&self.picture(slice))?;
                fs::write(folder.join(&name), bytes).map_err(|error| format!("{name}: {error}"))
            }
        });
        written.into_iter().collect::<Result<_, _>>().map_err(no)
    }

    /// Reads a stack.
    pub fn read(folder: &Path) -> Result<Slices, VolumeError> {
        let no = |reason: String| VolumeError::Read {
            folder: folder.to_owned(),
            reason,
        };
        let screen = display(folder).map_err(no)?;
        let read = by_number(screen.slices, || {
            let screen = &screen;
            move |slice: u32| picture(folder, screen, slice).map(|picture| voxels(screen, &picture))
        });
        let mut half_planes = vec![Vec::new(); screen.half_planes() as usize];
        let mut had = vec![false; half_planes.len()];
        for (slice, sides) in (0..).zip(read) {
            for (half_plane, lit) in screen.sides(slice).into_iter().zip(sides.map_err(no)?) {
                let at = half_plane as usize;
                if had[at] && half_planes[at] != lit {
                    let name = name(slice);
                    return Err(no(format!(
                        "{name} is not the picture of half a turn before turned over, as turn = \"full\" needs it"
                    )));
                }
                had[at] = true;
                half_planes[at] = lit;
            }
        }
        Ok(Slices {
            screen,
            half_planes,
        })
    }
}

/// The names in an existing folder that a stack may replace; none where the folder does not exist but can be created.
fn names(folder: &Path) -> Result<Option<Vec<String>>, String> {
    if !folder.exists() {
        let parent = folder.parent().filter(|parent| *parent != Path::new(""));
        return match parent.is_none_or(Path::is_dir) {
            true => Ok(None),
            false => Err("the folder that it would be in is not there".to_owned()),
        };
    }
    let entries = fs::read_dir(folder).map_err(|error| error.to_string())?;
    let mut names = Vec::new();
    for entry in entries {
        let entry = entry.map_err(|error| error.to_string())?;
        names.push(entry.file_name().to_string_lossy().into_owned());
    }
    if let Some(other) = names
        .iter()
        .find(|name| *name != DISPLAY && !is_slice(name))
    {
        return Err(format!("it holds {other}, which is no part of a stack"));
    }
    if !names.is_empty() {
        display(folder).map_err(|reason| format!("it is no stack ({reason})"))?;
    }
    Ok(Some(names))
}

/// Creates the folder, or removes the pictures of slices in it.
fn make_room(folder: &Path) -> Result<(), String> {
    let Some(names) = names(folder)? else {
        return fs::create_dir(folder).map_err(|error| error.to_string());
    };
    for name in names {
        fs::remove_file(folder.join(&name)).map_err(|error| format!("{name}: {error}"))?;
    }
    Ok(())
}

fn encoded(picture: &RgbImage) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::NoFilter)
        .write_image(
            picture,
            picture.width(),
            picture.height(),
            ExtendedColorType::Rgb8,
        )
        .map_err(|error| error.to_string())?;
    Ok(bytes)
}

fn picture(folder: &Path, screen: &RotatingScreen, slice: u32) -> Result<RgbImage, String> {
    let name = name(slice);
    let bytes = fs::read(folder.join(&name)).map_err(|error| format!("{name}: {error}"))?;
    let picture = image::load_from_memory_with_format(&bytes, ImageFormat::Png)
        .map_err(|error| format!("{name}: {error}"))?
        .into_rgb8();
    let (width, height) = picture.dimensions();
    let pixels = screen.pixels;
    if (width, height) != (pixels, pixels) {
        return Err(format!(
            "{name} is {width} x {height}, {DISPLAY} says {pixels} x {pixels}"
        ));
    }
    match picture
        .as_raw()
        .iter()
        .find(|&&value| value != 0 && value != 255)
    {
        Some(value) => Err(format!(
            "{name} has a channel of {value}, and a slice only 0 and 255"
        )),
        None => Ok(picture),
    }
}

/// The half planes on the right and on the left of a picture.
fn voxels(screen: &RotatingScreen, picture: &RgbImage) -> [Vec<Lit>; 2] {
    let columns = screen.columns();
    let [mut right, mut left] = [Vec::new(), Vec::new()];
    for row in 0..screen.pixels {
        for column in 0..columns {
            for (side, x) in [
                (&mut right, columns + column),
                (&mut left, columns - 1 - column),
            ] {
                let [r, g, b] = picture.get_pixel(x, row).0.map(|value| value & 1);
                let channels = r | g << 1 | b << 2;
                if channels != 0 {
                    let at = row * columns + column;
                    side.push(Lit { at, channels });
                }
            }
        }
    }
    [right, left]
}

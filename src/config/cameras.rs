//! Where the cameras stand, from the options that place them.
#![forbid(unsafe_code)]

use super::choice::switch;
use super::error::ConfigError;
use super::field::Field;
use super::options::OptionId;
use super::settings::Settings;
use super::{Camera, Kept};

pub(super) fn camera(settings: &Settings) -> Result<Camera, ConfigError> {
    use OptionId::{AutoDepth, Convergence, EyeSpacing, FocalDepth, Separation};
    let measured = settings.get(AutoDepth).is_none() || switch(settings, AutoDepth)?;
    let eye = settings
        .field(EyeSpacing)
        .or_else(|| settings.field(FocalDepth));
    let clip = settings
        .field(Separation)
        .or_else(|| settings.field(Convergence));
    if let (Some((first, first_value)), Some((second, second_value))) = (&eye, &clip) {
        return Err(ConfigError::TwoCameras {
            first: first.clone(),
            first_value: (*first_value).to_owned(),
            second: second.clone(),
            second_value: (*second_value).to_owned(),
        });
    }
    if let Some((field, value)) = settings.field(FocalDepth)
        && number((field.clone(), value))? <= 0.0
    {
        return Err(ConfigError::NotPositive {
            field,
            value: value.to_owned(),
        });
    }
    let given = |id| settings.field(id).map(number).transpose();
    if measured {
        if let (Some((field, value)), None) =
            (settings.field(Convergence), settings.field(Separation))
            && number((field.clone(), value))? <= 0.0
        {
            return Err(ConfigError::NotPositive {
                field,
                value: value.to_owned(),
            });
        }
        let kept = match (
            given(Separation)?,
            given(Convergence)?,
            given(EyeSpacing)?,
            given(FocalDepth)?,
        ) {
            (None, None, None, None) => Some(None),
            (Some(separation), None, ..) => Some(Some(Kept::Separation(separation))),
            (None, Some(convergence), ..) => Some(Some(Kept::Convergence(convergence))),
            (_, _, Some(spacing), None) => Some(Some(Kept::EyeSpacing(spacing))),
            (_, _, None, Some(depth)) => Some(Some(Kept::FocalDepth(depth))),
            // Both are given: there is nothing to find.
            _ => None,
        };
        if let Some(kept) = kept {
            return Ok(Camera::Measured(kept));
        }
    }
    if eye.is_some() {
        let (spacing, focal_depth) = pair(settings, EyeSpacing, FocalDepth)?;
        return Ok(Camera::Eye {
            spacing,
            focal_depth,
        });
    }
    if clip.is_some() {
        let (separation, convergence) = pair(settings, Separation, Convergence)?;
        return Ok(Camera::Clip {
            separation,
            convergence,
        });
    }
    Ok(Camera::Auto)
}

/// Two numbers that only make sense together; at least one is there.
fn pair(settings: &Settings, first: OptionId, second: OptionId) -> Result<(f64, f64), ConfigError> {
    match (settings.field(first), settings.field(second)) {
        (Some(a), Some(b)) => Ok((number(a)?, number(b)?)),
        (Some((field, value)), None) => Err(ConfigError::Partner {
            partner: field.sibling(second),
            field,
            value: value.to_owned(),
        }),
        (None, Some((field, value))) => Err(ConfigError::Partner {
            partner: field.sibling(first),
            field,
            value: value.to_owned(),
        }),
        (None, None) => Ok((0.0, 0.0)),
    }
}

fn number((field, value): (Field, &str)) -> Result<f64, ConfigError> {
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(ConfigError::Number {
            field,
            value: value.to_owned(),
            example: "0.25",
        }),
    }
}

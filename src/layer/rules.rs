//! The profile of the running program: read again from its file, and written with the values in force.

use super::Layer;
use crate::config::{
    Camera, FlatDepth, Kept, Live, OptionId, Profile, profile, profile_text, program, replace,
};
use crate::control::{Answer, ControlError};
use std::path::PathBuf;
use std::sync::Arc;

impl Layer {
    /// The profile in force.
    pub fn profile(&self) -> &Arc<Profile> {
        &self.session.profile
    }

    /// Puts another profile in force from the next draw on. It has to be called between frames. What the user has given by options stays.
    pub fn adopt_profile(&mut self, profile: Arc<Profile>) {
        let before = std::mem::replace(&mut self.session.profile, Arc::clone(&profile));
        let program = program::this_program();
        self.cameras
            .classifier
            .change_rules(&profile, program.as_deref());
        self.cameras.follow(self.session.config.views);
        if profile.hud_depth != before.hud_depth && self.session.config.hud_depth.is_none() {
            self.adopt(Live {
                hud_depth: profile.hud_depth.unwrap_or_default(),
                ..self.session.live
            });
        }
        if profile.focal_depth != before.focal_depth {
            let (config, camera) = (self.session.config, self.session.live.camera);
            self.known.rig.change_focal(profile.focal_depth);
            self.cameras
                .comfort
                .change(config, camera, profile.focal_depth);
        }
    }

    /// Reads the file of the profile again, or looks for one where there was none.
    pub(super) fn reload_profile(&mut self) -> Result<Answer, ControlError> {
        let file = &self.session.profile.file;
        let read = match file.as_os_str().is_empty() {
            false => Profile::read(file).map_err(ControlError::Profile)?,
            true => program::this_program()
                .and_then(|program| Profile::automatic(&self.session.config.profiles, &program))
                .ok_or(ControlError::NoProfile)?,
        };
        let answer = Answer::Profile {
            path: read.file.clone(),
            rules: read.rules.len(),
            left: Vec::new(),
        };
        self.adopt_profile(Arc::new(read));
        Ok(answer)
    }

    /// Writes the values in force, with the rules of the profile as they are, into `path` or the user's own profile of the program.
    pub(super) fn save_profile(&mut self, path: Option<PathBuf>) -> Result<Answer, ControlError> {
        let program = program::this_program().unwrap_or_default();
        let before = &self.session.profile.file;
        let users = profile::users();
        let own = users
            .as_ref()
            .is_some_and(|folder| before.starts_with(folder));
        let path = match path {
            Some(path) => path,
            None if own => before.clone(),
            None => users
                .ok_or(ControlError::NoProfile)?
                .join(format!("{program}.toml")),
        };
        let unsaved = |error: std::io::Error| ControlError::Unsaved {
            path: path.clone(),
            reason: error.to_string(),
        };
        let text = match before.as_os_str().is_empty() {
            true => profile_text::new(&program),
            false => std::fs::read_to_string(before).map_err(unsaved)?,
        };
        let live = &self.session.live;
        let focal = match live.camera {
            Camera::Eye { focal_depth, .. }
            | Camera::Measured(Some(Kept::FocalDepth(focal_depth))) => Some(focal_depth),
            _ => None,
        };
        let hud =
            (live.hud_depth != self.session.profile.hud_depth.unwrap_or_default()).then(|| {
                match live.hud_depth {
                    FlatDepth::At(depth) => depth.to_string(),
                    follows => format!("\"{follows}\""),
                }
            });
        let focal = focal.map(|depth| depth.to_string());
        let values = [("hud-depth", hud), ("focal-depth", focal)];
        let values = values
            .iter()
            .filter_map(|(key, value)| Some((*key, value.as_deref()?)))
            .collect::<Vec<_>>();
        let text = profile_text::with_values(&text, &values);
        let written = Profile::parse(&text, &path).map_err(ControlError::Profile)?;
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(unsaved)?;
        }
        replace(&path, text.as_bytes()).map_err(unsaved)?;
        let chosen = match live.camera {
            Camera::Clip { .. } => &[OptionId::Separation, OptionId::Convergence][..],
            Camera::Measured(Some(Kept::Separation(_))) => &[OptionId::Separation],
            Camera::Measured(Some(Kept::EyeSpacing(_))) | Camera::Eye { .. } => {
                &[OptionId::EyeSpacing]
            }
            Camera::Measured(Some(Kept::Convergence(_))) => &[OptionId::Convergence],
            _ => &[],
        };
        let output = (live.output != self.session.config.output).then_some(&OptionId::Output);
        let left = chosen.iter().chain(output).filter_map(|id| id.spec().key);
        let answer = Answer::Profile {
            path,
            rules: written.rules.len(),
            left: left.map(str::to_owned).collect(),
        };
        // It is the one that is read again from now on.
        self.session.profile = Arc::new(written);
        Ok(answer)
    }
}

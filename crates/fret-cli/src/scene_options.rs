//! The scene that a command works on.

use std::io::Read;
use std::path::PathBuf;

use clap::Args;
use contact_core::scene::{Reach, Section, read_scene_and, read_text};
use contact_core::{Error, Scene};
use contact_wear::Wear;

use crate::terminal::print_message;

/// Upper limit of the bytes of a scene from the standard input; it may contain heights.
const LONGEST: u64 = 1 << 30;

/// A scene file and the changes to it.
#[derive(Args)]
pub(crate) struct SceneOptions {
    /// Scene file (TOML); - reads it from the standard input
    pub(crate) scene: PathBuf,
    /// Replace a value of the scene file, such as friction.mu=0.5 or
    /// body2.coatings.0.E.E_substrate=4
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) settings: Vec<String>,
    /// Let the scene name files outside its own folder
    #[arg(long)]
    pub(crate) allow_outside: bool,
}

impl SceneOptions {
    /// Reads the scene with the changes of the options.
    pub(crate) fn read(&self) -> Result<Scene, Error> {
        let (text, name) = self.text()?;
        Scene::from_toml_str_reaching(&text, &name, &self.settings, self.reach())
    }

    /// The scene and its table `[wear]`, if it has one.
    pub(crate) fn read_whole(&self) -> Result<(Scene, Option<Wear>), Error> {
        let (text, name) = self.text()?;
        Wear::scene_and_wear(&text, &name, &self.settings, self.reach())
    }

    /// Whether the scene has a load history, a table `[history]`.
    pub(crate) fn has_history(&self) -> Result<bool, Error> {
        let (text, name) = self.text()?;
        let has_section = |root: &Section<'_>, _: &Scene| Ok(root.get("history").is_some());
        Ok(read_scene_and(&text, &name, &self.settings, self.reach(), has_section)?.1)
    }

    /// The files that the scene may name.
    pub(crate) fn reach(&self) -> Reach {
        if self.allow_outside {
            Reach::Anywhere
        } else {
            Reach::Folder
        }
    }

    /// The text of the file, and its name in errors.
    fn text(&self) -> Result<(String, String), Error> {
        if self.scene.as_os_str() == "-" {
            let failed = |message: String| Error::File {
                path: "standard input".into(),
                message,
            };
            let mut text = String::new();
            std::io::stdin()
                .take(LONGEST)
                .read_to_string(&mut text)
                .map_err(|e| failed(e.to_string()))?;
            if text.len() as u64 == LONGEST {
                return Err(failed(format!(
                    "is no scene: it has {LONGEST} bytes or more"
                )));
            }
            return Ok((text, "standard input".into()));
        }
        read_text(&self.scene)
    }
}

/// Warns of allowed but implausible values of a scene.
pub(crate) fn warn_of_scene(scene: &Scene) {
    warn_of_doubts(&scene.doubts());
}

/// Warns of doubts.
pub(crate) fn warn_of_doubts(doubts: &[String]) {
    for doubt in doubts {
        print_message(&format!("fret: warning: {doubt}"));
    }
}

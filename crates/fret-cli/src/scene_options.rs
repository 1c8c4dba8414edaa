//! The scene that a command works on.

use std::io::Read;
use std::path::PathBuf;

use clap::Args;
use contact_core::scene::Reach;
use contact_core::{Error, Scene};

use crate::terminal::say;

/// Bytes of a scene that is read from the standard input, fewer than: heights may stand in it.
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
    pub(crate) fn read(&self) -> Result<Scene, Error> {
        let reach = if self.allow_outside {
            Reach::Anywhere
        } else {
            Reach::Folder
        };
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
            return Scene::from_toml_str_reaching(&text, "standard input", &self.settings, reach);
        }
        Scene::from_file_reaching(&self.scene, &self.settings, reach)
    }
}

/// Warns of allowed but implausible values of a scene.
pub(crate) fn say_doubts(scene: &Scene) {
    say_each(&scene.doubts());
}

/// Warns of doubts.
pub(crate) fn say_each(doubts: &[String]) {
    for doubt in doubts {
        say(&format!("fret: warning: {doubt}"));
    }
}

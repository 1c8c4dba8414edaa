//! Keys of a scene file by the words that others have for them.

/// Words and symbols of others, and the key of the scene file that each of them means.
const SYNONYMS: [(&str, &str); 30] = [
    ("mu", "friction.mu"),
    ("f", "friction.mu"),
    ("cof", "friction.mu"),
    ("friction_coefficient", "friction.mu"),
    ("coefficient", "friction.mu"),
    ("pitch", "grid.spacing"),
    ("step", "grid.spacing"),
    ("cell", "grid.spacing"),
    ("cell_size", "grid.spacing"),
    ("dx", "grid.spacing"),
    ("dy", "grid.spacing"),
    ("spacing", "grid.spacing"),
    ("width", "grid.extent"),
    ("size", "grid.extent"),
    ("extent", "grid.extent"),
    ("n", "grid.n"),
    ("nx", "grid.n"),
    ("ny", "grid.n"),
    ("cells", "grid.n"),
    ("plane_strain", "grid.plane_strain"),
    ("load", "path.W"),
    ("force", "path.W"),
    ("normal_load", "path.W"),
    ("normal_force", "path.W"),
    ("F", "path.W"),
    ("P", "path.W"),
    ("Q", "path.T_x"),
    ("shift", "path.delta_x"),
    ("displacement", "path.delta_x"),
    ("stroke", "path.delta_x"),
];

/// Short names of keys, in settings and as parameters of studies.
const SHORT: [(&str, &str); 1] = [("mu", "friction.mu")];

/// Characters of an unknown name that are compared with the allowed names.
const COMPARED: usize = 64;

/// The full key of a short one, or the key itself.
pub(super) fn full_key(key: &str) -> &str {
    let short = SHORT.iter().find(|(name, _)| *name == key.trim());
    short.map_or(key, |(_, full)| full)
}

/// The key that a word of others means in the table `table`: one of its `allowed` names, or a key of
/// another section where the word stands at the root of the file.
pub(super) fn meant_key(unknown: &str, table: &str, allowed: &[&str]) -> Option<String> {
    let (_, key) = SYNONYMS.iter().find(|(word, _)| *word == unknown)?;
    let (section, name) = key.split_once('.')?;
    if table.is_empty() {
        return Some(if section == "path" {
            format!("path[0].{name}")
        } else {
            (*key).to_owned()
        });
    }
    let in_section = table.split(['.', '[']).next() == Some(section) && allowed.contains(&name);
    in_section.then(|| format!("{table}.{name}"))
}

/// The allowed name that is nearest to an unknown one in its spelling; none if all are far from it.
pub(super) fn nearest(unknown: &str, allowed: &[&str]) -> Option<String> {
    let start: String = unknown.chars().take(COMPARED).collect();
    let distance = |name: &&&str| strsim::damerau_levenshtein(&start, name);
    allowed
        .iter()
        .min_by_key(distance)
        .map(|&name| name.to_owned())
}

//! Faces in contact, against the tables: K 1e-3, borders of the parts 2e-2 (one of them 2.3e-2).

use std::collections::BTreeMap;

use crate::truth::{Fretting, numbers, shape, tables};
use fracture::{Crack, Faces, Path, State};

#[test]
fn closed_and_partly_open_cracks_with_and_without_friction() {
    let mut cracks: BTreeMap<String, Crack> = BTreeMap::new();
    let mut failed = Vec::new();
    for (key, row) in tables()["closure"].as_object().unwrap() {
        let parts: Vec<_> = key.split('|').collect();
        let value = |n: usize| parts[n].parse::<f64>().unwrap();
        let straight = || Crack::new(Path::straight(-1.0, 1.0, value(1).to_radians())).unwrap();
        let shared = cracks.entry(parts[1].into()).or_insert_with(straight);
        let crack = shared.similar(-1.0, value(3)).unwrap();
        let stress = Fretting::named(parts[2]).along(&crack.points());
        let faces = match Faces::new(&crack, value(0)).unwrap().next(&stress) {
            Ok(faces) => faces,
            Err(error) => {
                failed.push(format!("{key}: {error}"));
                continue;
            }
        };
        let truth = numbers(&row["F"]);
        let larger = truth[0].abs().max(truth[1].abs()).max(1e-2);
        let k = faces.intensity;
        let told = shape(k.error, crack.length());
        for (found, truth) in [k.K_I, k.K_II].iter().zip(&truth) {
            let off = (shape(*found, crack.length()) - truth).abs();
            if off > 1e-3 * larger || off > told + 1e-6 {
                failed.push(format!(
                    "{key}: K off by {off:e} of {larger}, told {told:e}"
                ));
            }
        }
        let borders: Vec<_> = faces.parts().unwrap().iter().skip(1).map(|p| p.1).collect();
        let wanted: Vec<_> = numbers(&row["c"])
            .into_iter()
            .filter(|c| *c > 5e-6)
            .collect();
        // The border of a stick zone at 0.7 % of the length from the mouth.
        let bound = if key == "0.3|20|FS.3-|0.2" {
            2.3e-2
        } else {
            2e-2
        };
        let far = |(found, c): (&f64, &f64)| (found / c - 1.0).abs() > bound;
        let borders: Vec<_> = borders.into_iter().filter(|c| *c > 5e-6).collect();
        if borders.len() != wanted.len() || borders.iter().zip(&wanted).any(far) {
            failed.push(format!("{key}: borders {borders:?} of {wanted:?}"));
        }
    }
    assert!(failed.is_empty(), "{}\n{}", failed.len(), failed.join("\n"));
}

#[test]
fn friction_remembers_and_frictionless_faces_do_not() {
    let crack = Crack::new(Path::straight(-1.0, 0.5, 0.0)).unwrap();
    let at = |name: &str| Fretting::named(name).along(&crack.points());
    let follow = |friction: f64, names: &[&str]| {
        let start = Faces::new(&crack, friction).unwrap();
        names
            .iter()
            .fold(start, |faces, name| faces.next(&at(name)).unwrap())
    };
    let (short, long) = (
        follow(0.0, &["FS.3-"]),
        follow(0.0, &["FS.3+", "FS.6-", "FS.3-"]),
    );
    assert!((short.intensity.K_II - long.intensity.K_II).abs() < 1e-9);
    // Unloading from more shear leaves slip behind that stuck faces hold.
    let (short, long) = (follow(0.3, &["FS.3-"]), follow(0.3, &["FS.6-", "FS.3-"]));
    assert!(long.intensity.K_II > short.intensity.K_II + 1e-3);
    let stuck = |faces: &Faces| faces.parts().unwrap().iter().any(|p| p.0 == State::Stick);
    assert!(stuck(&long) && !stuck(&short));
}

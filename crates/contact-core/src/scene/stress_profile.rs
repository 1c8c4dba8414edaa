//! Residual stress of a layer over depth.

use crate::error::Error;

/// Residual stress of one layer.
///
/// Linear between the depths of the table, constant above the first and below the last. One row is a
/// uniform stress.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Depth below the top of the layer \[m\], s_xx and s_yy \[Pa\], tension positive. None: no stress.
    pub rows: Vec<[f64; 3]>,
}

impl Profile {
    /// A uniform stress s_xx = s_yy \[Pa\].
    pub fn uniform(stress: f64) -> Self {
        Self {
            rows: vec![[0.0, stress, stress]],
        }
    }

    /// Whether there is no stress.
    pub fn is_zero(&self) -> bool {
        self.rows.iter().all(|[_, xx, yy]| *xx == 0.0 && *yy == 0.0)
    }

    /// s_xx and s_yy at a depth below the top of the layer \[Pa\].
    pub fn stress_at(&self, depth: f64) -> [f64; 2] {
        let next_row = self.rows.partition_point(|row| row[0] <= depth);
        let (Some(below), Some(above)) = (
            self.rows.get(next_row).or(self.rows.last()),
            self.rows.get(next_row.saturating_sub(1)),
        ) else {
            return [0.0; 2];
        };
        let fraction = if below[0] > above[0] && depth > above[0] {
            ((depth - above[0]) / (below[0] - above[0])).min(1.0)
        } else {
            0.0
        };
        [1, 2].map(|n| above[n] + fraction * (below[n] - above[n]))
    }

    /// Largest stress of von Mises \[Pa\]; between two rows it is at most the larger one of theirs.
    pub fn von_mises(&self) -> f64 {
        let equivalent_stress = |[_, xx, yy]: &[f64; 3]| (xx * xx - xx * yy + yy * yy).sqrt();
        self.rows.iter().map(equivalent_stress).fold(0.0, f64::max)
    }

    /// Fails at a number that is not finite and at depths that do not grow; `key` is the key of the profile.
    pub fn check(&self, key: &str) -> Result<(), Error> {
        let mut previous_depth = None;
        for (n, [depth, xx, yy]) in self.rows.iter().enumerate() {
            let uniform = self.rows.len() == 1;
            let name = |column: usize| {
                if uniform {
                    key.to_owned()
                } else {
                    format!("{key}[{n}][{column}]")
                }
            };
            if !(*depth >= 0.0 && depth.is_finite()) {
                let allowed = "a depth in m below the top of the layer, 0 or more";
                return Err(Error::invalid(name(0), *depth, allowed));
            }
            if let Some(previous) = previous_depth.filter(|before| depth <= before) {
                let allowed =
                    format!("above {previous:e} m, the depth of the row before: depths grow");
                return Err(Error::invalid(name(0), *depth, allowed));
            }
            previous_depth = Some(*depth);
            for (column, stress) in [(1, xx), (2, yy)] {
                if !stress.is_finite() {
                    return Err(Error::invalid(
                        name(column),
                        *stress,
                        "a finite stress in Pa",
                    ));
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Profile;

    #[test]
    fn a_table_is_linear_between_its_depths_and_constant_beyond() {
        let table = Profile {
            rows: vec![
                [10e-6, -600e6, -500e6],
                [50e-6, -200e6, -100e6],
                [90e-6, 40e6, 0.0],
            ],
        };
        table.check("residual").expect("sound");
        for (depth, xx, yy) in [
            (0.0, -600e6, -500e6),
            (10e-6, -600e6, -500e6),
            (30e-6, -400e6, -300e6),
            (50e-6, -200e6, -100e6),
            (70e-6, -80e6, -50e6),
            (1.0, 40e6, 0.0),
        ] {
            let stress = table.stress_at(depth);
            assert!(
                (stress[0] - xx).abs() < 1e-3 && (stress[1] - yy).abs() < 1e-3,
                "{depth}"
            );
        }
        assert_eq!(Profile::uniform(-1e9).stress_at(3e-6), [-1e9, -1e9]);
        assert_eq!(Profile::default().stress_at(3e-6), [0.0, 0.0]);
    }

    #[test]
    fn numbers_without_meaning_are_refused_by_name() {
        let sound = [[0.0, -1e8, -1e8], [1e-5, 0.0, 0.0]];
        for (row, column, value) in [
            (0, 0, -1e-6),
            (1, 0, 0.0),
            (1, 0, f64::NAN),
            (0, 1, f64::NAN),
            (1, 2, f64::INFINITY),
        ] {
            let mut rows = sound.to_vec();
            rows[row][column] = value;
            let error = Profile { rows }.check("body2.residual").expect_err("bad");
            let key = format!("body2.residual[{row}][{column}]");
            assert!(error.to_string().contains(&key), "{error}");
        }
    }
}

//! What criteria judge: stress and plastic strain of points over time.

use ndarray::ArrayView3;
use stress_tensor::StressTensor;

use crate::criterion::Criterion;
use crate::error::Error;

/// The largest stress \[Pa\]: products of two stay finite.
const LARGEST: f64 = 1e75;
/// Largest change of the volume by plastic strain, over its largest component: rounding to single
/// precision is 1e-7.
const VOLUME: f64 = 1e-4;

/// Stress and plastic strain of points over time, components xx, yy, zz, xy, xz, yz.
#[derive(Clone, Debug)]
pub struct History<'a> {
    /// Stress of shape (time, points, 6) \[Pa\], tension positive.
    pub stress: ArrayView3<'a, f64>,
    /// Plastic strain at the same instants, tensor components (`None`: elastic). A criterion of strain takes
    /// the sum of the elastic strain of the stress and this strain; other criteria leave it out.
    pub plastic: Option<ArrayView3<'a, f64>>,
}

impl<'a> History<'a> {
    /// Of points that stay elastic, or whose plastic strain is constant.
    pub fn elastic(stress: &ArrayView3<'a, f64>) -> Self {
        Self {
            stress: *stress,
            plastic: None,
        }
    }

    /// Fails without a history.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let (instants, _, components) = self.stress.dim();
        if components != 6 {
            let allowed = "6 long: xx, yy, zz, xy, xz, yz";
            return Err(Error::argument("last axis of stress", components, allowed));
        }
        if instants < 2 {
            let allowed = "at least 2: a criterion needs a history";
            return Err(Error::argument("instants of stress", instants, allowed));
        }
        let (shape, plastic) = (self.stress.dim(), self.plastic.as_ref());
        match plastic.map(ArrayView3::dim).filter(|own| *own != shape) {
            Some(own) => {
                let allowed = format!("of the shape of the stress, {shape:?}");
                let found = format!("an array of shape {own:?}");
                Err(Error::argument("plastic strain", found, allowed))
            }
            None => Ok(()),
        }
    }

    /// The plastic strain, if a criterion takes it, and 2 G by which it is a stress \[Pa\].
    pub(crate) fn taken_by(&self, criterion: &Criterion) -> Option<(ArrayView3<'a, f64>, f64)> {
        self.plastic.zip(criterion.twice_shear_modulus())
    }
}

/// The stresses of a few points, one after the other.
pub(crate) fn stresses(
    stress: &ArrayView3<'_, f64>,
    first: usize,
    points: usize,
) -> Result<Vec<StressTensor>, Error> {
    copied(stress, first, points, |t, p, tensor| {
        let bad = tensor.iter().position(|s| !(s.abs() <= LARGEST));
        let Some(c) = bad else { return Ok(tensor) };
        let key = format!("stress[{t}, {p}, {c}]");
        let allowed = "a finite stress in Pa, up to 1e75";
        Err(Error::argument(key, tensor[c], allowed))
    })
}

/// The plastic strains of a few points times 2 G \[Pa\], one after the other.
pub(crate) fn plastic_strains(
    (plastic, twice_shear): (&ArrayView3<'_, f64>, f64),
    first: usize,
    points: usize,
) -> Result<Vec<StressTensor>, Error> {
    copied(plastic, first, points, |t, p, tensor| {
        let largest = tensor.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
        let grown = tensor[0] + tensor[1] + tensor[2];
        let bad = tensor.iter().find(|e| !(twice_shear * e.abs() <= LARGEST));
        if let Some(bad) = bad {
            let key = format!("plastic strain[{t}, {p}]");
            return Err(Error::argument(key, bad, "a finite strain"));
        }
        if grown.abs() > VOLUME * largest {
            let key = format!("xx + yy + zz of the plastic strain[{t}, {p}]");
            let allowed = "0: plastic strain keeps the volume";
            return Err(Error::argument(key, grown, allowed));
        }
        Ok(tensor.map(|e| twice_shear * e))
    })
}

fn copied(
    of: &ArrayView3<'_, f64>,
    first: usize,
    points: usize,
    taken: impl Fn(usize, usize, StressTensor) -> Result<StressTensor, Error>,
) -> Result<Vec<StressTensor>, Error> {
    let instants = of.dim().0;
    let mut tensors = vec![[0.0; 6]; points * instants];
    for t in 0..instants {
        for p in 0..points {
            let tensor = std::array::from_fn(|c| of[(t, first + p, c)]);
            tensors[p * instants + t] = taken(t, first + p, tensor)?;
        }
    }
    Ok(tensors)
}

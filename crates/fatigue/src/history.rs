//! The input of a criterion: stress and plastic strain of points over time.

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
    /// History of points that stay elastic, or whose plastic strain is constant.
    pub fn elastic(stress: &ArrayView3<'a, f64>) -> Self {
        Self {
            stress: *stress,
            plastic: None,
        }
    }

    /// Fails if the shape is wrong, or with fewer than two instants.
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
        match plastic
            .map(ArrayView3::dim)
            .filter(|strain_shape| *strain_shape != shape)
        {
            Some(strain_shape) => {
                let allowed = format!("of the shape of the stress, {shape:?}");
                let actual = format!("an array of shape {strain_shape:?}");
                Err(Error::argument("plastic strain", actual, allowed))
            }
            None => Ok(()),
        }
    }

    /// The plastic strain, if a criterion takes it, and 2 G, which converts it to a stress \[Pa\].
    pub(crate) fn strain_for(&self, criterion: &Criterion) -> Option<(ArrayView3<'a, f64>, f64)> {
        self.plastic.zip(criterion.twice_shear_modulus())
    }
}

/// The stresses of a few points, one after the other.
pub(crate) fn stresses(
    stress: &ArrayView3<'_, f64>,
    first: usize,
    points: usize,
) -> Result<Vec<StressTensor>, Error> {
    copy_tensors(stress, first, points, |t, p, tensor| {
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
    copy_tensors(plastic, first, points, |t, p, tensor| {
        let largest = tensor.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
        let volume_change = tensor[0] + tensor[1] + tensor[2];
        let bad = tensor.iter().find(|e| !(twice_shear * e.abs() <= LARGEST));
        if let Some(bad) = bad {
            let key = format!("plastic strain[{t}, {p}]");
            return Err(Error::argument(key, bad, "a finite strain"));
        }
        if volume_change.abs() > VOLUME * largest {
            let key = format!("xx + yy + zz of the plastic strain[{t}, {p}]");
            let allowed = "0: plastic strain keeps the volume";
            return Err(Error::argument(key, volume_change, allowed));
        }
        Ok(tensor.map(|e| twice_shear * e))
    })
}

/// Copies the tensors of a few points, each after its conversion by `convert(t, point, tensor)`.
fn copy_tensors(
    tensors_of_all: &ArrayView3<'_, f64>,
    first: usize,
    points: usize,
    convert: impl Fn(usize, usize, StressTensor) -> Result<StressTensor, Error>,
) -> Result<Vec<StressTensor>, Error> {
    let instants = tensors_of_all.dim().0;
    let mut tensors = vec![[0.0; 6]; points * instants];
    for t in 0..instants {
        for p in 0..points {
            let tensor = std::array::from_fn(|c| tensors_of_all[(t, first + p, c)]);
            tensors[p * instants + t] = convert(t, first + p, tensor)?;
        }
    }
    Ok(tensors)
}

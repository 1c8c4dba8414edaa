//! Rows of truth.

use debris::Lattice;
use serde_json::Value;

/// Half-width of a disc or strip in the rows \[m\], and other numbers, by their keys.
pub(crate) struct Row(Value);

pub(crate) fn row(name: &str) -> Row {
    let rows: Value = serde_json::from_str(include_str!("../data/rows.json")).expect("rows");
    Row(rows[name].clone())
}

impl Row {
    pub(crate) fn input(&self, key: &str) -> f64 {
        self.0["input"][key].as_f64().expect(key)
    }

    pub(crate) fn output(&self, key: &str) -> f64 {
        self.0["output"][key].as_f64().expect(key)
    }

    pub(crate) fn list(&self, part: &str, key: &str) -> Vec<f64> {
        let list = self.0[part][key].as_array().expect(key);
        list.iter().map(|v| v.as_f64().expect(key)).collect()
    }

    /// Triples x, y, value.
    pub(crate) fn points(&self, key: &str) -> Vec<[f64; 3]> {
        let points = self.0["output"][key].as_array().expect(key);
        let number = |v: &Value, k: usize| v[k].as_f64().expect(key);
        points
            .iter()
            .map(|p| [0, 1, 2].map(|k| number(p, k)))
            .collect()
    }
}

/// A line of cells over a strip.
pub(crate) struct Strip {
    pub(crate) lattice: Lattice,
    pub(crate) x: Vec<f64>,
}

impl Strip {
    /// `inside` cells over the width 2 b, and two open ones on either side.
    pub(crate) fn new(b: f64, inside: usize) -> Self {
        let dx = 2.0 * b / inside as f64;
        let columns = inside + 4;
        let x = |i: usize| (i as f64 + 0.5 - 0.5 * columns as f64) * dx;
        Self {
            lattice: Lattice::line(columns, dx),
            x: (0..columns).map(x).collect(),
        }
    }

    /// A field of x.
    pub(crate) fn map<T>(&self, f: impl Fn(f64) -> T) -> Vec<T> {
        self.x.iter().map(|x| f(*x)).collect()
    }

    /// Value of a field at x, linear between the centres.
    pub(crate) fn interpolate(&self, field: &[f64], x: f64) -> f64 {
        let place = (x - self.x[0]) / self.lattice.dx;
        let i = (place.floor() as usize).min(self.x.len() - 2);
        let part = place - i as f64;
        (1.0 - part) * field[i] + part * field[i + 1]
    }

    /// The same, linear in the logarithm.
    pub(crate) fn log_at(&self, field: &[f64], x: f64) -> f64 {
        let logs: Vec<f64> = field.iter().map(|v| v.ln()).collect();
        self.interpolate(&logs, x).exp()
    }
}

/// The half y > 0 of square cells over -a to a.
pub(crate) struct Half {
    pub(crate) lattice: Lattice,
    size: f64,
}

impl Half {
    /// `inside` (even) cells over 2 a, and two open ones on either side.
    pub(crate) fn new(a: f64, inside: usize) -> Self {
        let size = 2.0 * a / inside as f64;
        Self {
            lattice: Lattice {
                columns: inside + 4,
                rows: inside / 2 + 2,
                dx: size,
                dy: size,
                sealed: [true, false],
            },
            size,
        }
    }

    fn centre(&self, n: usize) -> (f64, f64) {
        let (i, j) = (n / self.lattice.rows, n % self.lattice.rows);
        let x = (i as f64 + 0.5 - 0.5 * self.lattice.columns as f64) * self.size;
        (x, (j as f64 + 0.5) * self.size)
    }

    pub(crate) fn map<T>(&self, f: impl Fn(f64, f64) -> T) -> Vec<T> {
        let centres = (0..self.lattice.cells()).map(|n| self.centre(n));
        centres.map(|(x, y)| f(x, y)).collect()
    }

    /// Value of a field at a place, linear in the logarithm between the centres.
    pub(crate) fn log_at(&self, field: &[f64], x: f64, y: f64) -> f64 {
        let rows = self.lattice.rows;
        let (px, py) = (
            x / self.size + 0.5 * self.lattice.columns as f64 - 0.5,
            (y / self.size - 0.5).max(0.0),
        );
        let (i, j) = (px.floor() as usize, py.floor() as usize);
        let (a, b) = (px - i as f64, py - j as f64);
        let value = |i: usize, j: usize| field[i * rows + j].ln();
        let low = (1.0 - a) * value(i, j) + a * value(i + 1, j);
        let high = (1.0 - a) * value(i, j + 1) + a * value(i + 1, j + 1);
        ((1.0 - b) * low + b * high).exp()
    }

    pub(crate) fn sum(&self, field: &[f64]) -> f64 {
        2.0 * self.size * self.size * field.iter().sum::<f64>()
    }
}

pub(crate) fn near(value: f64, exact: f64, relative: f64, what: &str) {
    assert!(
        (value - exact).abs() <= relative * exact.abs(),
        "{what}: {value}, exact {exact}"
    );
}

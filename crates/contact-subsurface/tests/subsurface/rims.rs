//! Where rims and stick borders are.

use contact_core::convolution::Tractions;
use contact_core::scene::Grid;
use contact_subsurface::{Border, Line, Zone, borders};
use ndarray::Array2;

/// Cattaneo's tractions with a stick zone of the radius c, a = p_H = 1, mu = 0.5, and the cells
/// that stick.
fn cattaneo(grid: &Grid, c: f64) -> ([Array2<f64>; 2], Array2<bool>) {
    let root = |x: f64, y: f64, a: f64| (a * a - x * x - y * y).max(0.0).sqrt();
    let p = grid.map(|x, y| root(x, y, 1.0));
    let q = grid.map(|x, y| 0.5 * (root(x, y, 1.0) - root(x, y, c)));
    let stick = Array2::from_shape_fn(p.dim(), |(i, j)| grid.x(i).hypot(grid.y(j)) < c);
    ([p, q], stick)
}

fn found(grid: &Grid, c: f64, line: Option<Line>) -> Vec<Border> {
    let ([p, q], stick) = cattaneo(grid, c);
    let tractions = Tractions {
        q_x: q.as_slice(),
        q_y: None,
        p: p.as_slice(),
    };
    borders(grid, &tractions, stick.as_slice(), line).unwrap()
}

#[test]
fn rims_and_stick_borders_are_known_within_a_fraction_of_a_cell() {
    for n in [64, 65, 128] {
        let grid = Grid::centred(2.43, n).unwrap();
        for line in [None, Some(Line::AlongX(0.0)), Some(Line::AlongY(0.31))] {
            let all = found(&grid, 0.6, line);
            for (zone, radius) in [(Zone::Contact, 1.0), (Zone::Stick, 0.6)] {
                let of_zone: Vec<_> = all.iter().filter(|b| b.zone == zone).collect();
                assert!(if line.is_some() {
                    of_zone.len() == 2
                } else {
                    of_zone.len() > n
                });
                for Border {
                    x, y, within_cell, ..
                } in of_zone
                {
                    // Sampled tractions vanish a hundredth of a cell from where the solver's do.
                    let off = (x.hypot(*y) - radius).abs() / grid.dx;
                    assert!(
                        *within_cell && off < 0.1,
                        "{n} {line:?} {zone:?}: {off} cells"
                    );
                    if let Some(line) = line {
                        let at = line.place(line.nearest_distance(*x, *y));
                        assert!((at.0 - x).hypot(at.1 - y) < 1e-12);
                    }
                }
            }
        }
    }
}

#[test]
fn a_line_contact_has_two_rims_and_a_shifted_stick_zone() {
    let grid = Grid::strip(2.5, 80, 1.0).unwrap();
    let root = |x: f64, a: f64| (a * a - x * x).max(0.0).sqrt();
    let (p, q) = (
        grid.map(|x, _| root(x, 1.0)),
        grid.map(|x, _| 0.3 * (root(x, 1.0) - root(x - 0.2, 0.5))),
    );
    let stick = grid
        .map(|x, _| f64::from((x - 0.2).abs() < 0.5))
        .mapv(|s| s > 0.0);
    let tractions = Tractions {
        q_x: q.as_slice(),
        q_y: None,
        p: p.as_slice(),
    };
    let all = borders(&grid, &tractions, stick.as_slice(), None).unwrap();
    let exact = [(Zone::Contact, [-1.0, 1.0]), (Zone::Stick, [-0.3, 0.7])];
    for (zone, places) in exact {
        let x: Vec<f64> = all.iter().filter(|b| b.zone == zone).map(|b| b.x).collect();
        assert_eq!(x.len(), 2, "{all:?}");
        for (x, place) in x.iter().zip(places) {
            assert!((x - place).abs() < 0.05 * grid.dx, "{all:?}");
        }
    }
    // Tractions of another grid.
    assert!(borders(&Grid::strip(2.5, 81, 1.0).unwrap(), &tractions, None, None).is_err());
}

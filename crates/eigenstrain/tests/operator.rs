//! The operator against closed forms and against itself.
#![allow(missing_docs)]

use eigenstrain::{Answer, COMPONENTS, Cells, Layer, Mesh, Operator, Sources, surface_compliance};

const STEEL: Layer = Layer {
    E: 210e9,
    nu: 0.3,
    thickness: f64::INFINITY,
};

fn square(n: usize, d: f64) -> Cells {
    Cells {
        nx: n,
        ny: n,
        dx: d,
        dy: d,
        plane_strain: false,
    }
}

fn line(n: usize, d: f64) -> Cells {
    Cells {
        ny: 1,
        plane_strain: true,
        ..square(n, d)
    }
}

/// Stress on all planes, and displacement of the surface.
fn answer(operator: &mut Operator, sources: Sources<'_>) -> (Vec<f64>, Vec<f64>) {
    let mut stress = vec![0.0; operator.len()];
    let mut displacement = vec![0.0; 3 * operator.mesh().cells.len()];
    let wanted = vec![true; operator.mesh().planes()];
    let to = Answer {
        stress: &mut stress,
        wanted: &wanted,
        displacement: &mut displacement,
        of_tractions: true,
    };
    operator.apply(sources, to);
    (stress, displacement)
}

/// Centres of the cells from the middle \[m\].
fn centre(n: usize, i: usize, d: f64) -> f64 {
    (i as f64 - 0.5 * (n as f64 - 1.0)) * d
}

/// A Gaussian centre of dilatation at the depth c: largest error of u_z and u_r over the largest u_z.
fn dilatation(n: usize, extent: f64) -> [f64; 2] {
    let (c, e_0) = (1.0, 1e-3);
    let s = c / 6.0;
    let d = extent / n as f64;
    let mesh =
        Mesh::graded(square(n, d), vec![STEEL], 2.0 * c, [c / 16.0; 2], 2.0 * c).expect("a mesh");
    let mut operator = Operator::new(mesh);
    let mut e = vec![0.0; operator.len()];
    let cells = n * n;
    for plane in 0..operator.mesh().planes() {
        let z = operator.mesh().depth(plane) - c;
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let (x, y) = (centre(n, i, d), centre(n, j, d));
            let here = e_0 * (-(x * x + y * y + z * z) / (s * s)).exp();
            for component in 0..3 {
                e[(plane * COMPONENTS + component) * cells + i * n + j] = here;
            }
        }
    }
    let sources = Sources {
        eigenstrain: Some(&e),
        tractions: None,
    };
    let (_, u) = answer(&mut operator, sources);
    let volume = e_0 * (std::f64::consts::PI.sqrt() * s).powi(3);
    let strength = (1.0 + STEEL.nu) * volume / std::f64::consts::PI;
    let mut worst = [0.0_f64; 2];
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let (x, y) = (centre(n, i, d), centre(n, j, d));
        let r_3 = (x * x + y * y + c * c).powf(1.5);
        let at = i * n + j;
        worst[0] = worst[0].max((u[2 * cells + at] + strength * c / r_3).abs());
        worst[1] = worst[1].max((u[at] - strength * x / r_3).abs());
        worst[1] = worst[1].max((u[cells + at] - strength * y / r_3).abs());
    }
    worst.map(|error| error / (strength / (c * c)))
}

#[test]
fn a_centre_of_dilatation_moves_the_surface_as_in_the_closed_form() {
    for (n, extent) in [(64, 5.3), (64, 8.0), (48, 5.3)] {
        let [z, r] = dilatation(n, extent);
        assert!(
            z < 2e-3 && r < 2e-3,
            "{n} cells, {extent}: u_z {z}, u_r {r}"
        );
    }
}

#[test]
fn the_surface_of_a_homogeneous_column_is_exact_on_any_mesh() {
    let ([_, mu], nu) = (STEEL.lame(), STEEL.nu);
    for elements in [1, 3, 10] {
        let mesh = Mesh::graded(
            square(8, 1.0),
            vec![STEEL],
            1.0,
            [1.0 / f64::from(elements); 2],
            1.0,
        );
        let mesh = mesh.expect("a mesh");
        for exponent in -4..=3 {
            let k = 10f64.powi(exponent);
            let exact = [1.0 - nu, -(0.5 - nu), 1.0 - nu, 1.0].map(|c| c / (mu * k));
            for (found, exact) in surface_compliance(&mesh, k).iter().zip(exact) {
                let error = (found / exact - 1.0).abs();
                assert!(error < 1e-12, "k = {k}, {elements}: {error}");
            }
        }
    }
}

#[test]
fn work_of_tractions_and_of_eigenstrains_is_reciprocal() {
    let mut rng = fastrand::Rng::with_seed(7);
    for stack in 0..50 {
        let mut layers: Vec<Layer> = (0..rng.usize(0..3))
            .map(|_| Layer {
                E: 10f64.powf(10.0 + 2.0 * rng.f64()),
                nu: 0.48 * rng.f64(),
                thickness: 0.1 + rng.f64(),
            })
            .collect();
        layers.push(STEEL);
        let cells = if stack % 5 == 0 {
            line(17, 0.2)
        } else {
            Cells {
                ny: 4 + rng.usize(0..8),
                dy: 0.3,
                ..square(4 + rng.usize(0..9), 0.2)
            }
        };
        let mesh = Mesh::graded(cells, layers, 0.6 + rng.f64(), [0.3; 2], 2.0).expect("a mesh");
        let mut operator = Operator::new(mesh.clone());
        let n = cells.len();
        let mut random = |n: usize| -> Vec<f64> { (0..n).map(|_| rng.f64() - 0.5).collect() };
        let e = random(operator.len());
        let t = [random(n), random(n), random(n)];
        let tractions = Some([&t[0][..], &t[1], &t[2]]);
        let (_, u) = answer(
            &mut operator,
            Sources {
                eigenstrain: Some(&e),
                tractions: None,
            },
        );
        let (stress, _) = answer(
            &mut operator,
            Sources {
                eigenstrain: None,
                tractions,
            },
        );
        let area = cells.area();
        let on_surface: f64 = u
            .iter()
            .zip(t.iter().flatten())
            .map(|(u, t)| u * t * area)
            .sum();
        let (mut inside, mut size) = (0.0, 0.0);
        for plane in 0..mesh.planes() {
            let weight = mesh.weight(plane) * area;
            for component in 0..COMPONENTS {
                let twice = if component < 3 { 1.0 } else { 2.0 };
                for cell in 0..n {
                    let at = (plane * COMPONENTS + component) * n + cell;
                    let work = twice * weight * stress[at] * e[at];
                    inside += work;
                    size += work.abs();
                }
            }
        }
        let error = (on_surface - inside).abs() / size;
        assert!(
            error < 1e-10,
            "stack {stack}: {on_surface:e} for {inside:e}, {error:e}"
        );
    }
}

#[test]
fn stress_under_a_hertz_pressure() {
    for n in [32, 64] {
        let (a, p_0, nu) = (1.0_f64, 1e9, STEEL.nu);
        let d = 3.2 * a / n as f64;
        let mesh = Mesh::graded(square(n, d), vec![STEEL], 1.5 * a, [a / 16.0; 2], 1.5 * a)
            .expect("a mesh");
        let mut operator = Operator::new(mesh.clone());
        // Means over the cells: 8 x 8 points in each.
        let mut p = vec![0.0; n * n];
        for (at, p) in p.iter_mut().enumerate() {
            for (k, l) in (0..8).flat_map(|k| (0..8).map(move |l| (k, l))) {
                let x = centre(n, at / n, d) + (f64::from(k) - 3.5) / 8.0 * d;
                let y = centre(n, at % n, d) + (f64::from(l) - 3.5) / 8.0 * d;
                *p += p_0 * (1.0 - (x * x + y * y) / (a * a)).max(0.0).sqrt() / 64.0;
            }
        }
        let zero = vec![0.0; n * n];
        let tractions = Some([&zero[..], &zero, &p]);
        let (stress, _) = answer(
            &mut operator,
            Sources {
                eigenstrain: None,
                tractions,
            },
        );
        let mut worst = [0.0_f64; 2];
        let middle = n / 2;
        for plane in 0..mesh.planes() {
            let z = mesh.depth(plane);
            let at = |component: usize| {
                let of = |i: usize, j: usize| {
                    stress[(plane * COMPONENTS + component) * n * n + i * n + j]
                };
                0.25 * (of(middle, middle)
                    + of(middle - 1, middle)
                    + of(middle, middle - 1)
                    + of(middle - 1, middle - 1))
            };
            let zz = -p_0 / (1.0 + z * z);
            let rr = -p_0 * ((1.0 + nu) * (1.0 - z * (1.0 / z).atan()) - 0.5 / (1.0 + z * z));
            worst[0] = worst[0].max((at(2) - zz).abs() / p_0);
            worst[1] = worst[1].max((at(0) - rr).abs() / p_0);
        }
        assert!(worst.iter().all(|e| *e < 4e-3), "{n}: {worst:?}");
    }
}

/// A Gaussian of e_zz and e_xz around the depth c, on the cells of a mesh.
fn gaussian(mesh: &Mesh, c: f64) -> Vec<f64> {
    let Cells { nx, ny, dx, dy, .. } = mesh.cells;
    let s = c / 3.0;
    let mut e = vec![0.0; mesh.planes() * COMPONENTS * nx * ny];
    for plane in 0..mesh.planes() {
        let z = mesh.depth(plane) - c;
        for cell in 0..nx * ny {
            let (x, y) = (centre(nx, cell / ny, dx), centre(ny, cell % ny, dy));
            let value = 1e-3 * (-0.5 * (x * x + y * y + z * z) / (s * s)).exp();
            for component in [2, 4] {
                e[(plane * COMPONENTS + component) * nx * ny + cell] = value;
            }
        }
    }
    e
}

/// A component of the stress on two planes, continued to a depth.
fn continued(
    mesh: &Mesh,
    stress: &[f64],
    planes: [usize; 2],
    component: usize,
    z: f64,
) -> Vec<f64> {
    let cells = mesh.cells.len();
    let [near, far] = planes.map(|plane| mesh.depth(plane));
    let part = (z - near) / (far - near);
    let of = |plane: usize| &stress[(plane * COMPONENTS + component) * cells..][..cells];
    let pairs = of(planes[0]).iter().zip(of(planes[1]));
    pairs
        .map(|(near, far)| near + part * (far - near))
        .collect()
}

#[test]
fn tractions_of_the_surface_and_of_interfaces_fall_with_second_order() {
    let coating = Layer {
        E: 630e9,
        nu: 0.25,
        thickness: 1.0,
    };
    let off = [8, 16, 32].map(|elements: usize| {
        let h = 1.0 / elements as f64;
        let bottoms = (1..=2 * elements).map(|n| n as f64 * h).collect();
        let mesh = Mesh::new(square(24, 0.15), vec![coating, STEEL], bottoms).expect("a mesh");
        let e = gaussian(&mesh, 0.7);
        let mut operator = Operator::new(mesh.clone());
        let (stress, _) = answer(
            &mut operator,
            Sources {
                eigenstrain: Some(&e),
                tractions: None,
            },
        );
        let most = stress.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
        let (mut surface, mut jump) = (0.0_f64, 0.0_f64);
        for component in [2, 4, 5] {
            for s in continued(&mesh, &stress, [0, 1], component, 0.0) {
                surface = surface.max(s.abs() / most);
            }
            let last = 2 * elements - 1;
            let above = continued(&mesh, &stress, [last, last - 1], component, 1.0);
            let below = continued(&mesh, &stress, [last + 1, last + 2], component, 1.0);
            for (above, below) in above.iter().zip(&below) {
                jump = jump.max((above - below).abs() / most);
            }
        }
        [surface, jump]
    });
    for kind in 0..2 {
        let [coarse, middle, fine] = off.map(|of| of[kind]);
        assert!(fine < 3e-3, "{off:?}");
        assert!(coarse / middle > 3.2 && middle / fine > 3.4, "{off:?}");
    }
}

#[test]
fn a_wider_grid_gives_the_same_answer() {
    for plane_strain in [false, true] {
        let d = 0.15;
        let cells = |n: usize| {
            if plane_strain {
                line(n, d)
            } else {
                square(n, d)
            }
        };
        let coating = Layer {
            E: 90e9,
            nu: 0.35,
            thickness: 0.4,
        };
        let answers = [24, 48].map(|n| {
            let layers = vec![coating, STEEL];
            let mesh = Mesh::graded(cells(n), layers, 1.8, [0.15; 2], 1.8).expect("a mesh");
            let e = gaussian(&mesh, 0.6);
            let mut operator = Operator::new(mesh);
            let sources = Sources {
                eigenstrain: Some(&e),
                tractions: None,
            };
            answer(&mut operator, sources)
        });
        let rows = if plane_strain { 1 } else { 24 };
        let all = |n: usize| if plane_strain { n } else { n * n };
        let [narrow, wide] = &answers;
        for (narrow, wide) in [(&narrow.0, &wide.0), (&narrow.1, &wide.1)] {
            let most = narrow.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
            let fields = narrow.len() / all(24);
            let mut worst = 0.0_f64;
            for (field, i, j) in (0..fields)
                .flat_map(|f| (0..24).flat_map(move |i| (0..rows).map(move |j| (f, i, j))))
            {
                let (a, b) = if plane_strain {
                    (field * 24 + i, field * 48 + i + 12)
                } else {
                    (
                        field * 576 + i * 24 + j,
                        field * 2304 + (i + 12) * 48 + j + 12,
                    )
                };
                worst = worst.max((narrow[a] - wide[b]).abs() / most);
            }
            assert!(worst < 1e-3, "plane strain {plane_strain}: {worst:e}");
        }
    }
}

/// Fields of a body whose axes x and y are exchanged: components by `order`, cells transposed.
fn with_axes_exchanged(fields: &[f64], order: &[usize], cells: Cells) -> Vec<f64> {
    let (nx, ny, len) = (cells.nx, cells.ny, cells.len());
    let mut exchanged = vec![0.0; fields.len()];
    let blocks = fields.chunks_exact(order.len() * len);
    for (block, to) in blocks.zip(exchanged.chunks_exact_mut(order.len() * len)) {
        for (component, from) in order.iter().enumerate() {
            for (i, j) in (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j))) {
                to[component * len + j * nx + i] = block[from * len + i * ny + j];
            }
        }
    }
    exchanged
}

#[test]
fn exchanged_axes_give_exchanged_answers() {
    let mut rng = fastrand::Rng::with_seed(402);
    let stress_order = [1, 0, 2, 3, 5, 4];
    let vector_order = [1, 0, 2];
    for (nx, ny, dy) in [(8, 8, 0.2), (12, 7, 0.2), (9, 10, 0.3), (24, 24, 0.2)] {
        let cells = Cells {
            nx,
            ny,
            dy,
            ..square(nx, 0.2)
        };
        let exchanged = Cells {
            nx: ny,
            ny: nx,
            dx: cells.dy,
            dy: cells.dx,
            ..cells
        };
        let coating = Layer {
            E: 400e9,
            nu: 0.25,
            thickness: 0.3,
        };
        let answers = |cells: Cells, sources: Sources<'_>| {
            let layers = vec![coating, STEEL];
            let mesh = Mesh::graded(cells, layers, 0.9, [0.2; 2], 1.2).expect("a mesh");
            answer(&mut Operator::new(mesh), sources)
        };
        let mesh = Mesh::graded(cells, vec![coating, STEEL], 0.9, [0.2; 2], 1.2).expect("a mesh");
        let mut random = |n: usize| -> Vec<f64> { (0..n).map(|_| rng.f64() - 0.5).collect() };
        let e = random(mesh.planes() * COMPONENTS * cells.len());
        let t: Vec<f64> = random(3 * cells.len()).iter().map(|t| 1e10 * t).collect();
        let of_axes = |cells: Cells, e: &[f64], t: &[f64]| {
            let t: Vec<&[f64]> = t.chunks_exact(cells.len()).collect();
            let sources = Sources {
                eigenstrain: Some(e),
                tractions: Some([t[0], t[1], t[2]]),
            };
            answers(cells, sources)
        };
        let (stress, displacement) = of_axes(cells, &e, &t);
        let turned = of_axes(
            exchanged,
            &with_axes_exchanged(&e, &stress_order, cells),
            &with_axes_exchanged(&t, &vector_order, cells),
        );
        let wanted = [
            with_axes_exchanged(&stress, &stress_order, cells),
            with_axes_exchanged(&displacement, &vector_order, cells),
        ];
        for (found, wanted) in [turned.0, turned.1].iter().zip(&wanted) {
            let most = wanted.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
            let pairs = found.iter().zip(wanted);
            let off = pairs.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / most;
            assert!(off < 1e-9, "{nx} x {ny}: {off:e}");
        }
    }
}

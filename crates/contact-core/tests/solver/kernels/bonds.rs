//! Bonds that give way: limits, closed forms, the jump at every interface of random stacks; nu =
//! 1/2.

use crate::kernel_tables::{load, number, off, whole};
use crate::splitmix::Draw;
use contact_core::kernels::{
    Complex64, RadialResponse, Stack, influence_coefficients, stress_of_cell_at,
};
use contact_core::scene::{Body, Bond, Coating, Elastic, Grid, KernelSettings, Shape};
use serde_json::Value;

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };

fn body(layers: &[(Elastic, f64, Bond)], substrate: Elastic) -> Body {
    let mut body = Body::homogeneous(substrate, Shape::Flat);
    for (material, thickness, bond) in layers {
        body.coatings.push(Coating {
            material: *material,
            thickness: *thickness,
        });
        body.bonds.push(*bond);
    }
    body
}

fn four(r: RadialResponse) -> [f64; 4] {
    [r.zz, r.rr, r.tt, r.rz]
}

fn near(found: f64, truth: f64, share: f64) {
    assert!(
        (found / truth - 1.0).abs() < share,
        "{found:e} of {truth:e}"
    );
}

#[test]
fn a_perfect_bond_is_none() {
    let coating = (Elastic { E: 600e9, nu: 0.2 }, 3e-6, Bond::PERFECT);
    let bonded = body(&[coating], STEEL);
    let mut plain = bonded.clone();
    plain.bonds.clear();
    for k in [1e3, 1e5, 1e6, 1e7] {
        let (a, b) = (
            Stack::new(&bonded).response(k),
            Stack::new(&plain).response(k),
        );
        assert_eq!(four(a), four(b));
    }
    let grid = Grid::from_spacing((12, 8), (1e-6, 1e-6)).unwrap();
    let of = |b: &Body| influence_coefficients(b, &grid, &KernelSettings::default(), false, None);
    assert_eq!(of(&bonded).unwrap(), of(&plain).unwrap());
}

/// A layer on a smooth rigid base (K. L. Johnson, Contact Mechanics (1985), sec. 5.7) and a free
/// plate, half of it pressed from both sides, half bent.
#[test]
fn smooth_interfaces_and_free_plates() {
    let (material, h) = (Elastic { E: 90e9, nu: 0.35 }, 2e-6);
    let unit = (1.0 - material.nu) / material.G();
    let far = 1e12 * h / material.G();
    let smooth = Bond {
        normal: 0.0,
        shear: far,
    };
    let free = Bond {
        normal: far,
        shear: far,
    };
    for x in [0.3_f64, 1.0, 2.0, 5.0] {
        let k = x / h;
        let on_base = body(&[(material, h, smooth)], Elastic::RIGID);
        let pressed = |y: f64| ((2.0 * y).cosh() - 1.0) / ((2.0 * y).sinh() + 2.0 * y);
        let bent = |y: f64| ((2.0 * y).cosh() + 1.0) / ((2.0 * y).sinh() - 2.0 * y);
        near(Stack::new(&on_base).response(k).zz, unit * pressed(x), 1e-6);
        let plate = body(&[(material, h, free)], STEEL);
        let truth = unit * 0.5 * (pressed(x / 2.0) + bent(x / 2.0));
        near(Stack::new(&plate).response(k).zz, truth, 1e-6);
    }
}

/// A thin soft layer gives way as its bond does.
#[test]
fn a_thin_soft_layer_is_a_bond() {
    let hard = Elastic { E: 400e9, nu: 0.2 };
    let glue = Elastic { E: 2e9, nu: 0.4 };
    let (h, thin) = (3e-6, 1e-9);
    let as_bond = body(&[(hard, h, Bond::of_layer(glue, thin))], STEEL);
    let layers = [(hard, h, Bond::PERFECT), (glue, thin, Bond::PERFECT)];
    let as_layer = body(&layers, STEEL);
    for k in [1e4, 1e5, 5e5] {
        let (a, b) = (
            Stack::new(&as_bond).response(k),
            Stack::new(&as_layer).response(k),
        );
        for (a, b) in four(a).into_iter().zip(four(b)) {
            assert!((a - b).abs() < 2e-3 * four(Stack::new(&as_layer).response(k))[0]);
        }
    }
}

/// Within a layer all fields are elastic by construction; what fixes them is the traction on the
/// surface and, at each interface, equal tractions and a jump of displacement that the bond allows.
#[test]
fn random_stacks_hold_together_as_their_bonds_say() {
    let mut random = Draw(48);
    for _ in 0..40 {
        let mut material = || Elastic {
            E: 10_f64.powf(9.0 + 3.0 * random.next()),
            nu: 0.5 * random.next(),
        };
        let (a, b, c) = (material(), material(), material());
        let mut bond = || Bond {
            normal: 10_f64.powf(-19.0 + 4.0 * random.next()),
            shear: 10_f64.powf(-19.0 + 4.0 * random.next()),
        };
        let (first, second) = (bond(), bond());
        let stack = Stack::new(&body(&[(a, 1e-6, first), (b, 3e-6, second)], c));
        for k in [1e4, 1e5, 1e6] {
            let (k_x, k_y) = (0.6 * k, 0.8 * k);
            let surface = stack.frf(k_x, k_y, 0.0, None).unwrap();
            for (column, row, sign) in [(0, 4, -1.0), (1, 5, -1.0), (2, 2, -1.0)] {
                assert!((surface.s[row][column] - Complex64::new(sign, 0.0)).norm() < 1e-12);
            }
            for (z, layer, bond) in [(1e-6, 0, first), (4e-6, 1, second)] {
                let above = stack.frf(k_x, k_y, z, Some(layer)).unwrap();
                let below = stack.frf(k_x, k_y, z, Some(layer + 1)).unwrap();
                for column in 0..3 {
                    for (row, traction, compliance) in
                        [(0, 4, bond.shear), (1, 5, bond.shear), (2, 2, bond.normal)]
                    {
                        let t = above.s[traction][column];
                        assert!((t - below.s[traction][column]).norm() < 1e-10);
                        let jump = above.u[row][column] - below.u[row][column];
                        let scale = above.u[row][column].norm().max(below.u[row][column].norm());
                        let off = (jump + t * compliance).norm();
                        assert!(off < 1e-9 * scale.max(1e-20), "{off:e} of {scale:e}");
                    }
                }
            }
            // Reciprocity of the surface.
            let u = stack.surface_frf(k_x, k_y).unwrap();
            for i in 0..3 {
                for j in 0..3 {
                    let other = u[j][i].conj();
                    assert!((u[i][j] - other).norm() < 1e-12 * u[2][2].norm().max(u[i][j].norm()));
                }
            }
        }
    }
}

/// Forty random stacks of one to four layers, some incompressible, some interfaces perfect, against
/// one linear system for all constants solved in 60 digits: on the surface and on both sides of an
/// interface.
#[test]
fn random_stacks_against_a_direct_solution_in_many_digits() {
    let entries = load("kernel_bonds.json");
    let mut stacks: Vec<i64> = entries.iter().map(|e| whole(e, "id")).collect();
    stacks.dedup();
    assert_eq!((stacks.len(), entries.len()), (40, 120));
    let mut worst: f64 = 0.0;
    for entry in &entries {
        let mut body = crate::kernel_tables::body(entry);
        let bond = |v: &Value| Bond {
            normal: number(v, "normal"),
            shear: number(v, "shear"),
        };
        body.bonds = entry["bonds"]
            .as_array()
            .unwrap()
            .iter()
            .map(bond)
            .collect();
        let stack = Stack::new(&body);
        let (m, n) = (number(entry, "m"), number(entry, "n"));
        let (z, layer) = (number(entry, "x3"), whole(entry, "layer_index") as usize);
        let ours = stack.frf(m, n, z, Some(layer)).unwrap();
        worst = worst.max(off(&ours.u, entry, "u"));
        if z > 0.0 {
            worst = worst.max(off(&ours.s, entry, "s"));
        } else {
            worst = worst.max(off(&stack.surface_frf(m, n).unwrap(), entry, "u"));
        }
    }
    println!("largest difference {worst:.1e} of the largest entry of its kind");
    assert!(worst < 1e-11, "{worst:e}");
}

#[test]
fn incompressible_materials_are_the_limit_of_nearly_incompressible_ones() {
    let of = |nu: f64, below: Elastic| {
        let rubber = Elastic { E: 5e6, nu };
        body(&[(rubber, 5e-6, Bond::PERFECT)], below)
    };
    for k in [1e3, 1e5, 1e6] {
        for below in [STEEL, Elastic { E: 2e6, nu: 0.5 }] {
            let exact = four(Stack::new(&of(0.5, below)).response(k));
            let limit = four(Stack::new(&of(0.5 - 1e-9, below)).response(k));
            for (a, b) in exact.into_iter().zip(limit) {
                let thin = 1.0 / (k * 5e-6_f64).powi(2);
                assert!((a - b).abs() < 1e-7 * thin.max(1.0) * exact[0], "{a} {b}");
            }
        }
    }
    let at = |nu| stress_of_cell_at(&of(nu, STEEL), (1e-6, 1e-6), (2e-6, 0.0, 3e-6), None).unwrap();
    let (exact, limit) = (at(0.5), at(0.5 - 1e-8));
    for (a, b) in exact.iter().flatten().zip(limit.iter().flatten()) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
}

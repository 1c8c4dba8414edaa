//! Contacts of few cells: refused, or warned of, with the cells that it takes.

use contact_core::march::{March, Reached};
use contact_core::scene::{Body, LoadPath, Rough, Shape};

use super::{STEEL, W, run, sphere};

/// `cells` across the Hertz radius.
fn of_cells(cells: f64) -> contact_core::Scene {
    let n = 32;
    sphere(
        (STEEL, STEEL),
        (n as f64 / cells, n),
        LoadPath::start().normal(W, 1),
    )
    .0
}

#[test]
fn a_contact_of_less_than_two_cells_is_refused_before_it_is_solved_and_after() {
    for cells in [1e-3, 0.3, 0.6, 1.0, 1.5] {
        let scene = of_cells(cells);
        let before = scene.check_fit().expect_err("refused").to_string();
        assert!(before.contains("cells across its radius"), "{before}");
        if cells <= 1.0 {
            let after = contact_core::march::solve(&scene, &mut ())
                .expect_err("refused")
                .to_string();
            assert!(after.contains("cells across its radius"), "{after}");
        }
        let n: f64 = 32.0 * 2.0 / cells - 1e-6;
        let asked = format!("must be [{}, {}] or more", n.ceil(), n.ceil());
        assert!(before.contains(&asked), "{before}");
        assert_eq!(before.contains("lengths are in m"), cells < 0.1, "{before}");
    }
    assert!(of_cells(2.2).check_fit().is_ok());
}

#[test]
fn a_contact_of_less_than_eight_cells_is_doubted() {
    for (cells, doubted) in [(3.0, true), (7.0, true), (9.0, false)] {
        let scene = of_cells(cells);
        let reached = Reached::from_increments(&run(&scene));
        assert!(
            (reached.cells_per_radius - cells).abs() < 0.1 * cells + 0.2,
            "{cells}: {reached:?}"
        );
        let says = |doubts: &[String]| doubts.iter().any(|d| d.contains("cells across its radius"));
        assert_eq!(
            says(&scene.doubts()),
            doubted,
            "{cells}: {:?}",
            scene.doubts()
        );
        assert_eq!(says(&reached.doubts(&scene)), doubted, "{cells}");
    }
}

/// What grows, slides or leaves is judged where it is largest; an ellipse by its smaller axis, a
/// strip by half of its width, asperities by theirs.
#[test]
fn what_is_smallest_where_the_contact_is_largest_counts() {
    let mut growing = of_cells(8.5);
    growing.path = LoadPath::start().normal(W, 40).normal(1e-4 * W, 2);
    let increments = run(&growing);
    assert!(increments[0].cells_per_radius < 4.0);
    assert!(
        Reached::from_increments(&increments)
            .doubts(&growing)
            .is_empty()
    );

    let mut ellipse = of_cells(3.0);
    ellipse.body1.shape = Shape::Ellipsoid {
        R_x: 0.01,
        R_y: 0.0005,
        angle: 0.4,
    };
    // Semi-axes of (R_x R_y)^(1/2) about, one 7 times the other.
    let mut march = March::new(&ellipse).expect("a scene");
    let increment = march.advance().expect("an increment").expect("solved");
    assert!(increment.cells_per_radius < 2.0, "{increment:?}");
    let refused = ellipse.check_fit().expect_err("refused").to_string();
    assert!(refused.contains("cells across its radius"), "{refused}");

    let mut rough = of_cells(9.0);
    rough.body2 = Body::homogeneous(
        STEEL,
        Shape::Rough(Rough {
            rms: 2e-6,
            hurst: 0.8,
            longest: 16.0 * rough.grid.dx,
            shortest: 4.0 * rough.grid.dx,
            seed: 1,
        }),
    );
    let increments = run(&rough);
    let increment = increments[0];
    assert!(increment.cells_per_radius < 4.0, "{increment:?}");
    assert!(increment.contact_area > 0.0);
    // Spots are no fault of the grid: they are doubted by their name, with the numbers they touch.
    rough.grid.dx *= 4.0;
    rough.grid.dy *= 4.0;
    for body in [&mut rough.body2] {
        if let Shape::Rough(rough) = &mut body.shape {
            (rough.longest, rough.shortest) = (4.0 * rough.longest, 4.0 * rough.shortest);
        }
    }
    let increments = run(&rough);
    assert!(increments[0].cells_per_radius < 2.0, "{:?}", increments[0]);
    let doubts = Reached::from_increments(&increments).doubts(&rough);
    let doubt = doubts
        .iter()
        .find(|doubt| doubt.contains("across their radius"));
    let doubt = doubt.expect("a doubt of the asperities");
    assert!(
        doubt.contains("asperities") && doubt.contains("real area"),
        "{doubt}"
    );
}

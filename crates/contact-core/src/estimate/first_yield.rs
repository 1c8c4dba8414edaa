//! The load at which yielding begins.

use crate::error::Error;
use crate::march::March;
use crate::scene::{
    Branch, FirstYield, Friction, Grid, LoadPath, Loads, PathGrid, SaveFields, Scene,
};
use crate::yielding::Yielding;

/// Most cells along a side of the trials.
const CELLS: usize = 32;
/// Most trials, and the error of the stress at which they end.
const TRIALS: usize = 5;
const SETTLED: f64 = 5e-3;

/// The normal load without friction at which a body of a scene begins to yield, found by elastic contacts;
/// `None` where no body may yield or nothing is pressed.
///
/// # Errors
/// A scene without meaning, or a contact that does not converge.
pub fn first_yield(scene: &Scene) -> Result<Option<FirstYield>, Error> {
    let hertz = scene.hertz();
    let largest = hertz.map_or(scene.path.W_max(), |hertz| hertz.W);
    if !scene.yields() || !(largest > 0.0) {
        return Ok(None);
    }
    // Of Hertz contacts: size and pressure over the load, as powers.
    let (size, pressure) = match (hertz, scene.grid.plane_strain) {
        (Some(_), true) => (0.5, 0.5),
        (Some(_), false) => (1.0 / 3.0, 1.0 / 3.0),
        (None, _) => (0.0, 1.0),
    };
    let mut W = largest;
    let mut first_yield = None;
    for _ in 0..TRIALS {
        let trial = trial(scene, W, (W / largest).powf(size));
        let Some((ratio, place)) = worst(&trial)? else {
            return Ok(None);
        };
        let begins = W * ratio.powf(-1.0 / pressure);
        first_yield = Some(FirstYield { W: begins, ..place });
        if (ratio - 1.0).abs() < SETTLED {
            break;
        }
        W = begins;
    }
    Ok(first_yield)
}

/// The scene without friction under the normal load `W` \[N\] alone, on a grid of `size` times its extent and at
/// most [`CELLS`] cells along a side.
fn trial(scene: &Scene, W: f64, size: f64) -> Scene {
    let grid = scene.grid;
    let cells = |n: usize| if n > CELLS { CELLS } else { n };
    let (nx, ny) = (cells(grid.nx), cells(grid.ny));
    let (length, width) = grid.extent();
    let along_y = if grid.plane_strain { 1.0 } else { size };
    let to = Loads {
        W,
        ..Loads::default()
    };
    let mut trial = Scene {
        friction: Friction::coulomb(0.0),
        grid: Grid {
            nx,
            ny,
            dx: size * length / nx as f64,
            dy: along_y * width / ny as f64,
            ..grid
        },
        path: LoadPath {
            branches: vec![Branch::new(to, 1, 1.0)],
            ..LoadPath::default()
        },
        ..scene.clone()
    };
    trial.settings.solver.path_grid = PathGrid::Same;
    trial.settings.save = SaveFields::All;
    trial
}

/// Largest stress of von Mises over the yield stress of its layer in the contact of a trial, and where it is;
/// none where nothing can yield.
fn worst(trial: &Scene) -> Result<Option<(f64, FirstYield)>, Error> {
    let mut march = March::new(&trial.elastic())?;
    let Some(increment) = march.advance() else {
        return Ok(None);
    };
    increment?;
    let [p, q_x, q_y] = march.tractions();
    let Some(mut yielding) = Yielding::from_scene(trial, false)? else {
        return Ok(None);
    };
    let point = yielding.nearest_to_yield([&p, &q_x, &q_y]);
    Ok(point.map(|(ratio, body, layer, depth)| {
        let W = 0.0;
        (
            ratio,
            FirstYield {
                W,
                body,
                layer,
                depth,
            },
        )
    }))
}

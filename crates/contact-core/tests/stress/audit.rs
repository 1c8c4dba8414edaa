//! What physics asks of every increment, computed from the fields alone.

use contact_core::convolution::{DcFft, Displacements, SurfaceOperator, Tractions};
use contact_core::kernels::pair_coefficients;
use contact_core::march::{Fields, Increment, March, Motion, Status};
use contact_core::plan::Mirror;
use contact_core::scene::Loads;
use ndarray::Array2;

use crate::misfit::Misfit;

/// How far the equations are off, each over what the tolerance allows: above 1 is a violation.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Violations {
    pub(crate) nan: f64,
    pub(crate) response: f64,
    pub(crate) balance: f64,
    pub(crate) contact: f64,
    pub(crate) coulomb: f64,
    pub(crate) slip: f64,
    pub(crate) dissipation: f64,
    pub(crate) energy: f64,
    pub(crate) monotone: f64,
    pub(crate) report: f64,
}

impl Violations {
    pub(crate) const NAMES: [&str; 10] = [
        "finite numbers",
        "displacements of the tractions",
        "force balance",
        "complementarity",
        "Coulomb's law",
        "stick and slip",
        "energy that friction takes",
        "energy identity",
        "monotone contact",
        "residuals as reported",
    ];

    pub(crate) fn values(&self) -> [f64; 10] {
        [
            self.nan,
            self.response,
            self.balance,
            self.contact,
            self.coulomb,
            self.slip,
            self.dissipation,
            self.energy,
            self.monotone,
            self.report,
        ]
    }

    pub(crate) fn worse(&mut self, other: &Self) {
        self.nan = self.nan.max(other.nan);
        self.response = self.response.max(other.response);
        self.balance = self.balance.max(other.balance);
        self.contact = self.contact.max(other.contact);
        self.coulomb = self.coulomb.max(other.coulomb);
        self.slip = self.slip.max(other.slip);
        self.dissipation = self.dissipation.max(other.dissipation);
        self.energy = self.energy.max(other.energy);
        self.monotone = self.monotone.max(other.monotone);
        self.report = self.report.max(other.report);
    }
}

/// What sums of up to 2^16 cells lose to rounding, 2^16 eps = 1.5e-11, and a margin: force balance
/// and Coulomb's law hold by construction.
const ROUNDING: f64 = 1e-9;

/// Follows a run.
pub(crate) struct Audit {
    h_init: Array2<f64>,
    misfit: Misfit,
    /// The bodies' response on the whole grid, in double precision.
    op: DcFft,
    /// Nothing before the first increment, when all is zero but the gap.
    last: Option<(Fields, Motion, Loads)>,
    /// What the slip of that increment missed \[m\].
    missed: [Array2<f64>; 2],
    work: f64,
}

impl Audit {
    pub(crate) fn new(march: &March) -> Self {
        let (scene, plan) = (march.scene(), march.plan());
        let pair = pair_coefficients(
            (&scene.body1, &scene.body2),
            &scene.grid,
            &scene.settings.kernel,
            scene.settings.skip.equal_layers,
            plan.kernels(),
            None,
        );
        Self {
            op: DcFft::new(&pair.unwrap(), Mirror::None, plan.coupling),
            h_init: scene.h_init(),
            misfit: Misfit::of(scene),
            last: None,
            missed: [(); 2].map(|()| Array2::zeros((scene.grid.nx, scene.grid.ny))),
            work: 0.0,
        }
    }

    pub(crate) fn check(&mut self, march: &March, increment: &Increment) -> Violations {
        let now = march.fields();
        let mut found = Violations::default();
        let real = [
            &now.p,
            &now.q_x,
            &now.q_y,
            &now.u_x,
            &now.u_y,
            &now.u_z,
            &now.slip_x,
            &now.slip_y,
        ];
        let numbers = [
            increment.motion.delta_x,
            increment.motion.delta_y,
            increment.motion.delta_z,
            increment.energy.imbalance(),
        ];
        let finite = real.iter().all(|f| f.iter().all(|v| v.is_finite()))
            && numbers.iter().all(|v| v.is_finite());
        if !finite {
            found.nan = f64::INFINITY;
            return found;
        }
        found.response = self.response(march, &now);
        found.balance = balance(march, &now, increment) / ROUNDING;
        self.contact(&now, increment, &mut found);
        self.friction(march, &now, increment, &mut found);
        self.dissipation(march, &now, increment, &mut found);
        self.energy(march, &now, increment, &mut found);
        self.monotone(march, &now, increment, &mut found);
        self.last = Some((now, increment.motion, increment.point.loads));
        self.missed = march.missed();
        found
    }

    /// The displacements are those of the tractions less the shear that is owed, everywhere; and what is
    /// owed moves the contact by no more than the tolerance of the slip, root mean square.
    fn response(&mut self, march: &March, now: &Fields) -> f64 {
        let owed = march.owed();
        let answered = [&now.q_x - &owed[0], &now.q_y - &owed[1]];
        let friction = march.plan().friction;
        let u = self.answer(&answered, friction, Some(&now.p));
        let off = |of: &Array2<f64>, u: &[f64]| {
            let off = of.iter().zip(u).map(|(of, u)| (of - u).abs());
            off.fold(0.0, f64::max)
        };
        let across = off(&now.u_z, &u[2]) / self.misfit.gap;
        if !friction {
            return across;
        }
        let along = off(&now.u_x, &u[0]).max(off(&now.u_y, &u[1]));
        let [x, y, _] = self.answer(&owed, friction, None);
        let moved = now.contact.iter().zip(x.iter().zip(&y));
        let squares: f64 = moved
            .filter(|(touches, _)| **touches)
            .map(|(_, (x, y))| x * x + y * y)
            .sum();
        let moved = squares.sqrt() / Misfit::root_of_cells(now);
        across.max(along.max(moved) / self.misfit.slip)
    }

    /// u_x, u_y, u_z under tractions \[m\].
    fn answer(
        &mut self,
        q: &[Array2<f64>; 2],
        friction: bool,
        p: Option<&Array2<f64>>,
    ) -> [Vec<f64>; 3] {
        let mut u = [(); 3].map(|()| vec![0.0; q[0].len()]);
        let [u_x, u_y, u_z] = &mut u;
        self.op.respond(
            Tractions {
                q_x: q[0].as_slice().filter(|_| friction),
                q_y: q[1].as_slice().filter(|_| friction),
                p: p.and_then(|p| p.as_slice()),
            },
            Displacements {
                u_x: friction.then_some(&mut u_x[..]),
                u_y: friction.then_some(&mut u_y[..]),
                u_z: Some(&mut u_z[..]),
            },
        );
        u
    }

    /// p >= 0, no gap under pressure, no overlap without, as the tolerance says: the first in the
    /// root mean square, the second everywhere. The increment has to report the same.
    fn contact(&self, now: &Fields, increment: &Increment, found: &mut Violations) {
        if now.p.iter().any(|&p| p < 0.0) {
            found.contact = f64::INFINITY;
        }
        if increment.status == Status::NoContact {
            return;
        }
        let gap = &now.u_z + &self.h_init - increment.motion.delta_z;
        let (mut squares, mut cells, mut overlap) = (0.0, 0.0_f64, 0.0_f64);
        for (&p, &gap) in now.p.iter().zip(&gap) {
            if p > 0.0 {
                squares += gap * gap;
                cells += 1.0;
            } else {
                overlap = overlap.max(-gap);
            }
        }
        let gap = (squares / cells.max(1.0)).sqrt();
        found.contact = found.contact.max(gap.max(overlap) / self.misfit.gap);
        let said = &increment.residuals;
        // Of an increment in pieces the worst of them is reported.
        if increment.work.parts == 1 {
            let off = |said: f64, found: f64| (said * self.misfit.yardstick - found).abs();
            let off = off(said.gap, gap).max(off(said.penetration, overlap));
            // The sums run in another order here; u_z may cancel against h_init to a millionth.
            found.report = off / (1e-3 * self.misfit.gap);
        }
    }

    /// |q| <= mu p everywhere, and equal where a cell slips; no slip in stick cells, and slip against
    /// q in the others, in the root mean square over the contact, what the last increment missed made
    /// good. The increment has to report the same, and to say where it missed it.
    fn friction(&self, march: &March, now: &Fields, increment: &Increment, found: &mut Violations) {
        let mu = march.scene().friction.mu;
        let (turned, missed) = (march.turned(), march.missed());
        let p_max = increment.p_max;
        let (mut squares, mut cells) = (0.0, 0.0_f64);
        // Cells that slip, the squares of their slip and of its part that does not oppose q.
        let (mut slipping, mut slipped, mut astray) = (0.0, 0.0, 0.0);
        let (mut most, mut entered, mut untold) = (0.0_f64, false, 0.0_f64);
        let at_rest = |n: usize| now.stick.as_slice().is_some_and(|stick| stick[n]);
        for n in 0..now.p.len() {
            let at = |f: &Array2<f64>| f.as_slice().map_or(f64::NAN, |f| f[n]);
            let bound = mu * at(&now.p);
            let q = [at(&now.q_x), at(&now.q_y)];
            let size = q[0].hypot(q[1]);
            let beyond = (size - bound) / (mu * p_max).max(f64::MIN_POSITIVE);
            most = most.max(beyond);
            let sticks = at_rest(n);
            if size > bound || !sticks {
                found.coulomb = found.coulomb.max(beyond.abs() / ROUNDING);
            }
            let Some((last, motion, _)) = &self.last else {
                continue;
            };
            let misses = missed.each_ref().map(at);
            if bound <= 0.0 {
                untold = untold.max(misses[0].hypot(misses[1]));
                continue;
            }
            // What a cell moved before it entered the contact is no slip.
            let enters = at(&last.p) <= 0.0;
            entered |= enters;
            let ds = if enters {
                [
                    at(&now.slip_x) - at(&last.slip_x),
                    at(&now.slip_y) - at(&last.slip_y),
                ]
            } else {
                [
                    at(&now.u_x) - at(&last.u_x) - (increment.motion.delta_x - motion.delta_x),
                    at(&now.u_y) - at(&last.u_y) - (increment.motion.delta_y - motion.delta_y),
                ]
            };
            let ds = [0, 1].map(|c| ds[c] + at(&self.missed[c]) - at(&turned[c]));
            let off = if enters && sticks {
                // The fields do not tell how far a cell moved before it entered.
                misses[0].hypot(misses[1])
            } else if sticks {
                ds[0].hypot(ds[1])
            } else {
                let along = (ds[0] * q[0] + ds[1] * q[1]) / size;
                let across = (ds[0] * q[1] - ds[1] * q[0]) / size;
                let off = along.max(0.0).hypot(across);
                slipping += 1.0;
                slipped += ds[0] * ds[0] + ds[1] * ds[1];
                astray += off * off;
                off
            };
            if !enters {
                untold = untold.max((off - misses[0].hypot(misses[1])).abs());
            }
            squares += off * off;
            cells += 1.0;
        }
        // In pieces, each has slips of its own; a body that slides has any shift beyond the
        // incipient one, and its slip the direction of the force only in the end.
        if increment.status == Status::GrossSlip || increment.work.parts > 1 {
            return;
        }
        if mu == 0.0 || cells == 0.0 {
            return;
        }
        let slip = (squares / cells).sqrt();
        found.slip = slip / self.misfit.slip;
        let said = &increment.residuals;
        let stick = said.stick.powi(2) * (cells - slipping);
        let direction = said.direction.powi(2) * slipping;
        let said_slip = mu * self.misfit.yardstick * ((stick + direction) / cells).sqrt();
        // The differences of displacements may cancel to a thousandth of the tolerance.
        let known = 1e-3 * self.misfit.slip;
        found.report = (found.report)
            .max((said.coulomb - most).abs() / ROUNDING)
            .max(said.balance / ROUNDING);
        found.report = found.report.max(untold / known);
        if entered {
            return;
        }
        found.report = found.report.max((said_slip - slip).abs() / known);
        if slipped > 0.0 {
            let off = (said.angle.sin() - (astray / slipped).sqrt().min(1.0)).abs();
            found.report = found.report.max(off / (known * (cells / slipped).sqrt()));
        }
    }

    /// Friction takes the mean bound of the increment times the slip against the shear from a cell that
    /// slips; from one that leaves the contact the slip against half of the shear that it had, if that
    /// is so directed; nothing from the others: by the tractions, displacements and shifts alone. All
    /// of it is what the increment reports.
    fn dissipation(
        &self,
        march: &March,
        now: &Fields,
        increment: &Increment,
        found: &mut Violations,
    ) {
        let scene = march.scene();
        let (mu, turned) = (scene.friction.mu, march.turned());
        let last = self.last.as_ref();
        let before = |field: fn(&Fields) -> &Array2<f64>, n| last.map_or(0.0, |l| field(&l.0)[n]);
        let shift = last.map_or(Motion::default(), |l| l.1);
        let shift = [
            increment.motion.delta_x - shift.delta_x,
            increment.motion.delta_y - shift.delta_y,
        ];
        let (mut all, mut size, mut so_far) = (0.0, 0.0, 0.0);
        for (n, &p) in now.p.indexed_iter() {
            let gained = now.dissipated[n] - before(|f| &f.dissipated, n);
            all += gained;
            size += gained.abs();
            so_far += now.dissipated[n].abs();
            // In pieces, each has slips of its own.
            if increment.work.parts > 1 {
                continue;
            }
            let p_before = before(|f| &f.p, n);
            let slip = if p_before <= 0.0 {
                // What a cell moved before it entered the contact is no slip.
                [
                    now.slip_x[n] - before(|f| &f.slip_x, n),
                    now.slip_y[n] - before(|f| &f.slip_y, n),
                ]
            } else {
                let turned = [0, 1].map(|c| if p > 0.0 { turned[c][n] } else { 0.0 });
                [
                    now.u_x[n] - before(|f| &f.u_x, n) - shift[0] - turned[0],
                    now.u_y[n] - before(|f| &f.u_y, n) - shift[1] - turned[1],
                ]
            };
            let against = |q: [f64; 2]| -(slip[0] * q[0] + slip[1] * q[1]);
            let q = [now.q_x[n], now.q_y[n]];
            let mean = 0.5 * mu * (p + p_before);
            let taken = if mu * p <= 0.0 {
                0.5 * against([before(|f| &f.q_x, n), before(|f| &f.q_y, n)]).max(0.0)
            } else if now.stick[n] {
                0.0
            } else {
                mean * against(q) / q[0].hypot(q[1])
            };
            // The differences of displacements may cancel to a thousandth of the tolerance, and the shear
            // is at its bound up to rounding.
            let slipped = ROUNDING * slip[0].hypot(slip[1]);
            let known =
                (1e-3 * self.misfit.slip + slipped) * mean + 1e-12 * now.dissipated[n].abs();
            let off = (gained - taken).abs();
            if off > 0.0 {
                found.dissipation = found.dissipation.max(off / known);
            }
        }
        let off = (all * scene.grid.cell_area() - increment.energy.dissipated).abs();
        if off > 0.0 {
            let known = (ROUNDING * size + 1e-12 * so_far) * scene.grid.cell_area();
            found.dissipation = found.dissipation.max(off / known);
        }
    }

    /// Work of the loads = energy stored + work of shear on slip + work of pressure on gaps, with
    /// the mean tractions of the increment, and as the increment reports them.
    fn energy(
        &mut self,
        march: &March,
        now: &Fields,
        increment: &Increment,
        found: &mut Violations,
    ) {
        let scene = march.scene();
        let area = scene.grid.cell_area();
        let none = (Motion::default(), Loads::default());
        let (motion, from) = self.last.as_ref().map_or(none, |(_, m, l)| (*m, *l));
        let (ended, to) = (increment.motion, increment.point.loads);
        let d = [
            ended.delta_x - motion.delta_x,
            ended.delta_y - motion.delta_y,
            ended.delta_z - motion.delta_z,
        ];
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let of_loads = mean(from.T_x, to.T_x) * d[0]
            + mean(from.T_y, to.T_y) * d[1]
            + mean(from.W, to.W) * d[2];
        self.work += of_loads.abs();
        let last = self.last.as_ref().map(|(fields, ..)| fields);
        let before = |field: fn(&Fields) -> &Array2<f64>, n| last.map_or(0.0, |f| field(f)[n]);
        let cells = now.contact.iter().filter(|c| **c).count() as f64;
        let along = self.misfit.slip * cells.sqrt();
        let open = self.misfit.gap * cells.sqrt();
        let (mut stored, mut on_surface) = (0.0, 0.0);
        let (mut pressed, mut sheared) = ([0.0; 2], [0.0; 2]);
        for (n, &p) in now.p.indexed_iter() {
            let tractions = [
                (p, before(|f| &f.p, n)),
                (now.q_x[n], before(|f| &f.q_x, n)),
                (now.q_y[n], before(|f| &f.q_y, n)),
            ];
            let displacements = [
                (now.u_z[n], before(|f| &f.u_z, n), d[2]),
                (now.u_x[n], before(|f| &f.u_x, n), d[0]),
                (now.u_y[n], before(|f| &f.u_y, n), d[1]),
            ];
            for ((t, t_0), (u, u_0, d)) in tractions.into_iter().zip(displacements) {
                stored += 0.5 * (t * u - t_0 * u_0);
                on_surface -= mean(t, t_0) * (u - u_0 - d);
            }
            for k in 0..2 {
                let [p, q_x, q_y] = tractions.map(|t| [t.0, t.1][k]);
                pressed[k] += p * p;
                sheared[k] += q_x * q_x + q_y * q_y;
            }
        }
        // In pieces, each has mean tractions of its own.
        if increment.work.parts > 1 || self.work == 0.0 {
            return;
        }
        let (stored, on_surface) = (stored * area, on_surface * area);
        let e = increment.energy;
        // A gap or a slip within the tolerance, times the traction there (Cauchy and Schwarz), at
        // the beginning and at the end.
        let mean_of = |squares: [f64; 2]| mean(squares[0].sqrt(), squares[1].sqrt());
        let allowed = area * (open * mean_of(pressed) + along * mean_of(sheared));
        let rounding = ROUNDING * self.work;
        for (missing, allowed) in [
            (of_loads - stored - on_surface, allowed + rounding),
            (e.work - of_loads, rounding),
            (
                e.dissipated - e.quadrature + e.opening - on_surface,
                allowed + rounding,
            ),
            (e.imbalance(), allowed + rounding),
        ] {
            found.energy = found.energy.max(missing.abs() / allowed);
        }
    }

    /// More force, more contact: where shear does not act on the pressure. A cell may leave whose
    /// pressure is within what the tolerance allows.
    fn monotone(&self, march: &March, now: &Fields, increment: &Increment, found: &mut Violations) {
        let Some((last, _, loads)) = &self.last else {
            return;
        };
        if march.plan().coupling || increment.point.loads.W < loads.W {
            return;
        }
        let lost = last.p.iter().zip(&now.p).filter(|(_, now)| **now == 0.0);
        let lost = lost.fold(0.0_f64, |most, (before, _)| most.max(*before));
        found.monotone = lost / self.misfit.pressure(now);
    }
}

fn balance(march: &March, now: &Fields, increment: &Increment) -> f64 {
    let scene = march.scene();
    let Loads { W, T_x, T_y, .. } = increment.point.loads;
    let force = |f: &Array2<f64>| f.sum() * scene.grid.cell_area();
    let scale = if W > 0.0 { W } else { scene.path.W_max() };
    let friction = (scene.friction.mu * scale).max(f64::MIN_POSITIVE);
    let normal = (force(&now.p) - W).abs() / scale;
    if scene.friction.mu == 0.0 {
        return normal;
    }
    let shear = (force(&now.q_x) - T_x)
        .abs()
        .max((force(&now.q_y) - T_y).abs());
    normal.max(shear / friction)
}

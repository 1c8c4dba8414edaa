//! The wear settings of a user: laws, cycles, jumps, events.

use contact_core::Error;
use contact_core::scene::{Body, Dependence, Scene};

use super::air::{Air, check_positive};
use super::debris_bed::DebrisBed;
use super::law::BodyWear;
use super::stroke::stroke;

/// Most cycles of a run.
const MOST_CYCLES: f64 = 1e15;

/// Method to solve the contact of a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Cycling {
    /// Sliding for gross slip by given shifts that are large against the spots of the contact, else the march
    /// (default).
    #[default]
    Auto,
    /// Increment by increment through the load path, with stick, partial slip and gross slip
    /// ([`March`](contact_core::march::March)). The surfaces lie still: for slips that are small against the
    /// contact.
    March,
    /// Gross slip along x under given shifts: every cell slips by the motion of the bodies, |q| =
    /// mu p, and the pressure is solved at every place of the stroke, with the worn surfaces in
    /// their shifted positions.
    Sliding,
}

/// Lengths of the jumps over cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Jumps {
    /// Implicit, of second order. The error of a jump stays below this part of the worn depth, and
    /// the error of the pressure below twenty times that part (root mean squares).
    Tolerance(f64),
    /// Implicit, that many of equal length, and more where a table of cycles bends or one does not
    /// converge; of second order.
    Number(usize),
    /// Explicit, that many of equal length, with the pressure at the start of each: of first order,
    /// and unstable where they are long. The usual method, for comparison.
    Explicit(usize),
}

impl Default for Jumps {
    /// Chosen jumps, with the default tolerance.
    fn default() -> Self {
        Self::Tolerance(0.01)
    }
}

/// Action when a coating is worn through somewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WornThrough {
    /// The run ends there (default).
    #[default]
    Stop,
    /// The run continues; where the next layer is bare, it wears by the law of that layer. The
    /// elastic response of the full coating is kept.
    GoOn,
}

/// Laws of wear, number of cycles, and method.
#[derive(Clone, Debug)]
pub struct Wear {
    /// Wear of body 1 and body 2.
    pub bodies: [BodyWear; 2],
    /// Cycles, > 0.
    pub cycles: f64,
    /// The first branch of the load path that belongs to the cycle, from 0 (default `None`: the
    /// start of its last closed cycle). The branches before it are run through once. The rest is
    /// the cycle and ends where it begins.
    pub first_branch: Option<usize>,
    /// How often a cycle passes each of its branches (default: each once, an empty list). A block of
    /// counted loops is a cycle whose path has every loop once; the branches between two loops count 0.
    pub branch_counts: Vec<f64>,
    /// Cycles per second \[Hz\], for coefficients that are functions of a power (default none).
    pub frequency: Option<f64>,
    /// Method to solve the contact of a cycle.
    pub cycling: Cycling,
    /// Lengths of the jumps.
    pub jumps: Jumps,
    /// Action when a coating is worn through.
    pub worn_through: WornThrough,
    /// Part of the worn volume of both bodies that stays in the contact as debris, 0 to 1 (default
    /// 0): the gap grows by the rest. Debris lies where it was worn off and is as stiff as the
    /// body. A worn scar that fits its counterbody is then `(1 - kept) depth = b^2/(2 R)` deep (the
    /// geometry of P. Arnaud, S. Baydoun, S. Fouvry, Tribol. Int. 161 (2021) 107077).
    pub debris_kept: f64,
    /// Oxygen in the contact (default none: it is everywhere).
    pub air: Option<Air>,
    /// The bed of debris (default none). It replaces [`Self::debris_kept`].
    pub bed: Option<DebrisBed>,
    /// Gap below which the region between the bodies is closed to the air \[m\] (default 1e-6).
    pub closed_below: f64,
    /// Yield stress of the softer body \[Pa\], above which the largest pressure is doubted (default
    /// none). A starved core that hardly wears carries more and more of the load.
    pub yield_stress: Option<f64>,
    /// Worn depth over the thickness of the coatings from which the event `thinned` is reported
    /// (default 0.1). The elastic response does not change with the thickness.
    pub event_depth_fraction: f64,
    /// The method of a settled run with the stroke that it was chosen by; empty before.
    pub note: String,
    /// Doubts about that method.
    pub doubts: Vec<String>,
    /// Half-width of the spots of the first contact of a settled run in gross slip \[m\].
    pub half_width: f64,
}

impl Wear {
    /// Wear of both bodies over so many cycles, all else by default.
    pub fn new(bodies: [BodyWear; 2], cycles: f64) -> Self {
        Self {
            bodies,
            cycles,
            first_branch: None,
            branch_counts: Vec::new(),
            frequency: None,
            cycling: Cycling::default(),
            jumps: Jumps::default(),
            worn_through: WornThrough::default(),
            debris_kept: 0.0,
            air: None,
            bed: None,
            closed_below: 1e-6,
            yield_stress: None,
            event_depth_fraction: 0.1,
            note: String::new(),
            doubts: Vec::new(),
            half_width: 0.0,
        }
    }

    /// The method of a settled run, with the stroke beside the contact; empty without a given stroke.
    pub fn note(&self) -> &str {
        &self.note
    }

    /// Fails with the key, the value and the allowed values if the settings are not valid for a
    /// scene.
    pub fn check(&self, scene: &Scene) -> Result<(), Error> {
        self.check_settings(scene)?;
        self.check_cycle(scene)
    }

    /// Fails if these settings do not fit a scene, whatever its cycle is.
    pub(crate) fn check_settings(&self, scene: &Scene) -> Result<(), Error> {
        if !(1.0..=MOST_CYCLES).contains(&self.cycles) {
            let allowed = format!("1 to {MOST_CYCLES:e}");
            return Err(Error::invalid("wear.cycles", self.cycles, allowed));
        }
        let bodies = [("body1", &scene.body1), ("body2", &scene.body2)];
        if let Some((name, _)) = bodies.iter().find(|(_, body)| body.yields()) {
            let allowed = "left out in a run of wear: start it with the imprint as part of a shape";
            return Err(Error::invalid(format!("{name}.plastic"), "given", allowed));
        }
        if let Some((name, body)) = bodies
            .iter()
            .find(|(_, body)| body.hardness < f64::INFINITY)
        {
            let allowed =
                "left out in a run of wear: start it with the indented surface as part of a shape";
            return Err(Error::invalid(
                format!("{name}.hardness"),
                body.hardness,
                allowed,
            ));
        }
        for ((name, body), wear) in bodies.into_iter().zip(&self.bodies) {
            wear.check(&format!("wear.{name}"), body.coatings.len() + 1)?;
        }
        if !self.bodies.iter().any(BodyWear::has_wear) {
            return Err(Error::invalid(
                "wear",
                "no law",
                "a law for one of the bodies at least",
            ));
        }
        if !(0.0..=1.0).contains(&self.debris_kept) {
            return Err(Error::invalid(
                "wear.debris_kept",
                self.debris_kept,
                "between 0 and 1",
            ));
        }
        self.check_third_body()?;
        if !(self.event_depth_fraction > 0.0 && self.event_depth_fraction <= 1.0) {
            return Err(Error::invalid(
                "wear.event_depth_fraction",
                self.event_depth_fraction,
                "above 0, at most 1",
            ));
        }
        if scene.friction.mu == 0.0 || scene.friction.mu.is_infinite() {
            let allowed = "a finite coefficient above 0 for wear";
            return Err(Error::invalid("friction.mu", scene.friction.mu, allowed));
        }
        if scene.friction.depends_on(Dependence::Increments) {
            let allowed = "\"cycles\", \"slip\" or \"dissipated\" over cycles of wear";
            return Err(Error::invalid("friction.history.of", "increment", allowed));
        }
        self.check_friction(scene)?;
        self.jumps.check()
    }

    /// Fails if the path of a scene has no cycle for these settings, or they lack its frequency.
    fn check_cycle(&self, scene: &Scene) -> Result<(), Error> {
        let needs = |body: &BodyWear| body.laws.iter().any(|law| law.needs_frequency());
        match self.frequency {
            Some(f) if !(f > 0.0 && f.is_finite()) => {
                return Err(Error::invalid("wear.frequency", f, "above 0 Hz"));
            }
            None if self.bodies.iter().any(needs) => {
                let allowed = "given in Hz: a coefficient is a function of the power density";
                return Err(Error::invalid("wear.frequency", "nothing", allowed));
            }
            _ => {}
        }
        let branches = scene.path.branches.len();
        if self
            .first_branch
            .is_some_and(|first| first == 0 || first >= branches)
        {
            return Err(Error::invalid(
                "wear.first_branch",
                self.first_branch.unwrap_or_default(),
                format!(
                    "1 to {}: a branch of the path after one that presses",
                    branches.max(2) - 1
                ),
            ));
        }
        let (scene, first_branch) = self.with_cycle(scene)?;
        Self::check_closed(&scene, first_branch)?;
        self.check_counts(scene.path.branches.len() - first_branch)?;
        if self.cycling == Cycling::Sliding {
            stroke(&scene, first_branch)?;
        }
        Ok(())
    }

    /// How often a cycle passes a branch, counted from 0 at its first one.
    pub(crate) fn branch_count(&self, branch: usize) -> f64 {
        self.branch_counts.get(branch).copied().unwrap_or(1.0)
    }

    /// Fails if the counts of the branches do not fit the cycle or its laws.
    fn check_counts(&self, branches: usize) -> Result<(), Error> {
        let counts = &self.branch_counts;
        if counts.is_empty() {
            return Ok(());
        }
        let key = "wear.branch_counts";
        if counts.len() != branches {
            let allowed = format!("{branches}, one for each branch of the cycle");
            return Err(Error::invalid(
                key,
                format!("{} numbers", counts.len()),
                allowed,
            ));
        }
        if let Some(n) = counts.iter().position(|n| !(0.0..=MOST_CYCLES).contains(n)) {
            let allowed = format!("0 to {MOST_CYCLES:e}");
            return Err(Error::invalid(format!("{key}[{n}]"), counts[n], allowed));
        }
        if counts.iter().sum::<f64>() <= 0.0 {
            return Err(Error::invalid(
                key,
                "0 everywhere",
                "above 0 for one branch at least",
            ));
        }
        if self.cycling == Cycling::Sliding {
            let allowed = "left out with cycling = \"sliding\", which knows one stroke";
            return Err(Error::invalid(key, "given", allowed));
        }
        let has_threshold = |body: &BodyWear| body.laws.iter().any(|law| law.has_threshold());
        if self.bodies.iter().any(has_threshold) {
            let allowed = "left out for laws with a threshold: it holds for one loop, and the slip of a \
                           block is the sum of many";
            return Err(Error::invalid(key, "given", allowed));
        }
        Ok(())
    }

    /// Sentences on numbers that are allowed but unlikely.
    pub fn doubts(&self) -> Vec<String> {
        let bodies = ["wear.body1", "wear.body2"].into_iter().zip(&self.bodies);
        let laws =
            bodies.flat_map(|(key, body)| body.laws.iter().flat_map(move |law| law.doubts(key)));
        let without_air = self.air.is_none() && self.depends_on_air();
        let without_air = without_air.then(|| {
            "wear: a law has a coefficient without oxygen (`starved`), which only wear.air uses"
                .to_owned()
        });
        laws.chain(without_air)
            .chain(self.doubts.iter().cloned())
            .collect()
    }

    /// Checks that a law depends on the aerated share.
    fn depends_on_air(&self) -> bool {
        let mut laws = self.bodies.iter().flat_map(|body| &body.laws);
        laws.any(|law| law.depends_on_air())
    }

    /// Fails at settings of air and bed without a meaning.
    fn check_third_body(&self) -> Result<(), Error> {
        check_positive("wear.closed_below", self.closed_below, "m")?;
        if let Some(yield_stress) = self.yield_stress {
            check_positive("wear.yield_stress", yield_stress, "Pa")?;
        }
        if let Some(air) = &self.air {
            air.check()?;
            if self.frequency.is_none() {
                let allowed =
                    "given in Hz beside wear.air, which consumes oxygen at a rate per second";
                return Err(Error::invalid("wear.frequency", "nothing", allowed));
            }
        }
        if !self.branch_counts.is_empty() && (self.air.is_some() || self.bed.is_some()) {
            let allowed = "left out beside wear.air and wear.bed, which follow one kind of cycle";
            return Err(Error::invalid("wear.branch_counts", "given", allowed));
        }
        let Some(bed) = &self.bed else { return Ok(()) };
        bed.check()?;
        if self.debris_kept > 0.0 {
            let allowed = "left out beside wear.bed, which computes what stays in the contact";
            return Err(Error::invalid(
                "wear.debris_kept",
                self.debris_kept,
                allowed,
            ));
        }
        Ok(())
    }

    /// Fails if the run lacks the third body that friction depends on.
    fn check_friction(&self, scene: &Scene) -> Result<(), Error> {
        let friction = &scene.friction;
        if let (Some(mu), None) = (friction.starved, &self.air) {
            let allowed = "given beside wear.air, which computes where oxygen arrives";
            return Err(Error::invalid("friction.starved", mu, allowed));
        }
        if let (Some(bed), None) = (&friction.bed, &self.bed) {
            let allowed = "given beside wear.bed, which computes the debris";
            return Err(Error::invalid("friction.bed.mu", bed.mu, allowed));
        }
        Ok(())
    }

    /// 1 - kept: growth of the gap over the worn depth.
    pub(crate) fn opens(&self) -> f64 {
        1.0 - self.debris_kept
    }

    /// Fails if the cycle that starts with a branch is not closed.
    pub(super) fn check_closed(scene: &Scene, first_branch: usize) -> Result<(), Error> {
        let branches = &scene.path.branches;
        let (before, last) = (
            &branches[first_branch - 1].to,
            &branches[branches.len() - 1].to,
        );
        if before.rolled != last.rolled {
            let allowed = "the same at both ends of a cycle";
            return Err(Error::invalid("path.rolled", last.rolled, allowed));
        }
        let Some(open) = scene.path.opens((first_branch, branches.len() - 1)) else {
            return Ok(());
        };
        let [from, to] = open.values;
        let allowed = format!(
            "what it is at the end of path[{}] ({from}), where the cycle begins",
            first_branch - 1
        );
        let key = format!("path[{}].{}", branches.len() - 1, open.name);
        Err(Error::invalid(key, to, allowed))
    }
}

impl Jumps {
    /// Fails at a tolerance or a number of jumps out of its range.
    fn check(self) -> Result<(), Error> {
        match self {
            Self::Tolerance(tolerance) if !(1e-6..=0.5).contains(&tolerance) => Err(
                Error::invalid("wear.tolerance", tolerance, "between 1e-6 and 0.5"),
            ),
            Self::Number(n) | Self::Explicit(n) if !(1..=10_000_000).contains(&n) => {
                Err(Error::invalid("wear.jumps", n, "1 to 10000000"))
            }
            _ => Ok(()),
        }
    }
}

/// Thicknesses of the coatings of a body, the outermost first \[m\].
pub(crate) fn thicknesses(body: &Body) -> Vec<f64> {
    body.coatings.iter().map(|c| c.thickness).collect()
}

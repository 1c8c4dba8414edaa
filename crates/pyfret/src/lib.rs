//! Python module `pyfret._core`: the public types of `contact-core` under the same names.
//!
//! Nothing is computed here. Each file translates one noun; the documentation for Python
//! stands in its docstrings and signatures; `tools/stub.py` makes `python/pyfret/_core.pyi` of them.

#![allow(
    rustdoc::broken_intra_doc_links,
    reason = "docstrings of Python give units in brackets"
)]
#![allow(
    clippy::fn_params_excessive_bools,
    clippy::needless_pass_by_value,
    clippy::too_many_arguments,
    reason = "PyO3 hands keyword arguments over one by one and by value"
)]

mod argument;
mod arguments;
mod assess;
mod attributes;
mod command_line;
mod depths;
mod document;
mod doubts;
mod eigenstrain;
mod error;
mod fatigue;
mod forked;
mod fracture;
mod guarded;
mod heat;
mod hints;
mod history;
mod interruptible;
mod kernels;
mod line;
mod march;
mod material;
mod operator;
mod outline;
mod parts;
mod plastic;
mod prelude;
mod python;
mod quantity;
mod reference;
mod residual_stress;
mod result;
mod scene;
mod states;
mod stress;
mod subsurface;
mod text;
mod variables;
mod wear;
mod yielding;

use pyo3::prelude::*;

#[pymodule]
mod _core {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::assess::{
        CriterionBelow, CycleSection, StressCache, YieldBelow, cycle_sections, notes_on_materials,
        range_of_life,
    };
    #[pymodule_export]
    use crate::command_line::run_command;
    #[pymodule_export]
    use crate::doubts::{
        doubt, doubt_quantity, measured_by, measures, quantities, quantity_in_si, si_of, unit_of,
        units,
    };
    #[pymodule_export]
    use crate::eigenstrain::EigenstrainOperator;
    #[pymodule_export]
    use crate::error::{
        ArgumentError, InvalidSceneError, KernelInaccurateError, NoConvergenceError, OffGridError,
        SlidingError, SolveError, StoreError,
    };
    #[pymodule_export]
    use crate::forked::limit_threads;
    #[pymodule_export]
    use crate::kernels::{
        Conversion, influence_coefficients, stress_at, stress_coefficients, surface_frf,
    };
    #[pymodule_export]
    use crate::march::{March, continued_pressure, labels};
    #[pymodule_export]
    use crate::operator::SurfaceOperator;
    #[pymodule_export]
    use crate::python::remake;
    #[pymodule_export]
    use crate::reference::{
        CattaneoMindlin, CoatedIndentation, CoupledIndentation, Hertz, HertzEllipse, HertzStress,
        LineContact, Lubkin, Springs, coated_indentation, coupled_indentation, dundurs_beta,
        goodman_stick_ratio, hertz, hertz_ellipse, line_contact,
    };
    #[pymodule_export]
    use crate::result::{CheckedStore, resume, solve, solve_in_memory, verify};
    #[pymodule_export]
    use crate::scene::{
        Body, Bond, Branch, Coating, Cone, CrownedRoller, Cylinder, Elastic, Ellipsoid, Flat,
        FlatPunch, Friction, Grid, History, LoadPath, PerRange, Plastic, Profile, Ridges, Ring,
        Rough, Scene, Spacing, Sphere, Sum, SurfaceMap, Waviness, Wedge, check_settings,
        check_sides, graded, map_from_heights,
    };

    #[pymodule_export]
    use crate::depths::{chosen_depths, count_work, depths};
    #[pymodule_export]
    use crate::fatigue::{
        Assessment, Criterion, Material, criteria, criterion_on, damage_of_values, damage_on,
        dang_van_path, find_material, find_turns, known_as, material_quantities, materials,
        nearest_materials, spectral_cycles, yielding_on,
    };
    #[pymodule_export]
    use crate::fracture::{
        ContactForCracks, Crack, arrest, channel_crack, crack_life, ellipse_factor,
        equivalent_range, partial_crack, threshold_at,
    };
    #[pymodule_export]
    use crate::heat::cycle_temperature;
    #[pymodule_export]
    use crate::history::{Envelope, loops};
    #[pymodule_export]
    use crate::line::{line_places, line_through};
    #[pymodule_export]
    use crate::outline::{Outline, main_sections};
    #[pymodule_export]
    use crate::states::States;
    #[pymodule_export]
    use crate::stress::{largest_of_samples, measure, principal, probe_labels};
    #[pymodule_export]
    use crate::subsurface::{Subsurface, section_of_states};
    #[pymodule_export]
    use crate::text::{
        degrees, read_bytes, read_text, rough, rounded_place, shown, table_text, with_error,
        with_range, wrap_text,
    };
    #[pymodule_export]
    use crate::wear::{resume_wear, verify_wear, wear, wear_of_file};
    #[pymodule_export]
    use crate::yielding::{Eigenstress, PlasticBody, yielded_columns};

    #[allow(non_upper_case_globals)] // Python's name
    #[pymodule_export]
    const __version__: &str = env!("CARGO_PKG_VERSION");
    /// Why a cycle has no stiffness, and what to do.
    #[pymodule_export]
    const TOO_FEW_INCREMENTS: &str = contact_subsurface::Cycle::TOO_FEW;
    /// Longest finite life [cycles]; a longer one is infinite.
    #[pymodule_export]
    const LONGEST_LIFE: f64 = fatigue::LONGEST;
    /// Cells in the thickness of a layer from which its own stress is known.
    #[pymodule_export]
    const CELLS_PER_FILM: f64 = contact_core::scene::CELLS_PER_FILM;
    /// Part of a worn depth that a jump which ends there may miss.
    #[pymodule_export]
    const DEPTH_ROUNDING: f64 = contact_wear::DEPTH_ROUNDING;
    /// Note on a largest plastic strain at a rim.
    #[pymodule_export]
    const STRAIN_AT_A_RIM: &str = contact_core::yielding::Rim::TOLD;
    /// Plastic work of a cycle over its friction work, or without friction over the plastic work of the
    /// path, below which bodies have shaken down.
    #[pymodule_export]
    const SHAKEN: f64 = contact_subsurface::SHAKEN;
    /// Net strain of a cycle over the strain that it adds up, from which a body ratchets.
    #[pymodule_export]
    const RATCHETS: f64 = contact_subsurface::RATCHETS;
    /// A material that does not deform.
    #[pymodule_export]
    const RIGID: Elastic = Elastic::RIGID;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        crate::python::keep(module);
        crate::guarded::guard(module)?;
        crate::fatigue::add_criteria(module.py())
    }
}

//! Criteria of crack initiation under multiaxial stress.

use crate::error::Error;

/// A criterion: one number for the stress history of a point, compared with a limit or a life.
///
/// s_n is the normal stress on a plane, tension positive, its largest value over time s_n,max;
/// tau_a the shear amplitude there, the radius of the smallest circle round the path of the shear
/// stress; p_h the hydrostatic stress. Strains are those of the elastic stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Criterion {
    /// sqrt(J2,a) + alpha p_h,max \[Pa\]: sqrt(J2,a) is the radius of the smallest sphere round the
    /// path of the deviatoric stress, |s|^2 = s:s/2.
    ///
    /// B. Crossland, Proc. Int. Conf. on Fatigue of Metals, IMechE, London (1956) 138-149.
    Crossland {
        /// Weight of the hydrostatic stress.
        alpha: f64,
    },
    /// Largest tau(t) + alpha p_h(t) \[Pa\]: tau is half of Tresca's stress of the deviatoric stress
    /// from the centre of the smallest sphere round its path, the stress of a grain that has shaken
    /// down.
    ///
    /// K. Dang Van, ASTM STP 1191 (1993) 120-130.
    DangVan {
        /// Weight of the hydrostatic stress.
        alpha: f64,
    },
    /// Largest tau_a + k s_n,max over the planes \[Pa\].
    ///
    /// W. N. Findley, J. Eng. Ind. 81 (1959) 301-305.
    Findley {
        /// Weight of the normal stress.
        k: f64,
    },
    /// tau_a + k s_n,max \[Pa\] on the plane of the largest tau_a; of equal ones, that with the larger
    /// s_n,max.
    ///
    /// T. Matake, Bull. JSME 20 (1977) 257-263.
    Matake {
        /// Weight of the normal stress.
        k: f64,
    },
    /// tau_a + k s_n,max \[Pa\] on the plane of the largest tau_a, with k = t_D/(2 s_u): the fatigue
    /// limit in shear over twice the tensile strength.
    ///
    /// D. L. McDiarmid, Fatigue Fract. Eng. Mater. Struct. 14 (1991) 429-453.
    McDiarmid {
        /// Weight of the normal stress.
        k: f64,
    },
    /// Largest s_n,max times half the range of the normal strain, over the planes \[Pa\]; 0 without
    /// tension.
    ///
    /// K. N. Smith, P. Watson, T. H. Topper, J. Mater. 5 (1970) 767-778; on planes
    /// D. F. Socie, J. Eng. Mater. Technol. 109 (1987) 293-298.
    SmithWatsonTopper {
        /// Young's modulus \[Pa\].
        E: f64,
        /// Poisson's ratio.
        nu: f64,
    },
    /// Largest gamma_a (1 + k s_n,max/s_y) over the planes, gamma_a = tau_a/G half the range of the
    /// shear strain; 0 where the bracket is negative.
    ///
    /// A. Fatemi, D. F. Socie, Fatigue Fract. Eng. Mater. Struct. 11 (1988) 149-165.
    FatemiSocie {
        /// Young's modulus \[Pa\].
        E: f64,
        /// Poisson's ratio.
        nu: f64,
        /// Weight of the normal stress.
        k: f64,
        /// Yield stress \[Pa\].
        s_y: f64,
    },
    /// gamma_a + S times the range of the normal strain, on the plane of the largest gamma_a; of
    /// equal ones, that with the larger range.
    ///
    /// F. A. Kandil, M. W. Brown, K. J. Miller, The Metals Society Book 280 (1982) 203-210.
    BrownMiller {
        /// Young's modulus \[Pa\].
        E: f64,
        /// Poisson's ratio.
        nu: f64,
        /// Weight of the normal strain.
        S: f64,
    },
}

impl Criterion {
    /// Name, as in Python and on the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Crossland { .. } => "crossland",
            Self::DangVan { .. } => "dang_van",
            Self::Findley { .. } => "findley",
            Self::Matake { .. } => "matake",
            Self::McDiarmid { .. } => "mcdiarmid",
            Self::SmithWatsonTopper { .. } => "smith_watson_topper",
            Self::FatemiSocie { .. } => "fatemi_socie",
            Self::BrownMiller { .. } => "brown_miller",
        }
    }

    /// Unit of its value: Pa, or 1 for a strain.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::FatemiSocie { .. } | Self::BrownMiller { .. } => "1",
            _ => "Pa",
        }
    }

    /// Whether it looks for a plane.
    pub fn has_plane(&self) -> bool {
        !matches!(self, Self::Crossland { .. } | Self::DangVan { .. })
    }

    /// Fails if a number is out of its range.
    pub fn check(&self) -> Result<(), Error> {
        let weight = |name: &str, value: f64| {
            if value >= 0.0 && value.is_finite() {
                return Ok(());
            }
            let key = format!("{}.{name}", self.name());
            Err(Error::invalid(key, value, "a weight, 0 or more"))
        };
        let positive = |name: &str, value: f64| {
            if value > 0.0 && value.is_finite() {
                return Ok(());
            }
            let key = format!("{}.{name}", self.name());
            Err(Error::invalid(key, value, "a positive stress in Pa"))
        };
        let elastic = |E: f64, nu: f64| {
            if !(nu > -1.0 && nu <= 0.5) {
                let key = format!("{}.nu", self.name());
                return Err(Error::invalid(key, nu, "-1 < nu <= 0.5"));
            }
            positive("E", E)
        };
        match *self {
            Self::Crossland { alpha } | Self::DangVan { alpha } => weight("alpha", alpha),
            Self::Findley { k } | Self::Matake { k } | Self::McDiarmid { k } => weight("k", k),
            Self::SmithWatsonTopper { E, nu } => elastic(E, nu),
            Self::FatemiSocie { E, nu, k, s_y } => {
                elastic(E, nu)?;
                weight("k", k)?;
                positive("s_y", s_y)
            }
            Self::BrownMiller { E, nu, S } => {
                elastic(E, nu)?;
                weight("S", S)
            }
        }
    }
}

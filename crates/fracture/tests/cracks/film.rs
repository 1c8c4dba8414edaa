//! Films, against the tables of partial and channel cracks: 2e-3.

use fracture::Film;

#[test]
fn channel_and_partial_cracks() {
    for (alpha, beta, g, F) in [
        (
            -0.8,
            0.0,
            0.86833,
            [1.066_325, 0.994_901, 0.921_499, 0.846_280],
        ),
        (
            -0.5,
            0.0,
            0.973_935_2,
            [1.083_807, 1.033_716, 0.982_246, 0.927_813],
        ),
        (
            0.0,
            0.0,
            1.257_812_2,
            [1.121_522, 1.121_522, 1.121_522, 1.121_522],
        ),
        (
            0.5,
            0.0,
            1.949_039_8,
            [1.181_609, 1.275_538, 1.372_778, 1.483_426],
        ),
        (
            0.8,
            0.0,
            3.47174,
            [1.251_082, 1.482_982, 1.731_889, 1.996_490],
        ),
        (
            -0.9,
            -0.225,
            0.74305,
            [1.061_530, 0.964_812, 0.842_215, 0.712_307],
        ),
        (
            -0.5,
            -0.125,
            0.913_963_5,
            [1.085_029, 1.025_632, 0.949_964, 0.866_905],
        ),
        (
            0.5,
            0.125,
            2.052_066_8,
            [1.178_306, 1.276_544, 1.399_197, 1.544_892],
        ),
        (
            0.8,
            0.2,
            3.72204,
            [1.245_576, 1.478_769, 1.765_754, 2.093_140],
        ),
    ] {
        let film = Film::new(alpha, beta).expect("a film");
        let found = film.channel().expect("g");
        assert!(
            (found / g - 1.0).abs() < 5e-4,
            "g({alpha}, {beta}): {found} of {g}"
        );
        for (depth, F) in [0.25, 0.5, 0.75, 0.9].into_iter().zip(F) {
            let found = film.partial(depth).expect("F");
            assert!(
                (found / F - 1.0).abs() < 5e-4,
                "F({alpha}, {beta}, {depth}): {found} of {F}"
            );
        }
    }
}

#[test]
fn equal_constants_are_no_film() {
    let film = Film::from_moduli((210e9, 0.3), (210e9, 0.3)).expect("a film");
    let g = film.channel().expect("g");
    assert!((g - 1.121_522_255_231_f64.powi(2)).abs() < 1e-6, "{g}");
    assert!(Film::new(1.0, 0.0).is_err() && Film::new(0.0, 0.6).is_err());
}

/// A film far stiffer than what it lies on: g grows as a smooth power of 1 - alpha, without a jump
/// up to the largest alpha.
#[test]
fn stiff_films_have_an_answer() {
    let alphas = [0.8, 0.85, 0.89, 0.9, 0.95, 0.99];
    let g = alphas.map(|alpha| {
        let film = Film::new(alpha, alpha / 4.0).expect("a film");
        film.channel().expect("g")
    });
    for k in 1..alphas.len() {
        let slope = -(g[k] / g[k - 1]).ln() / ((1.0 - alphas[k]) / (1.0 - alphas[k - 1])).ln();
        assert!(
            (0.5..0.7).contains(&slope),
            "alpha = {}: g = {}, slope {slope}",
            alphas[k],
            g[k]
        );
    }
    assert!((g[3] / 5.72467 - 1.0).abs() < 1e-5, "{}", g[3]);
}

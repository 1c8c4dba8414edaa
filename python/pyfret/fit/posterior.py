"""The posterior of the unknowns: samples by ``emcee`` of a quadratic model of the contact.

A sampler asks for ten thousands of solutions. Close to the best values the prediction is nearly
quadratic in the unknowns. With L L^T the covariance of the linear model, a polynomial of second
order in z is fitted to y(u + L z). Its points are solves at |z| = 2, side by side. Three further
solves check it. The prior is flat in what is searched: the logarithm of positive ranges. Where the
noise is not given, it is unknown as well, with the prior 1/sigma integrated out.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from pyfret._util.extras import needed

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["sampled"]

#: |z| of the solves that the model goes through, and largest |z| of one component that is sampled.
THROUGH, FARTHEST = 2.0, 4.0
#: Solves that the model is compared with.
CHECKS = 3
#: Steps of the chains that are left out, and every so many of the others is kept.
BURN, EVERY = 400, 10

#: What should have been measured over its noise, at unknowns u, all data in a row.
Solved = Callable[["list[NDArray[np.float64]]"], "list[NDArray[np.float64]]"]


def monomials(z: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return 1, z and the products of two components of z, for points in rows."""
    n = z.shape[1]
    squares = [z[:, i] * z[:, j] for i in range(n) for j in range(i, n)]
    return np.column_stack([np.ones(len(z)), z, *squares])


def design(n: int) -> NDArray[np.float64]:
    """Return points of norm one that determine a quadratic of n unknowns, besides the middle."""
    axes = np.vstack([np.eye(n), -np.eye(n)])
    pairs = [
        (s * axes[i] + t * axes[j]) / np.sqrt(2)
        for i, j in combinations(range(n), 2)
        for s, t in ((1, 1), (1, -1))
    ]
    return np.vstack([axes, *pairs])


def sampled(
    solved: Solved,
    best: NDArray[np.float64],
    covariance: NDArray[np.float64],
    measured: NDArray[np.float64],
    gauges: NDArray[np.float64],
    *,
    noise: float | None,
    count: int,
    seed: int,
) -> tuple[NDArray[np.float64], float]:
    """Samples of u, and the error of the model over the noise.

    Parameters
    ----------
    solved : callable
        Solutions at unknowns.
    best, covariance : array
        The best u, and the covariance of the linear model.
    measured : array
        What was measured, over noise, less what the offsets add.
    gauges : array
        Derivatives of what is computed by the offsets, shape (data, offsets).
    noise : float, optional
        Noise of what is measured; none: unknown.
    count, seed : int
        Samples, and the seed of the sampler.
    """
    emcee = needed("emcee", "fit")
    n, dice = len(best), np.random.default_rng(seed)
    values, ways = np.linalg.eigh(covariance)
    # An unknown that the data do not determine is free over all of its range.
    root = ways * np.minimum(np.sqrt(np.maximum(values, 0.0)), 0.25)

    def to_u(z: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert points z of the posterior's axes to u, the unknowns in their ranges."""
        return np.asarray(best + z @ root.T)

    def pull_inside(points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Move points towards the middle until u lies in its range."""
        for k, point in enumerate(points):
            while np.any((to_u(point) < 0) | (to_u(point) > 1)):
                point = points[k] = 0.8 * point
        return points

    aside = dice.standard_normal((CHECKS, n))
    aside *= THROUGH / np.linalg.norm(aside, axis=1, keepdims=True)
    points = pull_inside(np.vstack([np.zeros(n), THROUGH * design(n), aside]))
    predictions = np.stack(solved(list(to_u(points))))
    fitted, checks = slice(None, -CHECKS), slice(-CHECKS, None)
    terms = np.asarray(
        np.linalg.lstsq(monomials(points[fitted]), predictions[fitted])[0], np.float64
    )
    off = monomials(points[checks]) @ terms - predictions[checks]

    # Offsets act linearly: what they can explain is no misfit.
    basis = np.linalg.qr(gauges)[0] if gauges.shape[1] else np.zeros((len(measured), 0))

    def unexplained(rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the part of each row that the basis does not explain."""
        return rows - (rows @ basis) @ basis.T

    terms[0] -= measured
    unexplained_terms = unexplained(terms)
    gram, degrees = unexplained_terms @ unexplained_terms.T, len(measured) - gauges.shape[1]

    def log_probability(z: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the logarithm of the probability up to a constant; -inf outside of the ranges."""
        u, rows = to_u(z), monomials(z)
        squares = np.maximum(np.einsum("ki,ij,kj->k", rows, gram, rows), 1e-300)
        log_likelihood = -0.5 * squares / noise**2 if noise else -0.5 * degrees * np.log(squares)
        outside = np.any((u < 0) | (u > 1) | (np.abs(z) > FARTHEST), axis=1)
        return np.where(outside, -np.inf, log_likelihood)

    walkers = max(32, 4 * n)
    sampler = emcee.EnsembleSampler(walkers, n, log_probability, vectorize=True)
    sampler.random_state = np.random.RandomState(seed).get_state()
    steps = BURN + EVERY * -(-count // walkers)
    sampler.run_mcmc(pull_inside(0.1 * dice.standard_normal((walkers, n))), steps)
    chain = sampler.get_chain(discard=BURN, thin=EVERY, flat=True)[-count:]
    scatter = noise or float(np.sqrt(max(gram[0, 0], 1e-300) / max(degrees - n, 1)))
    return to_u(chain), float(np.sqrt(np.mean(unexplained(off) ** 2))) / scatter

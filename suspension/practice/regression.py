"""Checks of the workbook's regression: a fit, its scatter, joint intervals, an F statistic."""

import numpy as np
from scipy import stats

from suspension.practice.feedback import check, compare, listed, near

__all__ = ["check_fit", "check_half_widths", "check_linearity", "check_scatter"]

COLUMNS = np.array(["1", "x", "x²"])


def _readings(rng):
    """Displacements and forces of some spring."""
    x = rng.uniform(0, 1, rng.integers(9, 25))
    beta = rng.uniform([-4, 5, -6], [4, 20, 6])
    return x, _design(x) @ beta + rng.normal(0, 0.5, len(x))


def _design(x):
    return np.vander(x, 3, increasing=True)


def _fit(x, F):
    return np.linalg.lstsq(_design(x), F, rcond=None)[0]


def _partial(x, F, columns):
    return np.linalg.lstsq(_design(x)[:, columns], F, rcond=None)[0]


@check("fit(x, F)", "the residuals are orthogonal to the columns 1, x and x².")
def check_fit(fit, rng):
    """Whether ``fit(x, F)`` gives β0, β1, β2 of the parabola of least squares."""

    def fails(beta, x, F):
        M = _design(x)
        if near(beta, _fit(x, F), 0.01):
            return "These coefficients are right to some digits only: are they rounded?"
        r = F - M @ beta
        cosines = M.T @ r / np.linalg.norm(M, axis=0) / np.linalg.norm(r)
        which = COLUMNS[np.abs(cosines) > 1e-6]
        return (
            f"The residuals F − Mβ are not orthogonal to {listed(which)}, so a nearer parabola "
            "exists. Do your β solve MᵀM β = MᵀF, with the columns 1, x and x² in M?"
        )

    mistakes = {
        "These are the coefficients of a straight line: is the column x² missing?": (
            lambda x, F: _partial(x, F, [0, 1]),
            lambda x, F: np.append(_partial(x, F, [0, 1]), 0),
        ),
        "This parabola goes through the origin: is the column of ones missing?": (
            lambda x, F: _partial(x, F, [1, 2]),
            lambda x, F: np.append(0, _partial(x, F, [1, 2])),
        ),
        "The parabola is the right one, its coefficients come the wrong way round: β0 first, "
        "please. Does `np.vander` or `np.polyfit` begin with the highest power?": (
            lambda x, F: _fit(x, F)[::-1]
        ),
        "These are coefficients of 1, x and x³: is the third column x²?": (
            lambda x, F: np.linalg.lstsq(
                np.column_stack([np.ones_like(x), x, x**3]), F, rcond=None
            )[0]
        ),
        "This is MᵀF, the right-hand side alone: are the normal equations solved?": (
            lambda x, F: _design(x).T @ F
        ),
        "These coefficients give x as a parabola of F: have x and F changed places?": (
            lambda x, F: _fit(F, x)
        ),
        "This parabola goes exactly through the first three readings: what about the others?": (
            lambda x, F: np.linalg.solve(_design(x)[:3], F[:3])
        ),
    }
    cases = [_readings(rng) for _ in range(4)]
    compare(fit, cases, _fit, mistakes, "β0, β1 and β2", fails)


def _squares(x, F, beta):
    return np.sum((F - _design(x) @ beta) ** 2)


def _scatter(x, F, beta):
    return np.sqrt(_squares(x, F, beta) / (len(x) - 3))


@check(
    "scatter(x, F, beta)", "n − 3 directions are left for the errors, and you divide by so many."
)
def check_scatter(scatter, rng):
    """Whether ``scatter(x, F, beta)`` estimates the standard deviation of one reading."""

    def fails(answer, x, F, beta):
        moved = _design(x) @ beta + 2 * (F - _design(x) @ beta)
        ratio = float(np.ravel(scatter(x, moved, beta))[0]) / answer
        if not np.isclose(ratio, 2):
            return (
                f"Where every residual doubles the scatter should double, yours is "
                f"{ratio:.3g} times as large. Is it the root of a sum of squares of F − Mβ?"
            )
        return (
            f"Squared, it is {answer**2 / _squares(x, F, beta):.4g} times the sum of the "
            "squares of "
            f"the residuals, for {len(x)} readings. How many directions are left for the errors?"
        )

    divided = "The sum of squares is divided by {}. " + (
        "The fit has used up three of the n directions: how many are left for the errors?"
    )
    mistakes = {
        divided.format("n"): lambda *case: np.sqrt(_squares(*case) / len(case[0])),
        divided.format("n − 1, as for a mean"): lambda *case: np.sqrt(
            _squares(*case) / (len(case[0]) - 1)
        ),
        divided.format("n − 2, as for a straight line"): lambda *case: np.sqrt(
            _squares(*case) / (len(case[0]) - 2)
        ),
        "This is the variance, in N²: is the square root missing?": lambda *case: (
            _scatter(*case) ** 2
        ),
        "This is the length of the vector of residuals: by how many is its square divided?": (
            lambda *case: np.sqrt(_squares(*case))
        ),
        "This is the scatter of the forces about their mean: take that of the residuals, F − Mβ.": (
            lambda x, F, beta: np.std(F),
            lambda x, F, beta: np.std(F, ddof=1),
            lambda x, F, beta: np.std(F, ddof=3),
        ),
        "This is the mean of the absolute residuals: take the root of a mean of squares.": (
            lambda x, F, beta: np.abs(F - _design(x) @ beta).mean()
        ),
    }
    cases = [(x, F, _fit(x, F)) for x, F in (_readings(rng) for _ in range(4))]
    compare(scatter, cases, _scatter, mistakes, "one number", fails)


def _covariance(x, F):
    M = _design(x)
    return _scatter(x, F, _fit(x, F)) ** 2 * np.linalg.inv(M.T @ M)


def _errors(x, F):
    return np.sqrt(np.diag(_covariance(x, F)))


@check("half_widths(x, F, level)", "√(3 F(level; 3, n − 3)) standard errors for each coefficient.")
def check_half_widths(half_widths, rng):
    """Whether ``half_widths(x, F, level)`` gives the joint intervals of all three coefficients."""

    def times(factor):
        return lambda x, F, level: factor(level, len(x)) * _errors(x, F)

    def joint(level, n, p=3):
        return np.sqrt(p * stats.f.ppf(level, p, n - 3))

    def no_inverse(x, F, level):
        M = _design(x)
        return joint(level, len(x)) * _scatter(x, F, _fit(x, F)) / np.sqrt(np.diag(M.T @ M))

    def fails(answer, x, F, level):
        factors = answer / _errors(x, F)
        if np.ptp(factors) > 1e-6 * np.abs(factors).max():
            return (
                "A joint half-width is the same number of standard errors for every coefficient, "
                f"yours are {listed(f'{f:.3g}' for f in factors)}. Are the standard errors the "
                "roots of the diagonal of σ̂²(MᵀM)⁻¹?"
            )
        return (
            f"Your half-widths are {factors[0]:.4g} standard errors, the joint ones "
            f"{joint(level, len(x)):.4g}, for level = {level:g} and {len(x)} readings. Is the "
            "factor √(3 F(level; 3, n − 3))?"
        )

    mistakes = {
        "These are the one-at-a-time intervals, by Student's t: each is right for its own "
        "coefficient, all three together less often. The question is about all at once.": times(
            lambda level, n: stats.t.ppf((1 + level) / 2, n - 3)
        ),
        "These are one-at-a-time intervals, and with a one-sided quantile, t(level): half of the "
        "errors lie on each side, and the question is about all three at once.": times(
            lambda level, n: stats.t.ppf(level, n - 3)
        ),
        "These are Bonferroni's intervals for three coefficients: they hold jointly, but the "
        "course's are the shadows of the ellipsoid, with F in place of t.": times(
            lambda level, n: stats.t.ppf(1 - (1 - level) / 6, n - 3)
        ),
        "These are Bonferroni's intervals for two coefficients: all three at once are asked for, "
        "from the ellipsoid.": times(lambda level, n: stats.t.ppf(1 - (1 - level) / 4, n - 3)),
        "These hold for two coefficients at once, p = 2: all three are asked for.": times(
            lambda level, n: joint(level, n, 2)
        ),
        "The factor is √F: the ellipsoid is (β − β̂)ᵀMᵀM(β − β̂) ≤ 3σ̂²F. Where is the 3?": times(
            lambda level, n: joint(level, n) / np.sqrt(3)
        ),
        "The factor is 3F, which belongs to squared lengths: is a root missing?": times(
            lambda level, n: joint(level, n) ** 2
        ),
        "The degrees of freedom have changed places: F(3, n − 3) has the three coefficients "
        "first.": (times(lambda level, n: np.sqrt(3 * stats.f.ppf(level, n - 3, 3)))),
        "The quantile is that of F(3, n): n − 3 degrees of freedom are left for σ̂.": times(
            lambda level, n: np.sqrt(3 * stats.f.ppf(level, 3, n))
        ),
        "The quantile is F(1 − level), for intervals that hardly ever hold: is `level` taken "
        "for its complement?": (
            times(lambda level, n: np.sqrt(3 * stats.f.ppf(1 - level, 3, n - 3)))
        ),
        "The factor is that of a known σ, by χ². Here σ is estimated from "
        "the same readings.": times(lambda level, n: np.sqrt(stats.chi2.ppf(level, 3))),
        "The standard errors lack σ̂: they are the roots of the diagonal of (MᵀM)⁻¹ alone.": (
            lambda x, F, level: joint(level, len(x)) * _errors(x, F) / _scatter(x, F, _fit(x, F))
        ),
        "The factor multiplies the variances: is the root of the diagonal missing?": (
            lambda x, F, level: joint(level, len(x)) * _errors(x, F) ** 2
        ),
        "The standard errors are σ̂ over the lengths of the columns, which would do for orthogonal "
        "columns: is the diagonal taken before MᵀM is inverted?": no_inverse,
    }
    cases = [(*_readings(rng), level) for level in (0.9, 0.95, 0.99, 0.8)]
    compare(
        half_widths,
        cases,
        times(joint),
        mistakes,
        "the half-widths for β0, β1 and β2",
        fails,
    )


@check(
    "linearity(x, F)",
    "it is the squared distance of (0, 0) from the estimate, in the ellipse's units.",
)
def check_linearity(linearity, rng):
    """Whether ``linearity(x, F)`` is the F statistic of ``β0 = β2 = 0``."""

    def distance(x, F, which=(0, 2)):
        which = list(which)
        b, V = _fit(x, F)[which], _covariance(x, F)[np.ix_(which, which)]
        return b @ np.linalg.solve(V, b) / len(which)

    def block_of_inverse(x, F):
        b, W = _fit(x, F)[[0, 2]], np.linalg.inv(_covariance(x, F))[np.ix_([0, 2], [0, 2])]
        return b @ W @ b / 2

    def uncorrelated(x, F):
        return np.mean((_fit(x, F) / _errors(x, F))[[0, 2]] ** 2)

    def fails(answer, x, F):
        line = _partial(x, F, [1])
        growth = np.sum((F - line * x) ** 2) - _squares(x, F, _fit(x, F))
        return (
            f"Without β0 and β2 the sum of squares grows by {growth:.4g} N². Half of that, "
            "over σ̂², is "
            f"{distance(x, F):.4g}, and the distance is the same number; yours is "
            f"{answer:.4g}. Is it ½ bᵀV⁻¹b, with b = (β0, β2) and V their own covariance?"
        )

    mistakes = {
        "It is twice the statistic: F is the mean over the two coefficients. Where is the ½?": (
            lambda x, F: 2 * distance(x, F)
        ),
        "The block of β0 and β2 is taken from the inverse of the covariance, which holds β1 fixed: "
        "take the block first, then invert.": block_of_inverse,
        "It is what uncorrelated estimates would give: is the covariance of β0 and β2, off the "
        "diagonal, left out?": uncorrelated,
        "It lacks σ̂²: is (MᵀM)⁻¹ taken for the covariance?": (
            lambda x, F: distance(x, F) * _scatter(x, F, _fit(x, F)) ** 2
        ),
        "This is the p-value; the statistic itself is asked for.": (
            lambda x, F: stats.f.sf(distance(x, F), 2, len(x) - 3)
        ),
        "This tests all three coefficients, β1 too: a spring with β1 = 0 is none.": (
            lambda x, F: distance(x, F, (0, 1, 2))
        ),
        "This tests β0 and β1: Python counts from 0, so β0 and β2 are the indices 0 and 2.": (
            lambda x, F: distance(x, F, (0, 1))
        ),
        "This tests β1 and β2: Python counts from 0, so β0 and β2 are the indices 0 and 2.": (
            lambda x, F: distance(x, F, (1, 2))
        ),
        "It is the root of the statistic: F is a squared distance.": (
            lambda x, F: np.sqrt(distance(x, F))
        ),
    }
    cases = [_readings(rng) for _ in range(4)]
    compare(linearity, cases, distance, mistakes, "one number", fails)

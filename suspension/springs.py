"""Part I: fit the spring, and say how well its coefficients are known.

``python -m suspension.springs [FILE]`` reads the data, says what was read and exits with 1 if they
cannot be used; files are the business of `_readings`.
"""

import sys
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pandas as pd
import statsmodels.api as sm
from scipy import special, stats
from scipy.linalg import matmul_toeplitz
from statsmodels.regression.linear_model import OLSResults, RegressionResultsWrapper

from suspension import _checks, _readings
from suspension._readings import COLUMNS
from suspension.problem import DELTA_MAX

__all__ = [
    "Linearity",
    "Neighbours",
    "SpringFit",
    "Stiffness",
    "fit_spring",
    "is_synthetic",
    "load_spring_data",
    "load_vehicles",
]

EXACT = 1e-12  # residuals below this part of the largest force are roundoff


def load_spring_data(path=None):
    """Read a load against displacement test.

    Parameters
    ----------
    path : str or Path, optional
        A CSV or MATLAB file with `delta_over_delta_max` (dimensionless, 0 to 1) and `force` (N, of
        the spring pair). If not given, ``data/spring_data.mat`` where it exists, otherwise
        ``data/spring_data.csv``, which the project ships with synthetic readings.

    Returns
    -------
    data : DataFrame
        Columns `delta_over_delta_max` and `force`, floats. ``data.attrs["source"]`` is the name
        of the file, ``data.attrs["notes"]`` a tuple of what was noticed while reading: decimal
        commas, another delimiter, columns that are not used.

    Raises
    ------
    ValueError
        If the file cannot be read or anything in it is not as it must be. One line names the file,
        the line in it and what was expected.
    """
    readings = _readings.read(path)
    data = pd.DataFrame(dict(zip(COLUMNS, (readings.displacement, readings.force))))
    data.attrs.update(source=readings.source, notes=readings.notes)
    return data


def is_synthetic(data):
    """Whether `data` are the synthetic stand-in, so that a report can say so."""
    return _readings.are_synthetic(*(data[name] for name in COLUMNS))


class Stiffness(NamedTuple):
    """A stiffness as estimated from the data.

    Attributes
    ----------
    name : str
        Which one it is.
    value, error : float
        Estimate and standard error, N/m.
    free : int
        Degrees of freedom of the residual behind the error.
    """

    name: str
    value: float
    error: float
    free: int

    @property
    def distribution(self):
        """Confidence distribution in N/m, a frozen `scipy.stats.t`; errors as for `interval`."""
        self._needs_an_error()
        # Readings on a curve may leave an error of zero, which makes no distribution.
        return stats.t(self.free, loc=self.value, scale=max(self.error, np.finfo(float).tiny))

    def interval(self, level=0.95):
        """Confidence interval of this stiffness alone, N/m, shape (2,).

        Raises
        ------
        ValueError
            If `level` is not between 0 and 1, there are three readings, which leave no error, or
            `value` is no finite number, `error` none >= 0, or `free` no whole number.
        """
        level = _checks.interval("level", level, 0, 1)
        self._needs_an_error()
        half = stats.t.ppf((1 + level) / 2, self.free) * self.error
        return np.array([self.value - half, self.value + half])

    def _needs_an_error(self):
        if _checks.whole(f"free of the stiffness {self.name!r}", self.free, 0) < 1:
            raise ValueError("data must have more points than the three coefficients, got 3")
        _checks.number(f"value of the stiffness {self.name!r}", self.value)
        _checks.nonnegative(f"error of the stiffness {self.name!r}", self.error)


class Linearity(NamedTuple):
    """The F test of ``beta0 = beta2 = 0``, beside the joint intervals.

    Attributes
    ----------
    statistic, pvalue : float
        F and its p-value.
    joint : bool
        Whether zero lies in both joint intervals (p = 3).
    linear : bool
        Whether neither contradicts a linear spring without preload.
    """

    statistic: float
    pvalue: float
    joint: bool
    linear: bool


class Neighbours(NamedTuple):
    """Whether the residuals of neighbouring readings, in the order of the file, go together.

    Attributes
    ----------
    correlation : float
        Sum of the products of neighbours over the sum of squares. This and all else is nan if the
        parabola goes through every reading or there are fewer than five.
    low, high : float
        Between them it is in 95 of 100 experiments with independent errors.
    widening : float
        How many times as wide the interval of the slope at zero would have to be if the errors of
        readings i and j correlated with ``correlation ** abs(i - j)``.
    """

    correlation: float
    low: float
    high: float
    widening: float

    @property
    def suspicious(self):
        """Whether they correlate in a way that independent errors seldom do."""
        return self.correlation < self.low or self.correlation > self.high


@dataclass(frozen=True, eq=False)
class SpringFit:
    """The fit of ``F = beta0 + beta1 x + beta2 x^2``, x = delta / delta_max (Eq. 9).

    Attributes
    ----------
    results : statsmodels.regression.linear_model.RegressionResults
        For those who want more than the properties below; nothing in this project reads it.
    delta_max : float
        Largest displacement, m.
    """

    results: object
    delta_max: float

    def __repr__(self):
        beta = ", ".join(f"{b:.4g}" for b in self.beta)
        return (
            f"SpringFit(beta=[{beta}] N, stiffness={self.stiffness:.4g} N/m, "
            f"points={len(self.F)}, delta_max={self.delta_max:g} m)"
        )

    # --- readings and estimates -----------------------------------------------------------------

    @property
    def x(self):
        """Displacements of the readings over the largest, shape (m,)."""
        return self.results.model.exog[:, 1]

    @property
    def F(self):
        """Forces of the readings, N, shape (m,)."""
        return self.results.model.endog

    @property
    def beta(self):
        """Estimates of beta0, beta1 and beta2, N, shape (3,)."""
        return np.asarray(self.results.params)

    @property
    def residuals(self):
        """Measured minus fitted forces, N, shape (m,)."""
        return np.asarray(self.results.resid)

    @property
    def free(self):
        """Degrees of freedom of the residuals, m - 3."""
        return int(self.results.df_resid)

    @property
    def scatter(self):
        """Estimated standard deviation of one reading, N; nan if three readings leave none."""
        return float(np.sqrt(self.results.mse_resid)) if self.free else np.nan

    @property
    def covariance(self):
        """Estimated covariance of the three estimates, N^2, shape (3, 3)."""
        return self.scatter**2 * self._unit_covariance

    @property
    def _unit_covariance(self):
        """``(M^T M)^-1`` of the design matrix M."""
        return np.asarray(self.results.normalized_cov_params)

    @property
    def errors(self):
        """Standard errors of the three estimates, N, shape (3,)."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def exact(self):
        """Whether the readings lie on the parabola, but for roundoff."""
        return bool(np.abs(self.residuals).max() <= EXACT * np.abs(self.F).max())

    def force(self, x):
        """The fitted force at displacements `x`, N.

        Raises
        ------
        ValueError
            If a displacement is not finite.
        """
        return np.polynomial.polynomial.polyval(_checks.array("x", x), self.beta)

    def band(self, x, level=0.95):
        """Confidence band of the mean force, for each displacement alone.

        Parameters
        ----------
        x : array_like, shape (n,)
            Displacements over the largest.
        level : float

        Returns
        -------
        band : ndarray, shape (2, n)
            Lower and upper bound, N.

        Raises
        ------
        ValueError
            If `x` is not finite or has another shape, or `intervals` refuses.
        """
        rows = np.vander(_checks.array("x", x, (None,)), 3, increasing=True)
        error = np.sqrt(np.einsum("ni,ij,nj->n", rows, self.covariance, rows))
        half = self.width(level, "individual") * error
        return rows @ self.beta + np.array([-half, half])

    @property
    def stiffness(self):
        """Spring constant ``k = beta1 / delta_max``, N/m."""
        return float(self.beta[1] / self.delta_max)

    def stiffness_interval(self, level=0.95):
        """Confidence interval of the spring constant alone, N/m, shape (2,).

        Raises
        ------
        ValueError
            As `intervals` does.
        """
        return self.intervals(level, "individual")[1] / self.delta_max

    @property
    def cubic_pvalue(self):
        """p-value of a cubic term added to the model; a small one betrays a bias.

        None where there is nothing to tell it by: fewer than five readings, fewer than four
        different displacements, readings that lie on the parabola.
        """
        if self.free < 2 or self.exact:
            return None
        try:
            cubic = _readings.design(self.x, 4)
        except ValueError:
            return None
        return float(least_squares(self.F, cubic).pvalues[-1])

    @property
    def neighbours(self):
        """Whether neighbouring residuals correlate, and what that does to the intervals.

        Residuals are P times the errors, P the projection along the fitted curves, so that a sum
        of products of neighbours has known mean and variance, as in the test of Durbin and Watson.
        """
        m, r = len(self.x), self.residuals
        if self.free < 2 or self.exact:
            return Neighbours(np.nan, np.nan, np.nan, np.nan)
        correlation = float(r[:-1] @ r[1:] / (r @ r))
        M = _readings.design(self.x)
        estimate = self._unit_covariance @ M.T  # times the forces it is beta
        shifted = np.zeros_like(M)  # S M, S the mean of the shifts by one to either side
        shifted[1:] += M[:-1] / 2
        shifted[:-1] += M[1:] / 2
        small = estimate @ shifted
        mean = -np.trace(small) / self.free
        square = (m - 1) / 2 + np.trace(small @ small)  # of P S, its trace
        square -= 2 * np.trace(self._unit_covariance @ shifted.T @ shifted)
        variance = 2 * (square / self.free - mean**2) / (self.free + 2)
        half = stats.norm.ppf(0.975) * np.sqrt(variance)
        together = matmul_toeplitz(correlation ** np.arange(m), M)  # correlations of errors, M
        seen = (m - np.trace(estimate @ together)) / self.free  # of a variance of 1
        true = (estimate @ together @ self._unit_covariance)[1, 1] / self._unit_covariance[1, 1]
        widening = float(np.sqrt(true / seen))
        return Neighbours(correlation, float(mean - half), float(mean + half), widening)

    # --- which stiffness does the robot feel? ---------------------------------------------------

    @property
    def slope(self):
        """The slope of the parabola at zero, ``beta1 / delta_max``, which Question 1 asks for."""
        return self._slope_at("slope at zero", 0.0)

    @property
    def line(self):
        """The slope of the line through the origin; fair if `linearity` does not contradict it."""
        x, force = self.x, self.F
        slope = x @ force / (x @ x)
        free = len(x) - 1
        error = np.sqrt(np.sum((force - slope * x) ** 2) / free / (x @ x))
        return Stiffness(
            "line through the origin",
            float(slope / self.delta_max),
            float(error / self.delta_max),
            free,
        )

    def displacement(self, load):
        """Where the fitted force carries `load`, in N, while it grows: x = delta / delta_max.

        Beyond 1 it is an extrapolation. None if the parabola bends down before it gets there.

        Raises
        ------
        ValueError
            If `load` is no finite number.
        """
        load = _checks.number("load", load)
        beta0, beta1, beta2 = self.beta
        squared_slope = beta1**2 - 4 * beta2 * (beta0 - load)
        if not (beta1 > 0 and squared_slope > 0):
            return None
        return float(2 * (load - beta0) / (beta1 + np.sqrt(squared_slope)))

    def tangent(self, load):
        """The slope where the spring carries `load`, in N: what small swings about rest feel.

        Its standard error holds that displacement fixed. None if no displacement carries the load.

        Raises
        ------
        ValueError
            If `load` is no finite number.
        """
        x = self.displacement(load)
        return None if x is None else self._slope_at("tangent at the static load", x)

    def stiffnesses(self, load):
        """`slope`, `line` and, where there is one, `tangent(load)`.

        Raises
        ------
        ValueError
            If `load` is no finite number.
        """
        three = self.slope, self.line, self.tangent(load)
        return tuple(stiffness for stiffness in three if stiffness is not None)

    def _slope_at(self, name, x):
        weights = np.array([0, 1, 2 * x]) / self.delta_max
        error = np.sqrt(weights @ self.covariance @ weights)
        return Stiffness(name, float(weights @ self.beta), float(error), self.free)

    def linearity(self, level=0.95):
        """Do the data contradict a linear spring without preload, ``beta0 = beta2 = 0``?

        Readings that lie on a parabola to roundoff contradict it unless that is a line through
        the origin.

        Parameters
        ----------
        level : float
            Confidence level of the joint intervals; the F test rejects below ``1 - level``.

        Returns
        -------
        Linearity

        Raises
        ------
        ValueError
            As `intervals` does.
        """
        low, high = self.intervals(level)[[0, 2]].T
        if self.exact:
            size = np.abs(self.F).max()
            straight = bool((np.abs(self.beta[[0, 2]]) <= 1e3 * EXACT * size).all())
            if straight:
                return Linearity(0.0, 1.0, joint=True, linear=True)
            return Linearity(np.inf, 0.0, joint=False, linear=False)
        test = self.results.f_test(np.eye(3)[[0, 2]])
        joint = bool((low <= 0).all() and (high >= 0).all())
        p = float(test.pvalue)
        return Linearity(float(test.fvalue), p, joint, joint and p >= 1 - level)

    def power(self, beta0, beta2, level=0.95):
        """How often the F test of `linearity` would notice such a preload and curvature.

        The noncentral F distribution: ``P(F' > F^-1(level; 2, m - 3))`` with the noncentrality
        ``b^T V^-1 b``, b = (beta0, beta2) and V their covariance in this fit. The true scatter is
        taken to be the estimated one.

        Parameters
        ----------
        beta0, beta2 : float or array_like
            True coefficients, N; they broadcast.
        level : float
            Confidence level; the test rejects below ``1 - level``.

        Returns
        -------
        power : float or ndarray
            Probability, from ``1 - level`` for a linear spring to 1.

        Raises
        ------
        ValueError
            If a coefficient is not finite, they do not broadcast, `level` is not between 0 and 1,
            or there are three readings: they leave no error.
        """
        level = _checks.interval("level", level, 0, 1)
        self._needs_an_error()
        beta0, beta2 = _checks.array("beta0", beta0), _checks.array("beta2", beta2)
        try:
            b = np.stack(np.broadcast_arrays(beta0, beta2), -1)
        except ValueError:
            raise ValueError(
                f"beta2 must broadcast with beta0, got shapes {beta2.shape} and {beta0.shape}"
            ) from None
        V = self._unit_covariance[np.ix_([0, 2], [0, 2])]
        distance = np.einsum("...i,ij,...j", b, np.linalg.inv(V), b)
        with np.errstate(over="ignore"):
            noncentrality = distance / max(self.scatter**2, np.finfo(float).tiny)
        # Far beyond certainty; the distribution function gives up some powers of ten later.
        noncentrality = np.minimum(noncentrality, 1e7)
        limit = stats.f.ppf(level, 2, self.free)
        power = 1 - special.ncfdtr(2, self.free, noncentrality, limit)
        return power if power.ndim else float(power)

    # --- intervals of the coefficients ----------------------------------------------------------

    def intervals(self, level=0.95, method="scheffe", p=3):
        """Confidence intervals ``beta_j -+ s se(beta_j)``.

        Parameters
        ----------
        level : float
            Confidence level, 0 < level < 1.
        method : {"scheffe", "bonferroni", "individual"}
            With m points: ``s = sqrt(p F^-1(level; p, m - 3))`` holds for all combinations of p
            coefficients at once (p = 3 is the course's joint interval); ``s = t^-1(1 - (1 -
            level) / (2 p); m - 3)`` for p chosen ones at once; ``t^-1((1 + level) / 2; m - 3)``
            for one alone, whatever p is.
        p : {1, 2, 3}
            How many coefficients the statement is about.

        Returns
        -------
        intervals : ndarray, shape (3, 2)
            Lower and upper bound for beta0, beta1, beta2, N.

        Raises
        ------
        ValueError
            If `level` is not between 0 and 1, `method` or `p` is none of these, or there are three
            readings: they leave no error.
        """
        s = self.width(level, method, p)
        return self.beta[:, None] + np.outer(s * self.errors, [-1, 1])

    def width(self, level=0.95, method="scheffe", p=3):
        """Half-width s of `intervals`, in standard errors; arguments and refusals are the same."""
        level = _checks.interval("level", level, 0, 1)
        _checks.one_of("method", method, ("scheffe", "bonferroni", "individual"))
        _checks.one_of("p", p, (1, 2, 3))
        self._needs_an_error()
        if method == "scheffe":
            return float(np.sqrt(p * stats.f.ppf(level, p, self.free)))
        compared = p if method == "bonferroni" else 1
        return float(stats.t.ppf(1 - (1 - level) / (2 * compared), self.free))

    def _needs_an_error(self):
        if self.free < 1:
            raise ValueError("data must have more points than the three coefficients, got 3")


def load_vehicles():
    """Published suspensions, for the chart of Part IV; ``data/README.md`` describes the columns.

    Returns
    -------
    vehicles : DataFrame
    """
    return pd.read_csv(_readings.shipped("vehicles.csv"), index_col=False)


def fit_spring(data, delta_max=DELTA_MAX):
    """Least squares for the force-displacement model, Eq. 9.

    Any displacements and any slope can be fitted; it is `load_spring_data` that insists on a
    spring.

    Parameters
    ----------
    data : DataFrame
        Columns `delta_over_delta_max` (dimensionless) and `force` (N).
    delta_max : float
        Largest displacement, m, > 0.

    Returns
    -------
    SpringFit

    Raises
    ------
    ValueError
        If a column is missing or holds anything but finite numbers, or if the displacements are
        fewer than three or too close to each other to tell three coefficients apart.
    TypeError
        If `data` is no DataFrame.
    """
    delta_max = _checks.positive("delta_max", delta_max)
    x, force = _columns(data)
    design = pd.DataFrame(_readings.design(x), columns=["beta0", "beta1", "beta2"])
    return SpringFit(least_squares(force, design), delta_max)


def _columns(data):
    """The two columns of a DataFrame as arrays of finite floats."""
    _checks.instance("data", data, pd.DataFrame)
    missing = [name for name in COLUMNS if name not in data]
    if missing:
        raise ValueError(f"data must have the columns {list(COLUMNS)}, got {list(data)}")
    columns = []
    for name in COLUMNS:
        values = np.asarray(data[name])
        if values.dtype.kind == "b":
            raise ValueError(f"{name} must be an array of numbers, got booleans")
        columns.append(_checks.array(name, values, (None,)))
    return columns


def least_squares(y, X):
    """Ordinary least squares by statsmodels, every digit from the factor R of ``X = Q R``.

    statsmodels' own QR still forms ``X^T X`` for the covariance, and loses half of the digits
    there (NIST's certified cases, see the tests).
    """
    model = sm.OLS(y, X)
    beta = np.asarray(model.fit(method="qr").params)
    R_inverse = np.linalg.inv(np.linalg.qr(model.exog, mode="r"))
    return RegressionResultsWrapper(OLSResults(model, beta, R_inverse @ R_inverse.T))


if __name__ == "__main__":
    sys.exit(_readings.main(sys.argv[1:]))

"""Part I: fit the spring, and say how well its coefficients are known.

``python -m suspension.springs [FILE]`` reads the data, says what was read and exits with 1 if they
cannot be used.
"""

import hashlib
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import statsmodels.api as sm
from scipy import stats
from statsmodels.regression.linear_model import OLSResults, RegressionResultsWrapper

from suspension import _checks
from suspension._readings import COLUMNS, read
from suspension.problem import DELTA_MAX

__all__ = [
    "TRUE_STIFFNESS",
    "Linearity",
    "SpringFit",
    "Stiffness",
    "fit_spring",
    "is_synthetic",
    "load_spring_data",
]

# Beside the package in a checkout; inside it when it is installed.
FOLDERS = (
    Path(__file__).resolve().parents[1] / "data",
    Path(__file__).resolve().parent / "data",
)
FILES = ("spring_data.mat", "spring_data.csv")

# The synthetic stand-in, data/make_spring_data.py: its digest, so that another file under the same
# name is not taken for it, and the truth behind it.
SYNTHETIC = "4443053ab6a814e209f91ab03635f51ed49172dc75c624a1e632790b21e09b11"
TRUE_STIFFNESS = 800.0  # N/m

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
    readings = read(_default_file() if path is None else path)
    data = pd.DataFrame(dict(zip(COLUMNS, (readings.displacement, readings.force))))
    name = _default_file().name if path is None else Path(path).name
    try:
        fit = fit_spring(data)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    if not fit.beta[1] > 1e-6 * readings.force.max():
        raise ValueError(
            f"{name}: expected a force that grows with the displacement, got a slope at zero of "
            f"{round(fit.stiffness, 6) + 0.0:.4g} N/m"
        )
    data.attrs.update(source=name, notes=readings.notes)
    return data


def _default_file():
    for folder in FOLDERS:
        for name in FILES:
            if (folder / name).exists():
                return folder / name
    raise ValueError(f"path must be given, because {FOLDERS[0]} holds no {' or '.join(FILES)}")


def is_synthetic(data):
    """Whether `data` are the synthetic stand-in, so that a report can say so."""
    text = data[list(COLUMNS)].to_csv(index=False, lineterminator="\n")
    return hashlib.sha256(text.encode()).hexdigest() == SYNTHETIC


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
        """Confidence distribution in N/m, a frozen `scipy.stats.t`."""
        self._needs_an_error()
        return stats.t(self.free, loc=self.value, scale=self.error)

    def interval(self, level=0.95):
        """Confidence interval of this stiffness alone, N/m, shape (2,)."""
        level = _checks.interval("level", level, 0, 1)
        self._needs_an_error()
        half = stats.t.ppf((1 + level) / 2, self.free) * self.error
        return np.array([self.value - half, self.value + half])

    def _needs_an_error(self):
        if self.free < 1:
            raise ValueError("data must have more points than the three coefficients, got 3")


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


@dataclass(frozen=True, eq=False)
class SpringFit:
    """The fit of ``F = beta0 + beta1 x + beta2 x^2``, x = delta / delta_max (Eq. 9).

    Attributes
    ----------
    results : statsmodels.regression.linear_model.RegressionResults
    delta_max : float
        Largest displacement, m.
    """

    results: object
    delta_max: float

    def __repr__(self):
        beta = ", ".join(f"{b:.4g}" for b in self.beta)
        return (
            f"SpringFit(beta=[{beta}] N, stiffness={self.stiffness:.4g} N/m, "
            f"points={len(self._force)}, delta_max={self.delta_max:g} m)"
        )

    @property
    def _x(self):
        return self.results.model.exog[:, 1]

    @property
    def _force(self):
        return self.results.model.endog

    @property
    def beta(self):
        """Estimates of beta0, beta1 and beta2, N, shape (3,)."""
        return np.asarray(self.results.params)

    @property
    def stiffness(self):
        """Spring constant ``k = beta1 / delta_max``, N/m."""
        return float(self.beta[1] / self.delta_max)

    def stiffness_interval(self, level=0.95):
        """Confidence interval of the spring constant alone, N/m, shape (2,)."""
        return self.intervals(level, "individual")[1] / self.delta_max

    @property
    def cubic_pvalue(self):
        """p-value of a cubic term added to the model; a small one betrays a bias."""
        exog = self.results.model.exog
        cubic = np.column_stack([exog, exog[:, 1] ** 3])
        return float(sm.OLS(self.results.model.endog, cubic).fit().pvalues[-1])

    # --- which stiffness does the robot feel? ---------------------------------------------------

    @property
    def slope(self):
        """The slope of the parabola at zero, ``beta1 / delta_max``, which Question 1 asks for."""
        return self._slope_at("slope at zero", 0.0)

    @property
    def line(self):
        """The slope of the line through the origin; fair if `linearity` does not contradict it."""
        x, force = self._x, self._force
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
        """
        x = self.displacement(load)
        return None if x is None else self._slope_at("tangent at the static load", x)

    def stiffnesses(self, load):
        """`slope`, `line` and, where there is one, `tangent(load)`."""
        three = self.slope, self.line, self.tangent(load)
        return tuple(stiffness for stiffness in three if stiffness is not None)

    def _slope_at(self, name, x):
        weights = np.array([0, 1, 2 * x]) / self.delta_max
        free, error = int(self.results.df_resid), np.nan
        if free:
            error = np.sqrt(weights @ np.asarray(self.results.cov_params()) @ weights)
        return Stiffness(name, float(weights @ self.beta), float(error), free)

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
        """
        low, high = self.intervals(level)[[0, 2]].T
        size = np.abs(self._force).max()
        if np.abs(self.results.resid).max() <= EXACT * size:
            straight = bool((np.abs(self.beta[[0, 2]]) <= 1e3 * EXACT * size).all())
            if straight:
                return Linearity(0.0, 1.0, joint=True, linear=True)
            return Linearity(np.inf, 0.0, joint=False, linear=False)
        test = self.results.f_test(np.eye(3)[[0, 2]])
        joint = bool((low <= 0).all() and (high >= 0).all())
        p = float(test.pvalue)
        return Linearity(float(test.fvalue), p, joint, joint and p >= 1 - level)

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
        """
        s = self.width(level, method, p)
        se = np.asarray(self.results.bse)
        return self.beta[:, None] + np.outer(s * se, [-1, 1])

    def width(self, level=0.95, method="scheffe", p=3):
        """Half-width s of the intervals in standard errors; arguments as in `intervals`."""
        level = _checks.interval("level", level, 0, 1)
        _checks.one_of("method", method, ("scheffe", "bonferroni", "individual"))
        _checks.one_of("p", p, (1, 2, 3))
        free = self.results.df_resid
        if free < 1:
            raise ValueError("data must have more points than the three coefficients, got 3")
        if method == "scheffe":
            return float(np.sqrt(p * stats.f.ppf(level, p, free)))
        compared = p if method == "bonferroni" else 1
        return float(stats.t.ppf(1 - (1 - level) / (2 * compared), free))


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
    different = len(np.unique(x))
    if different < 3:
        raise ValueError(
            "data must have at least three points at three different displacements to fit three "
            f"coefficients, got {len(x)} points at {different}"
        )
    design = pd.DataFrame({"beta0": np.ones_like(x), "beta1": x, "beta2": x**2})
    scaled = design.to_numpy() / np.linalg.norm(design, axis=0)
    if not np.linalg.cond(scaled) < 1e8:
        raise ValueError(
            "data must have displacements far enough apart to tell three coefficients, "
            f"got {x.min():g} to {x.max():g}, {np.ptp(x):.2g} apart"
        )
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


def main(arguments):
    """Say what a file of readings holds; the exit code is 1 if it cannot be used."""
    try:
        data = load_spring_data(*arguments[:1])
        fit = fit_spring(data)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 1
    x, force = (data[name] for name in COLUMNS)
    print(f"file    {data.attrs['source']}{' (synthetic)' if is_synthetic(data) else ''}")
    print(f"points  {len(data)}")
    print(f"range   delta/delta_max from {x.min():g} to {x.max():g}")
    print(f"        force from {force.min():g} to {force.max():g} N, of the spring pair")
    print(f"slope   {fit.stiffness:.1f} N/m at zero, with delta_max = {fit.delta_max:g} m")
    for note in data.attrs["notes"]:
        print(f"note    {note}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

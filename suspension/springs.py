"""Part I: fit the spring, and say how well its coefficients are known."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import statsmodels.api as sm
from scipy import io, stats
from statsmodels.regression.linear_model import OLSResults, RegressionResultsWrapper

from suspension import _checks

__all__ = ["SpringFit", "fit_spring", "is_synthetic", "load_spring_data", "synthetic_spring_data"]

DATA = Path(__file__).resolve().parent.parent / "data"
COLUMNS = ["delta_over_delta_max", "force"]
TRUE_STIFFNESS = 800.0  # N/m, of the synthetic spring


def load_spring_data(path=None):
    """Read a load against displacement test.

    Parameters
    ----------
    path : str or Path, optional
        A CSV or MATLAB file with `delta_over_delta_max` (dimensionless) and `force` (N, of the
        spring pair). If not given, ``data/spring_data.mat`` where it exists, otherwise the
        synthetic ``data/spring_data.csv``.

    Returns
    -------
    data : DataFrame
        Columns `delta_over_delta_max` and `force`, floats; ``data.attrs["source"]`` is the name
        of the file.

    Raises
    ------
    ValueError
        If the file cannot be read, lacks a column, or holds anything but finite numbers.
    """
    if path is None:
        path = DATA / "spring_data.mat"
        path = path if path.exists() else path.with_suffix(".csv")
    try:
        path = Path(path)
        if path.suffix == ".mat":
            table = {k: np.ravel(x) for k, x in io.loadmat(path).items() if k[:2] != "__"}
        else:
            table = pd.read_csv(path)
    except Exception as error:  # each reader fails in its own ways
        raise ValueError(
            f"path must be a readable .csv or .mat file, got {path}: {error}"
        ) from None
    missing = [name for name in COLUMNS if name not in table]
    if missing:
        raise ValueError(f"{path.name} must have the columns {COLUMNS}, got {list(table)}")
    columns = {name: _checks.array(name, table[name], (None,)) for name in COLUMNS}
    if len({len(x) for x in columns.values()}) > 1:
        raise ValueError(f"{path.name} must have columns of one length")
    data = pd.DataFrame(columns)
    data.attrs["source"] = path.name
    return data


def synthetic_spring_data():
    """The stand-in for the course's measurements, which are not public; a DataFrame.

    21 displacements, a linear spring of 800 N/m (delta_max = 0.0165 m) without preload, Gaussian
    noise of 0.12 N, readings rounded to 0.02 N: a scale that reads to 1 g, doubled. The seed was
    fixed once and never tuned.
    """
    x = np.linspace(0, 1, 21).round(2)
    noise = np.random.default_rng(2086).normal(0, 0.12, x.size)
    force = 0.02 * np.round((TRUE_STIFFNESS * 0.0165 * x + noise) / 0.02)
    return pd.DataFrame({"delta_over_delta_max": x, "force": force.round(2)})


def is_synthetic(data):
    """Whether `data` are the synthetic stand-in, so that a report can say so."""
    return data.equals(synthetic_spring_data())


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


def fit_spring(data, delta_max=0.0165):
    """Least squares for the force-displacement model, Eq. 9.

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
        If a column is missing or not finite, there are fewer than three points, or fewer than
        three different displacements.
    """
    missing = [name for name in COLUMNS if name not in data]
    if missing:
        raise ValueError(f"data must have the columns {COLUMNS}, got {list(data)}")
    x, force = (_checks.array(name, data[name], (None,)) for name in COLUMNS)
    if len(np.unique(x)) < 3:
        raise ValueError(
            "data must have at least three points at three different displacements to fit three "
            f"coefficients, got {len(x)} points at {len(np.unique(x))}"
        )
    design = pd.DataFrame({"beta0": np.ones_like(x), "beta1": x, "beta2": x**2})
    return SpringFit(least_squares(force, design), _checks.positive("delta_max", delta_max))


def least_squares(y, X):
    """Ordinary least squares by statsmodels, every digit from the factor R of ``X = Q R``.

    statsmodels' own QR still forms ``X^T X`` for the covariance, and loses half of the digits
    there (NIST's certified cases, see the tests).
    """
    model = sm.OLS(y, X)
    beta = np.asarray(model.fit(method="qr").params)
    R_inverse = np.linalg.inv(np.linalg.qr(model.exog, mode="r"))
    return RegressionResultsWrapper(OLSResults(model, beta, R_inverse @ R_inverse.T))

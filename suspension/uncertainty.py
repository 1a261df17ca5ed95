"""From the fitted spring to the verdict: what the regression's uncertainty does to the answers.

The stiffness is the only number that is measured. Given the data its confidence distribution is a
t distribution about the estimate; speeds and verdicts are functions of the stiffness, so their
distributions follow without any further assumption or sampling.
"""

from dataclasses import replace

import numpy as np
from scipy import stats

from suspension.contact import critical_speeds, critical_stiffness, margin

__all__ = ["critical_speed_intervals", "loss_probability", "stiffness_distribution"]


def stiffness_distribution(fit):
    """Confidence distribution of the stiffness in N/m, a frozen `scipy.stats.t`."""
    error = np.asarray(fit.results.bse)[1] / fit.delta_max
    return stats.t(fit.results.df_resid, loc=fit.stiffness, scale=error)


def critical_speed_intervals(fit, robot, bump, vmin, vmax, level=0.95):
    """Every critical speed with its confidence interval.

    Parameters
    ----------
    fit : SpringFit
    robot : Robot
        Both stiffnesses are replaced by the fitted one.
    bump : GaussianBump
    vmin, vmax : float
        Range of speeds, m/s.
    level : float
        Confidence level of each interval.

    Returns
    -------
    intervals : ndarray, shape (n, 3)
        Speed at the estimate, lower and upper end, m/s; nan where the critical speed does not
        exist, or leaves the range, at an end of the interval of the stiffness.
    """

    def speeds(k):
        return critical_speeds(replace(robot, k1=k, k2=k), bump, vmin, vmax)

    best = speeds(fit.stiffness)
    ends = [_follow(best, speeds(k)) for k in fit.stiffness_interval(level)]
    return np.column_stack([best, np.sort(ends, axis=0).T]) if len(best) else np.empty((0, 3))


def _follow(best, moved):
    # In order of speed, critical speeds appear and vanish in pairs or at the ends of the range.
    if len(moved) == len(best):
        return moved
    nearest = [moved[np.abs(np.log(moved / v)).argmin()] if len(moved) else np.nan for v in best]
    return np.where(np.abs(np.log(np.array(nearest) / best)) < 0.3, nearest, np.nan)


def loss_probability(fit, robot, bump, v):
    """How much of the stiffness's confidence distribution loses contact at speed `v`, 0 to 1.

    Between two critical stiffnesses the verdict is one and the same, so this is a sum of
    differences of the distribution function.
    """
    k = stiffness_distribution(fit)
    low, high = max(k.ppf(1e-9), 0.05 * fit.stiffness), k.ppf(1 - 1e-9)
    nominal = replace(robot, k1=fit.stiffness, k2=fit.stiffness)
    flips = critical_stiffness(nominal, bump, v, low, high)
    edges = np.array([low, *flips, high])
    middle = (edges[1:] + edges[:-1]) / 2
    lost = [margin(replace(robot, k1=k, k2=k), bump, v) <= 0 for k in middle]
    return float(np.diff([0.0, *k.cdf(flips), 1.0]) @ lost)

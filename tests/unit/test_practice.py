"""Every typical mistake is told by its own words; a right answer passes in any style.

A mistake is planted by an edit of the workbook's own solution, so that both stay alike.
"""

import inspect
import re

import nbformat
import numpy as np
import pandas as pd
import pytest
from helpers import ROOT
from scipy import optimize

from suspension import practice
from suspension.practice import hunts
from suspension.schemes import RK4
from suspension.springs import fit_spring

WORKBOOK = sorted(ROOT.glob("notebooks/workbook/*.ipynb"))
CHECKS = {
    name.removeprefix("check_"): getattr(practice, name)
    for name in practice.__all__
    if name.startswith("check_") and name != "check_hunt"
}


def solutions():
    """By the name of a function, its source in the workbook and what it is defined among."""
    found = {}
    for path in WORKBOOK:
        cells = nbformat.read(path, as_version=4).cells
        imports = next(cell.source for cell in cells if cell.cell_type == "code")
        space = {}
        exec(imports, space)
        for cell in cells:
            if "solution" in cell.metadata.get("tags", []) and cell.source.startswith("def "):
                exec(cell.source, space)
                found[re.match(r"def (\w+)", cell.source)[1]] = cell.source, space
    return found


SOLUTIONS = solutions()


def written(name, source):
    """A function in place of the solution, among the other solutions of its notebook."""
    space = dict(SOLUTIONS[name][1])
    exec(source, space)
    return space[name]


# What a student may have written in place of what stands in the solution, and what is to be said.
PLANTED = {
    "fit": [
        (
            "np.vander(x, 3, increasing=True)",
            "np.column_stack([x, x**2])",
            "column of ones missing",
        ),
        ("np.vander(x, 3, increasing=True)", "np.vander(x, 2, increasing=True)", "x² missing"),
        ("np.vander(x, 3, increasing=True)", "np.vander(x, 3)", "wrong way round"),
        ("np.linalg.solve(M.T @ M, M.T @ F)", "M.T @ F", "right-hand side alone"),
        ("M = np", "x, F = F, x; M = np", "x and F changed places"),
        ("np.linalg.solve(M.T @ M, M.T @ F)", "np.linalg.solve(M[:3], F[:3])", "first three"),
        ("np.linalg.solve(M.T @ M, M.T @ F)", "np.linalg.solve(M, F)", "stopped with LinAlgError"),
        ("x, 3, increasing=True)", "x, 4, increasing=True)[:, [0, 1, 3]]", "third column x²"),
        ("M.T @ F)", "M.T @ F).round(2)", "are they rounded"),
    ],
    "scatter": [
        ("(len(x) - 3)", "len(x)", "divided by n."),
        ("(len(x) - 3)", "(len(x) - 1)", "n − 1"),
        ("(len(x) - 3)", "(len(x) - 2)", "n − 2"),
        ("np.sqrt(r @ r / (len(x) - 3))", "r @ r / (len(x) - 3)", "variance"),
        ("np.sqrt(r @ r / (len(x) - 3))", "np.linalg.norm(r)", "length of the vector"),
        ("np.sqrt(r @ r / (len(x) - 3))", "np.std(F)", "forces about their mean"),
        ("np.sqrt(r @ r / (len(x) - 3))", "np.abs(r).mean()", "absolute residuals"),
        ("np.sqrt(r @ r / (len(x) - 3))", "r", "of shape"),
        ("r @ r / (len(x) - 3)", "F @ F / (len(x) - 3)", "every residual doubles"),
        ("(len(x) - 3)", "(len(x) - 4)", "How many directions"),
    ],
    "half_widths": [
        (
            "np.sqrt(3 * stats.f.ppf(level, 3, len(x) - 3))",
            "stats.t.ppf((1 + level) / 2, len(x) - 3)",
            "one-at-a-time intervals, by",
        ),
        (
            "np.sqrt(3 * stats.f.ppf(level, 3, len(x) - 3))",
            "stats.t.ppf(level, len(x) - 3)",
            "one-sided",
        ),
        (
            "np.sqrt(3 * stats.f.ppf(level, 3, len(x) - 3))",
            "stats.t.ppf(1 - (1 - level) / 6, len(x) - 3)",
            "Bonferroni's intervals for three",
        ),
        (
            "np.sqrt(3 * stats.f.ppf(level, 3, len(x) - 3))",
            "stats.t.isf((1 - level) / 4, len(x) - 3)",
            "Bonferroni's intervals for two",
        ),
        ("3 * stats.f.ppf(level, 3,", "2 * stats.f.ppf(level, 2,", "p = 2"),
        ("3 * stats", "stats", "Where is the 3?"),
        (
            "np.sqrt(3 * stats.f.ppf(level, 3, len(x) - 3))",
            "(3 * stats.f.ppf(level, 3, len(x) - 3))",
            "is a root missing",
        ),
        ("level, 3, len(x) - 3", "level, len(x) - 3, 3", "have changed places"),
        ("level, 3, len(x) - 3", "level, 3, len(x)", "F(3, n)"),
        ("ppf(level", "ppf(1 - level", "F(1 − level)"),
        ("sigma * np.sqrt(", "np.sqrt(", "lack σ̂"),
        (
            "np.sqrt(np.diag(np.linalg.inv(M.T @ M)))",
            "sigma * np.diag(np.linalg.inv(M.T @ M))",
            "multiplies the variances",
        ),
        (
            "np.sqrt(np.diag(np.linalg.inv(M.T @ M)))",
            "1 / np.sqrt(np.diag(M.T @ M))",
            "before MᵀM is inverted",
        ),
        (
            "np.sqrt(3 * stats.f.ppf(level, 3, len(x) - 3))",
            "np.sqrt(stats.chi2.ppf(level, 3))",
            "χ²",
        ),
        (
            "np.sqrt(3 * stats.f.ppf(level, 3, len(x) - 3))",
            "2.0",
            "Your half-widths are 2 standard",
        ),
        ("* errors", "* errors[::-1]", "same number of standard errors"),
    ],
    "linearity": [
        (" / 2", "", "Where is the ½?"),
        (
            "covariance[np.ix_([0, 2], [0, 2])]\n    return b @ np.linalg.solve(V, b)",
            "np.linalg.inv(covariance)[np.ix_([0, 2], [0, 2])]\n    return b @ V @ b",
            "holds β1 fixed",
        ),
        ("np.linalg.solve(V, b)", "(b / np.diag(V))", "off the diagonal"),
        ("scatter(x, F, beta) ** 2 * ", "", "lacks σ̂²"),
        (
            "return b @ np.linalg.solve(V, b) / 2",
            "return stats.f.sf(b @ np.linalg.solve(V, b) / 2, 2, len(x) - 3)",
            "p-value",
        ),
        (
            "beta[[0, 2]], covariance[np.ix_([0, 2], [0, 2])]\n    return b @ "
            "np.linalg.solve(V, b) / 2",
            "beta, covariance\n    return b @ np.linalg.solve(V, b) / 3",
            "all three",
        ),
        ("[0, 2]", "[0, 1]", "tests β0 and β1"),
        ("[0, 2]", "[1, 2]", "tests β1 and β2"),
        (
            "return b @ np.linalg.solve(V, b) / 2",
            "return (b @ np.linalg.solve(V, b) / 2) ** 0.5",
            "root of the statistic",
        ),
        (" / 2", " / 4", "sum of squares grows"),
    ],
    "state_matrix": [
        (
            "[-(k1 + k2) / m, -(c1 + c2) / m, kL / m, cL / m]",
            "[(k1 + k2) / m, (c1 + c2) / m, -kL / m, -cL / m]",
            "Row 2, column 1",
        ),
        ("kL, cL = k1", "k1, k2, c1, c2 = -k1, -k2, -c1, -c2\n    kL, cL = k1", "rows 2 and 4"),
        (
            "c1, c2 = robot.k1, robot.k2, robot.c1, robot.c2",
            "c1, c2 = robot.k1, robot.k2, -robot.c1, -robot.c2",
            "dampers have the wrong sign",
        ),
        (
            "k1 * L1 - k2 * L2, c1 * L1 - c2 * L2",
            "k2 * L2 - k1 * L1, c2 * L2 - c1 * L1",
            "changed places in the coupling",
        ),
        ("kL / m, cL / m", "-kL / m, -cL / m", "coupling in row 2"),
        ("kL / Izz, cL / Izz", "-kL / Izz, -cL / Izz", "coupling in row 4"),
        (
            "k1 * L1 - k2 * L2, c1 * L1 - c2 * L2",
            "-k1 * L1 - k2 * L2, -c1 * L1 - c2 * L2",
            "both axles have one sign",
        ),
        ("k1 * L1 - k2 * L2, c1 * L1 - c2 * L2", "0, 0", "do not feel each other"),
        ("[0, 1, 0, 0]", "[0, 0, 0, 0]", "is 0, and should be 1"),
        ("**2", "", "L²"),
        ("Izz, -kLL / Izz, -cLL / Izz", "m, -kLL / m, -cLL / m", "Row 4, column 2"),
        ("Izz, L1, L2 = robot.m, robot.Izz", "Izz, L1, L2 = robot.m, robot.m", "divided by m"),
        ("Izz, L1, L2 = robot.m, robot.Izz", "Izz, L1, L2 = robot.m, 1", "divided by Izz"),
        ("m, Izz, L1, L2 = robot.m", "m, Izz, L1, L2 = 1", "not divided by m"),
        ("[0, 0, 0, 1],\n", "", "array of shape (3, 4)"),
    ],
    "cn_step": [
        ("np.linalg.solve(identity - dt / 2 * A, b)", "b", "Nothing is solved"),
        ("dt / 2 * (F0 + F1)", "dt * F0", "F1, too"),
        ("dt / 2 * (F0 + F1)", "dt * F1", "F0, too"),
        ("dt / 2 * (F0 + F1)", "dt * (F0 + F1)", "F counts twice"),
        ("dt / 2 * (F0 + F1)", "dt / 4 * (F0 + F1)", "F counts half"),
        ("dt / 2 * A", "dt * A", "dt in them"),
        ("dt / 2", "dt", "dt in them"),
        ("identity + dt / 2 * A", "identity - dt / 2 * A", "Both matrices"),
        (
            "identity = np.eye(len(w))",
            "identity, A, F0, F1 = np.eye(len(w)), -A, F0, F1",
            "have changed places",
        ),
        ("identity = np.eye(len(w))", "identity = 1", "np.eye"),
        ("identity = np.eye(len(w))", "identity, A = np.eye(len(w)), A.T", "act on rows"),
        ("+ dt / 2 * (F0 + F1)", "", "equilibrium does not stay"),
        (
            " + dt / 2 * (F0 + F1)  # all that is known\n    return np.linalg.solve(identity "
            "- dt / 2 * A, b)",
            "\n    return np.linalg.solve(identity - dt / 2 * A, b) + dt / 2 * (F0 + F1)",
            "added after the solving",
        ),
        ("b = (identity", "return w + dt * (A @ w + F0)\n    b = (identity", "explicit Euler"),
        (
            "b = (identity",
            "return np.linalg.solve(identity - dt * A, w + dt * F1)\n    b = (identity",
            "backward Euler",
        ),
        (
            "b = (identity",
            "end = w + dt * (A @ w + F0)\n    return w + dt / 2 * (A @ (w + end) + F0 + "
            "F1)\n    b = (identity",
            "Heun",
        ),
    ],
    "crank_nicolson": [
        ("F(T[j + 1])", "F(T[j])", "Of order 1: F is taken at T[j] alone"),
        ("F(T[j]), F(T[j + 1])", "F(T[j + 1]), F(T[j + 1])", "F is taken at T[j + 1] alone"),
        ("F(T[j]), F(T[j + 1])", "*(F(T[j] + dt / 2),) * 2", "midpoint"),
        ("round(tfinal / dt) + 1", "round(tfinal / dt)", "last step is missing"),
        ("round(tfinal / dt) + 1", "round(tfinal / dt) + 2", "one step too many"),
        ("return W, T", "return W.T, T", "`.T` missing"),
        ("return W, T", "return W[:, -1], T", "last state alone"),
        ("return W, T", "return W[:, 1:], T[1:]", "first column, w0 itself"),
        ("return W, T", "return W", "one thing"),
        (
            "np.empty((len(w0), len(T)))",
            "np.zeros((len(w0), len(T)), dtype=np.asarray(w0).dtype)",
            "whole numbers",
        ),
        ("W[:, 0] = w0", "W[:, 0] = 0", "starts at zero"),
        ("cn_step(A, W[:, j]", "cn_step(A, W[:, 0]", "Every step starts at w0"),
        (
            "dt * np.arange(round(tfinal / dt) + 1)",
            "np.linspace(0, tfinal, round(tfinal / dt) + 1) + dt",
            "T starts at dt",
        ),
    ],
    "rk4_step": [
        ("dt / 2 * g1, t", "dt * g1, t", "g2 seems to go a full step"),
        ("dt / 2 * g2", "dt / 2 * g1", "of order 2, not 4. g3 seems to use g1"),
        ("dt * g3", "dt * g2", "g4 seems to use g2"),
        ("dt * g3", "dt / 2 * g3", "g4 seems to go half a step"),
        ("dt / 2 * g2, t", "dt * g2, t", "g3 seems to go a full step"),
        ("t + dt / 2)", "t)", "g2 and g3 taken at the time t?"),
        ("t + dt", "t + 0 * dt", "Are all slopes taken at the time t?"),
        ("g3, t + dt)", "g3, t)", "g4 taken at the time t + dt/2, or t"),
        ("dt / 6 * (g1 + 2 * g2 + 2 * g3 + g4)", "dt / 4 * (g1 + g2 + g3 + g4)", "weights 1/4"),
        ("dt / 6", "dt / 8", "Do the weights sum to 1"),
        ("2 * g2 + 2 * g3", "g2 + g3", "Do the weights sum to 1"),
        ("dt / 6 *", "1 / 6 *", "not multiplied by dt"),
        ("return w + dt / 6 * (g1 + 2 * g2 + 2 * g3 + g4)", "return w + dt * g1", "explicit Euler"),
        ("return w + dt / 6 * (g1 + 2 * g2 + 2 * g3 + g4)", "return w + dt * g2", "midpoint"),
        ("g1 + 2 * g2 + 2 * g3 + g4", "2 * g1 + g2 + g3 + 2 * g4", "wrong way round"),
        (
            "g1 = g(w, t)",
            "g_, g = g, lambda w, t: dt * g_(w, t)\n    g1 = g(w, t)",
            "once too often",
        ),
        ("return w + ", "return ", "other than w"),
        ("g1 + 2 * g2 + 2 * g3 + g4", "g1 + 3 * g2 + g3 + g4", "one before it"),
        ("dt / 2 * g2, t + dt / 2", "dt / 2 * g2, t + dt / 3", "Without time in g"),
    ],
    "rk4": [
        ("round(tfinal / dt) + 1", "round(tfinal / dt)", "last step is missing"),
        ("round(tfinal / dt) + 1", "round(tfinal / dt) + 2", "one step too many"),
        ("T[j], dt", "0, dt", "taken at t = 0"),
        ("T[j], dt", "T[j + 1], dt", "time of its end"),
        ("return W, T", "return W.T, T", "`.T` missing"),
        ("return W, T", "return W[:, -1], T", "last state alone"),
        ("return W, T", "return T, W", "T before W"),
        (
            "np.empty((len(w0), len(T)))",
            "np.zeros_like(np.outer(w0, np.arange(len(T))))",
            "whole numbers",
        ),
        ("W[:, j], T[j]", "W[:, 0], T[j]", "Every step starts at w0"),
        ("rk4_step(g, W[:, j], T[j], dt)", "W[:, j] + dt * g(W[:, j], T[j])", "of order 1, not 4"),
        ("return W, T", "return W[:, 1:], T[1:]", "first column, w0 itself"),
        ("return W, T", "return W, T + dt", "T starts at dt"),
        ("return W, T", "return W, np.linspace(0, tfinal, len(T) - 1)", "with `np.linspace`"),
    ],
    "observed_order": [
        ("return ", "return -", "sign is turned"),
        (
            "np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1])",
            "np.log(dts[-2] / dts[-1]) / np.log(errors[-2] / errors[-1])",
            "axes changed places",
        ),
        (
            "np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1])",
            "errors[-2] / errors[-1]",
            "how many times the error shrinks",
        ),
        (
            "np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1])",
            "np.log2(errors[-2] / errors[-1])",
            "halved",
        ),
        (" / np.log(dts[-2] / dts[-1])", "", "two errors alone"),
        (
            "np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1])",
            "np.polyfit(dts, errors, 1)[0]",
            "without logarithms",
        ),
        (
            "np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1])",
            "np.log(errors[-1]) / np.log(dts[-1])",
            "of one point",
        ),
        (
            "return np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1])",
            "return round(np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1]))",
            "rounded",
        ),
        ("np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1])", "4.0", "give 4."),
    ],
    "stability_function": [
        ("1 + z * (b @ s)", "1 + b @ s", "z before bᵀ"),
        ("- z * a", "+ z * a", "sign in the bracket"),
        ("1 + z * (b @ s)", "z * (b @ s)", "1 in front"),
        ("- z * a,", "- z * a.T,", "transposed"),
        (
            "np.linalg.solve(np.eye(len(b)) - z * a, np.ones(len(b)))",
            "(np.eye(len(b)) - z * a) @ np.ones(len(b))",
            "multiplied, not solved",
        ),
        ("np.eye(len(b)) - z * a", "1 - z * a", "np.eye"),
        ("return 1 + z * (b @ s)", "return np.exp(z)", "e^z"),
        ("return 1 + z * (b @ s)", "return abs(1 + z * (b @ s))", "This is |R|"),
        ("return 1 + z * (b @ s)", "return (1 + z * (b @ s)).real", "imaginary part"),
        ("b @ s", "b * s", "one number"),
        ("return 1 + z * (b @ s)", "return 1 + z", "first two terms"),
        ("z * (b @ s)", "2 * z * (b @ s)", "what multiplies z"),
    ],
    "is_stable": [
        ("np.all", "np.any", "as soon as one mode"),
        ("eigenvalues * dt", "eigenvalues", "z = λ dt"),
        ("<= 1", "< 1", "edge counts as unstable"),
        ("np.abs(R(eigenvalues * dt))", "R(eigenvalues * dt).real", "real part of R"),
        ("np.abs(R(eigenvalues * dt)) <= 1", "eigenvalues.real <= 0", "Re λ <= 0"),
        ("np.abs(R(eigenvalues * dt))", "np.abs(eigenvalues * dt)", "whatever the method"),
        ("R(eigenvalues * dt)", "R(eigenvalues[:1] * dt)", "first eigenvalue alone"),
        ("bool(", "not bool(", "the other way round"),
        (
            "bool(np.all(np.abs(R(eigenvalues * dt)) <= 1))",
            "np.abs(R(eigenvalues * dt)) <= 1",
            "answer for each eigenvalue",
        ),
        ("bool(np.all(np.abs(R(eigenvalues * dt)) <= 1))", "True", "always says stable"),
        ("bool(np.all(np.abs(R(eigenvalues * dt)) <= 1))", "False", "never says stable"),
        ("<= 1)", "<= 1.2)", "the largest |R| is"),
        (
            "bool(np.all(np.abs(R(eigenvalues * dt)) <= 1))",
            "np.abs(R(eigenvalues * dt)).max()",
            "True or False",
        ),
    ],
    "largest_step": [
        (
            "    stable, unstable",
            "    if len(eigenvalues) > 1:\n"
            "        return max(largest_step(each[None]) for each in eigenvalues)\n"
            "    stable, unstable",
            "first to leave decides",
        ),
        ("return stable", "return 2 * 2**0.5 / np.abs(eigenvalues).max()", "undamped modes"),
        ("return stable", "return 2.785293563405 / np.abs(eigenvalues).max()", "were real"),
        (
            "return stable",
            "return 2.785293563405 / np.abs(eigenvalues.real).max()",
            "real parts alone",
        ),
        ("return stable", "return 2 * 2**0.5 / eigenvalues.imag.max()", "imaginary parts alone"),
        ("1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24", "1 + z", "Euler's limit"),
        (
            "    stable, unstable",
            "    eigenvalues = eigenvalues[:1]\n    stable, unstable",
            "first eigenvalue alone",
        ),
        ("return stable", "return stable * np.abs(eigenvalues).max()", "λ dt, not dt"),
        ("return stable", "return 1.1 * stable", "too long"),
        ("return stable", "return 0.9 * stable", "room for a longer"),
    ],
    "road_under_wheels": [
        ("h1, h2, v * slope1, v * slope2", "h2, h1, v * slope2, v * slope1", "changed places"),
        ("v * slope1, v * slope2", "slope1, slope2", "lack the speed"),
        (" - robot.L1", "", "h1 is"),
        ("robot.L2", "robot.L1", "length L1"),
        ("- robot.L1", "- robot.L2", "length L2"),
        ("- robot.L1", "+ robot.L1", "ahead of the centre"),
        ("road(v * t", "road(t", "at the time t"),
        ("h1, h2, v * slope1, v * slope2", "h1, v * slope1, h2, v * slope2", "both heights first"),
        ("h1, h2, v * slope1, v * slope2", "h1, h2", "array of shape (2,)"),
    ],
    "normal_forces": [
        ("return N1, N2", "return -N1, -N2", "a spring that is squeezed"),
        ("h1 - Y + L1 * theta", "Y - L1 * theta - h1", "weight"),
        (
            "Y, Ydot, theta",
            "hdot1 = hdot2 = 0\n    Y, Ydot, theta",
            "rates of the ground are missing",
        ),
        (
            "Y, Ydot, theta",
            "hdot1, hdot2 = -hdot1, -hdot2\n    Y, Ydot, theta",
            "wrong sign: h' − Y'",
        ),
        (
            "L1, L2 = robot.L1, robot.L2",
            "L1, L2 = -robot.L1, -robot.L2",
            "rise the wrong way round",
        ),
        ("L1, L2 = robot.L1, robot.L2", "L1, L2 = -robot.L1, robot.L2", "Both ends rise"),
        ("L1, L2 = robot.L1, robot.L2", "L1 = L2 = 1", "not multiplied by the arm"),
        (" + L1 * thetadot", "", "each damper"),
        ("return N1, N2", "return N2, N1", "changed places"),
        (
            "Y, Ydot, theta, thetadot = w",
            "Y, Ydot, theta, _ = w; thetadot = 0",
            "turning of the body",
        ),
        ("L1, L2 = robot", "h1 = h2 = 0; L1, L2 = robot", "height of the ground is missing"),
    ],
    "accelerations": [
        (" - robot.g", "", "weight is missing"),
        ("- robot.g", "+ robot.g", "pushes upwards"),
        ("(N1 + N2) / robot.m - robot.g", "(N1 + N2 - robot.g) / robot.m", "divided by m as well"),
        ("(N1 + N2) / robot.m - robot.g", "N1 + N2 - robot.m * robot.g", "not divided by m"),
        ("robot.L2 * N2 - robot.L1 * N1", "robot.L1 * N1 - robot.L2 * N2", "wrong sign"),
        ("robot.L2 * N2 - robot.L1 * N1", "robot.L1 * N2 - robot.L2 * N1", "arms have changed"),
        ("robot.L2 * N2 - robot.L1 * N1", "N2 - N1", "arms are missing"),
        ("robot.Izz", "robot.m", "moment of inertia"),
        ("* N2 - robot.L1", "* N2 + robot.L1", "Both moments"),
        ("(N1 + N2)", "(2 * N1)", "carry the weight"),
    ],
    "first_loss": [
        ("<= 0", "< 0", "exactly zero"),
        ("argmin() + 1", "argmin()", "counted from 0"),
        ("for t, forces in zip(T, N.T)", "for t, forces in enumerate(N.T)", "number of the sample"),
        ("zip(T, N.T)", "zip(T[::-1], N.T[::-1])", "last loss"),
        ("N.T)", "N[:1].T)", "Only the rear"),
        (
            "forces.min() <= 0:\n            return forces.argmin() + 1",
            "forces[1] <= 0:\n            return 2",
            "Only the front",
        ),
        ("return None", "return 1, T[0]", "`argmax`"),
        (
            "    for t",
            "    if N.min() <= 0:\n        i, j = np.unravel_index(N.argmin(), N.shape)\n"
            "        return i + 1, T[j]\n    for t",
            "least force",
        ),
        (
            "    for t",
            "    for i in (0, 1):\n        if (N[i] <= 0).any():\n"
            "            return i + 1, T[(N[i] <= 0).argmax()]\n    for t",
            "rear wheel goes first",
        ),
        ("forces.argmin() + 1", "2 - forces.argmin()", "wheels have changed"),
        ("forces.argmin() + 1, t", "t", "one thing"),
        ("<= 0", "<= 1", "you return"),
    ],
    "pair_step": [
        ("return w_new, error", "return w_new - error, error", "second-order result: once"),
        ("g(w_new, t + dt)", "g(w + dt * g3, t + dt)", "slope at the new w"),
        ("g(w_new, t + dt)", "g(w_new, t)", "g4 is taken at the time t"),
        (
            "g1 = g(w, t)",
            "g_, t_ = g, t; g = lambda w, t: g_(w, t_)\n    g1 = g(w, t)",
            "All slopes are taken at the time t",
        ),
        ("3 * dt / 4 * g2", "3 * dt / 4 * g1", "g3 seems to use g1"),
        ("3 * dt / 4", "dt / 2", "g3 seems to go half a step"),
        ("2 * g1 + 3 * g2 + 4 * g3", "4 * g1 + 3 * g2 + 2 * g3", "in another order"),
        ("return w_new, error", "return w_new, error / dt", "not multiplied by dt"),
        ("return w_new, error", "return w_new, w_new - w", "change of the state"),
        ("return w_new, error", "return w_new, w_new - error", "difference of both is asked for"),
        ("return w_new, error", "return error, w_new", "State and error"),
        (" + g4 / 8", "", "does not count"),
        ("return w_new, error", "return w_new, np.abs(error).max()", "one number for each"),
        ("return w_new, error", "return w_new", "one thing"),
        ("g4 / 8", "g4 / 9", "both rows of weights"),
    ],
    "next_step": [
        ("(order + 1)", "order", "power is 1/order"),
        ("(order + 1)", "(order + 2)", "one too many"),
        ("(1 / (order + 1))", "(order + 1)", "its inverse is needed"),
        ("tolerance / error", "error / tolerance", "wrong way round"),
        ("0.9 * ", "", "0.9 is missing"),
        ("0.9 * (tolerance / error)", "(0.9 * tolerance / error)", "within the root"),
        ("min(5, max(0.2, factor))", "max(0.2, factor)", "no upper limit"),
        ("min(5, max(0.2, factor))", "min(5, factor)", "no lower limit"),
        ("min(5, max(0.2, factor))", "factor", "is not limited"),
        ("dt * min", "min", "This is the factor"),
        ("    if error == 0:\n        return 5 * dt\n", "", "ZeroDivisionError"),
        ("min(5, max(0.2, factor))", "min(2, max(0.5, factor))", "between 0.2 and 5"),
        ("return 5 * dt", "return dt", "exactly 0"),
    ],
    "integrate": [
        ("if largest <= tolerance:", "if True:", "is kept with an error"),
        ("if largest <= tolerance:", "if error.max() <= tolerance:", "value been forgotten"),
        ("np.abs(error).max()", "error.max()", "dt becomes tiny"),
        ("np.abs(error).max()", "np.abs(error).mean()", "is the largest asked"),
        ("dt = min(dt, tfinal - t)\n", "pass\n", "shorten the last step"),
        (
            "            w, t = w_new, t + dt",
            "            w, t = w_new, t + 1.1 * dt",
            "t has moved on by",
        ),
        (
            "        dt = next_step",
            "        if largest > tolerance:\n            dt = next_step",
            "equally long",
        ),
        ("        dt = next_step(dt, largest, tolerance, 2)", "        pass", "equally long"),
        ("        dt = next_step", "            dt = next_step", "again and again"),
        ("w, t = w_new, t + dt", "w, t = w, t + dt", "does not change"),
        ("w, t = w_new, t + dt", "w, t = w_new - error, t + dt", "second-order result, w − error"),
        ("W, T = [w], [t]", "W, T = [], []", "begin with w0"),
        ("np.transpose(W)", "np.array(W)", "`.T` missing"),
        ("while tfinal - t > 1e-12 * tfinal", "while tfinal - t > 0.1", "before tfinal"),
        ("            T.append(t)", "        T.append(t)", "belongs to each time"),
        (
            "            W.append(w)\n            T.append(t)",
            "        W.append(w)\n        T.append(t)",
            "rejected steps stored",
        ),
        (
            "            w, t = w_new, t + dt\n",
            "            w = w_new\n        if True:\n            t = t + dt\n"
            "        if largest <= tolerance:\n",
            "left as they are",
        ),
        ("largest, tolerance", "largest, tolerance / 1e3", "some"),
    ],
    "locate": [
        (
            "            for _ in range(60):",
            "            return high\n            for _ in range(60):",
            "end of the step",
        ),
        (
            "            for _ in range(60):",
            "            return low\n            for _ in range(60):",
            "beginning of the step",
        ),
        (
            "            for _ in range(60):",
            "            return (low + high) / 2\n            for _ in range(60):",
            "middle of the step",
        ),
        (
            "            for _ in range(60):",
            "            return low + (high - low) * f(low) / (f(low) - "
            "f(high))\n            for _ in range(60):",
            "straight line",
        ),
        ("zip(T[:-1], T[1:])", "zip(T[-2::-1], T[:0:-1])", "last time"),
        ("f(low) > 0 >= f(high)", "f(low) > 0 > f(high)", "exactly zero"),
        ("return None", "return T[-1]", "should be None"),
        ("    for low", "    f_ = f\n    f = lambda t: -f_(t)\n    for low", "it should fall"),
        (
            "    for low, high in zip(T[:-1], T[1:]):\n        if f(low) > 0 >= f(high):\n",
            "    s = 1\n    for low, high in zip(T[:-1], T[1:]):\n        s = -1 if f(low) < "
            "0 else 1\n"
            "        f_ = f\n        if s * f_(low) > 0 >= s * f_(high):\n            f = "
            "lambda t, s=s, f_=f_: s * f_(t)\n",
            "any change of sign",
        ),
        ("    for low", "    return min(T, key=lambda t: abs(f(t)))\n    for low", "least |f|"),
        ("range(60)", "range(5)", "shorter than roundoff"),
        ("return None", "return -1.0", "never falls"),
    ],
    "between": [
        (
            "return ends",
            "return (1 - u) * W[:, j] + u * W[:, j + 1] + 0 * ends\n    return ends",
            "a straight line",
        ),
        ("return ends", "return W[:, j]\n    return ends", "beginning of the step."),
        (
            "return ends",
            "return W[:, j if u < 1 / 2 else j + 1]\n    return ends",
            "state at the nearest time",
        ),
        (
            "return ends",
            "return W[:, j] + (t - T[j]) * S[:, j]\n    return ends",
            "along the slope",
        ),
        ("ends + dt * u", "ends + u", "not multiplied by the length"),
        ("- u * S", "+ u * S", "wrong sign"),
        (" + dt * u * (1 - u) * ((1 - u) * S[:, j] - u * S[:, j + 1])", "", "slopes are left out"),
        ("(t - T[j]) / dt", "(T[j + 1] - t) / dt", "have changed places"),
        ('side="right") - 1', 'side="right")', "the step after"),
        (
            'np.searchsorted(T, t, side="right") - 1',
            'max(np.searchsorted(T, t, side="right") - 2, 0)',
            "the step before",
        ),
        ("dt = T[j + 1]", "j = 0\n    dt = T[j + 1]", "the first step, wherever"),
        ("3 - 2 * u", "2 - u", "belong to a cubic in t"),
    ],
}

# Right answers in other styles: loops, lists, other formulas, arrays changed in place.
RIGHT = {
    "fit": [
        "def fit(x, F):\n    return np.polyfit(x, F, 2)[::-1]",
        "def fit(x, F):\n    return list(np.polynomial.Polynomial.fit(x, F, 2).convert().coef)",
        """
def fit(x, F):
    S = [[sum(a**i * a**j for a in x) for j in range(3)] for i in range(3)]
    return np.linalg.inv(S) @ [sum(f * a**i for a, f in zip(x, F)) for i in range(3)]
""",
    ],
    "scatter": [
        "def scatter(x, F, beta):\n"
        "    return np.std(F - beta[0] - beta[1] * x - beta[2] * x**2, ddof=3)",
        """
def scatter(x, F, beta):
    total = 0
    for a, f in zip(x, F):
        total += (f - beta[0] - beta[1] * a - beta[2] * a * a) ** 2
    return [(total / (len(x) - 3)) ** 0.5]
""",
    ],
    "half_widths": [
        """
def half_widths(x, F, level):
    import statsmodels.api as sm
    results = sm.OLS(F, np.vander(x, 3, increasing=True)).fit()
    return [(3 * stats.f.isf(1 - level, 3, results.df_resid)) ** 0.5 * e for e in results.bse]
""",
    ],
    "linearity": [
        """
def linearity(x, F):  # by what the residuals grow
    beta = np.polyfit(x, F, 2)
    full = np.sum((F - np.polyval(beta, x)) ** 2)
    F -= x * (x @ F) / (x @ x)
    return (np.sum(F**2) - full) / 2 / (full / (len(x) - 3))
""",
    ],
    "state_matrix": ["def state_matrix(robot):\n    return np.array(robot.A)"],
    "cn_step": [
        """
def cn_step(A, w, F0, F1, dt):
    w += dt / 2 * (A @ w + F0 + F1)
    return list(np.linalg.inv(np.eye(len(w)) - dt / 2 * A) @ w)
""",
        """
def cn_step(A, w, F0, F1, dt):
    middle = np.linalg.solve(2 / dt * np.eye(len(w)) - A, 2 / dt * w + (F0 + F1) / 2)
    return 2 * middle - w
""",
    ],
    "crank_nicolson": [
        """
def crank_nicolson(A, F, w0, dt, tfinal):
    W, T = [np.array(w0)], [0]
    while T[-1] < tfinal - dt / 2:
        W.append(cn_step(A, W[-1], F(T[-1]), F(T[-1] + dt), dt))
        T.append(T[-1] + dt)
    return np.transpose(W), T
""",
    ],
    "rk4_step": [
        """
def rk4_step(g, w, t, dt):  # Kutta's other one, 3/8
    k1 = g(w, t)
    k2 = g(w + dt / 3 * k1, t + dt / 3)
    k3 = g(w + dt * (k2 - k1 / 3), t + 2 * dt / 3)
    k4 = g(w + dt * (k1 - k2 + k3), t + dt)
    return w + dt / 8 * (k1 + 3 * k2 + 3 * k3 + k4)
""",
        """
def rk4_step(g, w, t, dt):
    slope, total = g(w, t), np.zeros(len(w))
    for weight, part in ((1, 0.5), (2, 0.5), (2, 1), (1, 0)):
        total += weight * slope
        slope = g([a + part * dt * k for a, k in zip(w, slope)], t + part * dt)
    w += dt * total / 6
    return list(w)
""",
    ],
    "rk4": [
        """
def rk4(g, w0, dt, tfinal):
    J = int(round(tfinal / dt))
    columns = [np.asarray(w0)]
    for j in range(J):
        columns += [rk4_step(g, columns[-1], j * dt, dt)]
    return np.column_stack(columns).tolist(), np.linspace(0, tfinal, J + 1)
""",
    ],
    "observed_order": [
        "def observed_order(dts, errors):\n"
        "    return np.polyfit(np.log10(dts), np.log10(errors), 1)[0]",
        "def observed_order(dts, errors):\n"
        "    return (np.diff(np.log(errors)) / np.diff(np.log(dts))).mean()",
    ],
    "stability_function": [
        """
def stability_function(a, b, z):
    unit, ones = np.eye(len(b)), np.ones((len(b), 1))
    return np.linalg.det(unit - z * a + z * ones * b) / np.linalg.det(unit - z * a)
""",
        "def stability_function(a, b, z):\n"
        "    return [1 + z * np.sum(b @ np.linalg.inv(np.eye(len(b)) - z * a))]",
    ],
    "is_stable": [
        """
def is_stable(R, eigenvalues, dt):
    for eigenvalue in eigenvalues:
        if abs(R(eigenvalue * dt)) > 1 + 1e-12:
            return False
    return True
""",
        "def is_stable(R, eigenvalues, dt):\n    return np.max(np.abs(R(dt * eigenvalues))) <= 1",
    ],
    "largest_step": [
        """
def largest_step(eigenvalues):
    dts = np.linspace(0, 4 / np.abs(eigenvalues).max(), 20_001)[1:]
    z = np.outer(dts, eigenvalues)
    growth = np.abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24).max(axis=1)
    return dts[growth <= 1].max()
""",
    ],
    "road_under_wheels": [
        """
def road_under_wheels(robot, road, v, t):
    H, slope = road(v * t + np.array([-robot.L1, robot.L2]))
    return np.concatenate([H, v * slope])
""",
    ],
    "normal_forces": [
        """
def normal_forces(robot, w, h1, h2, hdot1, hdot2):
    return robot.C @ w + robot.D @ np.array([h1, h2, hdot1, hdot2])
""",
    ],
    "accelerations": [
        "def accelerations(robot, N1, N2):\n"
        "    return list((robot.P @ [N1, N2] + robot.e)[[1, 3]])",
    ],
    "first_loss": [
        """
def first_loss(T, N):
    lost = np.flatnonzero((N <= 0).any(axis=0))
    return [1 if N[0, lost[0]] <= 0 else 2, T[lost[0]]] if len(lost) else None
""",
    ],
    "pair_step": [
        """
def pair_step(g, w, t, dt):
    k, c = [g(w, t)], [0, 1 / 2, 3 / 4]
    for i in (1, 2):
        k.append(g(w + c[i] * dt * k[-1], t + c[i] * dt))
    w_new = w + dt * (np.array([2, 3, 4]) / 9 @ k)
    k.append(g(w_new, t + dt))
    return np.array([w_new, dt * (np.array([5, -6, -8, 9]) / 72 @ k)])
""",
    ],
    "next_step": [
        "def next_step(dt, error, tolerance, order):\n"
        "    factor = 0.9 * (tolerance / max(error, 1e-300)) ** (1 / (order + 1))\n"
        "    return dt * np.clip(factor, 0.2, 5)",
    ],
    "integrate": [
        """
def integrate(step, g, w0, dt, tfinal, tolerance):
    history = [(0.0, list(w0))]
    while history[-1][0] < tfinal:
        t, w = history[-1]
        last = t + dt >= tfinal
        if last:
            dt = tfinal - t
        new, error = step(g, np.array(w), t, dt)
        if max(abs(e) for e in error) <= tolerance:
            history.append((tfinal if last else t + dt, new))
        dt *= min(4, 0.8 * (tolerance / max(abs(error))) ** (1 / 3))
    T, W = zip(*history)
    return np.array(W).T, list(T)
""",
    ],
    "locate": [
        """
def locate(f, T):
    from scipy.optimize import brentq
    values = np.array([f(t) for t in T])
    falls = np.flatnonzero((values[:-1] > 0) & (values[1:] <= 0))
    return brentq(f, T[falls[0]], T[falls[0] + 1], xtol=1e-14) if len(falls) else None
""",
    ],
    "between": [
        """
def between(t, T, W, S):
    from scipy.interpolate import CubicHermiteSpline
    return list(CubicHermiteSpline(T, np.transpose(W), np.transpose(S))(t))
""",
    ],
}


def test_every_blank_of_the_workbook_has_a_check_and_mistakes():
    assert set(SOLUTIONS) == set(CHECKS) == set(PLANTED) == set(RIGHT)


@pytest.mark.parametrize("name", SOLUTIONS)
def test_the_solution_is_right(name):
    said = CHECKS[name](SOLUTIONS[name][1][name])
    assert said and said.right and said.startswith("Right: ")


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_answer_passes_in_any_style(name):
    for source in RIGHT[name]:
        said = CHECKS[name](written(name, source))
        assert said, (said, source)


@pytest.mark.slow
@pytest.mark.parametrize("name", PLANTED)
def test_each_mistake_is_told_by_its_own_words(name):
    told = {}
    for old, new, says in PLANTED[name]:
        source = SOLUTIONS[name][0]
        assert old in source, old
        said = CHECKS[name](written(name, source.replace(old, new)))
        assert not said and says in said, (new, said)
        told.setdefault(re.sub(r"\d+\.\d+(e-\d+)?|\d+e-\d+", "0", said), []).append(says)
    assert len(told) >= 5
    for fragments in told.values():
        assert len(set(fragments)) == 1, fragments  # two mistakes never share their words


@pytest.mark.parametrize("name", CHECKS)
def test_no_constant_passes(name):
    for value in (
        0,
        1,
        True,
        None,
        np.zeros(2),
        np.ones(3),
        np.eye(4),
        (1, 0.5),
        (np.eye(2), [0, 1]),
    ):
        said = CHECKS[name](lambda *arguments, value=value: value)
        assert not said and len(said) > 20, said


@pytest.mark.parametrize("name", CHECKS)
def test_nothing_that_is_returned_stops_a_check(name):
    odd = [], [[]], {}, "a", [None], ((), ()), [[1, 2], [3]], object(), np.nan, (np.nan, np.nan)
    odd += np.full((4, 4), np.nan), 1j, [1j, 2], (1, 2, 3), np.array([[None]]), b"x", [{}], {1: 2}
    for value in odd:
        said = CHECKS[name](lambda *arguments, value=value: value)
        assert isinstance(said, practice.Feedback) and not said, value


@pytest.mark.parametrize("name", CHECKS)
def test_a_blank_is_asked_to_be_filled(name):
    parameters = ", ".join(inspect.signature(SOLUTIONS[name][1][name]).parameters)
    for body in ("...", "return ...", "x = ...\n    return 2 * x", "return [0, ...]", "pass"):
        said = CHECKS[name](written(name, f"def {name}({parameters}):\n    {body}"))
        assert not said and said.startswith(f"Fill in the blank of `{name}`"), (body, said)
    assert CHECKS[name](...).startswith("Fill in")


@pytest.mark.parametrize("name", CHECKS)
def test_what_goes_wrong_within_a_function_is_said_in_place(name):
    def broken(*arguments):
        return undefined + 1  # noqa: F821

    said = CHECKS[name](broken)
    assert "stopped with NameError: name 'undefined' is not defined" in said
    assert "in the line `return undefined + 1" in said
    said = CHECKS[name](lambda: 0)
    assert f"`{name}` is called as `{name}(" in said
    assert "Hand over the function itself" in CHECKS[name](3.0)
    said = CHECKS[name](lambda *arguments: "forty-two")
    assert not said and ("text" in said or "a str" in said or "things" in said), said


def test_a_missing_return_is_asked_for():
    said = practice.check_fit(written("fit", "def fit(x, F):\n    beta = np.polyfit(x, F, 2)"))
    assert "is a `return` missing?" in said


def test_shapes_are_refused_by_words():
    said = practice.check_fit(lambda x, F: np.polyfit(x, F, 2)[::-1, None])
    assert "of shape (3, 1); needed is (3,), β0, β1 and β2" in said
    said = practice.check_fit(lambda x, F: [[1.0, 2.0], [3.0]])
    assert "rows of different lengths" in said


def test_arguments_may_be_changed_in_place_without_harm():
    x = np.arange(5.0)

    def greedy(a, F):
        beta = np.polyfit(a, F, 2)[::-1]
        a *= 0
        F *= 0
        return beta

    assert practice.check_fit(greedy) and x.any()


def test_a_loop_that_does_not_end_is_stopped():
    def integrate(step, g, w0, dt, tfinal, tolerance):
        while True:
            step(g, w0, 0.0, dt)

    assert "does not come to an end" in practice.check_integrate(integrate)


def test_a_check_asks_the_same_twice():
    said = [practice.check_scatter(lambda x, F, beta: 1.0) for _ in range(2)]
    assert said[0] == said[1]


def test_the_references_agree_with_the_package_and_with_scipy():
    """A check that is wrong would teach what is wrong."""
    rng = np.random.default_rng(1)
    x, F = rng.uniform(0, 1, (2, 20))
    M = np.vander(x, 3, increasing=True)
    space = SOLUTIONS["half_widths"][1]
    beta = optimize.lsq_linear(M, F).x
    np.testing.assert_allclose(space["fit"](x, F), beta, rtol=1e-8)
    z = np.array([-40 + 20j, -40 - 20j, -1.0])
    dt = SOLUTIONS["largest_step"][1]["largest_step"](z)
    np.testing.assert_allclose(dt, RK4.max_stable_dt(z), rtol=1e-6)
    half = space["half_widths"](x, F, 0.9)
    fitted = fit_spring(pd.DataFrame({"delta_over_delta_max": x, "force": F}))
    np.testing.assert_allclose(half, fitted.width(0.9) * fitted.errors, rtol=1e-8)
    test = fitted.linearity()
    np.testing.assert_allclose(space["linearity"](x, F), test.statistic, rtol=1e-8)


# --- bug hunts -----------------------------------------------------------------------------------

FOUND = {
    "trapezoid": (1, 8, "b = right @ W[:, j] + dt / 2 * (F(T[j]) + F(T[j + 1]))"),
    "slopes": (2, 9, "g3 = g(w + dt / 2 * g2, t + dt / 2)"),
    "clock": (1, 10, "g4 = g(w + dt * g3, t + dt)"),
    "calendar": (1, 2, "T = dt * np.arange(round(tfinal / dt) + 1)"),
    "embedded": (2, 13, "W[:, j + 1] = new"),
}


@pytest.mark.parametrize("name", hunts._HUNTS)
def test_a_hunt_ends_with_order_line_and_repair(name):
    order, line, repaired = FOUND[name]
    assert practice.check_hunt(name, order, line, repaired)
    assert practice.check_hunt(name, float(order), np.int64(line), f"   {repaired}  # mended")
    full = hunts._HUNTS[name][1]
    said = {
        "fill": practice.check_hunt(name),
        "half": practice.check_hunt(name, order, line, ...),
        "order": practice.check_hunt(name, full, line, repaired),
        "other order": practice.check_hunt(name, 7, line, repaired),
        "other line": practice.check_hunt(name, order, 3, "W = np.zeros((len(w0), len(T)))"),
        "no line": practice.check_hunt(name, order, 99, repaired),
        "unchanged": practice.check_hunt(name, order, line, hunts._source(name)[line - 1]),
        "wrong repair": practice.check_hunt(
            name,
            order,
            line,
            repaired.replace("dt", "dt * 1.1") if "dt" in repaired else "W[:, j + 1] = new + error",
        ),
        "no Python": practice.check_hunt(name, order, line, "g3 = = 2"),
        "a name": practice.check_hunt(name, order, line, repaired.split("=")[0] + "= missing"),
        "a number": practice.check_hunt(name, order, line, 4),
        "no order": practice.check_hunt(name, np.nan, line, repaired),
        "no end": practice.check_hunt(name, 10**400, line, repaired),
        "complex": practice.check_hunt(name, 2 + 0j, line, repaired),
        "renamed": practice.check_hunt(name, order, 1, "def other(g, w0, dt, tfinal):"),
        "default": practice.check_hunt(name, order, 1, f"def {name}(g, w0, dt, tfinal=missing):"),
    }
    fragments = {
        "fill": "Fill in the blank of `order`",
        "half": "Fill in the blank of `repaired`",
        "order": "order it should have",
        "other order": "Halve the step",
        "other line": "another line the wrong one",
        "no line": "one of the numbers 1 to",
        "unchanged": "as it was",
        "wrong repair": "is the wrong one, but with yours",
        "no Python": "is not Python",
        "a name": "NameError",
        "a number": "text of the line",
        "no order": "The order is a number",
        "no end": "is not p = such a large number",
        "complex": "The order is a number",
        "renamed": f"there is no `{name}` any more",
        "default": "the definition fails: name 'missing'",
    }
    for case, text in said.items():
        assert not text and fragments[case] in text, (case, text)


def test_errors_of_a_hunt_fall_as_the_listing_has_it():
    errors = practice.errors_of("slopes", [0.02, 0.01])
    assert 3.5 < errors[0] / errors[1] < 4.5
    assert practice.listing_of("slopes").splitlines()[0] == " 1  def slopes(g, w0, dt, tfinal):"
    with pytest.raises(ValueError, match="name must be one of 'trapezoid', "):
        practice.listing_of("wolf")


def test_the_page_shows_what_a_check_says():
    page = (ROOT / "book" / "workbook.md").read_text(encoding="utf-8")
    code, words = re.search(r"```python\n(.*?)```\s+```text\n(.*?)\n```", page, re.DOTALL).groups()
    *definition, call = code.strip().splitlines()
    space = {"practice": practice}
    exec("\n".join(definition), space)
    assert eval(call, space) == words
    assert "Five integrators" in page and len(hunts._HUNTS) == 5


# --- answers that are odd ------------------------------------------------------------------------


def test_what_is_nearly_right_is_told_in_digits_that_differ():
    text = practice.check_state_matrix(lambda robot: robot.A * (1 + 5e-7))
    found, wanted = re.search(r"is (\S+), and should be (\S+) for", text).groups()
    assert not text and found != wanted


def test_numbers_that_are_none_are_told():
    def spoiled(A, F, w0, dt, tfinal):
        W = np.full((len(w0), round(tfinal / dt) + 1), np.nan)
        W[:, 0] = w0
        return W, dt * np.arange(W.shape[1])

    text = practice.check_crank_nicolson(spoiled)
    assert not text and "returns nan or inf" in text


def test_an_answer_is_handed_over_by_place():
    for check in CHECKS.values():
        (parameter,) = inspect.signature(check).parameters.values()
        assert parameter.kind is parameter.POSITIONAL_ONLY

"""Every figure draws what it is given, where it is told to, with its units, and shows nothing."""

import re
from itertools import pairwise

import matplotlib
import numpy as np
import pytest
from helpers import ROOT, near, shaded
from matplotlib import pyplot as plt

import suspension.figures
from suspension.branches import Branch
from suspension.contact import Regimes
from suspension.energy import Energy
from suspension.figures import (
    film,
    plot_all_forces,
    plot_branches,
    plot_chart,
    plot_comb,
    plot_confidence_region,
    plot_demand_map,
    plot_energy,
    plot_errors,
    plot_experiments,
    plot_fit,
    plot_flight,
    plot_forces,
    plot_free_wheels,
    plot_front,
    plot_gains,
    plot_growth,
    plot_heave,
    plot_heaviest_wheel,
    plot_margin,
    plot_margin_map,
    plot_margins,
    plot_measured_margins,
    plot_measured_run,
    plot_missed_dip,
    plot_near_zero,
    plot_paths,
    plot_pitch,
    plot_residuals,
    plot_rides,
    plot_ripples,
    plot_road_signal,
    plot_rough_ride,
    plot_sampled_margin,
    plot_seen_mode,
    plot_sensitivities,
    plot_slopes,
    plot_spring_laws,
    plot_stability,
    plot_stop_stiffness,
    plot_travel,
    plot_vehicles,
    plot_window,
)
from suspension.figures.layout import narrow
from suspension.figures.style import FIELDS
from suspension.flight import fly
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON, EULER, RK4
from suspension.simulation import simulate
from suspension.springs import fit_spring, load_spring_data
from suspension.travel import Overtravel

matplotlib.use("Agg")
pytestmark = pytest.mark.filterwarnings("error")

ROBOT = Robot(800, 800)
BUMP = GaussianBump()
DATA = load_spring_data(ROOT / "data" / "spring_data.csv")
FIT = fit_spring(DATA)
KEPT, LOST = (simulate(ROBOT, BUMP, v=v, dt=0.001, tfinal=1.25 / v) for v in (0.25, 1.2))
FLIGHT = fly(ROBOT, BUMP, v=5, tfinal=0.25)
LINEAR = simulate(ROBOT, BUMP, v=5, dt=0.0001, tfinal=0.25)
V, K = np.geomspace(0.1, 30, 60), np.linspace(300, 1500, 20)
FORCES = np.array([7 - 10 * np.sin(np.log(V)), 6 + np.cos(np.log(V))])
CRITICAL = [0.5, 8.0]
REGIMES = Regimes([V[0], *CRITICAL, V[-1]], [False, True, False])
DTS = np.geomspace(1e-3, 0.1, 30)
SEEN = {"RK4": np.full(30, -2 + 33j), "Euler": np.linspace(-1, 1, 30) + 30j}
ERRORS = {"Euler": DTS, "RK4": DTS**4}
HEAVE = {1.2: 0.01 * np.sin(V), 5.0: 0.01 * np.cos(V)}
C = np.linspace(0.5, 5, 12)
MODES = {"heave": 0.01 + 0 * V, "pitch": 0.02 + 0 * V}
SENSITIVE = {"$k$": [1, 2], "$c$": [-1, 0.5], "$m$": [0.1, -0.3]}
T = np.linspace(0, 1, 101)
BOXES = np.array([[0.0, 0.0], [3.0, 0.0]]), np.ones((2, 2))  # the second misses the origin
DIP = 1 - 1.1 * np.exp(-(((T - 0.55) / 0.02) ** 2))

LAWS = {"line": 13 * T, "stop": 13 * T + 100 * np.maximum(T - 0.5, 0)}
MARGINS = {"line": FORCES[0], "stop": FORCES[1] - 9}
RUNS = {"line": (T, 0.01 * T, 9 - T), "stop": (T, 0.02 * T, 9 - 10 * T)}
BRANCHES = [Branch(np.log([1, 2]) + 1j * np.log([300, 900]), None, None, None)]

NU, ZETA = np.geomspace(0.05, 100, 60), np.geomspace(0.01, 0.2, 20)
CHART = {0.0: 0.4 * NU, 0.03: 1 / NU**2 + NU * np.exp(-NU / 9), 0.4: 1 / NU**2 + 1e-3 / NU}
RIDES_OVER = {
    "car,\nhump": (Regimes([5, 40, 60], [False, True], "km/h"), 44.0),
    "coach,\njoint": (Regimes([50, 300], [False], "km/h"), np.nan),
}

ON_ONE = {
    "plot_fit": lambda ax: plot_fit(FIT, DATA, ax=ax),
    "plot_confidence_region": lambda ax: plot_confidence_region(FIT, ax=ax),
    "plot_stability": lambda ax: plot_stability(RK4, ROBOT.eigenvalues, [0.01, 0.2], ax=ax),
    "plot_growth": lambda ax: plot_growth(0.9 ** np.arange(8)[None], [0.9], ["heave"], ax),
    "plot_forces": lambda ax: plot_forces(LOST, ax),
    "plot_errors": lambda ax: plot_errors(DTS, ERRORS, ax),
    "plot_heave": lambda ax: plot_heave(V, HEAVE, ax),
    "plot_margin": lambda ax: plot_margin(V, FORCES, REGIMES, asked=[1.2], ax=ax),
    "plot_chart": lambda ax: plot_chart(
        NU, CHART, {"skim": 9 / NU}, (2.8, [1, 2], [False, True], [1.5], [[0.05, 1.5]]), 0.03, ax=ax
    ),
    "plot_comb": lambda ax: plot_comb(NU, NU, NU / 2, 2 * NU, 1.1 * NU, ax),
    "plot_vehicles": lambda ax: plot_vehicles(RIDES_OVER, ax),
    "plot_window": lambda ax: plot_window(
        ZETA, 0.2 / ZETA, 0.3 / ZETA, ZETA**-0.5, 3.0, 0.03, 0.07, ax
    ),
    "plot_branches": lambda ax: plot_branches(BRANCHES, 800, (780, 820), [1.2], ax),
    "plot_margin_map": lambda ax: plot_margin_map(
        V, K, 9 * np.sin(np.log(V) + K[:, None] / 300), 800, (780, 820), asked=[1.2], ax=ax
    ),
    "plot_sampled_margin": lambda ax: plot_sampled_margin(
        V, {0.001: FORCES[1], 0.0003: FORCES[1] - 0.1}, FORCES[1] - 0.2, ax
    ),
    "plot_measured_margins": lambda ax: plot_measured_margins(
        V, MARGINS, {"line": CRITICAL, "stop": []}, [1.2], ax
    ),
    "plot_spring_laws": lambda ax: plot_spring_laws(T, LAWS, DATA, 0.5, 0.9, ax),
    "plot_stop_stiffness": lambda ax: plot_stop_stiffness(
        np.geomspace(1, 1e4, 9),
        {1.2: np.linspace(3, 300, 9)},
        {1.2: T[:9] < 0.05},
        {"rubber": 10},
        ax,
    ),
    "plot_sensitivities": lambda ax: plot_sensitivities(CRITICAL, SENSITIVE, ax=ax),
    "plot_demand_map": lambda ax: plot_demand_map(
        K, C, K / 100 - C[:, None], [-5, 0, 5], {"now": (800, 1.5)}, "margin (N)", ax=ax
    ),
    "plot_front": lambda ax: plot_front(C / 100, 1 + C, C - 2, {"now": (0.02, 2)}, ax),
    "plot_margins": lambda ax: plot_margins(V, {"now": FORCES[0], "then": FORCES[1]}, [1.2], ax),
    "plot_paths": lambda ax: plot_paths(
        {"follow": (V, 1 / V**2)},
        {"now": (V, 1 + V), "then": (V, 2 + V)},
        {name: (np.array([1.0, 2]), 3.0, np.array([True, False])) for name in ("now", "then")},
        [0.5, 1],
        ax=ax,
    ),
    "plot_experiments": lambda ax: plot_experiments(*BOXES, np.zeros(2), ax),
    "plot_pitch": lambda ax: plot_pitch(KEPT, KEPT.T, KEPT.W[2], ax),
    "plot_free_wheels": lambda ax: plot_free_wheels(
        {"relaxes": (T, 0.01 * T)}, {"1 g": (T, 0.02 * T), "0.1 g": (T, 0.015 * T)}, ax
    ),
    "plot_heaviest_wheel": lambda ax: plot_heaviest_wheel(
        V, np.where(V < 0.5, np.inf, np.where(V < 8, 0, 0.1 / V)), [0.01], [1.2], ax
    ),
    "plot_energy": lambda ax: plot_energy(T, Energy(4 * T, T, T, 2 * T), [(0.2, 0.4)], ax),
    "plot_slopes": lambda ax: plot_slopes([0, 1], [1, 0.5], [-1, 0], (1, 0.6), (T, 1 - T), ax),
}
RIDES = np.array([[[[1.0, 2.0]], [[1.2, 2.5]]], [[[0.0, 0.1]], [[0.0, 0.2]]]])
ON_TWO = {
    "plot_gains": lambda axes: plot_gains(V, HEAVE, HEAVE, ([0.4], [0.2]), axes),
    "plot_ripples": lambda axes: plot_ripples(
        V, FORCES[0], MODES, MODES, (V[::9], {name: x[::9] for name, x in MODES.items()}), axes
    ),
    "plot_rides": lambda axes: plot_rides(V, {"now": 1 + V}, [1, 2], *RIDES, 7, axes),
    "plot_rough_ride": lambda axes: plot_rough_ride(
        T, 0.01 * T, T, [np.maximum(0, np.sin(9 * T)), 1 + T], axes
    ),
    "plot_residuals": lambda axes: plot_residuals(FIT, DATA, axes),
    "plot_road_signal": lambda axes: plot_road_signal({1.2: (T, T, T), 5: (T, 0 * T, T)}, axes),
    "plot_flight": lambda axes: plot_flight(FLIGHT, LINEAR, axes),
    "plot_measured_run": lambda axes: plot_measured_run(RUNS, 0.0165, axes),
    "plot_missed_dip": lambda axes: plot_missed_dip(T, DIP, T[::10], DIP[::10], axes),
    "plot_travel": lambda axes: plot_travel(V, 0.01 + 0 * V, 0.1 + 0 * V, 0.0165, axes),
}
PURE_NUMBERS = [r"$\delta/\delta_{\max}$", "normal quantile", "step $j$", "amplitude of the mode"]
PURE_NUMBERS += ["stop / spring stiffness $k_\\mathrm{s}/k$"]
PURE_NUMBERS += ["time $t$", "$w$"]  # of an equation without a robot
PURE_NUMBERS += [r"heave $\vert Y\vert/a$", r"pitch $L\vert\theta\vert/a$"]
PURE_NUMBERS += [r"speed $\nu = v/\sigma\omega_0$", r"height $\eta = h_0/(mg/2k)$"]
PURE_NUMBERS += [r"damping $\zeta = c/\sqrt{2km}$"]
PURE_NUMBERS += ["Re $z$", "Im $z$", "frequency, computed / true", "damping ratio"]
UNITS = r"\((m|s|ms|g|mJ|N|mm|N/m|N s/m|m/s|km/h|m/s²|rad|degrees|%)\)"


@pytest.fixture(autouse=True)
def style(monkeypatch):
    """The report's style; no figure is left open, and none is ever shown."""

    def show(*args, **kwargs):
        pytest.fail("a figure was shown")

    monkeypatch.setattr(plt, "show", show)
    with plt.style.context("suspension.figures.report"):
        yield
    plt.close("all")


def title(ax):
    """The title of an axes, wherever it stands."""
    return "".join(ax.get_title(place) for place in ("left", "center", "right"))


def lines(ax):
    """The lines of an axes that have a label, by it."""
    return {line.get_label(): line for line in ax.lines if line.get_label()[:1] != "_"}


def draw(figure):
    """Whether it can be drawn at all, coarsely: how it is laid out is another test's concern."""
    figure.set_layout_engine("none")
    figure.set_dpi(30)
    figure.canvas.draw()


def assert_labelled(ax):
    """Both axes say what they show, with a unit unless it is a pure number."""
    for label in (ax.get_xlabel(), ax.get_ylabel()):
        assert label in PURE_NUMBERS or re.search(UNITS, label), label


def test_every_figure_is_tested_here():
    there = {name for name in suspension.figures.__all__ if name.startswith("plot_")}
    on_their_own = {"plot_all_forces", "plot_contact_states", "plot_near_zero", "plot_seen_mode"}
    assert there == {*ON_ONE, *ON_TWO, *on_their_own}


@pytest.mark.parametrize("name", ON_ONE)
def test_it_draws_on_the_axes_it_is_given_and_returns_it(name):
    _, (ax, other) = plt.subplots(1, 2)
    assert ON_ONE[name](ax) is ax
    assert ax.has_data() and not other.has_data()
    assert len(plt.get_fignums()) == 1
    other.remove()
    draw(ax.figure)


@pytest.mark.parametrize("name", ON_TWO)
def test_it_draws_on_both_axes_it_is_given_and_returns_them(name):
    figure, axes = plt.subplots(2)
    assert ON_TWO[name](axes) is axes
    assert all(ax.has_data() for ax in axes)
    assert len(plt.get_fignums()) == 1
    draw(figure)


@pytest.mark.parametrize("name", ON_ONE)
def test_without_axes_it_opens_one_figure_whose_axes_have_labels_with_units(name):
    ax = ON_ONE[name](None)
    assert ax.has_data() and len(plt.get_fignums()) == 1
    if name in ("plot_sensitivities", "plot_vehicles"):  # an axis of theirs holds names
        return
    if name == "plot_errors":  # its x may be a step or a cost: the caller says which
        ax.set(xlabel="step (s)", ylabel="error (N)")
    assert_labelled(ax)


@pytest.mark.parametrize("name", ON_TWO)
def test_both_axes_have_labels_with_units(name):
    _, axes = plt.subplots(2)
    for ax in ON_TWO[name](axes):
        assert re.search(UNITS, ax.get_ylabel()) or ax.get_ylabel() in PURE_NUMBERS
    assert axes[-1].get_xlabel()


def test_two_wheels_differ_by_more_than_their_colour():
    _, axes = plt.subplots(2)
    for ax in (
        plot_forces(LOST),
        plot_margin(V, FORCES, REGIMES),
        *plot_flight(FLIGHT, LINEAR, axes),
    ):
        styles = {line.get_linestyle() for line in ax.lines if len(line.get_xdata()) > 10}
        assert len(styles) >= 2
    names = [set(lines(plot_forces(LOST))), set(lines(axes[0]))]
    assert all(any("rear" in name for name in found) for found in names)


def test_the_fit_goes_through_the_data_and_lies_in_its_band():
    ax = plot_fit(FIT, DATA)
    drawn = lines(ax)
    x, y = drawn["data"].get_data()
    near(x, DATA["delta_over_delta_max"], 1e-15)
    near(y, DATA["force"], 1e-15)
    x, y = drawn["least-squares fit"].get_data()
    near(y, np.polynomial.Polynomial(FIT.beta)(x), 1e-12)
    band = ax.collections[0].get_paths()[0].vertices
    low, high = (
        np.array([edge(band[np.isclose(band[:, 0], s), 1]) for s in x]) for edge in (np.min, np.max)
    )
    assert ((low < y) & (y < high)).all()


def test_a_higher_level_is_a_wider_band_and_a_larger_ellipse():
    narrow, wide = (plot_fit(FIT, DATA, level).collections[0] for level in (0.5, 0.999))
    extent = [np.ptp(band.get_paths()[0].vertices[:, 1]) for band in (narrow, wide)]
    assert extent[0] < extent[1]
    small, large = (plot_confidence_region(FIT, level=level).patches[0] for level in (0.5, 0.999))
    assert small.width < large.width and small.height < large.height


def test_the_ellipse_just_fits_into_the_joint_box_of_two():
    ax = plot_confidence_region(FIT)
    box = ax.patches[0].get_extents().transformed(ax.transData.inverted())
    (x0, x1), (y0, y1) = FIT.intervals(0.95, "scheffe", 2)[[0, 2]]
    near([box.x0, box.x1], [x0, x1], 1e-3)
    near([box.y0, box.y1], [y0, y1], 1e-3)


def test_residuals_are_data_less_fit():
    _, axes = plt.subplots(2)
    plot_residuals(FIT, DATA, axes)
    fitted = np.polynomial.Polynomial(FIT.beta)(DATA["delta_over_delta_max"].to_numpy())
    drawn = axes[0].lines[-1].get_ydata()
    np.testing.assert_allclose(drawn, DATA["force"] - fitted, atol=1e-12)
    np.testing.assert_allclose(axes[1].lines[-1].get_ydata(), np.sort(drawn), atol=1e-12)


@pytest.mark.parametrize("scheme", [EULER, CRANK_NICOLSON, RK4])
def test_points_are_marked_stable_where_no_mode_grows(scheme):
    dts = [1e-4, 0.05, 0.3]
    drawn = lines(plot_stability(scheme, ROBOT.eigenvalues, dts))
    for dt in dts:
        label = next(name for name in drawn if rf"\Delta t = {dt:g}$" in name)
        growth = np.abs(scheme.stability_function(ROBOT.eigenvalues * dt)).max()
        assert label.endswith(": stable" if growth <= 1 else ": unstable")
        z = drawn[label].get_xdata() + 1j * drawn[label].get_ydata()
        near(z, ROBOT.eigenvalues * dt, 1e-15)


@pytest.mark.slow
def test_the_points_of_the_smallest_step_are_enlarged_in_an_inset():
    dts = [0.05, 0.001, 0.3]
    ax = plot_stability(RK4, ROBOT.eigenvalues, dts)
    inset = plot_near_zero(RK4, ROBOT.eigenvalues, dts, ax)
    z = ROBOT.eigenvalues * 0.001
    points = inset.lines[-1]
    near(points.get_xdata() + 1j * points.get_ydata(), z, 1e-15)
    (left, right), (low, high) = inset.get_xlim(), inset.get_ylim()
    assert left < z.real.min() and 0 < right and low < z.imag.min() and z.imag.max() < high
    assert "0.001" in title(inset)
    ax.figure.canvas.draw()


@pytest.mark.slow
@pytest.mark.parametrize("k", [250, 800, 2300])
def test_the_ticks_of_the_enlarged_place_do_not_touch_on_a_phone(k):
    z = Robot(k, k).eigenvalues
    ax = plot_stability(CRANK_NICOLSON, z, [0.2, 0.1, 0.001])
    inset = plot_near_zero(CRANK_NICOLSON, z, [0.2, 0.1, 0.001], ax)
    narrow(ax.figure).canvas.draw()
    left, right = (tick.get_window_extent() for tick in inset.get_xticklabels())
    assert left.x1 + 5 < right.x0


def test_a_percentage_in_a_legend_has_its_space():
    texts = [text.get_text() for text in plot_fit(FIT, DATA).get_legend().get_texts()]
    assert "95 % band of the mean" in texts


def test_growth_starts_where_the_run_does():
    amplitude, growth = np.array([[2.0, 3.0, 5.0], [1.0, 0.5, 0.2]]), [1.5, 0.5]
    ax = plot_growth(amplitude, growth, ["heave", "pitch"])
    drawn = ax.lines
    assert drawn[2].get_label().startswith("pitch")
    near(drawn[1].get_ydata(), [2, 3, 4.5], 1e-15)
    near(drawn[3].get_ydata(), [1, 0.5, 0.25], 1e-15)


def test_forces_say_the_verdict_and_grey_out_what_follows():
    kept, lost = plot_forces(KEPT), plot_forces(LOST)
    assert "kept" in title(kept) and not kept.patches
    assert "front wheel lost at 0.177 s" in title(lost)
    left, right = lost.patches[0].get_extents().transformed(lost.transData.inverted()).intervalx
    assert (left, right) == (pytest.approx(LOST.loss.t), pytest.approx(LOST.T[-1]))
    assert "0.25" in title(kept)


@pytest.mark.parametrize("runs", [[LOST], [KEPT, LOST], [KEPT, LOST, LOST]])
def test_every_run_has_its_panel_and_no_panel_is_empty(runs):
    figure = plot_all_forces(runs)
    assert len(plt.get_fignums()) == 1
    assert len(figure.axes) == len(runs)
    for run, ax in zip(runs, figure.axes, strict=True):
        assert f"{run.v:g} m/s" in title(ax)
        assert_labelled(ax)
    figure.canvas.draw()


def test_an_unstable_run_is_drawn_too():
    run = simulate(ROBOT, BUMP, v=0.25, dt=0.1, tfinal=5, scheme=EULER)
    assert "lost" in title(plot_forces(run))


def test_flight_shows_forces_above_heights_in_millimetres():
    _, axes = plt.subplots(2)
    plot_flight(FLIGHT, LINEAR, axes)
    near(lines(axes[0])["front wheel"].get_ydata(), FLIGHT.N[1], 1e-15)
    highest = max(line.get_ydata().max() for line in axes[1].lines)
    assert highest == pytest.approx(1000 * FLIGHT.gaps.max())


def test_errors_may_have_their_own_costs():
    cost = {"Euler": [1, 2, 3], "RK4": [4, 8]}
    drawn = lines(plot_errors(cost, {"Euler": [1e-1, 1e-2, 1e-3], "RK4": [1e-5, 1e-9]}))
    assert drawn["RK4"].get_xdata().tolist() == [4, 8]
    assert plot_errors(cost, {"Euler": [1, 2, 3]}).get_xscale() == "log"


def test_many_curves_stay_apart():
    many = {f"method {i}": DTS * 2**i for i in range(9)}
    looks = {
        (line.get_color(), line.get_linestyle(), line.get_marker())
        for line in plot_errors(DTS, many).lines
    }
    assert len(looks) == 9


def test_heave_is_in_millimetres():
    drawn = lines(plot_heave(V, HEAVE))
    near(drawn["v = 1.2 m/s"].get_ydata(), 1000 * HEAVE[1.2], 1e-15)


def test_a_seen_mode_is_shown_by_frequency_and_damping_with_nyquists_limit():
    figure = plt.figure(layout="constrained")
    left, right = plot_seen_mode(DTS, SEEN, -2 + 33j, figure)
    assert figure.axes == [left, right]
    assert_labelled(left)
    assert_labelled(right)
    near(left.lines[0].get_ydata(), np.ones(30), 1e-15)
    near(right.lines[1].get_ydata(), np.linspace(1, -1, 30) / np.abs(SEEN["Euler"]), 1e-12)
    nyquist = next(line for line in left.lines if line.get_label() == "Nyquist")
    near(nyquist.get_ydata() * 33 * DTS, np.full(30, np.pi), 1e-12)
    figure.canvas.draw()


def test_a_missed_dip_is_in_the_close_up_between_two_steps():
    _, axes = plt.subplots(1, 2)
    plot_missed_dip(T, DIP, T[::10], DIP[::10], axes)
    left, right = axes[1].get_xlim()
    low, high = axes[1].get_ylim()
    assert left < T[DIP.argmin()] < right and right - left < 0.2
    assert low < DIP.min() < 0 < high


@pytest.mark.parametrize("critical", [[], [0.5], [0.5, 0.51, 8.0], [0.11, 29.0]])
def test_a_margin_has_a_word_or_a_shade_for_every_range(critical):
    lost = [i % 2 for i in range(len(critical) + 1)]
    ax = plot_margin(V, FORCES, Regimes([V[0], *critical, V[-1]], lost), asked=[1.2])
    words = [text.get_text() for text in ax.texts]
    assert {"lost", "kept"} & set(words)
    assert all(f"{speed:.3g}" in words for speed in critical)
    assert ("critical speeds" in lines(ax)) == (len(critical) > 1)
    assert ("critical speed" in lines(ax)) == (len(critical) == 1)
    ax.figure.canvas.draw()


def test_what_is_shaded_and_called_lost_is_what_is_given():
    """Whatever the samples say: between two of them a range can be missed."""
    regimes = Regimes([V[0], 1.0, 1.001, V[-1]], [True, False, True])
    ax = plot_margin(V, np.ones((2, len(V))), regimes)
    places = [text.get_position()[0] for text in ax.texts if text.get_text() == "lost"]
    assert len(places) == 2 and places[0] < 1 < places[1]
    near(shaded(ax), [[V[0], 1.0], [1.001, V[-1]]], 1e-9)


def test_close_critical_speeds_do_not_cover_each_other():
    regimes = Regimes([V[0], 5.0, 5.1, 5.2, V[-1]], [False, True, False, True])
    ax = plot_margin(V, FORCES, regimes)
    ax.figure.canvas.draw()
    boxes = [text.get_window_extent() for text in ax.texts if text.get_text()[0] == "5"]
    assert len(boxes) == 3
    assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_ranges_beyond_the_measured_spring_are_hatched_and_named_once():
    ax = plot_margin(
        V, FORCES, REGIMES, beyond=[Overtravel(0.3, 0.4, 1.1), Overtravel(0.7, 30, 2.0)]
    )
    hatched = [patch for patch in ax.patches if patch.get_hatch()]
    assert len(hatched) == 2
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert sum("beyond" in label for label in labels) == 1


def test_branches_stand_over_the_stiffness_with_its_interval_and_the_asked_speeds():
    ax = plot_branches(BRANCHES, 800, (780, 820), [1.2])
    curve, fitted, asked = ax.lines
    near(curve.get_xydata(), [[300, 1], [900, 2]], 1e-12)
    assert list(fitted.get_xdata()) == [800, 800] and list(asked.get_ydata()) == [1.2, 1.2]
    assert len(ax.patches) == 1 and "(m/s)" in ax.get_ylabel() and "(N/m)" in ax.get_xlabel()
    alone = plot_branches([], 800)
    assert not alone.patches and len(alone.lines) == 1


def test_a_map_turns_where_the_margin_is_zero():
    margin = np.log(V) - np.log(K / 300)[:, None]  # zero where v = k / 300
    ax = plot_margin_map(V, K, margin, 800, (780, 820), asked=[0.25, 1.2])
    contour = next(
        c for c in ax.collections if len(c.get_paths()) == 1 and c.get_linewidth()[0] == 1.6
    )
    v, k = contour.get_paths()[0].vertices.T
    near(v, k / 300, 0.01)
    assert len(ax.figure.axes) == 2 and "(N)" in ax.figure.axes[1].get_ylabel()
    assert ax.get_ylim() == (K[0], K[-1])


@pytest.mark.parametrize("speeds", [[], [0.5], [0.5, 8.0], np.geomspace(0.1, 20, 7)])
def test_sensitivities_have_a_bar_for_every_speed_and_parameter(speeds):
    percent = {"$k$": np.ones(len(speeds)), "$c$": -np.ones(len(speeds))}
    ax = plot_sensitivities(speeds, percent)
    assert len(ax.patches) == 2 * len(speeds)
    ends = sorted((bar.get_x(), bar.get_x() + bar.get_width()) for bar in ax.patches)
    assert all(left[1] <= right[0] + 1e-12 for left, right in pairwise(ends))
    assert "%" in ax.get_ylabel()


def test_travel_is_in_millimetres_and_degrees_beside_what_was_measured():
    _, axes = plt.subplots(2)
    plot_travel(V, np.full(len(V), 0.02), np.full(len(V), np.pi / 6), 0.0165, axes)
    compression, measured = (line.get_ydata() for line in axes[0].lines)
    near(compression, np.full(len(V), 20.0), 1e-15)
    near(measured, [16.5, 16.5], 1e-15)
    near(axes[1].lines[0].get_ydata(), np.full(len(V), 30.0), 1e-14)


@pytest.mark.parametrize("history", [LOST, FLIGHT], ids=["run", "flight"])
@pytest.mark.parametrize("times", [[0.1], [0.0, 0.1, 0.2]])
def test_a_film_has_a_frame_for_every_time(history, times):
    figure = film(history, ROBOT, BUMP, times)
    assert len(figure.axes) == len(times)
    for ax, t in zip(figure.axes, times, strict=True):
        assert f"t = {t:.3f} s" in [text.get_text() for text in ax.texts]
    figure.canvas.draw()


def test_a_box_that_misses_the_truth_is_drawn_thicker():
    caught, missed = plot_experiments(*BOXES, np.zeros(2)).patches
    assert missed.get_linewidth() > caught.get_linewidth()
    assert missed.get_edgecolor() != caught.get_edgecolor()


def test_a_slope_is_drawn_where_and_as_steep_as_it_was_found():
    ax = plot_slopes([0, 1], [1, 0.5], [-1, 0], (1, 0.6), (T, 1 - T))
    first, second = ax.lines[1], ax.lines[3]
    near(np.polyfit(*first.get_data(), 1), [-1, 1], 1e-12)
    near(np.polyfit(*second.get_data(), 1), [0, 0.5], 1e-12)


def test_what_the_wheelbase_holds_back_is_seen_beside_the_resonance():
    gain = np.array([1e-3, 0.1, 16.0, 1.0])
    _, axes = plt.subplots(1, 2)
    plot_gains(V[:4], {1.2: gain}, {1.2: 2 * gain}, ([0.4], [0.2]), axes)
    for ax, high in zip(axes, (16, 32)):
        low, top = ax.get_ylim()
        assert ax.get_yscale() == "log" and low < high / 500 and high < top


def test_a_demand_map_marks_suspensions_and_the_line_of_no_contact():
    marks, values = {"now": (800, 1.5), "then": (400, 2)}, K / 100 - C[:, None] - 3
    ax = plot_demand_map(K, C, 9 + values, [0, 5, 9], marks, "acceleration (m/s²)", values)
    drawn = lines(ax)
    for name, place in marks.items():
        near(np.ravel(drawn[name].get_xydata()), place, 1e-15)
    assert title(ax) == "acceleration (m/s²)"
    k, c = ax.collections[-1].get_paths()[0].vertices.T
    near(k / 100, c + 3, 0.02)
    without = plot_demand_map(K, C, values, [1, 5, 9], {}, "compression (mm)", 1 + 0 * values)
    assert len(without.collections) < len(ax.collections)


@pytest.mark.parametrize("blank", ["kept", "lost"])
def test_the_side_of_which_a_map_says_nothing_has_one_tone(blank):
    contact = 3 + C[:, None] - K / 100
    ax = plot_demand_map(K, C, contact, [0, 5], {}, "margin (N)", contact, blank)
    field = ax.collections[1]  # above the map, below the line
    k, c = np.concatenate([path.vertices for path in field.get_paths()]).T
    sign = 1 if blank == "kept" else -1
    inside = sign * (3 + c - k / 100)
    near([inside.min(), inside.max()], [0, (sign * contact).max()], 1e-12)
    assert f"contact {blank}" in ax.get_legend_handles_labels()[1]
    every = plot_demand_map(K, C, contact, [0, 5], {}, "margin (N)", 0 * contact - 1, blank)
    assert len(every.collections) == (1 if blank == "kept" else 2)


def test_best_compromises_that_lose_contact_are_rings():
    margin = np.where(C > 2, C, 0.0)
    ax = plot_front(C / 100, 1 + C, margin, {"now": (0.02, 2)})
    rings, dots = ax.lines[0], ax.collections[0]
    near(rings.get_xdata(), 10 * C[margin == 0], 1e-15)
    near(dots.get_offsets()[:, 0], 10 * C[margin > 0], 1e-15)
    near(dots.get_array(), margin[margin > 0], 1e-15)


def test_stops_that_take_contact_are_open():
    ratio, felt = np.geomspace(1, 100, 3), np.array([5.0, 9.0, 40.0])
    ax = plot_stop_stiffness(ratio, {1.2: felt}, {1.2: [True, False, False]}, {})
    kept, lost = (line for line in ax.lines if line.get_linestyle() == "None")
    assert list(kept.get_ydata()) == [5] and list(lost.get_ydata()) == [9, 40]
    assert lost.get_markerfacecolor() == "white" != kept.get_markerfacecolor()


def test_a_rough_ride_is_shaded_where_a_wheel_is_in_the_air():
    _, axes = plt.subplots(2)
    plot_rough_ride(T, 0.01 * T, T, [np.where(T > 0.5, 0, 1), 1 + T], axes)
    shaded = axes[1].collections[0].get_paths()[0].vertices
    high = shaded[shaded[:, 1] == 1, 0]
    assert high.min() > 0.48 and high.max() == 1


def test_each_ride_is_a_dot_beside_the_curve_of_the_linear_robot():
    _, axes = plt.subplots(1, 2)
    plot_rides(V, {"now": V}, [1.0, 2.0], *RIDES, 7, axes)
    dots = [line.get_ydata() for line in axes[0].lines if line.get_linestyle() == "None"]
    near(np.sort(np.concatenate(dots)), [1, 1.2, 2, 2.5], 1e-15)
    air = [line.get_ydata() for line in axes[1].lines if line.get_linestyle() == "None"]
    near(np.sort(np.concatenate(air)), [0, 0, 10, 20], 1e-13)


def test_a_choice_moves_along_lines_of_slope_minus_two():
    lost = np.array([True, False])
    points = {"now": (np.array([1.0, 4]), 2.0, lost), "soft": (np.array([2.0, 8]), 0.5, ~lost)}
    ax = plot_paths({}, {name: (V, 1 + V) for name in points}, points, [1.2, 5])
    grey = [line.get_xydata() for line in ax.lines if line.get_color() == "0.75"]
    assert len(grey) == 2
    for path, start in zip(grey, (1, 4)):
        near(path[:, 1] * path[:, 0] ** 2, 2 * start**2, 1e-12)
    filled = [line for line in ax.lines if line.get_marker() == "o" and len(line.get_xdata())]
    assert {line.get_xdata()[0] for line in filled if line.get_mfc() != "white"} == {1, 8}


def test_every_law_has_a_line_of_its_own():
    ax = plot_spring_laws(T, LAWS, DATA, 0.5, 0.9)
    drawn = lines(ax)
    for name, force in LAWS.items():
        near(drawn[name].get_ydata(), force, 1e-15)
    assert drawn["line"].get_linestyle() != drawn["stop"].get_linestyle()
    near(drawn["data"].get_ydata(), DATA["force"], 1e-15)


def test_critical_speeds_of_every_law_lie_on_zero():
    ax = plot_measured_margins(V, MARGINS, {"line": CRITICAL, "stop": [3.0]}, [1.2])
    marks = [line for line in ax.lines if line.get_marker() not in ("None", "")]
    assert [list(mark.get_xdata()) for mark in marks] == [CRITICAL, [3.0]]
    assert all((np.asarray(mark.get_ydata()) == 0).all() for mark in marks)


def test_a_chart_marks_what_is_asked_by_its_verdict_and_shades_what_is_lost():
    ax = plot_chart(
        NU,
        CHART,
        {"follow": 1 / NU**2},
        (2.8, [1, 2], [False, True], [1.5], [[0.05, 1.5]]),
        own=0.03,
    )
    drawn = lines(ax)
    near(drawn["asked, kept"].get_xydata(), [[1, 2.8]], 1e-15)
    near(drawn["asked, lost"].get_xydata(), [[2, 2.8]], 1e-15)
    thick = max(ax.lines, key=lambda line: line.get_linewidth())
    near(thick.get_xydata(), [[0.05, 2.8], [1.5, 2.8]], 1e-15)
    shaded = ax.collections[0].get_paths()[0].vertices
    assert shaded[:, 1].max() == ax.get_ylim()[1]
    assert shaded[:, 1].min() == pytest.approx(CHART[0.03].min(), rel=1e-12)
    words = [text.get_text().strip() for text in ax.texts]
    assert {"undamped", r"$\zeta$ = 0.03", r"$\zeta$ = 0.4", "follow", "contact lost"} <= set(words)


def test_a_limit_is_named_along_its_line():
    ax = plot_chart(NU, {0.03: CHART[0.03]}, {"follow": 1 / NU**2, "throw": NU / 2.5})
    turned = {text.get_text(): text.get_rotation() for text in ax.texts}
    assert 290 < turned["follow"] < 330 and 0 < turned["throw"] < 60


def test_a_vehicle_has_a_row_in_two_colours_with_its_critical_speed_on_it():
    ax = plot_vehicles(RIDES_OVER)
    car = [line for line in ax.lines if len(line.get_ydata()) and not any(line.get_ydata())]
    kept, lost, critical, heavy = (line.get_xdata() for line in car)
    assert list(kept) == [5, 40] and list(lost) == [40, 60]
    assert list(critical) == [40] and list(heavy) == [44]
    assert car[0].get_color() != car[1].get_color()
    assert [text.get_text() for text in ax.get_yticklabels()] == list(RIDES_OVER)
    assert [text.get_text() for text in ax.texts] == ["40"]


def test_the_page_has_a_dark_tone_of_each_field():
    style = (ROOT / "book/style/suspension.css").read_text(encoding="utf-8")
    dark = re.search(r'html\[data-theme="dark"\] \{(.*?)\}', style, re.DOTALL)[1]
    tones = dict(re.findall(r"--figure-([0-9a-f]{6}): (#[0-9a-f]{6});", dark))
    for colour in FIELDS.values():
        assert tones[colour[1:]] not in ("", colour), colour
    assert len({tones[colour[1:]] for colour in FIELDS.values()}) == len(FIELDS)


def test_no_figure_types_the_colour_of_a_field_anew():
    for module in (ROOT / "suspension/figures").glob("*.py"):
        text = module.read_text(encoding="utf-8")
        typed = [colour for colour in FIELDS.values() if colour in text.lower()]
        assert module.name == "style.py" or not typed, (module.name, typed)

"""What the tests of the explorer share: its controls, its words and its pictures."""

from inspect import getsource

import numpy as np
from helpers import PARITY, largest_difference

from suspension.explorer import SCHEMES
from suspension.explorer.family import Family
from suspension.forces import first_loss
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.simulation import simulate

BOX = ".suspension-explorer-box"
VIEW = f"{BOX} .suspension-explorer"
SLIDERS = ["Speed v (m/s)", "Step Δt (ms)", "Stiffness k (N/m)", "Damping c (N s/m)"]
BUMP_SLIDERS = ["Bump height (mm)", "Bump width σ (mm)"]
PLAIN = {0x2212: "-", 0xD7: "x", 0xA0: " "}  # the page's minus, times and fixed space


def two_bumps(x):
    (H1, d1), (H2, d2) = GaussianBump()(x), GaussianBump(0.018, 0.02, 0.85)(x)
    return H1 + H2, d1 + d2


BUMPS = getsource(two_bumps)  # a notebook of the tests defines it by the same lines
LOPSIDED = "Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)"
PAGES = {
    "bump": (Robot(793.2, 793.2), GaussianBump()),
    "bumps": (eval(LOPSIDED), two_bumps),
    "undamped": (Robot(793.2, 793.2, c1=0, c2=0), GaussianBump()),
}


def slider(tab, name, nth=0):
    return tab.locator(f"{BOX}.se-live").nth(nth).get_by_role("slider", name=name)


# Two frames later: what stands there in words, and a number for each picture, by panel.
LOOK = """root => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
  const pictures = {};
  for (const canvas of root.querySelectorAll("canvas")) {
    const { width, height, className } = canvas;
    let number = width;
    if (width && height) {
      const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
      for (const pixel of new Uint32Array(data.buffer)) number = (31 * number + pixel) | 0;
    }
    pictures[className] = number;
  }
  const words = [".se-status", ".se-details", ".se-clock"]
    .map((name) => root.querySelector(name).innerText).join(" ");
  done([words, pictures]);
})))"""


def look(tab, nth=0):
    """The words, and what is drawn, by panel."""
    words, pictures = tab.locator(VIEW).nth(nth).evaluate(LOOK)
    return words.translate(PLAIN), pictures


def words(tab, nth=0):
    return look(tab, nth)[0]


def pictures(tab, nth=0):
    return look(tab, nth)[1]


def tone(tab):
    return tab.locator(".se-status").first.get_attribute("data-tone")


def shown(tab, nth=0):
    """All that the page shows, and [W, N], shape (6, J+1)."""
    run = tab.locator(VIEW).nth(nth).evaluate("root => root.trajectory()")
    return run, np.array(run["W"] + run["N"], dtype=float)


def type_in(tab, name, text, nth=0):
    field = tab.locator(f"{BOX}.se-live").nth(nth).get_by_role("textbox", name=f"{name}, typed")
    field.fill(text)
    field.press("Enter")


def compare(page_run, robot, road, schemes=SCHEMES):
    """Assert that the page has what `simulate` has; return the largest difference."""
    page, rows = page_run
    family = Family(robot, road)
    other, bump = family.robot_at(page["k"], page["c"]), road
    if family.has_bump:
        bump = family.road_at(page["height"], page["sigma"])
    scheme = schemes[page["scheme_index"]]
    run = simulate(other, bump, v=page["v"], dt=page["dt"], tfinal=1.25 / page["v"], scheme=scheme)
    difference = largest_difference(rows, run)
    assert difference < PARITY, page["v"]
    assert first_loss(run.T, rows[4:]) == run.loss
    return difference

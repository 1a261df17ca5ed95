"""The page's own modules, run by Node: their numbers are Python's, and they know no physics."""

import re
from dataclasses import dataclass

import numpy as np
import pytest
from helpers import PARITY, ROOT, largest_difference
from node import ask_page, node, random_settings, run_in_node, run_own_tests, unpack, walk

from suspension.contact import critical_speeds, margin, regimes
from suspension.critical import critical_stiffness
from suspension.explorer import SCHEMES, Explorer, explore
from suspension.explorer.settings import MOTIONS
from suspension.flight import fly
from suspension.road import GaussianBump, road_input
from suspension.robot import Robot
from suspension.schemes import Scheme
from suspension.similarity import follow, groups, highest_bump, skim, throw
from suspension.simulation import simulate, steps

pytestmark = pytest.mark.slow  # Node runs, one for each setting

BUMP = GaussianBump()
ROBOT = Robot(793.2, 793.2)
LOPSIDED = Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)
HEUN = Scheme("Heun", 2, a=[[0, 0], [1, 0]], b=[1 / 2, 1 / 2], c=[0, 1])
SDIRK = Scheme("SDIRK", 2, a=[[1 / 4, 0], [1 / 2, 1 / 4]], b=[1 / 2, 1 / 2], c=[1 / 4, 3 / 4])


def two_bumps(x):
    (H1, d1), (H2, d2) = BUMP(x), GaussianBump(height=0.018, sigma=0.02, centre=0.85)(x)
    return H1 + H2, d1 + d2


@pytest.fixture(scope="module")
def explorers():
    schemes = (*SCHEMES, HEUN, SDIRK)
    return {
        "one bump": explore(ROBOT, BUMP, schemes=schemes).explorer,
        "two bumps, unsymmetric": explore(LOPSIDED, two_bumps, schemes=schemes).explorer,
        "undamped, short": explore(
            Robot(400, 400, c1=0, c2=0), BUMP, distance=0.7, schemes=schemes
        ).explorer,
    }


def narrow_settings(explorer, rng, count):
    """Settings all over the sliders, with bumps so narrow that no wheel starts on them."""
    for setting in random_settings(explorer, rng, count):
        yield setting | {"sigma": 0.01 + 0.2 * setting["sigma"]}


CASES = ["one bump", "two bumps, unsymmetric", "undamped, short"]


def family_at(explorer, setting):
    """The robot and the road at some settings."""
    family = explorer.family
    return (
        family.robot_at(setting["k"], setting["c"]),
        family.road_at(setting["height"], setting["sigma"]),
    )


@pytest.mark.parametrize("case", CASES)
def test_the_page_computes_what_simulate_computes(explorers, case, tmp_path):
    explorer, rng = explorers[case], np.random.default_rng(3)
    settings = list(random_settings(explorer, rng, 60))
    settings[0] |= {"v": 0.1, "dt": 0.00025}
    settings[1] |= {"v": 25.0, "dt": 0.2}
    settings[2] |= explorer.family.own
    settings[3] |= {"c": 0.0}
    assert {setting["scheme_index"] for setting in settings} == set(range(6))
    answers = ask_page(tmp_path, explorer, "run", settings)
    for setting, answer in zip(settings, answers, strict=True):
        robot, road = family_at(explorer, setting)
        v, dt, scheme = setting["v"], setting["dt"], explorer.schemes[setting["scheme_index"]]
        run = simulate(robot, road, v=v, dt=dt, tfinal=explorer.distance / v, scheme=scheme)
        assert largest_difference(unpack(answer), run) < PARITY, setting
        lost = answer["verdict"]["lost"]
        assert (lost and (lost["wheel"] + 1, lost["t"])) == run.loss, setting
        growths = np.abs(scheme.stability_function(robot.eigenvalues * dt))
        np.testing.assert_allclose(np.sort(answer["growths"]), np.sort(growths), rtol=1e-6)


@pytest.mark.parametrize("scheme_index", range(4))
def test_stability_is_pythons_too_without_dampers(explorers, scheme_index, tmp_path):
    explorer = explorers["undamped, short"]
    settings = [
        {**explorer.family.own, "v": 5.0, "dt": dt, "scheme_index": scheme_index}
        for dt in (0.0003, 0.002, 0.03, 0.05, 0.1, 0.2)
    ]
    for setting, answer in zip(
        settings, ask_page(tmp_path, explorer, "run", settings), strict=True
    ):
        stable = max(answer["growths"]) <= 1 + 1e-12
        scheme = explorer.schemes[scheme_index]
        assert stable == scheme.is_stable(explorer.family.robot.eigenvalues, setting["dt"])


def test_what_a_run_is_judged_by_is_the_exact_margin(explorers, tmp_path):
    explorer, rng = explorers["one bump"], np.random.default_rng(5)
    settings = list(narrow_settings(explorer, rng, 60))
    answers = ask_page(tmp_path, explorer, "truth", settings)
    for setting, answer in zip(settings, answers, strict=True):
        robot, road = family_at(explorer, setting)
        exact = margin(robot, road, setting["v"])
        assert answer["verdict"]["least"] == pytest.approx(exact, rel=1e-3, abs=2e-3), setting
        if abs(exact) > 0.01:
            assert bool(answer["verdict"]["lost"]) == (exact < 0), setting


def test_the_curve_over_all_speeds_is_that_of_the_exact_margins(explorers, tmp_path):
    explorer, rng = explorers["one bump"], np.random.default_rng(6)
    own = explorer.family.own | {"v": 1.0, "dt": 0.001, "scheme_index": 0}
    settings = [own, *narrow_settings(explorer, rng, 7)]
    answers = ask_page(tmp_path, explorer, "curve", settings)
    for setting, answer in zip(settings, answers, strict=True):
        robot, road = family_at(explorer, setting)
        least = np.min(answer["least"], axis=0)
        for v, found in list(zip(answer["speeds"], least, strict=True))[::6]:
            assert found == pytest.approx(margin(robot, road, v), abs=0.05), (v, setting)
    critical = critical_speeds(ROBOT, BUMP, 0.1, 25)
    np.testing.assert_allclose(answers[0]["critical"], critical, rtol=1e-4)


@pytest.fixture(scope="module")
def charts():
    return {
        "symmetric": explore(ROBOT, BUMP, compact="chart").explorer,
        "unsymmetric": explore(LOPSIDED, BUMP, compact="chart").explorer,
    }


@pytest.mark.parametrize("case", ["symmetric", "unsymmetric"])
def test_the_charts_highest_bump_is_pythons(charts, case, tmp_path):
    explorer = charts[case]
    settings = list(narrow_settings(explorer, np.random.default_rng(12), 60))
    settings[0]["height"] = 0.0  # a level road has its chart, too
    settings[1]["c"] = 0.0
    load = (ROBOT.C @ ROBOT.equilibrium).max()
    for setting, answer in zip(
        settings, ask_page(tmp_path, explorer, "chart", settings), strict=True
    ):
        robot, road = family_at(explorer, setting)
        v = np.array(answer["speeds"])[::16]
        exact = highest_bump(robot, road, v, distance=explorer.distance)
        height = setting["height"] or explorer.family.own["height"]
        # In forces: what the bump takes from a wheel.
        found = load * height / np.array(answer["highest"], float)[::16]
        np.testing.assert_allclose(found, load * height / exact, rtol=0.01, atol=0.05)


def test_the_charts_limits_are_pythons(charts, tmp_path):
    explorer = charts["symmetric"]
    settings = list(narrow_settings(explorer, np.random.default_rng(12), 12))
    names = [limit["name"] for limit in explorer.facts["chart"]["limits"]]
    assert names == ["follow", "throw", "skim"]
    for setting, answer in zip(
        settings, ask_page(tmp_path, explorer, "chart", settings), strict=True
    ):
        robot, road = family_at(explorer, setting)
        for n in (0, 50, 127):
            G = groups(robot, road, answer["speeds"][n])
            sag = road.height / G.eta
            expected = [sag * follow(G.nu, G.j), sag * throw(G.nu), sag * skim(G.nu, G.zeta)]
            np.testing.assert_allclose([line[n] for line in answer["limits"]], expected, rtol=1e-9)
    assert charts["unsymmetric"].facts["chart"]["limits"] == []


def test_the_charts_words_say_where_contact_is_kept_and_whether_the_window_is_open(
    charts, tmp_path
):
    explorer = charts["symmetric"]
    own = explorer.family.own | {"v": 1.2, "dt": 0.001, "scheme_index": 0}
    cases = {
        "open": own,
        "closed": own | {"c": 6.0},
        "every speed": own | {"height": 0.0},
        "low": own | {"height": 0.001},
    }
    answers = ask_page(tmp_path, explorer, "chart", list(cases.values()))
    for (case, setting), answer in zip(cases.items(), answers, strict=True):
        robot, road = family_at(explorer, setting)
        text = answer["words"]["headline"].replace("\u00a0", " ")
        assert ("window is open" in text) == (case == "open")
        assert ("window is closed" in text) == (case == "closed")
        assert answer["words"]["tone"] == ("lost" if case == "closed" else "kept")
        if case in ("every speed", "low"):
            assert text.endswith("contact is kept at every speed from 0.1 to 25 m/s.")
            continue
        found = regimes(robot, road, 0.1, 25)
        verdicts = re.findall("kept|lost", text.split("contact is")[1])
        assert [verdict == "lost" for verdict in verdicts] == found.lost.tolist()
        said = {float(x) for x in re.findall(r"[\d.]+(?= to| m/s)", text.split("contact is")[1])}
        np.testing.assert_allclose(sorted(said), found.critical, rtol=0.005)


@pytest.mark.parametrize("case", CASES)
def test_the_pages_flight_is_that_of_fly(explorers, case, tmp_path):
    explorer, rng = explorers[case], np.random.default_rng(8)
    settings = list(random_settings(explorer, rng, 20))
    for setting, v in zip(settings, (0.5, 0.8, 1.2, 2, 5, 8, 10, 20, 25)):
        setting |= explorer.family.own | {"v": v}
    switches = 0
    for setting, answer in zip(
        settings, ask_page(tmp_path, explorer, "flight", settings), strict=True
    ):
        robot, road = family_at(explorer, setting)
        v = setting["v"]
        flight = fly(robot, road, v=v, tfinal=explorer.distance / v, resolution=0.02)
        events = [(event["wheel"] + 1, event["kind"]) for event in answer["events"]]
        assert events == [(event.wheel, event.kind) for event in flight.events], setting
        for found, event in zip(answer["events"], flight.events, strict=True):
            assert found["t"] == pytest.approx(event.t, abs=PARITY), setting
            assert found["force"] == pytest.approx(event.force, rel=PARITY, abs=1e-8), setting
        np.testing.assert_allclose(answer["airtime"], flight.airtime, rtol=0, atol=PARITY)
        highest = flight.gaps.max()
        np.testing.assert_allclose(
            answer["highest"], flight.gaps.max(axis=1), rtol=0, atol=0.01 * highest + 1e-9
        )
        switches += len(events)
    assert switches > 30


@pytest.mark.parametrize("v", [0.8, 1.2, 2, 5])
def test_a_flight_is_by_the_chosen_scheme_and_tends_to_that_of_fly(explorers, v, tmp_path):
    """At the finest step the accurate schemes have fly's events; in long steps Euler has others."""
    explorer = explorers["one bump"]
    exact = fly(ROBOT, BUMP, v=v, tfinal=1.25 / v, resolution=0.02)
    finest = explorer.ranges["dt"].low
    cases = [(dt, index) for dt in (finest, 0.005) for index in range(len(SCHEMES))]
    settings = [
        {**explorer.family.own, "v": v, "dt": dt, "scheme_index": index} for dt, index in cases
    ]
    answers = ask_page(tmp_path, explorer, "flight by the scheme", settings)
    error = {}
    for (dt, index), answer in zip(cases, answers, strict=True):
        assert answer["dt"] == dt
        name, highest = SCHEMES[index].name, exact.gaps.max()
        error[name, dt] = abs(max(answer["highest"]) - highest) / highest
        first = answer["events"][0]
        assert (first["wheel"] + 1, first["kind"]) == exact.events[0][:2]
        assert first["t"] == pytest.approx(exact.events[0].t, abs=3e-3 if dt == finest else 0.02)
        if dt == finest and SCHEMES[index].order > 1:
            events = [(event["wheel"] + 1, event["kind"]) for event in answer["events"]]
            assert events == [(event.wheel, event.kind) for event in exact.events], name
            times = [event["t"] for event in answer["events"]]
            np.testing.assert_allclose(times, [event.t for event in exact.events], atol=0.1 * dt)
            assert error[name, dt] < 1e-3
    assert error["Euler", finest] < 0.06 and error["Backward Euler", finest] < 0.06
    assert error["Euler", 0.005] > 0.2 and error["Backward Euler", 0.005] > 0.2
    assert error["RK4", 0.005] < 0.01


def everything(explorer, rng, count):
    """All that can be set, at random: a run, how one looks at it, what one compares it with."""
    runs, pins = (list(random_settings(explorer, rng, count)) for _ in range(2))
    for run, pin in zip(runs, pins, strict=True):
        run |= {
            "time": round(rng.uniform(), 6),  # an address has six digits
            "motion": str(rng.choice(["linear", "flying"])),
            "view": str(rng.choice(["forces", "stability", "speeds"])),
            "pace": str(rng.choice(["fit", "same"])),
            "mapped": bool(rng.uniform() < 0.05),
            "pin": {},
        }
        if rng.uniform() < 0.3:
            run["pin"] = pin | {"motion": str(rng.choice(["linear", "flying"]))}
        yield run


def test_picture_words_clock_and_link_tell_one_state(tmp_path):
    """300 random settings, one after another: each is what its link opens, drawn and said."""
    explorer = explore(
        ROBOT, BUMP, asked=(0.25, 1.2, 5, 10), spring_end=0.0165, schemes=(*SCHEMES, HEUN)
    ).explorer
    settings = list(everything(explorer, np.random.default_rng(21), 300))
    tones = set()
    for setting, told in zip(settings, walk(tmp_path, explorer, settings), strict=True):
        assert told["differs"] == [], (told["link"], told["differs"])
        state, words, clock = told["state"], told["words"], told["clock"].replace("\u00a0", " ")
        name = explorer.schemes[setting["scheme_index"]].name
        assert state["scheme"] == name and state["v"] == told["moment"]["v"] == setting["v"]
        assert state["pin"] is None or state["pin"]["k"] == setting["pin"]["k"]
        t = setting["time"] * explorer.distance / setting["v"]
        assert told["moment"]["t"] == pytest.approx(t, rel=1e-9, abs=1e-12)
        robot, forces = (
            [text.replace("\u00a0", " ") for text in told["texts"][name]]
            for name in ("robot", "forces")
        )
        for i, symbol in enumerate(("N₁", "N₂")):
            number = re.search(rf"{symbol} = (.+? N)\b", clock)[1]
            force = told["moment"]["N"][i]
            lost = {"linear": "lost", "flying": "in the air"}[setting["motion"]]
            pressing = force is not None and force > 0
            assert f"{symbol} {f'= {number}' if pressing else lost}" in robot, clock
        assert f"Stability of {name}" in told["texts"]["stability"]
        assert (
            bool(told.get("pinned")) == bool(setting["pin"]) == ("faint: the pinned run" in robot)
        )
        faint = [text for text in robot if text.startswith("faint")]
        assert len(faint) <= 1 and ("faint" in told["key"][0]) == bool(faint)
        said = (words["headline"] + " ".join(words["details"])).replace("\u00a0", " ")
        assert not re.search("NaN|undefined|null|Infinity", said + " ".join(told["key"]))
        if setting["motion"] == "linear":
            lost = words["tone"] == "lost"
            assert not lost or "contact lost" in forces
            assert words["tone"] != "kept" or "contact lost" not in forces
        assert told["events"] == sorted(told["events"]) and told["events"][-1] == 1
        tones.add((setting["motion"], words["tone"]))
    expected = {(motion, tone) for motion in MOTIONS for tone in ("kept", "lost", "doubt")}
    assert tones >= expected


def test_on_the_edge_the_words_say_so(tmp_path):
    """At a stiffness where the verdict turns, a sign says nothing; a little beside it does."""
    explorer = explore(ROBOT, BUMP, v=5).explorer
    flip = critical_stiffness(ROBOT, BUMP, 5, 200, 2500)[0]
    run = {**explorer.family.own, "v": 5.0, "dt": 0.001, "scheme_index": 3}
    others = {"time": 0.3, "view": "forces", "pace": "fit", "mapped": False, "pin": {}}
    cases = [
        run | others | {"k": k, "motion": motion}
        for k in (flip, 1.01 * flip, 0.99 * flip)
        for motion in MOTIONS
    ]
    told = [one["words"] for one in walk(tmp_path, explorer, cases)]
    assert [one["tone"] for one in told[:2]] == ["edge", "edge"]
    for one in told[:2]:
        assert one["headline"].startswith("On the edge: least force") and "×" in one["headline"]
    assert {one["tone"] for one in told[2:]} == {"kept", "lost"}
    assert explorer.facts["edge"] == pytest.approx(1e-4 * ROBOT.m * ROBOT.g / 2)


def test_the_pages_contact_law_is_what_python_says(tmp_path):
    """A wheel that may pull until its spring is at its length leaves the ground later."""
    explorer = explore(ROBOT, BUMP, v=5).explorer
    setting = {**explorer.family.own, "v": 5.0, "dt": 0.001, "scheme_index": 3}
    before = ask_page(tmp_path, explorer, "flight", [setting])[0]["events"]
    model = explorer.facts["model"]
    assert [c["of"] for c in model["contact"]["conditions"]] == [["Cp", "Dp"], ["C", "D"]]
    conditions = [{"of": ["Cp", "Dp"], "strict": False}]
    pulls = {"conditions": conditions, "force": 0, "length": 0}
    explorer.facts = explorer.facts | {"model": model | {"contact": pulls}}
    after = ask_page(tmp_path, explorer, "flight", [setting])[0]["events"]
    first, later = (next(e["t"] for e in events if e["wheel"] == 1) for events in (before, after))
    run = explorer.trajectory()
    X = 5.0 * run.T + ROBOT.L2
    spring = BUMP(X)[0] - run.W[0] - ROBOT.L2 * run.W[2]  # linear up to there: the first to leave
    crossing = run.T[np.flatnonzero(spring < 0)[0]]
    assert first + 0.002 < later == pytest.approx(crossing, abs=0.0015)


def test_the_pages_exact_critical_speeds_are_pythons(tmp_path):
    explorer = explore(ROBOT, BUMP).explorer
    own = explorer.family.own | {"v": 1.0, "dt": 0.001, "scheme_index": 0}
    explorer.know_critical_speeds()
    there, elsewhere = ask_page(tmp_path, explorer, "curve", [own, own | {"k": own["k"] + 1}])
    assert there["critical"] == explorer.facts["exact"]["critical"] != elsewhere["critical"]
    np.testing.assert_allclose(there["critical"], critical_speeds(ROBOT, BUMP, 0.1, 25), rtol=1e-9)


CAR = Robot(20000, 22000, m=1200, Izz=1800, L1=1.3, L2=1.3, c1=1500, c2=1500)


def test_a_cars_page_computes_what_python_computes(tmp_path):
    explorer = explore(CAR, GaussianBump(height=0.05, sigma=0.3, centre=3.0)).explorer
    rng = np.random.default_rng(4)
    settings = [
        explorer.family.own | {"dt": 0.001, "scheme_index": 3, "v": v}
        for v in (0.3, 3.0, 30.0, 45.0)
    ] + list(random_settings(explorer, rng, 4))
    for answer, setting in zip(
        ask_page(tmp_path, explorer, "curve", settings), settings, strict=True
    ):
        robot, road = family_at(explorer, setting)
        rest = robot.m * robot.g / 2
        for v, found in list(zip(answer["speeds"], np.min(answer["least"], axis=0)))[::16]:
            exact = margin(robot, road, v, explorer.distance / v)
            assert found == pytest.approx(exact, abs=0.008 * rest), v
    for answer, setting in zip(
        ask_page(tmp_path, explorer, "flight", settings[:4]), settings[:4], strict=True
    ):
        robot, road = family_at(explorer, setting)
        flight = fly(robot, road, v=setting["v"], tfinal=explorer.distance / setting["v"])
        events = [(event["wheel"] + 1, event["kind"]) for event in answer["events"]]
        assert events == [(event.wheel, event.kind) for event in flight.events]


@dataclass(frozen=True)
class Linked(Robot):
    """A robot whose springs and dampers share their forces: another C and D, in Python alone."""

    @property
    def C(self):
        return SHARE @ Robot(self.k1, self.k2, c1=self.c1, c2=self.c2).C

    @property
    def D(self):
        return SHARE @ Robot(self.k1, self.k2, c1=self.c1, c2=self.c2).D


SHARE = np.array([[0.8, 0.3], [0.1, 0.9]])


def test_the_page_follows_a_model_that_only_python_knows(tmp_path):
    explorer = explore(Linked(700, 900, c2=2.5), BUMP).explorer
    settings = list(random_settings(explorer, np.random.default_rng(9), 12))
    for setting in settings:
        setting["dt"] = max(setting["dt"], 0.002)
    for setting, answer in zip(
        settings, ask_page(tmp_path, explorer, "run", settings), strict=True
    ):
        robot, road = family_at(explorer, setting)
        v, dt, scheme = setting["v"], setting["dt"], explorer.schemes[setting["scheme_index"]]
        R, G = scheme.one_step(robot.A, dt)
        w, N = robot.equilibrium, []
        for n in range(steps(1.25 / v, dt) + 1):
            N.append(robot.C @ w + robot.D @ road_input(robot, road, v, n * dt))
            F = [robot.B @ road_input(robot, road, v, (n + c) * dt) + robot.e for c in scheme.c]
            w = R @ w + sum(g @ f for g, f in zip(G, F))
        N = np.array(N).T
        np.testing.assert_allclose(unpack(answer)[4:], N, rtol=0, atol=1e-8 * np.abs(N).max())


def test_the_bundle_is_the_modules_joined(tmp_path):
    (tmp_path / "bundle.js").write_text(Explorer._esm, encoding="utf-8")
    printed = run_in_node(
        tmp_path,
        """
        import * as apart from "./page/widget.js";
        import * as joined from "./bundle.js";
        for (const { default: exported, ...others } of [apart, joined]) {
          const code = Object.entries(exported).map(([name, f]) => [name, String(f).length > 9]);
          console.log(JSON.stringify([code, others]));
        }
        """,
    )
    apart, joined = printed.splitlines()
    assert apart == joined == '[[["render",true]],{}]'


def test_the_modules_own_tests_pass(tmp_path):
    print(run_own_tests(tmp_path))


@pytest.mark.built
def test_the_modules_are_formatted_and_have_no_lint():
    biome = ROOT / "book" / "npm" / "node_modules" / "@biomejs" / "biome" / "bin" / "biome"
    if not biome.exists():
        pytest.skip("no Biome: 'npm ci' in book/npm, or 'make book', installs it")
    print(node(ROOT, biome, "ci", "--error-on-warnings"))

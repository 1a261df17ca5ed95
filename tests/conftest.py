"""Fixtures: the built book, a web server that serves it, and a browser to read it with."""

import os
from pathlib import Path

import pytest
from helpers import ROOT, find_chromium, serve_files, start_chromium


@pytest.fixture(scope="session")
def book():
    """Folder of the built book: that of ``make book``, or the one that BOOK_HTML names."""
    folder = Path(os.environ.get("BOOK_HTML", ROOT / "_build" / "html")).resolve()
    if not (folder / "index.html").is_file():
        pytest.fail(f"no book in {folder}: 'make test' builds it first, 'make book' only builds")
    return folder


@pytest.fixture(scope="session")
def site(book):
    """Address of the book in a sub-folder of a web server, ending in a slash."""
    with serve_files(book.parent) as address:
        yield f"{address}{book.name}/"


@pytest.fixture(scope="session")
def chromium():
    """Path of the system's Chromium, or a skip."""
    path = find_chromium()
    if path is None:
        pytest.skip("no Chromium found: install Debian's 'chromium' to run the browser tests")
    return path


@pytest.fixture(scope="session")
def browser(chromium):
    """A headless Chromium, driven by Playwright."""
    with start_chromium(chromium) as browser:
        yield browser


# What takes seconds, mostly because it is compared with brute force; `make quick` leaves it out.
SLOW = {
    "test_accuracy": [
        "test_tighter_tolerances_cost_more_and_err_less",
        "test_speeds_beside_the_last_critical_one_lose_contact_and_lie_within_5_percent",
    ],
    "test_course": ["test_the_slowest_runs_of_questions_6_and_10_agree"],
    "test_critical": [
        "test_critical_speeds_are_complete",
        "test_critical_speeds_move_as_the_sensitivities_say",
        "test_stiffness_at_which_the_verdict_flips",
        "test_the_verdicts_of_the_problem_follow_from_its_critical_speeds",
    ],
    "test_exact": [
        "test_any_robot_agrees_with_quadrature",
        "test_every_robot_at_every_speed_agrees_with_dop853",
        "test_flat_ground_is_the_matrix_exponential",
        "test_a_crawl_that_starts_on_the_bump_agrees_with_dop853",
    ],
    "test_explorer": ["test_the_still_picture_cuts_the_digits_of_its_lines_only"],
    "test_flight": [
        "test_a_dip_below_zero_that_hardly_lasts_is_found",
        "test_a_narrow_bump_is_not_stepped_over",
        "test_a_road_of_noise_is_told_where",
        "test_a_robot_that_chatters_is_told_when",
        "test_a_run_that_keeps_contact_is_simulate",
        "test_any_robot_on_any_road",
        "test_brute_force_at_two_microseconds",
        "test_energy_never_grows_on_flat_ground",
        "test_follows_is_the_footnote_at_every_sample",
        "test_no_switch_is_made_of_roundoff",
        "test_rk4_has_its_order_from_switch_to_switch_and_not_across",
    ],
    "test_least_force": ["test_no_wrong_verdict_in_600"],
    "test_report_airborne": [
        "test_sentences_about_flights_are_sound",
        "test_the_models_agree_or_not_as_the_numbers_say",
        "test_where_the_damper_lets_go_the_force_returns_without_a_jump_and_the_models_part",
    ],
    "test_report_regimes": ["test_the_verdict_tells_every_range"],
    "test_schemes": ["test_is_stable_agrees_with_max_stable_dt"],
    "test_travel": ["test_overtravel_splits_the_speeds_where_the_limit_is_passed"],
    "test_uncertainty": [
        "test_a_fit_stands_for_its_slope_at_zero",
        "test_a_pair_that_is_not_there_at_the_estimate_is_reported",
        "test_a_stiffness_that_is_hardly_known_is_followed_no_further_than_a_factor_of_twenty",
        "test_branches_are_the_critical_speeds_at_every_stiffness",
        "test_each_stiffness_of_a_spring_has_its_critical_speeds",
        "test_the_probability_of_a_loss_is_the_share_of_stiffnesses_that_lose",
    ],
}


def pytest_collection_modifyitems(items):
    """Mark the slow tests."""
    for item in items:
        if getattr(item, "originalname", None) in SLOW.get(item.path.stem, []):
            item.add_marker(pytest.mark.slow)

"""What nbval executes is kept, so that the book need not execute it again."""

import execution
import pytest
from helpers import ROOT


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item):
    """After its last cell, put a notebook's outputs where the book looks.

    Nothing is kept if the package or the data have been edited meanwhile: some
    cells may have run with the old ones, others with the new.
    """
    run = item.parent.__dict__
    if "shown" not in run:
        run["shown"], run["common"] = [], execution.fingerprint(ROOT)
    result = yield  # an error of a cell ends it here, and nothing is kept
    outputs = getattr(item, "test_outputs", None)
    if outputs is None:
        return result
    shown, notebook = run["shown"], item.parent.nb  # as it was collected
    shown.append(outputs)
    if len(shown) == len(execution.code_cells(notebook)):
        common = execution.fingerprint(ROOT)
        if common == run["common"]:
            build = ROOT / "_build"
            place = execution.place(item.path, notebook, common, build)
            execution.keep(shown, place)
    return result

"""A JupyterLab of its own, for the tests and the benchmark of the explorer."""

import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager

from helpers import ROOT

PRIVATE = (
    "JUPYTER_CONFIG_DIR",
    "JUPYTER_DATA_DIR",
    "JUPYTER_RUNTIME_DIR",
    "JUPYTERLAB_SETTINGS_DIR",
    "JUPYTERLAB_WORKSPACES_DIR",
    "IPYTHONDIR",
)
OPTIONS = (
    "--no-browser",
    "--allow-root",
    "--ip=127.0.0.1",
    "--IdentityProvider.token=",
    "--LabApp.news_url=None",
    "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
)


@contextmanager
def serve(folder, *options):
    """Start JupyterLab in a folder, without the user's settings; its address, ending in a slash."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    own = {name: str(folder / ".jupyter" / name) for name in PRIVATE}
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    env = os.environ | own | {"PYTHONPATH": path}
    notebooks = [str(path) for path in (folder / "notebooks").glob("*.ipynb")]
    if notebooks:  # as `make lab` does
        trust = [sys.executable, "-m", "jupyter", "trust", *notebooks]
        subprocess.run(trust, env=env, check=True, capture_output=True)
    command = [sys.executable, "-m", "jupyterlab", *OPTIONS, f"--port={port}"]
    server = subprocess.Popen(
        [*command, f"--ServerApp.root_dir={folder}", *options],
        env=env,
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        for _ in range(240):
            with socket.socket() as door:
                if door.connect_ex(("127.0.0.1", port)) == 0:
                    break
            assert server.poll() is None, "JupyterLab did not start"
            time.sleep(0.25)
        yield f"http://127.0.0.1:{port}/"
    finally:
        stop(server)


def stop(server):
    """End a server and its kernels; one too busy to shut them down by itself is killed."""
    server.terminate()
    try:
        server.wait(30)
    except subprocess.TimeoutExpired:
        os.killpg(server.pid, signal.SIGKILL)
        server.wait()


def wait_until_idle(tab):
    """Wait until a kernel has had nothing to do for two seconds: between two cells it has not."""
    idle, calm = tab.get_by_text("(ipykernel) | Idle"), 0
    for _ in range(240):
        tab.wait_for_timeout(500)
        calm = calm + 1 if idle.count() else 0
        if calm == 4:
            return
    raise AssertionError("the kernel is busy still")


def run_all(tab, address, notebook, alive=".suspension-explorer-box.se-live"):
    """Open a notebook alone, run all its cells, and wait for the explorer, or another picture."""
    tab.goto(f"{address}lab/tree/{notebook}?reset")
    # Asked to run before the kernel is there, JupyterLab asks back which one.
    tab.get_by_text("(ipykernel) | Idle").wait_for(timeout=90_000)
    tab.wait_for_timeout(1000)
    tab.get_by_role("menuitem", name="Run", exact=True).click()
    tab.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    # JupyterLab draws what is in sight.
    explorer = tab.locator(f"{alive} canvas[aria-label]")
    pages = tab.locator(".jp-NotebookPanel .jp-WindowedPanel-outer")
    for _ in range(300):
        if explorer.count():
            return
        tab.wait_for_timeout(500)
        pages.evaluate("""outer => {
          const end = outer.scrollTop + outer.clientHeight >= outer.scrollHeight - 5;
          outer.scrollTop = end ? 0 : outer.scrollTop + 0.9 * outer.clientHeight;
        }""")
    raise AssertionError(f"no explorer in {notebook}")

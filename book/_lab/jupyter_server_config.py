"""JupyterLab for this book, `make lab`: what it loads, serves, and writes into files.

A notebook that is opened is not marked as changed: it gets the description of the kernel that will
run it, which JupyterLab would write into it. One that is saved is stored as `make notebooks` stores
it, so that version control sees what a reader has changed and nothing else.
"""

import sys
from pathlib import Path, PurePosixPath

from ipykernel.ipkernel import IPythonKernel
from jupyter_server.services.contents.largefilemanager import AsyncLargeFileManager

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
sys.path.append(str(ROOT / "notebooks"))

from normalise import normalise  # noqa: E402


def is_own(path):
    """Whether `make notebooks` would execute it."""
    path = PurePosixPath(path.strip("/"))
    return len(path.parts) == 2 and path.match("notebooks/*.ipynb")


class Contents(AsyncLargeFileManager):
    """Files as they are, but for the book's own notebooks."""

    async def get(self, path, *args, **kwargs):
        """Open a file."""
        model = await super().get(path, *args, **kwargs)
        if is_own(path) and model["type"] == "notebook" and model["content"]:
            # What JupyterLab asks the kernel for, of the same Python.
            model["content"]["metadata"]["language_info"] = dict(IPythonKernel.language_info)
        return model

    async def save(self, model, path=""):
        """Write a file."""
        if is_own(path) and model.get("type") == "notebook" and model.get("content"):
            model = {**model, "content": normalise(model["content"])}
        return await super().save(model, path)


c = get_config()  # noqa: F821
c.ServerApp.contents_manager_class = Contents
c.ServerApp.extra_static_paths = [str(ROOT / "_build" / "html")]
c.LabServerApp.extra_labextensions_path = [str(HERE / "labextensions")]
c.LabApp.extra_labextensions_path = [str(HERE / "labextensions")]

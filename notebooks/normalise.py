"""Execute notebooks; store what the tests compare, and figures: `make notebooks`.

Of cells tagged `nbval-ignore-output` only figures and their captions are kept:
JupyterLab shows them before anything is run. Widgets and timings are dropped.
Execution counts run 1, 2, 3, as nbval wants them. Running it twice changes
nothing.
"""

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from traitlets.config import Config

KERNEL = {
    "kernelspec": {
        "display_name": "Python 3 (ipykernel)",
        "language": "python",
        "name": "python3",
    },
    "language_info": {"name": "python"},
}
FIGURE = "image/svg+xml"


def normalise(notebook):
    """A copy of an executed notebook that holds only what is compared or drawn."""
    notebook = nbformat.from_dict(notebook)
    notebook.metadata = nbformat.from_dict(KERNEL)
    notebook.nbformat, notebook.nbformat_minor = 4, 5
    count = 0
    for index, cell in enumerate(notebook.cells):
        cell.setdefault("id", f"cell-{index}")
        cell.metadata.pop("execution", None)
        if cell.cell_type != "code":
            cell.pop("attachments", None)
            continue
        count += 1
        cell.execution_count = count
        compared = "nbval-ignore-output" not in cell.metadata.get("tags", [])
        figure = any(FIGURE in x.get("data", {}) for x in cell.outputs)
        wanted = {FIGURE, "text/markdown"} if figure else set()
        cell.outputs = [
            plain(output, count)
            for output in cell.outputs
            if compared or wanted & set(output.get("data", {}))
        ]
    return notebook


def plain(output, count):
    """An output without addresses, widgets, and what else there is of a figure."""
    if "execution_count" in output:
        output.execution_count = count
    if "data" in output:
        output.metadata = nbformat.from_dict({})
        for mime in list(output.data):
            other = mime.startswith(("image/", "application/")) and mime != FIGURE
            if other or (mime == "text/html" and FIGURE in output.data):
                del output.data[mime]
    return output


def main(paths):
    """Execute and normalise the files in place."""
    for path in map(Path, paths):
        notebook = nbformat.read(path, as_version=4)
        client = NotebookClient(
            notebook,
            timeout=600,
            kernel_name="python3",
            coalesce_streams=True,
            resources={"metadata": {"path": str(path.parent)}},
            # Or the kernel warns that it speaks without encryption.
            config=Config(KernelManager={"transport_encryption": "auto"}),
        )
        client.execute()
        nbformat.write(normalise(notebook), path)
        print(path)


if __name__ == "__main__":
    main(sys.argv[1:])

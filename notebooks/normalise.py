"""Execute notebooks, store in them what the tests compare: ``make notebooks``.

Outputs of cells tagged ``nbval-ignore-output`` (figures, widgets, timings) are
dropped, pictures and widget state everywhere; execution counts run 1, 2, 3, as
nbval wants them. Running it twice changes nothing.
"""

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient

KERNEL = {
    "kernelspec": {
        "display_name": "Python 3 (ipykernel)",
        "language": "python",
        "name": "python3",
    },
    "language_info": {"name": "python"},
}
PICTURES = ("image/", "application/vnd.jupyter.widget")


def normalise(notebook):
    """A copy of an executed notebook that holds only what the tests compare."""
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
        ignored = "nbval-ignore-output" in cell.metadata.get("tags", [])
        cell.outputs = (
            []
            if ignored
            else [comparable(output, count) for output in cell.outputs]
        )
    return notebook


def comparable(output, count):
    """An output without its pictures, widgets and addresses."""
    if "execution_count" in output:
        output.execution_count = count
    if "data" in output:
        output.metadata = nbformat.from_dict({})
        for mime in [mime for mime in output.data if mime.startswith(PICTURES)]:
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
        )
        client.execute()
        nbformat.write(normalise(notebook), path)
        print(path)


if __name__ == "__main__":
    main(sys.argv[1:])

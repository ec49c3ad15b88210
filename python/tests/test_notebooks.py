"""The notebooks run as scripts, from the first cell to the last."""

import json
from pathlib import Path

import pytest

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path):
    pytest.importorskip("matplotlib").use("Agg")
    notebook = json.loads(path.read_text(encoding="utf-8"))
    needed = notebook["metadata"].get("needs", [])
    for package in needed:
        pytest.importorskip(package)
    names = {"__name__": path.stem}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            assert not cell["outputs"], "outputs are not kept"
            exec(compile("".join(cell["source"]), str(path), "exec"), names)

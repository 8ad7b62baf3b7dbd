"""The stories of README.md as notebooks, each run from its first cell to its last."""

import pytest
from conftest import ROOT

FOLDER = ROOT / "python" / "notebooks"
#: Text among the outputs of each.
STORIES = {
    "a_heater_that_rings": "pid_Kp",
    "a_log_from_the_pool": "nDotR",
    "what_in_the_paper_is_true": "refuted",
}


def test_each_story_of_the_readme_has_one():
    assert {path.stem for path in FOLDER.glob("*.ipynb")} == set(STORIES)


@pytest.mark.parametrize("story", STORIES)
def test_it_runs(story):
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    notebook = nbformat.read(FOLDER / f"{story}.ipynb", as_version=4)
    title = notebook.cells[0].source.splitlines()[0].removeprefix("# ")
    assert f"\n## {title}\n" in (ROOT / "README.md").read_text(encoding="utf-8")
    resources = {"metadata": {"path": FOLDER}}
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources=resources).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    drawn = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(drawn) >= 2
    assert STORIES[story] in "".join(output.get("text", "") or output.data.get("text/plain", "") for output in outputs)

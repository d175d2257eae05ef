"""What stands beside scenes: experiments, presets, devices, types."""
import importlib.util
import subprocess
import sys

import lavalight
import pytest

from conftest import REPOSITORY


def test_experiments_are_tables():
    tables = lavalight.lab("dice", samples=2048)
    table = tables[0]
    assert table.rows and "estimate" in table.columns
    assert len(table.column("estimate")) == len(table.rows)
    assert table.name in repr(table)
    assert str(table).strip()
    assert table._repr_html_().count("<tr>") == len(table.rows) + 1
    with pytest.raises(KeyError, match="cannot find column"):
        table.column("nothing")


def test_experiments_of_one_seed_are_equal():
    assert lavalight.lab("dice", samples=1024, seed=3)[0].column("estimate") == lavalight.lab("dice", samples=1024, seed=3)[0].column("estimate")


def test_experiments_have_questions():
    assert "dice" in lavalight.experiments()
    with pytest.raises(lavalight.UsageError, match="dice"):
        lavalight.lab("nothing")


def test_presets_and_devices_are_listed():
    assert "mis" in lavalight.presets()
    device = lavalight.devices()[0]
    assert {"name", "driver", "type", "refusals"} <= set(device)


def test_the_vulkan_loader_is_opened_and_not_linked():
    linked = subprocess.run(["ldd", lavalight._lavalight.__file__], check=True, capture_output=True, text=True).stdout
    assert "libc.so" in linked
    if "glfw" in linked:
        pytest.skip("built with the window, whose Dear ImGui links the loader; wheels are built without")
    assert "vulkan" not in linked


def test_the_version_is_the_commands(command):
    assert lavalight.__version__ in command("--version").stdout


def test_types_are_strict():
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary", str(REPOSITORY / "python/tests/typed_user.py")],
                          capture_output=True, text=True, check=False, cwd=REPOSITORY / "python")
    if "No module named mypy" in done.stderr:
        pytest.skip("mypy is not installed")
    assert done.returncode == 0, done.stdout + done.stderr


def blocks_of(page):
    """The Python examples of a page."""
    text = (REPOSITORY / page).read_text(encoding="utf-8")
    return [block.split("```")[0] for block in text.split("```python\n")[1:]]


PAGES = [str(page.relative_to(REPOSITORY)) for page in (REPOSITORY / "README.md", *sorted(REPOSITORY.glob("docs/**/*.md")))]


@pytest.mark.parametrize("page", [page for page in PAGES if blocks_of(page)])
def test_examples_of_the_page_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "__main__"}
    if page == "docs/serve.md":
        names["scene_graph"] = pytest.importorskip("pydrake.geometry").SceneGraph()
    for block in blocks_of(page):
        if "import dask" in block and importlib.util.find_spec("distributed") is None:
            continue
        exec(compile(block, page, "exec"), names)  # one after another, as a reader would
    assert page != "docs/python.md" or names["image"].complete


def test_pages_with_examples_are_found():
    assert "docs/python.md" in PAGES and blocks_of("docs/python.md")

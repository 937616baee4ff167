"""The types of the module, checked by mypy, and against what there is."""

import pathlib
import subprocess
import sys

import pytest

import espalier as es
from espalier import _espalier, _recorded

PACKAGE = pathlib.Path(__file__).resolve().parents[1]


def test_mypy_finds_nothing(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "use.py").write_text(
        "import espalier as es\n"
        "model = es.Model(text='')\n"
        "string: es.ModuleString = model.derive(3)\n"
        "frame: es.PlantFrame\n"
        "reveal_type(frame.tip)\n"
    )
    line = [sys.executable, "-m", "mypy", "--ignore-missing-imports", "--cache-dir", tmp_path / "cache"]
    checked = subprocess.run([*line, "-p", "espalier"], cwd=PACKAGE, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout
    used = subprocess.run([*line, tmp_path / "use.py"], cwd=PACKAGE, capture_output=True, text=True)
    assert used.returncode == 0 and "numpy.ndarray" in used.stdout, used.stdout


@pytest.mark.parametrize("module", [_espalier, _recorded], ids=lambda module: module.__name__)
def test_stubs_name_all_that_the_extensions_have(module):
    stub = (PACKAGE / "espalier" / (module.__name__.rpartition(".")[2] + ".pyi")).read_text(encoding="utf-8")
    for name, value in vars(module).items():
        if name.startswith("_"):
            continue
        assert f"class {name}" in stub or f"def {name}" in stub or f"{name}:" in stub, name
        if isinstance(value, type) and not issubclass(value, Exception):
            for member in vars(value):
                assert member.startswith("_") or f"def {member}(" in stub, f"{name}.{member}"


def test_every_public_name_is_documented():
    for name in es.__all__:
        value = getattr(es, name)
        if isinstance(value, str):
            continue
        assert value.__doc__, name
        if isinstance(value, type):
            for member, of in vars(value).items():
                if not member.startswith("_") and (callable(of) or isinstance(of, property)):
                    assert of.__doc__, f"{name}.{member}"

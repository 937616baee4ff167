"""The installed package."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

import espalier as es

BUILD = pathlib.Path(es.__file__).parent.parent.parent


@pytest.mark.skipif(not shutil.which("cmake") or not (BUILD / "cmake_install.cmake").exists(), reason="no build folder")
def test_the_package_is_installed_as_a_component(tmp_path):
    subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", tmp_path], check=True, capture_output=True)
    (package,) = tmp_path.rglob("espalier/__init__.py")
    assert package.parents[1].name in ("dist-packages", "site-packages")
    assert (package.parent / "py.typed").exists() and not package.is_symlink()
    script = "import espalier as es; print(es.__file__); print(es.Model(text='lsystem: 1\\naxiom: AB\\nendlsystem\\n').derive())"
    environment = {**os.environ, "PYTHONPATH": str(package.parents[1]), "LD_LIBRARY_PATH": str(BUILD)}
    told = subprocess.run([sys.executable, "-c", script], env=environment, check=True, capture_output=True, text=True)
    assert told.stdout.split() == [str(package), "AB"]

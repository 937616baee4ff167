"""Builds wheels of Espalier with CMake: a backend as PEP 517 wants one.

A wheel has the module, and below its `data` the libraries, the program, models and man pages: they are installed beside the
module's folder of libraries, where it looks for them. Settings of pip: `--config-settings build-dir=FOLDER` (default: build/wheel),
`--config-settings cmake=-DNAME=VALUE`, `--config-settings libraries=inside`: with all libraries that are
none of the system's, for machines that lack them (needs patchelf); `--config-settings headers=FOLDER`: for the Python whose
headers packaging/newer-python has left there.
"""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
VERSION = re.search(r"^project\(espalier VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M)[1]
COMPONENTS = ("runtime", "look", "program", "data", "python")


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def metadata():
    lines = ["Metadata-Version: 2.1", f"Name: {PROJECT['name']}", f"Version: {VERSION}", f"Summary: {PROJECT['description']}",
             f"Author: {PROJECT['authors'][0]['name']}", f"License: {PROJECT['license']['text']}",
             f"Keywords: {','.join(PROJECT['keywords'])}", f"Requires-Python: {PROJECT['requires-python']}"]
    lines += [f"Classifier: {classifier}" for classifier in PROJECT["classifiers"]]
    lines += [f"Requires-Dist: {name}" for name in PROJECT["dependencies"]]
    for extra, names in PROJECT["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}"] + [f'Requires-Dist: {name}; extra == "{extra}"' for name in names]
    text = (ROOT / PROJECT["readme"]).read_text()
    return "\n".join(lines) + f"\nDescription-Content-Type: text/markdown\n\n{text}"


def python_of(settings):
    """The version that the module is for: "3.11"."""
    if "headers" not in settings:
        return f"{sys.version_info.major}.{sys.version_info.minor}"
    (headers,) = pathlib.Path(settings["headers"], "usr/include").glob("python3.*")
    return headers.name.removeprefix("python")


def modules_folder(settings):
    return f"lib/python{python_of(settings)}/site-packages"


def wheel_tag(settings):
    python = f"cp{python_of(settings).replace('.', '')}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def build_with_cmake(prefix, settings):
    build = pathlib.Path(settings.get("build-dir", ROOT / "build/wheel")).resolve()
    extra = settings.get("cmake", [])
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count())
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DESPALIER_UNITY=ON",
                    "-DESPALIER_TESTS=OFF", "-DESPALIER_PYTHON=ON", "-DCMAKE_INSTALL_PREFIX=/espalier-prefix",
                    "-DCMAKE_INSTALL_LIBDIR=lib", f"-DESPALIER_PYTHON_DIR={modules_folder(settings)}", f"-DPython_EXECUTABLE={sys.executable}",
                    f"-DESPALIER_PYTHON_HEADERS={settings.get('headers', '')}",
                    *([extra] if isinstance(extra, str) else extra)], check=True)
    subprocess.run(["cmake", "--build", build, "--parallel", jobs], check=True)
    for component in COMPONENTS:
        subprocess.run(["cmake", "--install", build, "--component", component, "--prefix", prefix, "--strip"], check=True)
    if settings.get("libraries") == "inside":
        pathlib.Path(prefix, "lib/espalier/libespalier_ranks.so").unlink(missing_ok=True)  # MPI is the cluster's
        # They lie beside the program's modules, where no other package of Python has libraries.
        subprocess.run([ROOT / "packaging/gather-libraries", prefix, "lib/espalier", "share/doc/espalier/licences"], check=True)


def place_in_wheel(path, data, modules):
    """The modules stand at the top of a wheel, programs among its scripts, all else below its data."""
    for folder, place in ((modules, ""), ("bin", f"{data}/scripts/")):
        if path.startswith(folder + "/"):
            return place + path.removeprefix(folder + "/")
    return f"{data}/data/{path}"


def installed_files(prefix):
    """Path and file; of a library the file under the name that programs ask for, because wheels have no links."""
    files = sorted(prefix.rglob("*"))
    linked = {file.resolve() for file in files if file.is_symlink()}
    for file in files:
        path = file.relative_to(prefix).as_posix()
        if file.is_dir() or (not file.is_symlink() and file.resolve() in linked):
            continue
        yield path, file.resolve()


def write_wheel(wheel, prefix, settings):
    about, data = f"espalier-{VERSION}.dist-info", f"espalier-{VERSION}.data"
    modules = modules_folder(settings)
    entries = [(place_in_wheel(path, data, modules), file.read_bytes(), file.stat().st_mode) for path, file in installed_files(prefix)]
    tags = f"Wheel-Version: 1.0\nGenerator: espalier_build {VERSION}\nRoot-Is-Purelib: false\nTag: {wheel_tag(settings)}\n"
    for name, content in (("METADATA", metadata().encode()), ("WHEEL", tags.encode()), ("LICENSE", (ROOT / "LICENSE").read_bytes())):
        entries.append((f"{about}/{name}", content, 0o100644))
    record = "".join(f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()},{len(content)}\n"
                     for name, content, _ in entries)
    entries.append((f"{about}/RECORD", f"{record}{about}/RECORD,,\n".encode(), 0o100644))
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content, mode in entries:
            entry = zipfile.ZipInfo(name)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, mode << 16
            archive.writestr(entry, content)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    name = f"espalier-{VERSION}-{wheel_tag(settings)}.whl"
    with tempfile.TemporaryDirectory() as folder:
        build_with_cmake(folder, settings)
        write_wheel(pathlib.Path(wheel_directory, name), pathlib.Path(folder), settings)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """What git knows, as ./dev release archives it, and the file that pip looks for."""
    name = f"espalier-{VERSION}"
    archive = pathlib.Path(sdist_directory, name + ".tar.gz")
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder, "tree.tar")
        subprocess.run(["git", "-C", ROOT, "archive", f"--prefix={name}/", "-o", tree, "HEAD"], check=True)
        with tarfile.open(tree) as files, tarfile.open(archive, "w:gz") as out:
            files.extractall(folder)
            pathlib.Path(folder, name, "PKG-INFO").write_text(metadata())
            out.add(pathlib.Path(folder, name), name)
    return archive.name

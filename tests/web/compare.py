#!/usr/bin/python3
"""Grows all models and scenes of the library natively and as WebAssembly, and compares what they are:

    compare.py NATIVE WEB.js [FOLDER] [--steps N] [--folders models environments]

NATIVE and WEB.js are same_bytes, compiled for this machine and for pages. Says how many agree in strings, drawings, fields and
measures, and names those that do not. Exit 0 if all that grow in both agree.
"""

import argparse
import subprocess
import sys
from pathlib import Path

MODELS = {".l", ".pgraph", ".sdl", ".species", ".rsml", ".mtg", ".dgf", ".swc", ".opf"}


def scene(path: Path) -> bool:
    return path.suffix == ".toml" and "[[plant]]" in path.read_text(errors="replace")


def uses_mesh(path: Path) -> bool:
    """A page has exact distances from triangles where a machine has a level set of OpenVDB."""
    return path.suffix == ".toml" and '"mesh"' in path.read_text(errors="replace")


def files_of(root: Path, folders: list[str]) -> list[str]:
    found = [path for folder in folders for path in sorted((root / folder).rglob("*")) if path.is_file()]
    return [str(path.relative_to(root)) for path in found if path.suffix in MODELS or scene(path)]


def grown(command: list[str], root: Path, steps: int, files: list[str]) -> dict[str, str]:
    """What each file has become, by its name. A file that ends the program is left out, and the others go on."""
    lines: dict[str, str] = {}
    left = files
    while left:
        run = subprocess.run([*command, str(steps), *left], cwd=root, capture_output=True, text=True)
        done = [line.split(" ", 1) for line in run.stdout.splitlines() if " " in line]
        lines |= {name: what for name, what in done if name in left}
        broken = next((name for name in left if name not in lines), None)
        if broken is None:
            break
        lines[broken] = f"ended with {run.returncode}: {run.stderr.strip()[-200:]}"
        left = left[left.index(broken) + 1 :]
    return lines


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("native")
    arguments.add_argument("web")
    arguments.add_argument("root", nargs="?", default=Path(__file__).parents[2], type=Path)
    arguments.add_argument("--steps", type=int, default=12)
    arguments.add_argument("--folders", nargs="+", default=["models", "environments"])
    given = arguments.parse_args()
    files = files_of(given.root, given.folders)
    native = grown([str(Path(given.native).resolve())], given.root, given.steps, files)
    web = grown(["node", "--no-experimental-fetch", str(Path(given.web).resolve())], given.root, given.steps, files)
    same = [name for name in files if native[name] == web[name] and native[name].startswith("step")]
    refused = [name for name in files if not web[name].startswith("step") and native[name].startswith("step")]
    neither = [name for name in files if not native[name].startswith("step")]
    meshes = [name for name in files if uses_mesh(given.root / name) and name not in same + refused + neither]
    differ = [name for name in files if name not in same + refused + neither + meshes]
    for name in refused:
        print(f"not in a page: {name}: {web[name].removeprefix('refused ')}")
    for name in meshes:
        print(f"the distance from its mesh is another in a page: {name}")
    for name in neither:
        print(f"in neither: {name}: {native[name]}")
    for name in differ:
        print(f"differs: {name}\n  native {native[name]}\n  web    {web[name]}")
    grow = len(same) + len(differ) + len(meshes)
    print(f"{len(same)} of {grow} have the same bits after {given.steps} steps; {len(refused)} do not grow in a page")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())

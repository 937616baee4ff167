"""What the program does to models, scenes and runs. Keywords are the options of `espalier COMMAND --help`."""

import contextlib
import os
import pathlib

from . import _espalier
from .drawing import Drawable, exported_file, page_element, page_file, picture_file, png_bytes, temporary_folder
from .program import call, call_for_json
from .recorded import Run
from .scene import Scene, toml


def render(what, output, **options):
    """Draws a run, or a model or a scene (as an object or a file) at its end: render(run, "tree.png", colour_by="age").

    The extension says whether it is a picture or a film; size="400x300". Returns the path.
    """
    with _folder_for(what) as folder:
        return picture_file(folder, output, **options)


def png(what, **options):
    """The bytes of a picture of a run, a model or a scene."""
    with _folder_for(what) as folder:
        return png_bytes(folder, **options)


def html(what, height=420, **options):
    """The page of share() as an element of a notebook's cell, which needs neither a server nor a network."""
    with _folder_for(what) as folder:
        return page_element(folder, height, **options)


def share(what, output, **options):
    """Writes a run as one HTML page that can be turned and played in every browser: frames=20, title="Oaks".

    A model or a scene is grown first. Returns the path.
    """
    with _folder_for(what) as folder:
        return page_file(folder, output, **options)


def export(run, output, **options):
    """Writes the last frame of a run, or those of step="all", as a file of another program; its extension says which.

    A model or a scene is grown first. Returns the path.
    """
    with _folder_for(run) as folder:
        return exported_file(folder, output, **options)


def plot(runs, output, **options):
    """Draws charts of one run or of a list of them, as .png or .svg: quantity="height,light.mean". Returns the path."""
    several = runs if isinstance(runs, (list, tuple)) else [runs]
    call("plot", *[_path_of(run) for run in several], output=output, **options)
    return pathlib.Path(output)


def analyse(run, **options):
    """Measures the plants of a run; returns tables by name: {"analysis": DataFrame, "orders": ..., "layers": ...}.

    With field="water", profile="y" the table is "water-y".
    """
    import pandas

    with temporary_folder() as folder:
        call("analyse", _path_of(run), output=folder, no_picture=True, **options)
        return {file.stem: pandas.read_csv(file) for file in sorted(pathlib.Path(folder).glob("*.csv"))}


def fit(what, *targets, parameter=None, **options):
    """Finds parameters of the file of a model or a scene from measurements: fit("bush.l", "traits.csv",
    parameter={"ANGLE": "10:60"}, method="abc", output="folder"). A dict, as `fit --json` prints; with abc the folder has
    posterior.csv, a sample of what the parameters may have been."""
    return call_for_json("fit", what, *targets, parameter=parameter, **options)


def scan(run, output, **options):
    """What a scanner or a depth camera sees of a run, as a DataFrame of points: scan(run, "points.csv", at="4,1,4"). Of
    other files than .csv, the numbers of beams and points."""
    told = call_for_json("scan", _path_of(run), output=output, **options)
    if pathlib.Path(output).suffix != ".csv":
        return told
    import pandas

    return pandas.read_csv(output)


def dataset(file, output=None, **options):
    """Grows, scans and draws the labelled plants of a data set's file: a DataFrame with a row for each plant, as
    dataset.csv has it. A data set in the same folder goes on where it stopped."""
    import pandas

    told = call_for_json("dataset", file, output=output, **options)
    return pandas.read_csv(pathlib.Path(told["folder"]) / "dataset.csv")


def translate(file):
    """The model, as text, that a file of another notation (.pgraph, .sdl, .species) stands for."""
    return call("translate", file)


def check(what, **options):
    """Finds what looks wrong in a model, a scene or a side file: {"warnings": [...], "facts": [...]}. Raises Error at
    a mistake."""
    return call_for_json("check", what, **options)


def sweep(scene, vary, jobs=None, output=None, **options):
    """Grows the file of a scene or a model for every combination of values; a DataFrame with a row a run and plant.

    vary: {"environment.light.strength": [0.2, 0.6], "simulation.seed": "1..4"}, lists or texts of `sweep --vary`; a
    name without a dot is a #define. A sweep with output="folder" goes on where it stopped.
    """
    import pandas

    if not isinstance(scene, (str, os.PathLike)):
        raise _espalier.Error("a sweep takes the file of a scene or a model; vary a scene made in Python in a loop of es.World")
    varied = {key: value if isinstance(value, str) else ",".join(map(_word, value)) for key, value in vary.items()}
    with temporary_folder() as scratch:
        folder = pathlib.Path(output or pathlib.Path(scratch) / "sweep")
        call("sweep", scene, vary=varied, jobs=jobs, output=folder, quiet=True, **options)
        return pandas.read_csv(folder / "sweep.csv")


def _word(value):
    return value if isinstance(value, str) else toml(value)


class tree(Drawable):
    """A tree from a few settings, as `espalier tree`: tree(preset="weeping", seed=4, crown_width=6)."""

    def __init__(self, preset=None, seed=0, **settings):
        self._settings = {"preset": preset, "seed": seed, **settings}

    def save(self, output, **options):
        """Writes the mesh in the format of the extension (.obj, .glb, .ply, .stl, ...); returns the path.

        A file that is there stays: the new one is numbered.
        """
        told = call_for_json("tree", output=output, **self._settings, **options)
        return pathlib.Path(told["files"][0]["path"])

    def save_run(self, folder):
        """Records the growth in a folder, and opens it."""
        with temporary_folder() as scratch:
            call("tree", output=pathlib.Path(scratch) / "tree.obj", run=folder, quiet=True, **self._settings)
        return Run(folder)

    @contextlib.contextmanager
    def _run_folder(self):
        with temporary_folder() as scratch:
            yield self.save_run(pathlib.Path(scratch) / "run").folder


def _path_of(run):
    return run.folder if isinstance(run, Run) else run


def _folder_for(what):
    """A context whose value is the folder of a run: of one that there is, or of one that is grown for it."""
    if isinstance(what, Drawable):
        return what._run_folder()
    if isinstance(what, (str, os.PathLike)) and pathlib.Path(what).is_dir():
        return contextlib.nullcontext(what)
    return Scene.of(what)._run_folder()

"""Scenes: plants and the processes that answer them."""

import contextlib
import json
import numbers
import os
import pathlib

import numpy

from . import _espalier
from .drawing import Drawable, temporary_folder


def toml(value):
    """A number, a text, a list or a dict of these, as a scene file writes it."""
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(one)}" for key, one in value.items()) + " }"
    if isinstance(value, (list, tuple, numpy.ndarray)):
        return "[" + ", ".join(toml(one) for one in value) + "]"
    raise _espalier.Error(f"a setting is a number, a text, a list or a dict, not {type(value).__name__}")


def _settings(values):
    return [(key, toml(value)) for key, value in (values or {}).items()]


class Model(Drawable, _espalier.Model):
    """A model, read and compiled: Model("tree.l") of any notation or Model(text="lsystem: 1 ..."); NAME=value replaces
    a #define. Raises Error with file, line and column. Pickled, it is its text, or its path and not the file."""

    def __init__(self, path=None, text=None, **defines):
        super().__init__(path, text, **defines)
        self._read_from = (None if path is None else pathlib.Path(os.path.abspath(path)), text, defines)

    def __repr__(self):
        path, text, defines = self._read_from
        said = [f"text={text!r}" if path is None else repr(os.path.relpath(path))]
        return f"Model({', '.join(said + [f'{name}={value}' for name, value in defines.items()])})"

    @property
    def text(self):
        """The text that it was made of; None for a file."""
        return self._read_from[1]

    def __reduce__(self):
        return _read_model, self._read_from

    @contextlib.contextmanager
    def _run_folder(self):
        with Scene(plants=[Plant(self)])._run_folder() as folder:
            yield folder


def _read_model(path, text, defines):
    return Model(path, text, **defines)


class Process:
    """A process in Python: subclass it and write answer(). An exception in it ends the growth with its traceback."""

    def answer(self, queries, answers):
        """Answers the whole batch of a step; called once a step that has queries.

        queries.position, .heading: float64 (n, 3), metres; .identity: uint64 (n,); .plant: uint32 (n,);
        .parameters: float64 (n, k), NaN beyond a query's own; .step, .time, .dt: numbers.
        answers: float64 (n, k), at first a copy of the parameters; what is written becomes the answer.
        """
        raise NotImplementedError


class process:
    """A process of the library by its name in `espalier list processes`: process("voxel-shade", voxel=0.25).

    Keywords are its keys in a scene file; tables are dicts: initial={"head": -300}, layers=[{"top": -0.1, ...}].
    Files are relative to the current folder.
    """

    def __init__(self, kind, **settings):
        self.kind = kind
        self.settings = settings

    def __repr__(self):
        return f"process({', '.join([repr(self.kind)] + [f'{key}={value!r}' for key, value in self.settings.items()])})"


class Plant:
    """A plant of a scene: a Model, or the file of one, that grows at a place, metres."""

    def __init__(self, model, at=(0, 0, 0), name=""):
        self.model = model if isinstance(model, _espalier.Model) else Model(model)
        self.at = at
        self.name = name

    def __repr__(self):
        return f"Plant({self.model!r}, at={self.at!r}, name={self.name!r})"


class Scene(Drawable):
    """Plants, and processes by the names that the models ask: {"light": process("voxel-shade")} or Process objects.

    plants: Plants or Models, or one of them. processes advance in their order; the name of a kind, such as "markers",
    is the process with its defaults. steps: those of the models. dt: time that a step stands for, in time_unit.
    """

    def __init__(self, plants=(), processes=None, steps=None, seed=0, dt=1, time_unit="step"):
        self._made_of = {
            "plants": _plants(plants),
            "processes": {name: _process(name, one) for name, one in (processes or {}).items()},
            "steps": steps,
            "seed": seed,
            "time": (dt, time_unit),
        }
        self._make()

    def _make(self):
        made_of = self._made_of
        overrides = _settings(made_of.get("set"))
        self._scene = _espalier.Scene(
            made_of.get("path"), made_of["seed"], made_of.get("steps"), overrides, made_of.get("trust", False)
        )
        if "time" in made_of:
            self._scene.set_time(*made_of["time"])
        for plant in made_of.get("plants", ()):
            self._scene.add_plant(plant.model, plant.at, plant.name)
        for name, one in made_of.get("processes", {}).items():
            if isinstance(one, Process):
                self._scene.add_python_process(name, one)
            else:
                self._scene.add_process(name, one.kind, _settings(one.settings))

    def __repr__(self):
        if "path" in self._made_of:
            return f"Scene.of({str(self._made_of['path'])!r})"
        return f"Scene(plants={self._made_of['plants']!r}, processes={self._made_of['processes']!r})"

    def __getstate__(self):
        path = self._made_of.get("path")
        return self._made_of if path is None else {**self._made_of, "path": pathlib.Path(os.path.abspath(path))}

    def __setstate__(self, made_of):
        self._made_of = made_of
        self._make()

    @contextlib.contextmanager
    def _run_folder(self, steps=None):
        with temporary_folder() as folder:
            record(self, folder, overwrite=True, steps=steps)
            yield folder

    @classmethod
    def of(cls, scene, seed=None, steps=None, set=None, trust=False):
        """The scene itself, that of a Plant or a Model alone, or that of a file (.toml, or a model).

        set changes values of a file, as `--set` does: {"plant.0.define.ANGLE": 40, "environment.light.voxel": 0.5}.
        trust: the environment programs that the file names may be started.
        """
        if isinstance(scene, cls):
            if seed is not None or set:
                raise _espalier.Error("a Scene has its seed and its settings already: Scene(..., seed=...)")
            return scene
        if isinstance(scene, (Plant, _espalier.Model)):
            if set:
                raise _espalier.Error("set changes the file of a scene; a Model takes its #defines: Model(file, ANGLE=40)")
            return cls(scene, seed=seed or 0, steps=steps)
        read = cls.__new__(cls)
        read.__setstate__({"path": pathlib.Path(scene), "seed": seed, "steps": steps, "set": set, "trust": trust})
        return read


def _plants(plants):
    several = [plants] if isinstance(plants, (Plant, _espalier.Model, str, os.PathLike)) else plants
    return [one if isinstance(one, Plant) else Plant(one) for one in several]


def _process(name, one):
    if isinstance(one, str):
        return process(one)
    if isinstance(one, (process, Process)):
        return one
    raise _espalier.Error(
        f"the process '{name}' is of type {type(one).__name__}: give es.process(\"voxel-shade\", ...), or an object of your own"
        " class of es.Process"
    )


def record(scene, output, overwrite=False, seed=None, steps=None, set=None):
    """Grows a scene and records it in the folder `output`, as `espalier run` does; returns the number of steps.

    scene, seed and set as in World. steps: instead of those of the scene. Ctrl-C ends it after a step. If it fails, the
    frames recorded so far are whole.
    """
    return Scene.of(scene, seed, set=set)._scene.record(output, overwrite, steps)

"""Scenes: plants and the processes that answer them."""

import os
import pathlib

from . import _espalier


class Model(_espalier.Model):
    """A model, read and compiled: Model("tree.l") of any notation or Model(text="lsystem: 1 ..."); NAME=value replaces
    a #define. Raises Error with file, line and column. Pickled, it is its text, or its path and not the file."""

    def __init__(self, path=None, text=None, **defines):
        super().__init__(path, text, **defines)
        self._read_from = (None if path is None else pathlib.Path(os.path.abspath(path)), text, defines)

    @property
    def text(self):
        """The text that it was made of; None for a file."""
        return self._read_from[1]

    def __reduce__(self):
        return _read_model, self._read_from

    def _repr_png_(self):
        from .looking import png

        return png(self)

    def _repr_html_(self):
        from .looking import html

        return html(self)


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
    """A process of the library by its name in `espalier list processes`: process("voxel-shade", voxel=0.25)."""

    def __init__(self, kind, **settings):
        self.kind = kind
        self.settings = {name.replace("_", "-"): value for name, value in settings.items()}


class Plant:
    """A plant of a scene: a Model that grows at a place, metres."""

    def __init__(self, model, at=(0, 0, 0), name=""):
        self.model = model
        self.at = at
        self.name = name


class Scene:
    """Plants, and processes by the names that the models ask: {"light": process("voxel-shade")} or Process objects."""

    def __init__(self, plants=(), processes=None, steps=None, seed=0):
        self._made_of = {"plants": list(plants), "processes": dict(processes or {}), "steps": steps, "seed": seed}
        self._make()

    def _make(self):
        made_of = self._made_of
        self._scene = _espalier.Scene(made_of.get("path"), made_of["seed"])
        if made_of.get("steps") is not None:
            self._scene.set_steps(made_of["steps"])
        for plant in made_of.get("plants", ()):
            self._scene.add_plant(plant.model, plant.at, plant.name)
        for name, one in made_of.get("processes", {}).items():
            if isinstance(one, Process):
                self._scene.add_python_process(name, one)
            else:
                self._scene.add_process(name, one.kind, one.settings)

    def __getstate__(self):
        path = self._made_of.get("path")
        return self._made_of if path is None else {**self._made_of, "path": pathlib.Path(os.path.abspath(path))}

    def __setstate__(self, made_of):
        self._made_of = made_of
        self._make()

    def _repr_png_(self):
        from .looking import png

        return png(self)

    def _repr_html_(self):
        from .looking import html

        return html(self)

    @classmethod
    def of(cls, scene, seed=None):
        """The scene itself, or that of a file (.toml, or a model)."""
        if isinstance(scene, cls):
            if seed is not None:
                raise _espalier.Error("a Scene has its seed already: Scene(..., seed=...)")
            return scene
        read = cls.__new__(cls)
        read.__setstate__({"path": pathlib.Path(scene), "seed": seed})
        return read


def record(scene, output, overwrite=False, seed=None, steps=None):
    """Grows a scene and records it in the folder `output`, as `espalier run` does; returns the number of steps.

    steps: instead of those of the scene. Ctrl-C ends it after a step. If it fails, the frames recorded so far are whole.
    """
    return Scene.of(scene, seed)._scene.record(output, overwrite, steps)

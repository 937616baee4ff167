"""Scenes: plants and the processes that answer them."""

from . import _espalier


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
        self._scene = _espalier.Scene(None, seed)
        if steps is not None:
            self._scene.set_steps(steps)
        for plant in plants:
            self._scene.add_plant(plant.model, plant.at, plant.name)
        for name, one in (processes or {}).items():
            if isinstance(one, Process):
                self._scene.add_python_process(name, one)
            else:
                self._scene.add_process(name, one.kind, one.settings)

    @classmethod
    def of(cls, scene, seed=None):
        """The scene itself, or that of a file (.toml, or a model)."""
        if isinstance(scene, cls):
            if seed is not None:
                raise _espalier.Error("a Scene has its seed already: Scene(..., seed=...)")
            return scene
        read = cls.__new__(cls)
        read._scene = _espalier.Scene(scene, seed)
        return read


def record(scene, output, overwrite=False, seed=None):
    """Grows a scene and records it in the folder `output`, as `espalier run` does; returns the number of steps.

    Ctrl-C ends it after a step. If it fails, the frames recorded so far are whole.
    """
    return Scene.of(scene, seed)._scene.record(output, overwrite)

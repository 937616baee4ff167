"""Worlds that grow step by step, and what their frames show."""

import numpy

from . import _espalier
from .drawing import Drawable
from .progress import Bar
from .scene import Scene


class _Parameters:
    """Parameters of internodes by name: parameters["I.3"], float64 (n,), NaN where a module has none."""

    def __init__(self, plants):
        self._plants = plants

    def __getitem__(self, name):
        return _joined([plant.column(name) for plant in self._plants])


class Internodes:
    """The internodes of all plants of a frame, plant after plant.

    Of one plant the arrays tip, base, radius and order are views without a copy, which keep the values of their step
    when the world goes on; of several plants they are joined copies.
    """

    def __init__(self, plants):
        self._plants = plants

    def __len__(self):
        return sum(len(plant) for plant in self._plants)

    @property
    def base(self):
        """Lower ends, float64 (n, 3), metres."""
        return _joined([plant.base for plant in self._plants])

    @property
    def tip(self):
        """Upper ends, float64 (n, 3), metres."""
        return _joined([plant.tip for plant in self._plants])

    @property
    def radius(self):
        """Radii at the tips, float64 (n,), metres; 0 for lines without width."""
        return _joined([plant.radius for plant in self._plants])

    @property
    def order(self):
        """Depths of branching, uint16 (n,); 0: the main axis."""
        return _joined([plant.order for plant in self._plants])

    @property
    def identity(self):
        """Identities of the modules for life, uint64 (n,); unique within a plant."""
        return _joined([plant.identity for plant in self._plants])

    @property
    def plant(self):
        """Numbers of the plants, uint32 (n,)."""
        return numpy.repeat(numpy.arange(len(self._plants), dtype=numpy.uint32), [len(p) for p in self._plants])

    @property
    def parameters(self):
        """Parameters of the modules by name: parameters["I.3"]."""
        return _Parameters(self._plants)

    def __repr__(self):
        return f"{len(self)} internodes"


class Frame(Drawable):
    """One step of a world after its exchange: step, time (the scene's unit), plants, internodes, fields."""

    def __init__(self, frame, scene):
        self._frame = frame
        self._scene = scene
        self.step = frame.step
        self.time = frame.time
        self.plants = frame.plants

    @property
    def internodes(self):
        """What the turtles drew as segments."""
        return Internodes(self.plants)

    def field(self, name):
        """The field of that name, such as "light"; raises Error once the world has gone on."""
        return self._frame.field(name)

    def __repr__(self):
        return f"Frame of step {self.step}: {len(self.plants)} plants, {len(self.internodes)} internodes"

    def quantities(self, plant=0):
        """What the processes tell of a plant (by its number) and of the world, as statistics.csv: {"light.mean": ...}.

        Raises Error once the world has gone on.
        """
        return self._frame.quantities(plant)

    def _run_folder(self):  # of the same scene grown anew up to this step, which gives the same plants
        return self._scene._run_folder(self.step)


class World:
    """The world of a Scene, of a Plant or a Model alone, or of the file of a scene (.toml) or model.

    seed, and set={"plant.0.define.ANGLE": 40}, change what a file says, as `--seed` and `--set` do. The same scene and
    seed give the same bytes.
    """

    def __init__(self, scene, seed=None, set=None):
        self._scene = Scene.of(scene, seed, set=set)
        self._world = _espalier.World(self._scene._scene)

    def run(self, steps=None, progress=False):
        """Yields frame 0 and a frame after every derivation step, `steps` of them or up to the scene's end.

        Called again it goes on from the present frame, for `steps` more; what the first call asks for may be longer
        than the scene. Ctrl-C ends it after a step. progress=True
        draws a bar on standard error, which notebooks show below the cell.
        """
        last = None if steps is None else self.steps_done + steps
        if not self._world.started:
            longer = steps is not None and steps > self._world.last_step
            self._world.start(steps if longer else None)  # otherwise run() could not go on later
            yield self.frame
        bar = Bar(self._world.last_step if last is None else min(last, self._world.last_step)) if progress else None
        while not self._world.at_end and (last is None or self.steps_done < last):
            self._world.step()
            if bar:
                bar.show(self.steps_done, at_end=self._world.at_end or self.steps_done == last)
            yield self.frame

    @property
    def frame(self):
        """The frame of the present step."""
        return Frame(self._world.frame(), self._scene)

    @property
    def stage_seconds(self):
        """Seconds of the last step, by stage: {"derive": ..., "interpret": ..., "exchange": ...}."""
        return self._world.stage_seconds

    @property
    def origin(self):
        """The place on the map, [x, y, z] in metres, y upwards, that all places are relative to; None near 0."""
        return self._world.origin

    @property
    def steps_done(self):
        """How many derivation steps were made."""
        return self._world.steps_done


def _joined(arrays):
    return arrays[0] if len(arrays) == 1 else numpy.concatenate(arrays)

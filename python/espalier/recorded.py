"""Recorded runs."""

import contextlib
import json
import pathlib

import numpy

from . import _espalier
from .conversions import add_conversions, file_to_vtk, to_pyvista
from .drawing import Drawable, exported_file, temporary_folder


class RecordedInternodes:
    """The internodes of all plants of a recorded frame, axis after axis. Arrays are views without a copy.

    base, tip: float32 (n, 3), metres; base_radius, radius (at the tips): float32 (n,), metres; identity, parent (of the
    modules): uint64 (n,); plant: uint32 (n,); order: uint16 (n,); birth: step, int32 (n,); bearer: the row of the
    internode that each stands on, int32 (n,), -1 for the first of a plant.
    """

    _COLUMNS = ("base", "tip", "base_radius", "radius", "identity", "parent", "plant", "order", "birth", "bearer")

    def __init__(self, loaded):
        self._loaded = loaded

    def __len__(self):
        return len(self._loaded)

    def __getattr__(self, name):
        if name not in self._COLUMNS:
            raise AttributeError(name)
        return getattr(self._loaded, name)

    def __dir__(self):
        return [*super().__dir__(), *self._COLUMNS]

    def __repr__(self):
        return f"{len(self)} internodes"

    @property
    def symbols(self):
        """Symbols of the modules, a list of n texts."""
        return self._loaded.symbols

    @property
    def parameters(self):
        """The recorded parameters by name, float64 (n,) each; NaN where a module has none."""
        return {name: self._loaded.parameter(name) for name in self._loaded.parameter_names}


class RecordedFrame(Drawable):
    """A recorded step: step, time (the scene's unit), internodes, fields. Its files are read when they are asked for."""

    def __init__(self, run, step, time):
        self._run = run
        self.step = step
        self.time = time

    @property
    def internodes(self):
        """What the turtles drew as segments."""
        return RecordedInternodes(self._run._reader.frame(self.step))

    def __repr__(self):
        return f"Frame of step {self.step} of {self._run!r}"

    def field(self, name):
        """The recorded field of that name, such as "light"."""
        return self._run.field(name, self.step)

    @property
    def _picture_options(self):
        return {"step": self.step}

    def _run_folder(self):
        return self._run._run_folder()


@add_conversions
class RecordedField:
    """A field as it was recorded: values, float32 (nx, ny, nz); origin, its lower corner, and voxel, metres; unit."""

    def __init__(self, name, values, origin, voxel, unit):
        self.name = name
        self.values = values
        self.origin = origin
        self.voxel = voxel
        self.unit = unit

    def __repr__(self):
        return f"Field '{self.name}': {' x '.join(map(str, self.values.shape))} voxels, {self.unit or 1}"

    def at(self, points):
        """Values at points (n, 3) in metres, trilinear between centres of voxels, those of the rim beyond them."""
        size = numpy.array(self.values.shape)
        place = (numpy.asarray(points, float) - self.origin) / self.voxel - 0.5
        place = numpy.clip(place, 0, size - 1)
        low = numpy.minimum(place.astype(int), numpy.maximum(size - 2, 0))
        part = place - low
        total = numpy.zeros(len(place))
        for corner in numpy.ndindex(2, 2, 2):
            index = numpy.minimum(low + corner, size - 1)
            weight = numpy.where(corner, part, 1 - part).prod(axis=1)
            total += weight * self.values[tuple(index.T)]
        return total


class History:
    """The life of one organ: identity, plant, symbol, parent, order, birth, death (steps; None: unknown), and rows."""

    def __init__(self, lasting, rows):
        self.__dict__.update(lasting)
        self.rows = rows

    @property
    def table(self):
        """A DataFrame with a row for each frame that has the organ: step, time, base, tip, length, radii, area and the
        recorded parameters."""
        import pandas

        return pandas.DataFrame(self.rows)


class Run(Drawable):
    """A run as it lies in a folder, also one that is still going."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        try:
            self.record = json.loads((self.folder / "run.json").read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise _espalier.Error(f"{self.folder}: no recorded run ({error})") from error

    def __repr__(self):
        return f"Run({str(self.folder)!r})"

    @property
    def _reader(self):
        from . import _recorded  # what reads runs loads libraries: only where it is asked for

        return _recorded.RecordedRun(self.folder)

    @property
    def origin(self):
        """The place on the map, [x, y, z] in metres, y upwards, that all places are relative to; None near 0."""
        return self.record.get("origin")

    @property
    def statistics(self):
        """statistics.csv as a DataFrame of pandas: a row for each step and plant."""
        import pandas  # takes half a second: only where it is asked for

        return pandas.read_csv(self.folder / "statistics.csv")

    @property
    def frames(self):
        """The recorded frames, in the order of time: a list of RecordedFrame."""
        return [RecordedFrame(self, step, time) for step, time in self._reader.frames]

    @property
    def organs(self):
        """A DataFrame with a row for each internode, organ and answered query of the last frame."""
        return self.organs_at("last")

    def organs_at(self, step):
        """The same of other frames: a step, "first", "last", "all" or "FROM:TO[:EVERY]". Names, kinds and symbols are
        categories, whose texts are kept once."""
        import pandas

        reader = self._reader
        columns = reader.organs(reader.chosen_steps(str(step)))
        for name in ("name", "kind", "symbol"):
            columns[name] = pandas.Categorical.from_codes(*columns[name])
        return pandas.DataFrame(columns, copy=False)

    def history(self, identity, plant=0):
        """The life of the organ of that identity; of a plant by its number or name. Raises Error if no frame has it."""
        reader = self._reader
        number = reader.plant(plant) if isinstance(plant, str) else int(plant)
        found = reader.history(int(identity), number)
        if found is None:
            raise _espalier.Error(f"{self.folder}: plant {plant} has no organ {identity}")
        return History(*found)

    def field(self, name, step=None):
        """The recorded field of that name and step; default: the last."""
        reader = self._reader
        return RecordedField(name, *reader.field(name, reader.frames[-1][0] if step is None else step))

    def to_mtg(self, step="last"):
        """The plants of a frame as the text of a multiscale tree graph, which openalea.mtg reads."""
        with self._exported("mtg", step) as file:
            return file.read_text(encoding="utf-8")

    def to_vtk(self, step=None):
        """The plants of a frame as vtkPolyData: lines and polygons with all that the timeline keeps; default: the last."""
        import re

        steps = [frame.step for frame in self.frames]
        if step is not None and step not in steps:
            raise _espalier.Error(f"{self.folder}: there is no frame {step}")
        files = re.findall(r'file="([^"]+)"', (self.folder / "plants.pvd").read_text(encoding="utf-8"))
        return file_to_vtk(self.folder / files[-1 if step is None else steps.index(step)])

    def to_pyvista(self, step=None):
        """The same as pyvista.PolyData."""
        return to_pyvista(self.to_vtk(step))

    @contextlib.contextmanager
    def _exported(self, format, step):
        with temporary_folder() as folder:
            yield exported_file(self.folder, pathlib.Path(folder) / f"run.{format}", step=step)

    def _run_folder(self):
        return contextlib.nullcontext(self.folder)


def open(folder):
    """Opens the folder of a run; raises Error if there is none."""
    return Run(folder)

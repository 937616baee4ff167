"""Espalier: open L-systems that grow in an environment. Metres; strings and frames as arrays of numpy.

>>> import espalier as es
>>> str(es.Model(text="lsystem: 1\\nderivation length: 2\\naxiom: A\\nA --> AB\\nendlsystem\\n").derive())
'ABB'
"""

from ._espalier import Error, Field, Model, Module, ModuleString, PlantFrame, RunError, __version__
from .recorded import Run, open
from .scene import Plant, Process, Scene, process, record
from .world import Frame, Internodes, World

__all__ = [
    "Error",
    "Field",
    "Frame",
    "Internodes",
    "Model",
    "Module",
    "ModuleString",
    "Plant",
    "PlantFrame",
    "Process",
    "RunError",
    "Run",
    "Scene",
    "World",
    "__version__",
    "open",
    "process",
    "record",
]

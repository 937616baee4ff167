"""Espalier: open L-systems that grow in an environment. Metres; strings and frames as arrays of numpy.

>>> import espalier as es
>>> str(es.Model(text="lsystem: 1\\nderivation length: 2\\naxiom: A\\nA --> AB\\nendlsystem\\n").derive())
'ABB'
"""

from ._espalier import Error, Field, Module, ModuleString, PlantFrame, RunError, __version__
from .conversions import add_conversions
from .looking import analyse, check, dataset, export, fit, plot, render, scan, share, sweep, translate, tree
from .lpy import from_lpy
from .recorded import Run, open
from .scene import Model, Plant, Process, Scene, process, record
from .world import Frame, Internodes, World

add_conversions(Field)

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
    "Run",
    "RunError",
    "Scene",
    "World",
    "__version__",
    "analyse",
    "check",
    "dataset",
    "export",
    "fit",
    "from_lpy",
    "open",
    "plot",
    "process",
    "record",
    "render",
    "scan",
    "share",
    "sweep",
    "translate",
    "tree",
]

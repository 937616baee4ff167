"""Objects whose __init__ never ran, as copying libraries and mistakes in subclasses make them, are errors."""

import pytest

import espalier as es
from espalier import _espalier, _recorded

ARGUMENTS = {
    "__getitem__": (0,),
    "__contains__": ("A.1",),
    "column": ("A.1",),
    "field": ("light",),
    "at": ([[0, 0, 0]],),
    "set_time": (1, "day"),
    "add_process": ("light", "voxel-shade", []),
    "add_python_process": ("light", es.Process()),
    "plant": ("oak",),
    "frame": (0,),
    "history": (1, 0),
    "organs": ([0],),
    "chosen_steps": ("last",),
    "parameter": ("A.1",),
}


def bound_classes():
    for module in (_espalier, _recorded):
        for value in vars(module).values():
            if isinstance(value, type) and not issubclass(value, Exception):
                yield value


def members(bound):
    """Names and ways to use them of all that the class defines."""
    for name, member in vars(bound).items():
        if name.startswith("_pybind11_"):  # newer versions of pybind11 add their own
            continue
        if isinstance(member, property):
            yield name, member.fget, ()
        elif type(member).__name__ == "instancemethod" and name != "__init__":
            yield name, member, ARGUMENTS.get(name, ())


@pytest.mark.parametrize("bound", bound_classes(), ids=lambda bound: bound.__name__)
def test_every_member_of_every_class_refuses_it(bound, tmp_path):
    used = 0
    for name, member, arguments in members(bound):
        if name in ("to_xarray", "to_vdb", "to_vtk", "to_pyvista"):  # of conversions.py, which use the others
            continue
        if (bound.__name__, name) == ("World", "frame"):
            arguments = ()
        if (bound.__name__, name) == ("RecordedRun", "field"):
            arguments = ("light", 0)
        if name == "record":
            arguments = (tmp_path / "run",)
        if name == "add_plant":
            arguments = (es.Model(text="lsystem: 1\nderivation length: 0\naxiom: A\nendlsystem\n"), (0, 0, 0), "")
        with pytest.raises(TypeError, match="never made"):
            member(bound.__new__(bound), *arguments)
        used += 1
    assert used > 0


def test_as_an_argument_it_is_refused_too():
    with pytest.raises(TypeError, match="never made"):
        es.Model.__new__(es.Model).derive(3)
    with pytest.raises(TypeError, match="never made"):
        _espalier.Scene().add_plant(_espalier.Model.__new__(_espalier.Model), (0, 0, 0), "")
    with pytest.raises(TypeError, match="never made"):
        _espalier.World(_espalier.Scene.__new__(_espalier.Scene))


def test_a_subclass_that_forgets_its_base_is_refused():
    class Mine(es.Model):
        def __init__(self):
            pass

    with pytest.raises(TypeError, match="__init__"):
        Mine()

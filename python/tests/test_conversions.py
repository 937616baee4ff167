"""Fields and frames as objects of other libraries."""

import importlib.util
import pathlib
import sys

import numpy
import pytest

import espalier as es

SHOOT = "lsystem: shoot\nderivation length: 4\naxiom: A(1)\nA(x) --> F(x)A(x/2)\nendlsystem\n"
ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    folder = tmp_path_factory.mktemp("conversions") / "course"
    es.record(ROOT / "environments" / "course-light.toml", folder)
    return es.open(folder)


@pytest.fixture(scope="module")
def fields(course):
    for frame in es.World(ROOT / "environments" / "course-light.toml").run():
        pass
    return {"live": frame.field("light"), "recorded": course.field("light")}


@pytest.mark.parametrize("which", ["live", "recorded"])
def test_xarray_knows_where_the_values_are(fields, which):
    pytest.importorskip("xarray")
    field = fields[which]
    array = field.to_xarray()
    assert array.name == "light" and array.dims == ("x", "y", "z") and array.shape == field.values.shape
    place = [int(size // 2) for size in array.shape]
    centre = [float(array[axis][place[i]]) for i, axis in enumerate("xyz")]
    assert numpy.isclose(float(array[tuple(place)]), field.at([centre])[0])
    assert numpy.isclose(float(array.sel(dict(zip("xyz", centre)), method="nearest")), field.at([centre])[0])


@pytest.mark.parametrize("which", ["live", "recorded"])
def test_openvdb_has_the_values_at_the_same_places(fields, which, tmp_path):
    vdb = pytest.importorskip("pyopenvdb")
    field = fields[which]
    field.to_vdb(tmp_path / "light.vdb")
    grid = vdb.read(str(tmp_path / "light.vdb"), "light")
    access = grid.getConstAccessor()
    for index in numpy.random.default_rng(7).integers(0, field.values.shape, (50, 3)):
        voxel = tuple(int(i) for i in index)
        assert access.getValue(voxel) == field.values[voxel]
        world = grid.transform.indexToWorld(voxel)
        assert numpy.allclose(world, numpy.array(field.origin) + (index + 0.5) * field.voxel)


def test_vtk_has_a_value_a_voxel_and_the_internodes_as_lines(fields, course, tmp_path):
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    field = fields["recorded"]
    image = field.to_vtk()
    assert image.GetNumberOfCells() == field.values.size
    corner = numpy.array(field.origin) + numpy.array(field.voxel) * field.values.shape
    assert numpy.allclose(image.GetBounds()[1::2], corner)
    for index in numpy.random.default_rng(11).integers(0, field.values.shape, (50, 3)):
        value = image.GetCellData().GetScalars().GetTuple1(image.ComputeCellId([int(i) for i in index]))
        assert value == field.values[tuple(index)]
    es.record(es.Scene(plants=[es.Plant(es.Model(text=SHOOT))]), tmp_path / "shoot")
    shoot = es.open(tmp_path / "shoot")
    assert [shoot.to_vtk(step).GetBounds()[3] for step in (1, 2, 3, None)] == [1, 1.5, 1.75, 1.875]
    with pytest.raises(es.Error, match="no frame 99"):
        course.to_vtk(99)


def test_a_library_that_is_missing_is_named(fields, course, monkeypatch):
    for name in ("xarray", "pyopenvdb", "pyvista"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(es.Error, match="apt install python3-xarray"):
        fields["live"].to_xarray()
    with pytest.raises(es.Error, match="python3-openvdb"):
        fields["recorded"].to_vdb()
    if importlib.util.find_spec("vtkmodules"):
        with pytest.raises(es.Error, match="pip install pyvista"):
            course.to_pyvista()

"""Fields and frames as the objects of other libraries, which are imported only here."""

import importlib

import numpy

from . import _espalier


def _library(name, package):
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise _espalier.Error(f"this needs the module {name}: {package}") from error


def field_to_xarray(field):
    """The field as an xarray.DataArray with the dimensions x, y and z: centres of voxels, metres."""
    xarray = _library("xarray", "apt install python3-xarray, or pip install xarray")
    values = field.values
    centres = {
        axis: ("xyz"[i], field.origin[i] + field.voxel[i] * (numpy.arange(values.shape[i]) + 0.5), {"units": "m"})
        for i, axis in enumerate("xyz")
    }
    return xarray.DataArray(values, centres, ("x", "y", "z"), field.name, {"units": field.unit})


def field_to_vdb(field, file=None):
    """The field as a FloatGrid of OpenVDB's module, with its name and its place in metres; written to a file, if one is named."""
    vdb = _library("pyopenvdb", "apt install python3-openvdb")
    grid = vdb.FloatGrid()
    grid.name = field.name
    grid.copyFromArray(numpy.ascontiguousarray(field.values))
    centre = [origin + 0.5 * voxel for origin, voxel in zip(field.origin, field.voxel)]
    rows = [[field.voxel[i] if j == i else 0 for j in range(3)] + [0] for i in range(3)]
    grid.transform = vdb.createLinearTransform([*rows, [*centre, 1]])
    if file is not None:
        vdb.write(str(file), grids=[grid])
    return grid


def field_to_vtk(field):
    """The field as a vtkImageData, a value a voxel."""
    data = _library("vtkmodules.vtkCommonDataModel", "apt install python3-vtk9, or pip install vtk")
    support = _library("vtkmodules.util.numpy_support", "apt install python3-vtk9, or pip install vtk")
    image = data.vtkImageData()
    image.SetOrigin(field.origin)
    image.SetSpacing(field.voxel)
    image.SetDimensions([size + 1 for size in field.values.shape])
    array = support.numpy_to_vtk(field.values.ravel(order="F"), deep=True)
    array.SetName(field.name)
    image.GetCellData().SetScalars(array)
    return image


def file_to_vtk(file):
    """A file of the timeline as vtkPolyData."""
    reading = _library("vtkmodules.vtkIOXML", "apt install python3-vtk9, or pip install vtk")
    reader = reading.vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def to_pyvista(of_vtk):
    """What to_vtk gives, wrapped by PyVista."""
    return _library("pyvista", "pip install pyvista").wrap(of_vtk)


def field_to_pyvista(field):
    """The field as a pyvista.ImageData."""
    return to_pyvista(field_to_vtk(field))


def add_conversions(field_class):
    """Gives a class of fields the methods above."""
    field_class.to_xarray = field_to_xarray
    field_class.to_vdb = field_to_vdb
    field_class.to_vtk = field_to_vtk
    field_class.to_pyvista = field_to_pyvista
    return field_class

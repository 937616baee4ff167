# Shows a recorded run well coloured in ParaView 5.11 or newer.
#
# In the program: Macros > Import New Macro..., choose this file; then File > Open a run's plants.pvd, and press the macro.
# Without a window:  pvpython espalier.py RUN PICTURE.png [COLOUR]
#
# COLOUR is an array: order (default), birth, plant, symbol, identity, or a parameter that the scene records.
import os
import sys

from paraview.simple import *

BARK = [0.42, 0.31, 0.22]
LEAF = [0.35, 0.55, 0.22]
AXIS = 1  # kinds of cells, docs/timeline.md


def folder_of(source):
    """The run's folder, from the reader that a source stands on."""
    while source is not None:
        name = getattr(source, "FileName", None)
        if name:
            return os.path.dirname(name if isinstance(name, str) else name[0])
        source = getattr(source, "Input", None)
    raise RuntimeError("open a run's plants.pvd first, and select it")


def is_constant(information):
    low, high = information.GetRange(0)
    return low >= high


def colour(display, source, array):
    """By the array, if it is there and says something; else leaves stay green and bark brown."""
    for association, data in (("POINTS", source.PointData), ("CELLS", source.CellData)):
        information = data.GetArray(array)
        if information is not None and not is_constant(information):
            ColorBy(display, (association, array))
            table = GetColorTransferFunction(array)
            table.ApplyPreset("Viridis (matplotlib)", True)
            display.RescaleTransferFunctionToDataRange(False, True)
            return True
    return False


def wood(plants, view, array):
    """Axes as tubes as thick as their radius."""
    axes = Threshold(Input=plants, Scalars=["CELLS", "kind"], LowerThreshold=AXIS, UpperThreshold=AXIS)
    surface = ExtractSurface(Input=axes)
    surface.UpdatePipeline()
    if surface.GetDataInformation().GetNumberOfCells() == 0:
        return
    tubes = Tube(Input=surface, Scalars=["POINTS", "radius"], NumberofSides=12, Radius=1.0)
    tubes.VaryRadius = "By Absolute Scalar"
    RenameSource("wood", tubes)
    display = Show(tubes, view)
    display.DiffuseColor = display.AmbientColor = BARK
    if not colour(display, tubes, array):
        display.ColorArrayName = ["POINTS", ""]


def surfaces(plants, view):
    """Leaves, flowers, polygons, generalized cylinders: in the plants' own colours where they have some."""
    organs = Threshold(Input=plants, Scalars=["CELLS", "kind"], LowerThreshold=AXIS + 1, UpperThreshold=AXIS + 4)
    organs.UpdatePipeline()
    if organs.GetDataInformation().GetNumberOfCells() == 0:
        return
    RenameSource("organs", organs)
    display = Show(organs, view)
    display.DiffuseColor = display.AmbientColor = LEAF
    if organs.CellData.GetArray("rgb") is not None:
        ColorBy(display, ("CELLS", "rgb"))
        display.MapScalars = 0
    else:
        display.ColorArrayName = ["POINTS", ""]


def field(path, view):
    """The first field, as three translucent layers of equal value."""
    if not os.path.exists(path):
        return
    reader = PVDReader(registrationName="fields", FileName=path)
    reader.UpdatePipeline()
    names = [reader.PointData.GetArray(i).GetName() for i in range(reader.PointData.GetNumberOfArrays())]
    if not names:
        return
    low, high = reader.PointData.GetArray(names[0]).GetRange(0)
    if low >= high:
        return
    layers = Contour(registrationName=names[0], Input=reader, ContourBy=["POINTS", names[0]])
    layers.Isosurfaces = [low + share * (high - low) for share in (0.25, 0.5, 0.75)]
    display = Show(layers, view)
    ColorBy(display, ("POINTS", names[0]))
    display.Opacity = 0.12
    display.RescaleTransferFunctionToDataRange(False, True)


def show(folder, view, array):
    plants = PVDReader(registrationName="plants", FileName=os.path.join(folder, "plants.pvd"))
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    plants.UpdatePipeline(scene.TimeKeeper.Time)
    Hide(plants, view)
    wood(plants, view, array)
    surfaces(plants, view)
    field(os.path.join(folder, "fields.pvd"), view)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    view.CameraViewUp = [0, 1, 0]
    view.CameraPosition = [0.55, 0.25, 1]
    view.CameraFocalPoint = [0, 0, 0]
    ResetCamera(view)
    GetActiveCamera().Dolly(1.6)
    Render(view)


if len(sys.argv) > 2:
    window = CreateRenderView(ViewSize=[1200, 900])
    show(sys.argv[1], window, sys.argv[3] if len(sys.argv) > 3 else "order")
    SaveScreenshot(sys.argv[2], window)
else:
    show(folder_of(GetActiveSource()), GetActiveViewOrCreate("RenderView"), "order")

# Shows a recorded run well coloured: in ParaView 5.11 or newer, or with the VTK of plain Python, 9.1 or newer.
#
# In ParaView: Macros > Import New Macro..., choose this file; then File > Open a run's plants.pvd, and press the macro.
# Without a window:  pvpython espalier.py RUN PICTURE.png [COLOUR]
#                    python3 espalier.py RUN PICTURE.png [COLOUR]      (Debian: package python3-vtk9; no screen: xvfb-run -a)
#
# COLOUR is an array: order (default), birth, plant, symbol, organ, identity, or a parameter that the scene records.
import os
import sys

try:
    from paraview.simple import *
except ImportError:
    import vtk
    from xml.etree import ElementTree

    in_paraview = False
else:
    in_paraview = True

BARK = [0.42, 0.31, 0.22]
LEAF = [0.35, 0.55, 0.22]
DIRECTION = [0.55, 0.25, 1]  # of the camera, from the plants
AXIS = 1  # kinds of cells, docs/timeline.md
SIZE = (1200, 900)


def plants_of(folder):
    path = os.path.join(folder, "plants.pvd")
    if not os.path.isfile(path):
        sys.exit("%s is not the folder of a run: it has no plants.pvd" % folder)
    return path


def require(array, known):
    if array not in known:
        sys.exit("the run has no array '%s'; it has %s" % (array, ", ".join(sorted(known))))


def fit(camera, bounds, aspect):
    """Moves the camera away from the middle of the bounds until their corners, tall or wide, fill the picture."""
    import math

    middle = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
    length = math.sqrt(sum(x * x for x in DIRECTION))
    back = [x / length for x in DIRECTION]
    right = [back[2], 0, -back[0]]
    length = math.hypot(right[0], right[2])
    right = [x / length for x in right]
    up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
          back[0] * right[1] - back[1] * right[0]]
    slope = math.tan(math.radians(camera.GetViewAngle()) / 2) * 0.92
    distance = 0
    for corner in range(8):
        offset = [bounds[2 * i + (corner >> i & 1)] - middle[i] for i in range(3)]
        across, along, nearer = [sum(a * b for a, b in zip(offset, axis)) for axis in (right, up, back)]
        distance = max(distance, nearer + abs(across) / (slope * aspect), nearer + abs(along) / slope)
    camera.SetFocalPoint(middle)
    camera.SetPosition([middle[i] + (distance or 1) * back[i] for i in range(3)])
    camera.SetViewUp(0, 1, 0)


# --- ParaView -----------------------------------------------------------------------------------------------------


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
    """By the array, if it says something; else leaves stay green and bark brown."""
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
    """Axes as tubes as thick as their radius, and as lines where they have none."""
    axes = Threshold(Input=plants, Scalars=["CELLS", "kind"], LowerThreshold=AXIS, UpperThreshold=AXIS)
    surface = ExtractSurface(Input=axes)
    surface.UpdatePipeline()
    if surface.GetDataInformation().GetNumberOfCells() == 0:
        return
    tubes = Tube(Input=surface, Scalars=["POINTS", "radius"], NumberofSides=12, Radius=1.0)
    tubes.VaryRadius = "By Absolute Scalar"
    RenameSource("wood", tubes)
    for source in (surface, tubes):
        display = Show(source, view)
        display.DiffuseColor = display.AmbientColor = BARK
        if not colour(display, source, array):
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
    plants = PVDReader(registrationName="plants", FileName=plants_of(folder))
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    plants.UpdatePipeline(scene.TimeKeeper.Time)
    require(array, {data.GetArray(i).GetName() for data in (plants.PointData, plants.CellData)
                    for i in range(data.GetNumberOfArrays())})
    Hide(plants, view)
    wood(plants, view, array)
    surfaces(plants, view)
    field(os.path.join(folder, "fields.pvd"), view)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    ResetCamera(view)
    fit(GetActiveCamera(), plants.GetDataInformation().GetBounds(), view.ViewSize[0] / view.ViewSize[1])
    Render(view)


# --- the VTK of plain Python --------------------------------------------------------------------------------------


def last_frame(folder):
    frames = ElementTree.parse(plants_of(folder)).getroot().iter("DataSet")
    last = max(frames, key=lambda frame: float(frame.get("timestep")))
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(folder, last.get("file")))
    reader.Update()
    return reader.GetOutput()


def cells_of_kinds(plants, lowest, highest):
    threshold = vtk.vtkThreshold()
    threshold.SetInputData(plants)
    threshold.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "kind")
    threshold.SetLowerThreshold(lowest)
    threshold.SetUpperThreshold(highest)
    threshold.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_BETWEEN)
    surface = vtk.vtkGeometryFilter()
    surface.SetInputConnection(threshold.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


def tubes_of(axes):
    axes.GetPointData().SetActiveScalars("radius")
    tubes = vtk.vtkTubeFilter()
    tubes.SetInputData(axes)
    tubes.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
    tubes.SetNumberOfSides(12)
    tubes.Update()
    return tubes.GetOutput()


def actor_of(data, plain, array):
    """Coloured by the array, or plain if there is none or it is constant; `rgb` holds colours itself."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    points, cells = data.GetPointData(), data.GetCellData()
    values = cells.GetArray(array) if array == "rgb" else points.GetArray(array) or cells.GetArray(array)
    low, high = values.GetRange(0) if values else (0, 0)
    mapper.SetScalarVisibility(low < high)
    if low < high:
        in_points = points.GetArray(array) is not None and array != "rgb"
        mapper.SetScalarMode(vtk.VTK_SCALAR_MODE_USE_POINT_FIELD_DATA if in_points
                             else vtk.VTK_SCALAR_MODE_USE_CELL_FIELD_DATA)
        mapper.SelectColorArray(array)
        mapper.SetScalarRange(low, high)
        if array != "rgb":
            mapper.SetLookupTable(violet_to_yellow())
            mapper.SetUseLookupTableScalarRange(False)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(plain)
    return actor


def violet_to_yellow():
    colours = vtk.vtkColorTransferFunction()
    ends = ((0.27, 0.00, 0.33), (0.23, 0.32, 0.55), (0.13, 0.57, 0.55), (0.37, 0.79, 0.38), (0.99, 0.91, 0.14))
    for i, rgb in enumerate(ends):
        colours.AddRGBPoint(i / 4, *rgb)
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i in range(256):
        table.SetTableValue(i, *colours.GetColor(i / 255))
    return table


def picture(folder, path, array):
    plants = last_frame(folder)
    data = (plants.GetPointData(), plants.GetCellData())
    require(array, {d.GetArrayName(i) for d in data for i in range(d.GetNumberOfArrays())})
    axes = cells_of_kinds(plants, AXIS, AXIS)
    organs = cells_of_kinds(plants, AXIS + 1, AXIS + 4)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for shown, plain, by in ((axes, BARK, array), (tubes_of(axes), BARK, array), (organs, LEAF, "rgb")):
        if shown.GetNumberOfCells() > 0:
            renderer.AddActor(actor_of(shown, plain, by))
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    fit(renderer.GetActiveCamera(), renderer.ComputeVisiblePropBounds(), SIZE[0] / SIZE[1])
    renderer.ResetCameraClippingRange()
    window.Render()
    pixels = vtk.vtkWindowToImageFilter()
    pixels.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(pixels.GetOutputPort())
    writer.Write()


if len(sys.argv) > 2:
    chosen = sys.argv[3] if len(sys.argv) > 3 else "order"
    if in_paraview:
        window = CreateRenderView(ViewSize=list(SIZE))
        show(sys.argv[1], window, chosen)
        SaveScreenshot(sys.argv[2], window)
    else:
        picture(sys.argv[1], sys.argv[2], chosen)
elif in_paraview:
    show(folder_of(GetActiveSource()), GetActiveViewOrCreate("RenderView"), "order")
else:
    sys.exit("usage: espalier.py RUN PICTURE.png [COLOUR]")

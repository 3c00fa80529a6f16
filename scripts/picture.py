"""Draws body.pvd and garment.pvd of a result; started by scripts/picture, which describes the arguments."""
import argparse
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import vtkmodules.all as vtk

PASCAL_PER_UNIT = {"Pa": 1.0, "kPa": 1e3, "mmHg": 133.322387415, "gf/cm2": 98.0665}
# Colour maps that run from light to dark evenly (ColorBrewer YlOrRd and GnBu), white at zero.
HEAT = ["fffff2", "ffeda0", "fed976", "feb24c", "fd8d3c", "fc4e2a", "e31a1c", "bd0026", "800026"]
COOL = ["fafffa", "e0f3db", "ccebc5", "a8ddb5", "7bccc4", "4eb3d3", "2b8cbe", "0868ac", "084081"]
# The colours of the report: viridis (van der Walt & Smith, CC0), dark at zero, over skin that bears nothing in grey.
VIRIDIS = ["440154", "482878", "3e4989", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725"]
PALETTES = {"heat": (HEAT, COOL), "viridis": (VIRIDIS, VIRIDIS)}
# Frame of the body: x side, y front, z up.
VIEWS = [("front", (0, 1, 0)), ("side", (1, 0, 0)), ("back", (0, -1, 0)), ("other side", (-1, 0, 0))]
INK = (0.15, 0.15, 0.15)
BARE = (0.88, 0.88, 0.88)


def rgb(text):
    return tuple(int(text[i : i + 2], 16) / 255 for i in (0, 2, 4))


def steps(collection):
    """The files of a PVD file in the order of time; none where there is no such file."""
    if not collection.is_file():
        return []
    sets = ElementTree.parse(collection).getroot().findall(".//DataSet")
    if not sets:
        sys.exit(f"error: {collection} lists no time step; run the case again")
    sets.sort(key=lambda entry: float(entry.get("timestep", 0)))
    return [collection.parent / entry.get("file") for entry in sets]


def read(file):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    return grid if grid.GetNumberOfCells() else None


def last_step(collection):
    """The grid of the last time step of a PVD file, or None where there is no such file."""
    files = steps(collection)
    return read(files[-1]) if files else None


def deformed(body):
    """The body's points are reference positions (the garment's are current ones)."""
    body.GetPointData().SetActiveVectors("displacement")
    warp = vtk.vtkWarpVector()
    warp.SetInputData(body)
    warp.Update()
    return warp.GetOutput()


def surface(grid):
    """Outer surface as triangles, each curved facet cut finely enough to look curved."""
    skin = vtk.vtkDataSetSurfaceFilter()
    skin.SetInputData(grid)
    skin.SetNonlinearSubdivisionLevel(3)
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(skin.GetOutputPort())
    normals.SetFeatureAngle(60)
    normals.Update()
    return normals.GetOutput()


def outline(sheet):
    """The open edges of a sheet."""
    clean = vtk.vtkCleanPolyData()  # a seam has two rows of points at one place: sewn here
    clean.SetInputData(sheet)
    clean.SetToleranceIsAbsolute(True)
    clean.SetAbsoluteTolerance(1e-6)
    edges = vtk.vtkFeatureEdges()
    edges.SetInputConnection(clean.GetOutputPort())
    edges.FeatureEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput()


def array_of(data, name):
    """(array, 'point' or 'cell') of a field, or (None, '')."""
    for fields, place in ((data.GetPointData(), "point"), (data.GetCellData(), "cell")):
        if fields.HasArray(name):
            return fields.GetArray(name), place
    return None, ""


def scale(data, name, factor):
    """Divides a field by `factor` in place (SI to the unit shown)."""
    array, _ = array_of(data, name)
    for i in range(array.GetNumberOfTuples()):
        array.SetValue(i, array.GetValue(i) / factor)


def largest_inside(skin):
    """The largest pressure where the garment covers the skin fully: a hem is a line and would take the whole scale."""
    pressure, _ = array_of(skin, "contact_pressure")
    coverage, _ = array_of(skin, "coverage")
    inside = [pressure.GetValue(i) for i in range(pressure.GetNumberOfTuples())
              if coverage is None or coverage.GetValue(i) > 0.95]
    return max(inside, default=0.0) or pressure.GetRange()[1]


def colours(table, top):
    function = vtk.vtkColorTransferFunction()
    function.SetColorSpaceToLab()
    for i, colour in enumerate(table):
        function.AddRGBPoint(top * i / (len(table) - 1), *rgb(colour))
    if table is VIRIDIS:  # dark at zero: skin that bears nothing stays grey
        function.AddRGBPoint(0.0, *BARE)
        function.AddRGBPoint(1e-3 * top, *BARE)
        function.AddRGBPoint(2e-3 * top, *rgb(table[0]))
    return function


def round_up(value):
    """The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten."""
    power = 10.0 ** len(str(int(value))) / 10 if value >= 1 else 1e-6
    while True:
        for step in (1, 1.5, 2, 3, 4, 5, 6, 8):
            if step * power >= value:
                return step * power
        power *= 10


def towards_camera(mapper, depth_steps):
    """Draws a sheet that lies on another one as if it were closer: the garment touches the skin."""
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0, -depth_steps)
    mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0, -depth_steps)


def coloured(data, name, function, depth_steps=0):
    mapper = vtk.vtkPolyDataMapper()
    towards_camera(mapper, depth_steps)
    mapper.SetInputData(data)
    _, place = array_of(data, name)
    mapper.SetScalarModeToUsePointFieldData() if place == "point" else mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray(name)
    mapper.SetLookupTable(function)
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    return as_actor(mapper)


def plain(data, colour, width=None, depth_steps=0):
    mapper = vtk.vtkPolyDataMapper()
    towards_camera(mapper, depth_steps)
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = as_actor(mapper)
    actor.GetProperty().SetColor(*colour)
    if width:
        actor.GetProperty().SetLineWidth(width)
        actor.GetProperty().LightingOff()
    return actor


def as_actor(mapper):
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.78)
    actor.GetProperty().SetDiffuse(0.27)
    actor.GetProperty().SetSpecular(0.0)
    return actor


def text(renderer, words, x, y, size, centred=True):
    actor = vtk.vtkTextActor()
    actor.SetInput(words)
    style = actor.GetTextProperty()
    style.SetColor(*INK)
    style.SetFontSize(size)
    if centred:
        style.SetJustificationToCentered()
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(x, y)
    renderer.AddActor2D(actor)


def colour_bar(window, function, title, box, size):
    """Beside a row; of a row of one colour its title alone."""
    renderer = vtk.vtkRenderer()
    renderer.SetViewport(*box)
    renderer.SetBackground(1, 1, 1)
    text(renderer, title, 0.05, 0.82, size, centred=False)
    window.AddRenderer(renderer)
    if not function:
        return
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(function)
    bar.SetNumberOfLabels(6)
    bar.SetLabelFormat(" %-.3g")
    bar.UnconstrainedFontSizeOn()
    style = bar.GetLabelTextProperty()
    style.SetColor(*INK)
    style.SetFontSize(size)
    style.ItalicOff()
    style.BoldOff()
    style.ShadowOff()
    bar.SetPosition(0.05, 0.08)
    bar.SetWidth(0.5)
    bar.SetHeight(0.68)
    bar.SetBarRatio(0.3)
    renderer.AddActor2D(bar)


def row(window, actors, bounds, bottom, top, right, size, views):
    """One renderer a view, all at one scale; parallel projection, so that lengths compare."""
    low, high = bounds[0::2], bounds[1::2]
    centre = [(a + b) / 2 for a, b in zip(low, high)]
    across, height = max(high[0] - low[0], high[1] - low[1]), high[2] - low[2]
    pixels = window.GetSize()
    aspect = (right / len(views) * pixels[0]) / ((top - bottom) * pixels[1])
    half = 0.5 * max(height, across / aspect) / 0.82
    for i, (name, direction) in enumerate(views):
        renderer = vtk.vtkRenderer()
        renderer.SetViewport(right * i / len(views), bottom, right * (i + 1) / len(views), top)
        renderer.SetBackground(1, 1, 1)
        for actor in actors:
            renderer.AddActor(actor)
        text(renderer, name, 0.5, 0.015, size)
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(*centre)
        camera.SetPosition(*(c + 10 * (across + height) * d for c, d in zip(centre, direction)))
        camera.SetViewUp(0, 0, 1)
        camera.SetParallelScale(half)
        renderer.ResetCameraClippingRange()
        window.AddRenderer(renderer)


def pressure_row(skin, edge, function, unit, top):
    over = array_of(skin, "contact_pressure")[0].GetRange()[1]
    note = f"\nhem up to {over:.3g}" if over > 1.001 * top else ""
    actors = [coloured(skin, "contact_pressure", function)] + ([edge] if edge else [])
    return actors, function, f"contact pressure\n{unit}{note}"


def tension_row(sheet, skin, edge, function, name, closer=40000):
    """`closer`: of cloth that lies on the skin; where it hangs in folds one would show through the other."""
    actors = [coloured(sheet, name, function, closer), edge]
    if skin:
        actors.append(plain(skin, (0.88, 0.86, 0.84)))
    return actors, function, f"tension, {name.split('_')[1]}\nN/m"


def shape_row(sheet, skin, edge):
    """Cloth in one colour, lit from where it is seen: its folds."""
    cloth = plain(sheet, (0.45, 0.58, 0.70))
    cloth.GetProperty().SetAmbient(0.15)
    cloth.GetProperty().SetDiffuse(0.9)
    actors = [cloth, edge] + ([plain(skin, (0.88, 0.86, 0.84))] if skin else [])
    return actors, None, "shape"


def carrying(sheet):
    """The thread system that carries the garment: the one with the larger maximum, and that."""
    return max((array_of(sheet, n)[0].GetRange()[1], n) for n in ("tension_warp", "tension_weft"))


def render(rows, bounds, width, views):
    """A window with one row a field."""
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    bar = 0.14 if len(views) > 3 else 0.22
    window.SetSize(width, 2 * int(width * (1 - bar) / len(views) * 1.58 * len(rows) / 2))
    size = max(10, width // (21 * len(views)))
    for i, (actors, function, title) in enumerate(rows):
        bottom, top = 1 - (i + 1) / len(rows), 1 - i / len(rows)
        row(window, actors, bounds, bottom, top, 1 - bar, size, views)
        colour_bar(window, function, title, (1 - bar, bottom, 1.0, top), size)
    window.Render()
    return window


def save(window, out):
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(out))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


def main():
    parser = argparse.ArgumentParser(prog="scripts/picture")
    parser.add_argument("result", type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--unit", choices=PASCAL_PER_UNIT)
    parser.add_argument("--width", type=int, default=1800)
    parser.add_argument("--palette", choices=PALETTES, default="heat")
    arguments = parser.parse_args()

    body, garment = (last_step(arguments.result / name) for name in ("body.pvd", "garment.pvd"))
    if body is None and garment is None:
        sys.exit(f"error: {arguments.result} holds neither body.pvd nor garment.pvd; name the out/ folder of a run")

    heat, cool = PALETTES[arguments.palette]
    rows = []  # actors, colour function, title
    sheet = surface(garment) if garment else None
    skin = surface(deformed(body)) if body else None
    shape_only = skin and not array_of(skin, "contact_pressure")[0]
    edge = plain(outline(sheet), INK, 2.0, 500 if shape_only else 80000) if sheet else None
    if skin and array_of(skin, "contact_pressure")[0]:
        unit = arguments.unit or ("Pa" if largest_inside(skin) < 2000 else "kPa")
        scale(skin, "contact_pressure", PASCAL_PER_UNIT[unit])
        top = round_up(max(largest_inside(skin), 1e-3))
        rows.append(pressure_row(skin, edge, colours(heat, top), unit, top))
    elif sheet:
        rows.append(shape_row(sheet, skin, edge))
    if sheet:
        top, name = carrying(sheet)
        rows.append(tension_row(sheet, skin, edge, colours(cool, round_up(max(top, 1e-3))), name, 0 if shape_only else 40000))
    out = arguments.out or arguments.result / "picture.png"
    box = vtk.vtkBoundingBox()
    for part in (skin, sheet):
        if part:
            box.AddBounds(part.GetBounds())
    bounds = [0.0] * 6
    box.GetBounds(bounds)
    save(render(rows, bounds, arguments.width, VIEWS), out)
    print(out)


if __name__ == "__main__":
    main()

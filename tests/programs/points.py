"""Shows a point cloud with VTK for some seconds; it turns."""
import sys

import vtkmodules.vtkInteractionStyle  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

reader = vtkPLYReader()
reader.SetFileName(sys.argv[1])
points = vtkVertexGlyphFilter()
points.SetInputConnection(reader.GetOutputPort())
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(points.GetOutputPort())
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetPointSize(2)
renderer = vtkRenderer()
renderer.AddActor(actor)
window = vtkRenderWindow()
window.SetSize(640, 480)
window.AddRenderer(renderer)
renderer.ResetCamera()
renderer.GetActiveCamera().Elevation(-50)
while True:
    renderer.GetActiveCamera().Azimuth(1)
    window.Render()

# SPDX-License-Identifier: MIT
"""Renders the best view in another library's own window, and prints how much of the silhouette agrees with ours.

    xvfb-run -a python3 silhouettes.py open3d|vtk MODEL     one number a case: intersection over union
"""
import sys

import numpy as np

import vantage

SIZE = (400, 300)


def in_open3d(V, F, _):
    import open3d
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(V), open3d.utility.Vector3iVector(F))
    camera = vantage.best_view(mesh).best.camera
    window = open3d.visualization.Visualizer()
    window.create_window(width=SIZE[0], height=SIZE[1], visible=False)
    window.add_geometry(mesh)
    if not window.get_view_control().convert_from_pinhole_camera_parameters(camera.open3d_parameters(*SIZE)):
        raise SystemExit("Open3D does not take these parameters")
    window.poll_events()
    window.update_renderer()
    picture = np.asarray(window.capture_screen_float_buffer(True))
    window.destroy_window()
    return camera, (picture < 0.98).any(axis=-1)  # the ground is white


def in_vtk(V, F, projection):
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  chooses how windows are drawn
    from vtkmodules import vtkRenderingCore as core
    from vtkmodules.util.numpy_support import vtk_to_numpy
    data = vtk_mesh(V, F)
    camera = vantage.best_view(data, projection=projection).best.camera
    mapper = core.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = core.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetColor(0, 0, 0)
    renderer = core.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    window = core.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    camera.set_vtk_camera(renderer.GetActiveCamera())
    renderer.ResetCameraClippingRange()
    window.Render()
    grab = core.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    picture = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(SIZE[1], SIZE[0], -1)[::-1]
    return camera, (picture < 128).any(axis=-1)


def vtk_mesh(V, F):
    """A vtkPolyData of triangles, or of quads and strips if F is a list of rows of other lengths."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(V), deep=True))
    cells = vtkCellArray()
    for face in F:
        cells.InsertNextCell(len(face))
        for vertex in face:
            cells.InsertCellPoint(int(vertex))
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def main():
    library, path = sys.argv[1:]
    model = vantage.load(path)
    V, F = model.vertices.copy(), model.faces.astype(np.int32)
    draw = {"open3d": in_open3d, "vtk": in_vtk}[library]
    for projection in ("perspective", "orthographic") if library == "vtk" else ("perspective",):
        camera, theirs = draw(V, F, projection)
        ours = vantage.render(V, F, camera=camera, size=SIZE)[..., 3] > 127
        print(projection, (ours & theirs).sum() / (ours | theirs).sum())


if __name__ == "__main__":
    main()

"""Drake's side of tools/ci/serve, run by a Python that has drake: python serve_drake.py ADDRESS MODEL.gltf

Renders colour, depth and label images of scenes through the server, by RenderEngineGltfClient. Judges depths and labels by the closed form of
boxes, and by Drake's own engine on VTK. Prints JSON.
"""
import json
import sys

import numpy as np
from pydrake.geometry import (
    Box, ClippingRange, ColorRenderCamera, Cylinder, DepthRange, DepthRenderCamera, GeometryInstance, MakeRenderEngineGltfClient, MakeRenderEngineVtk,
    Mesh, PerceptionProperties, RenderCameraCore, RenderEngineGltfClientParams, RenderEngineVtkParams, RenderLabel, Rgba, SceneGraph, Sphere)
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.sensors import CameraInfo

NEAR, FAR = 0.1, 10.0
SENSOR = (0.5, 6.0)  # metres that the depth sensor measures
NOWHERE = int(RenderLabel.kDontCare)  # white, which the protocol has for what the server adds

# Middle, size, label. Gaps of a millimetre and more: where two surfaces coincide, either may be seen.
BOXES = [((0.2, 0.1, 0.22), (1.0, 0.6, 0.4), 1), ((0.0, 0.0, -0.05), (6.0, 6.0, 0.1), 255), ((-0.7, 0.4, 0.51), (0.3, 0.3, 1.0), 30000), ((0.1, -1.2, 0.16), (0.2, 0.2, 0.3), 12345)]
CAMERAS = {"square": CameraInfo(160, 120, 0.9), "off-centre": CameraInfo(160, 120, 150.0, 145.0, 61.3, 70.8), "tall": CameraInfo(90, 200, 170.0, 210.5, 45.0, 99.5)}


def view():
    """A camera 2.5 m before the scene and 1.8 m up that looks down by 30 degrees: Drake's cameras look along z, y is down."""
    down = np.radians(30.0)
    forward = np.array([0.0, np.cos(down), -np.sin(down)])
    right = np.array([1.0, 0.0, 0.0])
    return RigidTransform(RotationMatrix(np.column_stack([right, np.cross(forward, right), forward])), [0.1, -2.5, 1.8])


def engine_query(engine, shapes):
    builder = DiagramBuilder()
    graph = builder.AddSystem(SceneGraph())
    graph.AddRenderer("engine", engine)
    source = graph.RegisterSource("scene")
    for i, (shape, middle, label) in enumerate(shapes):
        instance = GeometryInstance(RigidTransform(list(middle)), shape, f"shape {i}")
        properties = PerceptionProperties()
        properties.AddProperty("label", "id", RenderLabel(label))
        properties.AddProperty("phong", "diffuse", Rgba(0.2 + 0.2 * (i % 4), 0.5, 0.8 - 0.2 * (i % 4), 1.0))
        instance.set_perception_properties(properties)
        graph.RegisterAnchoredGeometry(source, instance)
    diagram = builder.Build()
    context = diagram.CreateDefaultContext()
    query = graph.get_query_output_port().Eval(graph.GetMyContextFromRoot(context))
    return diagram, context, query, graph.world_frame_id()


def images(engine, shapes, info):
    _diagram, _context, query, world = kept = engine_query(engine, shapes)
    core = RenderCameraCore("engine", info, ClippingRange(NEAR, FAR), RigidTransform())
    color = query.RenderColorImage(ColorRenderCamera(core), world, view()).data.copy()
    depth = query.RenderDepthImage(DepthRenderCamera(core, DepthRange(*SENSOR)), world, view()).data[..., 0].copy()
    label = query.RenderLabelImage(ColorRenderCamera(core), world, view()).data[..., 0].copy()
    del kept
    return color, depth, label


def closed_form(info):
    """Depths and labels of BOXES by the slab test, for the ray through the middle of each pixel."""
    x, y = np.meshgrid(np.arange(info.width()) + 0.5, np.arange(info.height()) + 0.5)
    local = np.stack([(x - info.center_x()) / info.focal_x(), (y - info.center_y()) / info.focal_y(), np.ones_like(x)], axis=-1)
    direction = local @ view().rotation().matrix().T
    origin = view().translation()
    depth, label = np.full(x.shape, np.inf), np.full(x.shape, NOWHERE)
    for middle, size, number in BOXES:
        with np.errstate(divide="ignore"):
            planes = np.stack([(np.array(middle) + sign * 0.5 * np.array(size) - origin) / direction for sign in (-1, 1)])
        enters, leaves = planes.min(axis=0).max(axis=-1), planes.max(axis=0).min(axis=-1)
        hit = (enters < leaves) & (enters > NEAR) & (enters < depth) & (enters < FAR)
        depth, label = np.where(hit, enters, depth), np.where(hit, number, label)
    return np.where(depth < SENSOR[0], 0.0, np.where(depth > SENSOR[1], np.inf, depth)), label


def inside(label):
    """Pixels whose neighbours have their label: on silhouettes rasterisation rounds edges to parts of a pixel, and rays do not."""
    padded = np.pad(label, 1, mode="edge")
    return np.logical_and.reduce([label == padded[1 + y:padded.shape[0] - 1 + y, 1 + x:padded.shape[1] - 1 + x] for y in (-1, 0, 1) for x in (-1, 0, 1)])


def judged(found, expected, where=None):
    """Largest error of depths, and how many pixels have another depth of none, or another label."""
    depth, label, true_depth, true_label = (image if where is None else image[where] for image in (*found, *expected))
    both = np.isfinite(depth) & np.isfinite(true_depth) & (depth > 0) & (true_depth > 0)
    return {"pixels": int(depth.size), "measured": int(both.sum()), "depth error": float(np.abs(depth - true_depth)[both].max()),
            "depth beyond 1 mm": int((np.abs(np.where(both, depth - true_depth, 0.0)) > 1e-3).sum()),
            "other limits": int((np.where(both, 1.0, depth) != np.where(both, 1.0, true_depth)).sum()), "labels that differ": int((label != true_label).sum())}


def main():
    address, model = sys.argv[1], sys.argv[2]
    base, _, endpoint = address.rpartition("/")

    def client():
        return MakeRenderEngineGltfClient(RenderEngineGltfClientParams(base_url=base, render_endpoint=endpoint))

    boxes = [(Box(*size), middle, label) for middle, size, label in BOXES]
    mixed = [*boxes, (Sphere(0.3), (-0.1, 0.7, 0.9), 200), (Cylinder(0.2, 0.6), (0.9, -0.5, 0.4), 4660)]
    result = {}
    for name, info in CAMERAS.items():
        color, depth, label = images(client(), boxes, info)
        result[f"{name}, closed form"] = judged((depth, label), closed_form(info))
        result[f"{name}, closed form"]["colours"] = len(np.unique(color.reshape(-1, 4), axis=0))
        color, depth, label = images(client(), mixed, info)
        _, true_depth, true_label = images(MakeRenderEngineVtk(RenderEngineVtkParams()), mixed, info)
        true_label = np.where(true_label == int(RenderLabel.kEmpty), NOWHERE, true_label)
        result[f"{name}, Drake's VTK"] = judged((depth, label), (true_depth, true_label), inside(true_label))
    # A glTF of its own, whose materials Drake paints with the label.
    with_mesh = [*boxes, (Mesh(model, 0.2), (0.8, -0.6, 0.5), 777)]
    _, depth, label = images(client(), with_mesh, CAMERAS["square"])
    result["labels of a scene with a glTF"] = {str(number): int((label == number).sum()) for number in np.unique(label)}
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()

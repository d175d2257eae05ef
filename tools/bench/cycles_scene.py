"""A glTF file under an environment map as a scene of Blender's, for Cycles beside Lavalight.

Blender's own importer reads the file, so that nothing of Lavalight's reading of glTF is repeated here. What is changed after the
import are choices of Blender's that glTF does not ask for: multiple scattering between microfacets, which appendix B of glTF
does not have, is turned off.
"""
from pathlib import Path

import bpy
import addon_utils  # bpy has it, once it is imported itself
import mathutils
import numpy as np


def declare_view(parser):
    """Options that say what is seen from where."""
    parser.add_argument("scene")
    parser.add_argument("environment")
    parser.add_argument("--look-from", required=True)
    parser.add_argument("--look-at", required=True)
    parser.add_argument("--fov", type=float, default=40.0, help="vertical, degrees")
    parser.add_argument("--size", default="512x512", type=lambda text: tuple(int(n) for n in text.split("x")))


def vector(text):
    return mathutils.Vector([float(part) for part in text.split(",")])


def to_blender(v):
    """glTF's y is up, Blender's z."""
    return mathutils.Vector((v.x, -v.z, v.y))


def add_camera(scene, options):
    data = bpy.data.cameras.new("view")
    data.sensor_fit = "VERTICAL"
    data.angle_y = np.radians(options.fov)
    data.clip_start, data.clip_end = 1e-3, 1e4
    camera = bpy.data.objects.new("view", data)
    start, target = to_blender(vector(options.look_from)), to_blender(vector(options.look_at))
    camera.location = start
    camera.rotation_euler = (target - start).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera


def add_environment(scene, path):
    """Blender's equirectangular projection is Lavalight's, once y is up in the one and z in the other."""
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(path)
    picture.image.colorspace_settings.name = "Linear Rec.709"
    tree.links.new(picture.outputs["Color"], tree.nodes["Background"].inputs["Color"])


def load(options):
    """The scene, with camera and light."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("io_scene_gltf2")
    bpy.ops.import_scene.gltf(filepath=str(Path(options.scene).resolve()))
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else []:
            if node.type == "BSDF_PRINCIPLED":
                node.distribution = "GGX"
    scene = bpy.context.scene
    add_camera(scene, options)
    add_environment(scene, str(Path(options.environment).resolve()))
    scene.render.resolution_x, scene.render.resolution_y = options.size
    scene.render.resolution_percentage = 100
    return scene

"""A glTF file, under an environment map or with its own lights, as a scene of Blender's, for Cycles beside Lavalight.

Blender's own importer reads the file, so that nothing of Lavalight's reading of glTF is repeated here. What is changed after the
import are choices of Blender's that glTF does not ask for: multiple scattering between microfacets, which appendix B of glTF
does not have, is turned off, and lights are points and directions without size, of the strength that the file has.
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
    """Blender's equirectangular projection is Lavalight's, once y is up in the one and z in the other. No map: black."""
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    if path is None:
        tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
        return
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(str(Path(path).resolve()))
    picture.image.colorspace_settings.name = "Linear Rec.709"
    tree.links.new(picture.outputs["Color"], tree.nodes["Background"].inputs["Color"])


def import_file(path):
    """Intensities are taken as radiometric, as Lavalight takes them, not as photometric."""
    addon_utils.enable("io_scene_gltf2")
    bpy.ops.import_scene.gltf(filepath=str(Path(path).resolve()), export_import_convert_lighting_mode="COMPAT")
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else []:
            if node.type == "BSDF_PRINCIPLED":
                node.distribution = "GGX"
    for light in bpy.data.lights:
        if light.type == "SUN":
            light.angle = 0
        else:
            light.shadow_soft_size = 0


def set_estimator(scene, bounces):
    """Plain path tracing, whose mean is the true picture but for the end of paths: no denoising, no clamps, a box filter."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.use_light_tree = True
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
    cycles.transmission_bounces = cycles.transparent_max_bounces = bounces
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type = "BOX"
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"


def load(options):
    """The scene, with camera and light."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    import_file(options.scene)
    scene = bpy.context.scene
    add_camera(scene, options)
    add_environment(scene, options.environment)
    scene.render.resolution_x, scene.render.resolution_y = options.size
    scene.render.resolution_percentage = 100
    return scene

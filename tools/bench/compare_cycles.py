"""Renders one view of a glTF file with Lavalight and with Cycles and compares the pictures; see tools/bench/compare_cycles.

Cycles gets the file through Blender's own importer, so that nothing of Lavalight's reading of glTF is repeated here. What is
changed after the import are choices of Blender's that glTF does not ask for: multiple scattering between microfacets, which
appendix B of glTF does not have, is turned off.
"""
import argparse
import json
import subprocess
from pathlib import Path

import bpy
import addon_utils  # bpy has it, once it is imported itself
import flip_evaluator
import mathutils
import numpy as np
import OpenEXR


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


def set_estimator(scene, options):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = options.spp, 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = options.bounces
    cycles.transmission_bounces = cycles.transparent_max_bounces = options.bounces
    cycles.blur_glossy = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x, scene.render.resolution_y = options.size
    scene.render.resolution_percentage = 100
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"


def render_with_cycles(options, out):
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
    set_estimator(scene, options)
    scene.render.filepath = str(out.resolve())
    bpy.ops.render.render(write_still=True)


def render_with_lavalight(options, out):
    width, height = options.size
    subprocess.run(
        [options.lavalight, "render", options.scene, "--env", options.environment, "--size", f"{width}x{height}",
         "--look-from", options.look_from, "--look-at", options.look_at, "--fov", str(options.fov),
         "--spp", str(options.spp), "--max-bounces", str(options.bounces), "-o", str(out), "--quiet"], check=True)


def pixels(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        return np.stack([channels[name].pixels for name in "RGB"], axis=-1).astype(np.float32)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lavalight", required=True)
    parser.add_argument("scene")
    parser.add_argument("environment")
    parser.add_argument("--look-from", required=True)
    parser.add_argument("--look-at", required=True)
    parser.add_argument("--fov", type=float, default=40.0, help="vertical, degrees")
    parser.add_argument("--size", default="512x512", type=lambda text: tuple(int(n) for n in text.split("x")))
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--bounces", type=int, default=16)
    parser.add_argument("--out", type=Path, default=Path("out/compare-cycles"))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    ours, theirs = options.out / "lavalight.exr", options.out / "cycles.exr"
    render_with_lavalight(options, ours)
    render_with_cycles(options, theirs)
    a, b = pixels(ours), pixels(theirs)
    error_map, flip, _ = flip_evaluator.evaluate(b, a, "HDR")
    OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage},
                 {"RGB": np.ascontiguousarray(error_map.astype(np.float32))}).write(str(options.out / "flip.exr"))
    means = {"lavalight": a.mean(axis=(0, 1)), "cycles": b.mean(axis=(0, 1))}
    print(json.dumps({"means": {name: [round(float(x), 5) for x in mean] for name, mean in means.items()},
                      "apart": [round(float(x), 4) for x in means["lavalight"] / means["cycles"] - 1],
                      "flip": round(float(flip), 4)}))


if __name__ == "__main__":
    main()

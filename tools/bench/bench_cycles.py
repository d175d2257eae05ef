"""Renders glTF scenes with Cycles for tools/bench/equal_error: answers requests on stdin, as Mitsuba's end in bench_mitsuba.py does.

Geometry and materials of built-in scenes are made from the same reading of the file as Mitsuba's (tools/bench/gltf_to_mitsuba.py),
with nodes that mean what Lavalight means. Views of the assets are read by Blender's own importer (tools/bench/cycles_scene.py).
Runs where Blender's module bpy is installed.
"""
import argparse
import json
import os
import sys
import time

import bpy
import numpy as np

import cycles_scene
from gltf_to_mitsuba import SMOOTH_ALPHA, Gltf, Unsupported, emission, triangles

CAMERA_SAMPLES = 1  # a render of so many costs what is not sampling


def scattering_node(nodes, material):
    """The node of what a surface does to light; raises Unsupported where Cycles has no counterpart."""
    pbr = material.get("pbrMetallicRoughness", {})
    extensions = material.get("extensions", {})
    color = (*pbr.get("baseColorFactor", [1, 1, 1, 1])[:3], 1)
    roughness = pbr.get("roughnessFactor", 1)
    smooth = roughness ** 2 < SMOOTH_ALPHA
    if pbr.get("metallicFactor", 1) == 1:
        node = nodes.new("ShaderNodeBsdfMetallic")  # F82 with a white edge: Schlick's Fresnel
        node.distribution = "GGX"
        node.inputs["Base Color"].default_value = color
        node.inputs["Edge Tint"].default_value = (1, 1, 1, 1)
    elif extensions.get("KHR_materials_transmission", {}).get("transmissionFactor", 0) == 1:
        if not extensions.get("KHR_materials_volume", {}).get("thicknessFactor", 0) > 0:
            raise Unsupported("a thin wall of glass")
        node = nodes.new("ShaderNodeBsdfGlass")
        node.distribution = "GGX"
        node.inputs["Color"].default_value = color
        node.inputs["IOR"].default_value = extensions.get("KHR_materials_ior", {}).get("ior", 1.5)
    else:
        node = nodes.new("ShaderNodeBsdfDiffuse")
        node.inputs["Color"].default_value = color
        return node
    node.inputs["Roughness"].default_value = 0 if smooth else roughness
    return node


def make_material(material):
    made = bpy.data.materials.new(material.get("name", "material"))
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    surface = scattering_node(nodes, material).outputs[0]
    radiance = emission(material)
    if any(radiance):
        light = nodes.new("ShaderNodeEmission")
        light.inputs["Color"].default_value = (*[r / max(radiance) for r in radiance], 1)
        strength = nodes.new("ShaderNodeMath")  # fronts only, unless the material is double-sided
        strength.operation = "MULTIPLY_ADD"
        strength.inputs[1].default_value = 0 if material.get("doubleSided", False) else -max(radiance)
        strength.inputs[2].default_value = max(radiance)
        links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], strength.inputs[0])
        links.new(strength.outputs[0], light.inputs["Strength"])
        both = nodes.new("ShaderNodeAddShader")
        links.new(surface, both.inputs[0])
        links.new(light.outputs[0], both.inputs[1])
        surface = both.outputs[0]
    links.new(surface, output.inputs["Surface"])
    return made


def add_mesh(scene, corners, normals, material):
    mesh = bpy.data.meshes.new("mesh")
    count = len(corners)
    mesh.vertices.add(3 * count)
    mesh.loops.add(3 * count)
    mesh.polygons.add(count)
    mesh.vertices.foreach_set("co", corners.astype(np.float32).ravel())
    mesh.loops.foreach_set("vertex_index", np.arange(3 * count, dtype=np.int32))
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    mesh.update()
    if normals is not None:
        mesh.normals_split_custom_set(normals.reshape(-1, 3).tolist())
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("mesh", mesh))


def add_camera(scene, camera, world):
    import mathutils
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle_y = camera["perspective"]["yfov"]
    data.clip_start, data.clip_end = 1e-3, 1e4
    placed = bpy.data.objects.new("camera", data)
    placed.matrix_world = mathutils.Matrix(world.tolist())
    scene.collection.objects.link(placed)
    scene.camera = placed


def set_estimator(scene, options):
    cycles_scene.set_estimator(scene, options.bounces)
    scene.render.threads_mode, scene.render.threads = "FIXED", options.threads
    scene.render.use_persistent_data = True


def load(path, size, environment):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    gltf = Gltf(path)
    materials = [make_material(m) for m in gltf.json["materials"]]
    for node, world in gltf.placed_nodes():
        if "camera" in node and scene.camera is None:
            add_camera(scene, gltf.json["cameras"][node["camera"]], world)
        for primitive in gltf.json["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            add_mesh(scene, *triangles(gltf, primitive, world), materials[primitive["material"]])
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (*environment, 1)
    scene.render.resolution_x, scene.render.resolution_y = size
    return scene


def render(samples, seed, file):
    """Seconds by the clock and of processor time, those before sampling included."""
    scene = bpy.context.scene
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.render.filepath = file
    start, processor = time.perf_counter(), time.process_time()
    bpy.ops.render.render(write_still=True)
    return time.perf_counter() - start, time.process_time() - processor


def load_request(request):
    if "view" in request:
        return cycles_scene.load(argparse.Namespace(**request["view"]))
    return load(request["load"], request["size"], request["environment"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--bounces", type=int, required=True)
    options = parser.parse_args()
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # Blender's own messages
    setup = 0.0
    for line in sys.stdin:
        request = json.loads(line)
        if "samples" in request:
            seconds, processor = render(request["samples"], request["seed"], request["file"])
            answer = {"seconds": max(seconds - setup, 1e-3), "processor": processor}
        else:
            set_estimator(load_request(request), options)
            setup = min(render(CAMERA_SAMPLES, seed, request["file"])[0] for seed in (1, 2, 3))
            answer = {}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()

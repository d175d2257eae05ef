// The import from bytes to Scene, step by step.
#include "gltf/import.h"

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/file.h"
#include "base/named.h"
#include "gltf/decode/accessor.h"
#include "gltf/file/document.h"
#include "gltf/read/animation_pointer.h"
#include "gltf/read/camera.h"
#include "gltf/read/image_light.h"
#include "gltf/read/light.h"
#include "gltf/read/material.h"
#include "gltf/read/mesh.h"
#include "gltf/read/nodes.h"
#include "gltf/read/pictures.h"
#include "gltf/read/variants.h"
#include "scene/framing_camera.h"
#include "scene/scene_origin.h"
#include "scene/solids.h"

namespace lavalight {
namespace {

void noteIgnored(const GltfDocument& document, GltfNotes& notes) {
    for (const std::string& extension : document.ignoredExtensions)
        notes.add(fmt::format("the extension {} is not supported and was ignored", printable(extension)));
    for (size_t i = 0; i < document.textures.size(); ++i)
        if (!document.textures[i].image)
            notes.add(fmt::format("texture {} {}, its materials show their plain factors", i,
                                  document.textures[i].problem));
    const JsonView accessors = document.list("accessors");
    for (size_t i = 0; i < accessors.size(); ++i)
        if (accessors[i].count("count", 0) == 0)
            notes.addObject("accessors without elements were taken as if they were not there",
                            describe("accessor", i, accessors[i].text("name")));
}

Bounds boundsOf(const std::vector<Mesh>& meshes) {
    if (meshes.empty())
        return {};
    Bounds bounds{meshes.front().positions.front(), meshes.front().positions.front()};
    for (const Mesh& mesh : meshes) {
        for (const glm::vec3& position : mesh.positions) {
            bounds.lower = glm::min(bounds.lower, position);
            bounds.upper = glm::max(bounds.upper, position);
        }
    }
    return bounds;
}

bool hasEmission(const Scene& scene) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
        return scene.materials[mesh.material].emission != glm::vec3(0.0f);
    });
}

bool hasPunctualLight(const Scene& scene) {
    return std::any_of(scene.punctualLights.begin(), scene.punctualLights.end(),
                       [](const PunctualLight& light) { return light.intensity != glm::vec3(0.0f); });
}

// The default material stands last. Where nothing wears it, it is not the file's; one material stays in any
// case.
void dropUnwornDefault(Scene& scene) {
    const size_t last = scene.materials.size() - 1;
    const bool isWorn = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                    [&](const Mesh& mesh) { return mesh.material == last; });
    if (!isWorn && last > 0)
        scene.materials.pop_back();
}

// What the scene will be seen from, unless that is a camera that stands in.
std::optional<Viewpoint> shownFrom(const std::vector<PlacedCamera>& cameras, const ImportOptions& options,
                                   const std::string& source) {
    if (options.viewpoint)
        return viewpointOf(Camera(), *options.viewpoint);
    if (cameras.empty())
        return std::nullopt;
    std::vector<std::string> names;
    names.reserve(cameras.size());
    for (const PlacedCamera& placed : cameras)
        names.push_back(placed.camera.name);
    const size_t shown =
        options.camera.empty() ? 0 : findNamed(names, {options.camera, "--camera", "camera", source});
    return viewpointOf(cameras[shown].camera, cameras[shown].position);
}

void noteCoarse(const GltfDocument& document, const VertexRuns& runs, Scene& scene, GltfNotes& notes) {
    scene.coarse = findCoarse(runs.all());
    if (!scene.coarse)
        return;
    const std::string finding = fmt::format(
        "geometry is too far apart for single precision: {:.3g} m from this scene's origin, ({:.12g}, "
        "{:.12g}, {:.12g}), positions are rounded to steps of {:.3g} m, too coarse for what is {:.3g} m "
        "wide; look from near it (--look-from), or render it by itself",
        scene.coarse->distance, scene.origin.x, scene.origin.y, scene.origin.z, scene.coarse->resolution,
        scene.coarse->size);
    for (const VertexRun& run : runs.all())
        if (isCoarse(run))
            notes.addObject(finding,
                            describe("mesh", run.mesh, document.list("meshes")[run.mesh].text("name")));
}

// Meshes and cameras about the origin that suits them. Far from the world's, meshes are read twice: where
// they are is known only then.
void readPlaces(const GltfDocument& document, const ImportOptions& options, NodeTree& nodes, Scene& scene,
                GltfNotes& notes) {
    std::vector<PlacedCamera> cameras = readCameras(document, nodes.shown, notes);
    const GltfNotes before = notes;
    Geometry geometry = readMeshes(document, nodes, scene.materials, notes);
    scene.origin = chooseOrigin(geometry.runs.all(), shownFrom(cameras, options, document.source));
    if (scene.origin != glm::dvec3(0.0)) {
        geometry = {};
        notes = before;
        nodes.moveOrigin(scene.origin);
        geometry = readMeshes(document, nodes, scene.materials, notes);
    }
    noteCoarse(document, geometry.runs, scene, notes);
    scene.meshes = std::move(geometry.meshes);
    scene.objects = std::move(geometry.objects);
    for (PlacedCamera& placed : cameras) {
        placed.camera.position = glm::vec3(placed.position - scene.origin);
        scene.cameras.push_back(std::move(placed.camera));
    }
}

Scene buildScene(GltfDocument& document, const ImportOptions& options) {
    checkAccessors(document);
    GltfNotes notes;
    applyAnimationPointers(document, options, notes);
    Scene scene;
    scene.source = document.source;
    scene.extensionsUsed = document.extensionsUsed;
    scene.ignoredExtensions = document.ignoredExtensions;

    scene.scenes = document.scenes;
    scene.shownScene = document.scene;
    scene.variants = document.variants;
    scene.animations = listAnimations(document);
    NodeTree nodes = placeNodes(document, poseAt(document, options));
    noteIgnored(document, notes);
    scene.materials = readMaterials(document, notes);
    scene.pictures = readPictures(document, scene.materials, notes);
    readPlaces(document, options, nodes, scene, notes);
    dropUnwornDefault(scene);
    scene.bounds = boundsOf(scene.meshes);
    findSolids(scene);
    for (const std::string& name : scene.openSolids)
        notes.add(fmt::format(
            "\"{}\" bounds no body (KHR_materials_volume): it is open, inside out, or transparent; light "
            "is attenuated where it meets a back",
            printable(name)));
    if (scene.meshes.empty())
        notes.add("the scene has no triangles");
    scene.hasOwnCamera = !scene.cameras.empty();
    if (!scene.hasOwnCamera)
        scene.cameras.push_back(framingCamera(scene.bounds));
    scene.punctualLights = readPunctualLights(document, nodes.shown, notes);
    scene.environmentMap = readImageLight(document, notes);
    scene.hasOwnLight = scene.environmentMap || hasEmission(scene) || hasPunctualLight(scene);
    if (!scene.hasOwnLight)
        scene.environment = glm::vec3(1.0f);
    scene.warnings = notes.lines();
    return scene;
}

Scene import(const GltfSource& source, std::string_view bytes, const ImportOptions& options) {
    try {
        GltfDocument document = parseGltf(bytes, source);
        chooseScene(document, options.scene);
        document.variant = findVariant(document.variants, options.variant, document.source);
        return buildScene(document, options);
    } catch (const std::bad_alloc&) {
        throw gltfError(source.name, "out of memory");
    } catch (const std::length_error&) {
        throw gltfError(source.name, "out of memory");
    }
}

} // namespace

Scene importGltf(const std::filesystem::path& path, const ImportOptions& options) {
    return import({path.string(), path.parent_path(), options.allowsExternal}, readFile(path), options);
}

Scene importGltf(const std::string& name, std::string_view bytes, const ImportOptions& options) {
    return import({name, std::nullopt, false}, bytes, options);
}

} // namespace lavalight

#include "cli/commands/info_command.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cli/material_text.h"
#include "scene/world_position.h"
#include "session/lit_scene.h"

namespace lavalight {
namespace {

uint64_t vertexCount(const Scene& scene) {
    uint64_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        count += mesh.positions.size();
    return count;
}

uint64_t emissiveTriangleCount(const Scene& scene) {
    uint64_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        if (scene.materials[mesh.material].emission != glm::vec3(0.0f))
            count += mesh.triangles.size();
    return count;
}

template <class T>
uint64_t bytesOf(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

// Vertices and indices in host memory, as imported.
uint64_t geometryBytes(const Scene& scene) {
    uint64_t bytes = 0;
    for (const Mesh& mesh : scene.meshes) {
        bytes += bytesOf(mesh.positions) + bytesOf(mesh.normals) + bytesOf(mesh.triangles) +
                 bytesOf(mesh.colors) + bytesOf(mesh.tangents);
        for (const std::vector<glm::vec2>& set : mesh.uvs)
            bytes += bytesOf(set);
        for (const std::vector<glm::vec4>& tangents : mesh.furtherTangents)
            bytes += bytesOf(tangents);
    }
    return bytes;
}

uint64_t texelCount(const Scene& scene) {
    uint64_t count = 0;
    for (const Picture& picture : scene.pictures)
        count += uint64_t{picture.width} * picture.height;
    return count;
}

uint64_t pictureBytes(const Scene& scene) {
    uint64_t bytes = 0;
    for (const Picture& picture : scene.pictures)
        bytes += picture.bytes.size();
    return bytes;
}

// Adding 0 takes the sign from a minus zero, which turned directions often have.
std::string vectorText(const glm::vec3& v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x + 0.0f, v.y + 0.0f, v.z + 0.0f);
}

// A place, in the world.
std::string placeText(const glm::vec3& p, const Scene& scene) {
    return fmt::format("({}, {}, {})", worldText(p.x, scene.origin.x, 6), worldText(p.y, scene.origin.y, 6),
                       worldText(p.z, scene.origin.z, 6));
}

std::string planesText(const Camera& camera) {
    if (std::isfinite(camera.zfar))
        return fmt::format(", sees {:.6g} m to {:.6g} m", camera.znear, camera.zfar);
    return camera.znear > 0.0f ? fmt::format(", sees from {:.6g} m on", camera.znear) : "";
}

std::string cameraText(const Camera& camera, const Scene& scene) {
    const std::string lens =
        camera.projection == Projection::perspective
            ? fmt::format("perspective, {:.4g} degrees high", glm::degrees(camera.verticalFov))
            : fmt::format("orthographic, {:.4g} m high", 2.0f * camera.halfHeight);
    const std::string aspect = camera.aspect ? fmt::format(", aspect {:.4g}", *camera.aspect) : "";
    return fmt::format("\"{}\": {}{}{}, at {}", camera.name, lens, aspect, planesText(camera),
                       placeText(camera.position, scene));
}

const char* kindName(PunctualKind kind) {
    switch (kind) {
    case PunctualKind::point:
        return "point";
    case PunctualKind::spot:
        return "spot";
    case PunctualKind::directional:
        return "directional";
    }
    return "";
}

std::string lightText(const PunctualLight& light, const Scene& scene) {
    const bool isDirectional = light.kind == PunctualKind::directional;
    std::string text = fmt::format("\"{}\": {}, {} {}", light.name, kindName(light.kind),
                                   vectorText(light.intensity), isDirectional ? "W/m^2" : "W/sr");
    if (!isDirectional)
        text += fmt::format(", at {}", placeText(light.position, scene));
    if (light.kind != PunctualKind::point)
        text += fmt::format(", towards {}", vectorText(light.direction));
    if (light.kind == PunctualKind::spot)
        text += fmt::format(", cone {:.4g} to {:.4g} degrees from its axis",
                            glm::degrees(light.innerConeAngle), glm::degrees(light.outerConeAngle));
    if (light.range < kNoRange)
        text += fmt::format(", range {:.6g} m", light.range);
    return text;
}

std::string listText(const std::vector<std::string>& names) {
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string materialText(const Material& material) {
    std::string text = fmt::format("\"{}\": {}", material.name, listText(lobeNames(material)));
    if (material.alphaMode != AlphaMode::opaque)
        text += fmt::format("; alpha {}", alphaModeName(material.alphaMode));
    if (const std::vector<std::string> textures = textureNames(material); !textures.empty())
        text += fmt::format("; textures {}", listText(textures));
    return text;
}

// A file that requires an extension which is not supported is refused before it comes this far.
std::string extensionText(const Scene& scene) {
    std::vector<std::string> texts;
    for (const std::string& name : scene.extensionsUsed) {
        const bool isIgnored = std::find(scene.ignoredExtensions.begin(), scene.ignoredExtensions.end(),
                                         name) != scene.ignoredExtensions.end();
        texts.push_back(name + (isIgnored ? " (ignored)" : " (supported)"));
    }
    return listText(texts);
}

void printMaterials(const Scene& scene) {
    for (size_t i = 0; i < scene.materials.size(); ++i)
        fmt::print("material {:<11} {}\n", i, materialText(scene.materials[i]));
    for (size_t i = 0; i < scene.variants.size(); ++i)
        fmt::print("variant {:<12} \"{}\"\n", i, scene.variants[i]);
}

void printText(const Scene& scene) {
    constexpr double kMebibyte = 1024.0 * 1024.0;
    fmt::print("scene                {}\n", scene.source);
    fmt::print("triangles            {}\n", scene.triangleCount());
    fmt::print("emissive triangles   {}\n", emissiveTriangleCount(scene));
    fmt::print("punctual lights      {}\n", scene.punctualLights.size());
    fmt::print("vertices             {}\n", vertexCount(scene));
    fmt::print("meshes               {}\n", scene.meshes.size());
    fmt::print("materials            {}\n", scene.materials.size());
    fmt::print("environment          {}\n", vectorText(scene.environment));
    fmt::print("bounds               {} to {}\n", placeText(scene.bounds.lower, scene),
               placeText(scene.bounds.upper, scene));
    if (scene.origin != glm::dvec3(0.0))
        fmt::print("origin               {}\n", placeText(glm::vec3(0.0f), scene));
    fmt::print("geometry memory      {:.3f} MiB\n", static_cast<double>(geometryBytes(scene)) / kMebibyte);
    fmt::print("textures             {} pictures, {} texels, {:.3f} MiB\n", scene.pictures.size(),
               texelCount(scene), static_cast<double>(pictureBytes(scene)) / kMebibyte);
    fmt::print("solids               {} closed, {} open\n", scene.solids.size(), scene.openSolids.size());
    fmt::print("extensions used      {}\n", extensionText(scene));
    fmt::print("extensions ignored   {}\n", listText(scene.ignoredExtensions));
    for (size_t i = 0; i < scene.scenes.size(); ++i)
        fmt::print("scene {:<14} \"{}\"{}\n", i, scene.scenes[i], i == scene.shownScene ? ", shown" : "");
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        fmt::print("camera {:<13} {}\n", i, cameraText(scene.cameras[i], scene));
    for (size_t i = 0; i < scene.punctualLights.size(); ++i)
        fmt::print("light {:<14} {}\n", i, lightText(scene.punctualLights[i], scene));
    printMaterials(scene);
    for (size_t i = 0; i < scene.animations.size(); ++i)
        fmt::print("animation {:<10} \"{}\": {:.6g} s\n", i, scene.animations[i].name,
                   scene.animations[i].seconds);
    for (const std::string& warning : scene.warnings)
        fmt::print("warning              {}\n", warning);
}

nlohmann::ordered_json vectorJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

nlohmann::ordered_json placeJson(const glm::vec3& position, const Scene& scene) {
    return vectorJson(toWorld(position, scene.origin));
}

nlohmann::ordered_json cameraJson(const Camera& camera, const Scene& scene) {
    nlohmann::ordered_json json = {{"name", camera.name}};
    if (camera.projection == Projection::perspective) {
        json["projection"] = "perspective";
        json["verticalFovDegrees"] = glm::degrees(camera.verticalFov);
    } else {
        json["projection"] = "orthographic";
        json["height"] = 2.0f * camera.halfHeight;
    }
    json["aspect"] = nullptr;
    if (camera.aspect)
        json["aspect"] = *camera.aspect;
    json["znear"] = camera.znear;
    json["zfar"] = nullptr;
    if (std::isfinite(camera.zfar))
        json["zfar"] = camera.zfar;
    json["position"] = placeJson(camera.position, scene);
    json["forward"] = vectorJson(camera.forward);
    json["up"] = vectorJson(camera.up);
    return json;
}

nlohmann::ordered_json lightJson(const PunctualLight& light, const Scene& scene) {
    nlohmann::ordered_json json = {
        {"name", light.name}, {"kind", kindName(light.kind)}, {"intensity", vectorJson(light.intensity)}};
    if (light.kind != PunctualKind::directional)
        json["position"] = placeJson(light.position, scene);
    if (light.kind != PunctualKind::point)
        json["direction"] = vectorJson(light.direction);
    if (light.kind == PunctualKind::spot) {
        json["innerConeDegrees"] = glm::degrees(light.innerConeAngle);
        json["outerConeDegrees"] = glm::degrees(light.outerConeAngle);
    }
    if (light.range < kNoRange)
        json["range"] = light.range;
    return json;
}

nlohmann::ordered_json materialsJson(const Scene& scene) {
    nlohmann::ordered_json materials = nlohmann::ordered_json::array();
    for (const Material& material : scene.materials)
        materials.push_back({{"name", material.name},
                             {"lobes", lobeNames(material)},
                             {"alphaMode", alphaModeName(material.alphaMode)},
                             {"textures", textureNames(material)}});
    return materials;
}

nlohmann::ordered_json sceneJson(const Scene& scene) {
    nlohmann::ordered_json cameras = nlohmann::ordered_json::array();
    for (const Camera& camera : scene.cameras)
        cameras.push_back(cameraJson(camera, scene));
    nlohmann::ordered_json lights = nlohmann::ordered_json::array();
    for (const PunctualLight& light : scene.punctualLights)
        lights.push_back(lightJson(light, scene));
    nlohmann::ordered_json animations = nlohmann::ordered_json::array();
    for (const Animation& animation : scene.animations)
        animations.push_back({{"name", animation.name}, {"seconds", animation.seconds}});
    return {
        {"scene", scene.source},
        {"triangles", scene.triangleCount()},
        {"emissiveTriangles", emissiveTriangleCount(scene)},
        {"vertices", vertexCount(scene)},
        {"meshes", scene.meshes.size()},
        {"materials", materialsJson(scene)},
        {"scenes", scene.scenes},
        {"shownScene", scene.shownScene},
        {"variants", scene.variants},
        {"pictures", scene.pictures.size()},
        {"texels", texelCount(scene)},
        {"pictureBytes", pictureBytes(scene)},
        {"environment", vectorJson(scene.environment)},
        {"bounds",
         {{"lower", placeJson(scene.bounds.lower, scene)}, {"upper", placeJson(scene.bounds.upper, scene)}}},
        {"origin", vectorJson(scene.origin)},
        {"geometryBytes", geometryBytes(scene)},
        {"solids", scene.solids.size()},
        {"openSolids", scene.openSolids},
        {"extensionsUsed", scene.extensionsUsed},
        {"extensionsIgnored", scene.ignoredExtensions},
        {"cameras", cameras},
        {"punctualLights", lights},
        {"animations", animations},
        {"warnings", scene.warnings}};
}

} // namespace

InfoCommand::InfoCommand(CLI::App& app)
    : Command(app, "info", "What was understood of a scene and what was not"), options_(parser()) {
    parser()
        .add_option("input", scene_,
                    fmt::format("A .gltf or .glb file, or built in: {}", listText(builtinNames())))
        ->type_name("SCENE")
        ->required();
    parser().add_flag("--json", json_, "Print JSON");
}

int InfoCommand::run() {
    const Scene scene = loadLitScene(scene_, options_.importOptions(), {});
    if (json_) // names in files need not be valid UTF-8
        fmt::print("{}\n", sceneJson(scene).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else
        printText(scene);
    return 0;
}

} // namespace lavalight

// From bytes to a checked document: container, JSON, version, extensions, buffers.
#include "gltf/file/document.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/os/memory.h"
#include "gltf/check/empty_accessors.h"
#include "gltf/check/extensions.h"
#include "gltf/check/schema.h"
#include "gltf/decode/draco.h"
#include "gltf/decode/meshopt.h"
#include "gltf/file/container.h"
#include "gltf/read/nodes.h"
#include "gltf/read/variants.h"
#include "scene/scene.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

struct Version {
    int major = 0;
    int minor = 0;
};

Version parseVersion(const std::string& text, const std::string& source) {
    Version version;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%9d.%9d%c", &version.major, &version.minor, &rest) != 2)
        throw gltfError(source, fmt::format("\"{}\" is not a glTF version", text));
    return version;
}

void checkVersion(const Json& json, const std::string& source) {
    const Json& asset = json.at("asset");
    const std::string text = asset.at("version").get<std::string>();
    if (parseVersion(text, source).major != 2)
        throw gltfError(source, fmt::format("it is glTF {}, only 2.x is supported", text));
    const std::string least = asset.value("minVersion", text);
    const Version minimum = parseVersion(least, source);
    if (asset.contains("minVersion") && (minimum.major != 2 || minimum.minor > 0))
        throw gltfError(source, fmt::format("it needs a reader of glTF {}, this one reads 2.0", least));
}

std::vector<std::string> namesIn(const Json& json, const char* section) {
    return json.value(section, std::vector<std::string>());
}

// The names of all "extensions" on objects: files in the wild use some without listing them. "extras" are the
// application's own business.
void collectExtensions(const Json& json, const std::string& source, std::set<std::string>& names) {
    if (json.is_array()) {
        for (const Json& element : json)
            collectExtensions(element, source, names);
    }
    if (!json.is_object())
        return;
    for (const auto& [key, value] : json.items()) {
        if (key == "extensions") {
            if (!value.is_object())
                throw gltfError(source, "one of its \"extensions\" is not an object");
            for (const auto& extension : value.items())
                names.insert(extension.key());
        }
        if (key != "extras")
            collectExtensions(value, source, names);
    }
}

std::string whyNotRead(std::string_view name) {
    if (name.starts_with("KHR_gaussian_splatting"))
        return "and Lavalight renders triangles, not Gaussian splats; try a mesh of the same object";
    if (extensionNamed(name) != nullptr)
        return "which this program was built without; run tools/setup, configure and build again";
    return "which is not supported";
}

void sortExtensions(const Json& json, GltfDocument& document) {
    const auto required = namesIn(json, "extensionsRequired");
    for (const std::string& name : required) {
        if (!isExtensionRead(name))
            throw document.error(fmt::format("it requires the extension {}, {}", name, whyNotRead(name)));
    }
    document.extensionsUsed = namesIn(json, "extensionsUsed");
    std::set<std::string> names(document.extensionsUsed.begin(), document.extensionsUsed.end());
    collectExtensions(json, document.source, names);
    std::copy_if(names.begin(), names.end(), std::back_inserter(document.ignoredExtensions),
                 [](const std::string& name) { return !isExtensionRead(name); });
}

// What the table of rules cannot say: which parts a camera or a light of one type needs.
void checkTypes(const GltfDocument& document) {
    const JsonView cameras = document.list("cameras");
    for (size_t i = 0; i < cameras.size(); ++i) {
        const std::string& type = cameras[i].text("type");
        const std::string name = describe("camera", i, cameras[i].text("name"));
        if (type != "perspective" && type != "orthographic")
            throw document.error(
                fmt::format("{} has the type \"{}\" instead of perspective or orthographic", name, type));
        if (!cameras[i].has(type))
            throw document.error(fmt::format("{} has no \"{}\"", name, type));
    }
    const JsonView lights = document.punctualLights();
    for (size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].text("type") == "spot" && !lights[i].has("spot"))
            throw document.error(describe("light", i, lights[i].text("name")) +
                                 " is a spot light without \"spot\"");
    }
}

// "{}" is an object of two bytes whose structure has a thousand.
void requireMemoryForObjects(const GltfDocument& document) {
    constexpr size_t kOverhead = 2; // vectors have room for as many again
    const uint64_t bytes = kOverhead * (sizeof(Material) * document.list("materials").size() +
                                        2 * sizeof(PlacedNode) * document.list("nodes").size());
    if (const std::string shortage = memoryShortage(bytes); !shortage.empty())
        throw document.error("its nodes, materials and other objects " + shortage);
}

} // namespace

GltfDocument parseGltf(std::string_view bytes, const GltfSource& source) {
    const GltfContainer container = splitContainer(bytes, source.name);
    Json json = parseCheckedJson(container.json, source.name);
    GltfDocument document;
    document.source = source.name;
    checkVersion(json, source.name);
    sortExtensions(json, document);
    document.buffers = loadBuffers(json, container.binary, source);
    decodeMeshopt(json, document.buffers, source.name);
    decodeDraco(json, document.buffers, source.name);
    dropEmptyAccessors(json);
    document.textures = readTextures(json);
    document.images = loadImages(json, document.buffers, source);
    document.variants = readVariants(json);
    document.json = std::move(json);
    checkTypes(document);
    requireMemoryForObjects(document);
    return document;
}

} // namespace lavalight

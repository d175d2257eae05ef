// From bytes to a checked document: container, JSON, version, extensions, buffers, tinygltf's structures.
#include "gltf/file/document.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/os/memory.h"
#include "gltf/check/extensions.h"
#include "gltf/check/schema.h"
#include "gltf/decode/draco.h"
#include "gltf/decode/meshopt.h"
#include "gltf/file/container.h"
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

void sortExtensions(const Json& json, GltfDocument& document) {
    const auto required = namesIn(json, "extensionsRequired");
    for (const std::string& name : required) {
        if (!isSupportedExtension(name))
            throw document.error(fmt::format("it requires the extension {}, which is not supported", name));
    }
    document.extensionsUsed = namesIn(json, "extensionsUsed");
    std::set<std::string> names(document.extensionsUsed.begin(), document.extensionsUsed.end());
    collectExtensions(json, document.source, names);
    std::copy_if(names.begin(), names.end(), std::back_inserter(document.ignoredExtensions),
                 [](const std::string& name) { return !isSupportedExtension(name); });
}

// tinygltf refuses index accessors without a buffer view, which glTF fills with zeros or sparse elements.
// Accessors without one get a view of their own, the last; its number, the former count of views, is
// returned.
size_t giveEachAccessorAView(Json& part) {
    const size_t views = part.contains("bufferViews") ? part["bufferViews"].size() : 0;
    if (!part.contains("accessors"))
        return views;
    part["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
    for (Json& accessor : part["accessors"]) {
        if (!accessor.contains("bufferView"))
            accessor["bufferView"] = views;
    }
    return views;
}

// The root's extensions that become structures: the punctual lights. tinygltf refuses spot lights without
// their cone as well, but without naming the light.
Json rootExtensions(const Json& json, const std::string& source) {
    constexpr const char* kLights = "KHR_lights_punctual";
    const Json extensions = json.value("extensions", Json::object());
    if (!extensions.contains(kLights) || !extensions[kLights].contains("lights"))
        return Json::object();
    const Json& lights = extensions[kLights]["lights"];
    for (size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].at("type") == "spot" && !lights[i].contains("spot"))
            throw gltfError(source, describe("light", i, lights[i].value("name", "")) +
                                        " is a spot light without \"spot\"");
    }
    return {{kLights, {{"lights", lights}}}};
}

// tinygltf reads the parts of the file that become structures, after the checks; what would make it open
// files or decode images stays out of its sight, because it follows offsets and addresses unchecked.
tinygltf::Model parseModel(Json& json, const std::string& source) {
    Json part;
    for (const char* section : {"asset", "accessors", "animations", "bufferViews", "cameras", "materials",
                                "meshes", "nodes", "scene", "scenes", "skins"}) {
        if (json.contains(section))
            part[section] = std::move(json[section]);
    }
    part["extensions"] = rootExtensions(json, source);
    const size_t views = giveEachAccessorAView(part);
    const std::string text = part.dump();
    if (text.size() > std::numeric_limits<unsigned int>::max())
        throw gltfError(source, "its JSON is larger than 4 GiB");
    tinygltf::TinyGLTF parser;
    tinygltf::Model model;
    std::string errors;
    std::string warnings;
    bool parsed = false;
    try {
        parsed = parser.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                            static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE);
    } catch (const std::exception& error) {
        errors += error.what();
    }
    if (!parsed)
        throw gltfError(source, errors.empty() ? "it is not valid glTF" : errors);
    model.bufferViews.resize(views);
    for (tinygltf::Accessor& accessor : model.accessors) {
        if (accessor.bufferView == static_cast<int>(views))
            accessor.bufferView = -1;
    }
    return model;
}

// "{}" is an object of two bytes whose structure has a thousand.
void requireMemoryForObjects(const Json& json, const std::string& source) {
    constexpr size_t kOverhead = 2; // vectors have room for as many again, and we make structures of our own
    const auto bytesOf = [&](const char* section, size_t size) {
        return json.contains(section) ? kOverhead * size * json.at(section).size() : 0;
    };
    const uint64_t bytes =
        bytesOf("accessors", sizeof(tinygltf::Accessor)) +
        bytesOf("animations", sizeof(tinygltf::Animation)) +
        bytesOf("bufferViews", sizeof(tinygltf::BufferView)) + bytesOf("cameras", sizeof(tinygltf::Camera)) +
        bytesOf("materials", sizeof(tinygltf::Material) + sizeof(Material)) +
        bytesOf("meshes", sizeof(tinygltf::Mesh)) +
        bytesOf("nodes", sizeof(tinygltf::Node) + sizeof(glm::dmat4)) +
        bytesOf("scenes", sizeof(tinygltf::Scene)) + bytesOf("skins", sizeof(tinygltf::Skin));
    if (const std::string shortage = memoryShortage(bytes); !shortage.empty())
        throw gltfError(source, "its nodes, materials and other objects " + shortage);
}

// tinygltf leaves out what it cannot read; then indices would point to the wrong objects.
void requireComplete(const GltfDocument& document, const std::vector<size_t>& primitiveCounts) {
    for (size_t i = 0; i < primitiveCounts.size(); ++i) {
        const tinygltf::Mesh& mesh = document.model.meshes.at(i);
        if (mesh.primitives.size() != primitiveCounts[i])
            throw document.error(describe("mesh", i, mesh.name) + " has a primitive that cannot be read");
    }
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
    document.textures = readTextures(json);
    document.images = loadImages(json, document.buffers, source);
    document.variants = readVariants(json);
    std::vector<size_t> primitiveCounts;
    if (json.contains("meshes")) {
        for (const Json& mesh : json.at("meshes"))
            primitiveCounts.push_back(mesh.at("primitives").size());
    }
    requireMemoryForObjects(json, source.name);
    document.model = parseModel(json, source.name);
    requireComplete(document, primitiveCounts);
    return document;
}

} // namespace lavalight

// Fuzzes the readers of glTF extensions that gltf_fuzz reaches seldom: streams of meshoptimizer and animation
// pointers. An input's first byte chooses the reader. The documents around the values are valid.
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "gltf/decode/accessor.h"
#include "gltf/decode/meshopt.h"
#include "gltf/read/animation_pointer.h"
#include "input.h"

namespace {

using namespace lavalight;
using test::Input;
using test::require;
using Json = nlohmann::json;

// Decodes one stream twice: what the decoder leaves as it was would differ.
void readStream(Input input) {
    constexpr std::array kModes = {"ATTRIBUTES", "TRIANGLES", "INDICES", "POINTS"};
    constexpr std::array kFilters = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR", "WAVELET"};
    const size_t stride = input.number<uint16_t>() % 300u;
    const size_t count = input.number<uint16_t>();
    const size_t surplus = input.number<uint8_t>() == 0 ? 1 : 0; // a length that does not fit
    Json compression = {{"buffer", 0}, {"count", count}, {"byteStride", stride}};
    compression["mode"] = input.oneOf(kModes);
    compression["filter"] = input.oneOf(kFilters);
    const std::string bytes(input.rest());
    compression["byteLength"] = bytes.size();
    const Json view = {{"buffer", 1},
                       {"byteLength", count * stride + surplus},
                       {"extensions", {{"KHR_meshopt_compression", compression}}}};
    std::string decoded;
    for (int round = 0; round < 2; ++round) {
        Json json = {{"bufferViews", {view}}};
        std::vector<GltfBuffer> buffers = {{bytes.size(), bytes}, {count * stride, {}}};
        decodeMeshopt(json, buffers, "fuzz");
        require(buffers.size() == 3 && buffers[2].bytes.size() == count * stride);
        require(round == 0 || buffers[2].bytes == decoded);
        decoded = buffers[2].bytes;
    }
}

Json animatedDocument() {
    static const Json document = Json::parse(R"({
        "asset": {"version": "2.0"},
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1],
                         "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0, 0]}}}},
                       "extensions": {"KHR_materials_ior": {"ior": 1.5}, "KHR_materials_volume": {"thicknessFactor": 1}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "nodes": [{"mesh": 0, "translation": [0, 0, 0], "weights": [0, 1],
                   "extensions": {"KHR_node_visibility": {"visible": true}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}], "weights": [0.5, 0.5]}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"innerConeAngle": 0.1}}]},
                       "EXT_lights_image_based": {"lights": [{"intensity": 1}]}}})");
    return document;
}

// One channel at a time of the input: what it sets is finite, and everything else is as it was.
void readPointer(Input input) {
    constexpr std::array kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2"};
    constexpr std::array kComponents = {5126, 5120, 5121, 5122, 5123};
    constexpr std::array kSizes = {4u, 1u, 1u, 2u, 2u};
    constexpr std::array kLanes = {1u, 2u, 3u, 4u, 4u};
    constexpr std::array kInterpolations = {"LINEAR", "STEP", "CUBICSPLINE"};
    const size_t type = input.number<uint8_t>() % kTypes.size();
    const size_t component = input.number<uint8_t>() % kComponents.size();
    const size_t keys = 1 + input.number<uint8_t>() % 8u;
    const size_t values = 1 + input.number<uint8_t>() % 32u;
    const double seconds = input.finite();
    const std::string interpolation = input.oneOf(kInterpolations);
    const std::string pointer(input.takeLine());
    const size_t valueBytes = values * kLanes[type] * kSizes[component];
    std::string bytes(input.take(4 * keys + valueBytes));
    bytes.resize(4 * keys + valueBytes);
    GltfDocument document;
    document.source = "fuzz";
    document.json = animatedDocument();
    document.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 4 * keys}},
                                    {{"buffer", 0}, {"byteOffset", 4 * keys}, {"byteLength", valueBytes}}};
    document.json["accessors"] = {
        {{"bufferView", 0}, {"componentType", 5126}, {"type", "SCALAR"}, {"count", keys}},
        {{"bufferView", 1},
         {"componentType", kComponents[component]},
         {"type", kTypes[type]},
         {"normalized", component != 0},
         {"count", values}}};
    document.json["animations"] = {
        {{"channels",
          {{{"sampler", 0},
            {"target",
             {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}}}},
         {"samplers", {{{"input", 0}, {"output", 1}, {"interpolation", interpolation}}}}}};
    document.buffers = {{bytes.size(), bytes}};
    checkAccessors(document);
    const Json before = document.json;
    GltfNotes notes;
    applyAnimationPointers(document, {.seconds = seconds}, notes);
    const Json changes = Json::diff(before, document.json);
    require(notes.lines().empty() || changes.empty());
    for (const Json& change : changes) {
        const auto path = change["path"].get<std::string>();
        require(path.starts_with(pointer));
        require(!path.starts_with("/accessors") && !path.starts_with("/animations"));
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Input input({reinterpret_cast<const char*>(data), size});
    try {
        if (input.number<uint8_t>() % 2 == 0)
            readStream(input);
        else
            readPointer(input);
    } catch (const Error& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos);
    }
    return 0;
}

// Fuzzes image-based lights: their numbers, faces and coefficients.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "gltf/read/image_light.h"
#include "image/png.h"
#include "input.h"

namespace {

using namespace lavalight;
using test::Input;
using test::numbers;
using test::require;
using Json = nlohmann::json;

// Four texels, one of them transparent.
std::string smallPicture() {
    constexpr std::array<uint32_t, 4> kTexels = {0xff808080, 0x80ffffff, 0x01102030, 0x00ffffff};
    return encodePng(2, 2, kTexels);
}

void readLight(Input input) {
    GltfDocument document;
    document.source = "fuzz";
    const size_t images = input.number<uint8_t>() % 3u;
    const std::string picture = smallPicture();
    for (size_t i = 0; i < images; ++i)
        document.images.push_back({"image", picture, ""});
    Json light = {{"intensity", input.finite()}, {"rotation", numbers(input, 4)}};
    Json faces = Json::array();
    for (size_t i = 0, count = input.number<uint8_t>() % 8u; i < count; ++i)
        faces.push_back(input.number<uint8_t>() % 4u);
    light["specularImages"] = Json::array({faces});
    light["irradianceCoefficients"] = Json::array();
    for (size_t i = 0; i < 9; ++i)
        light["irradianceCoefficients"].push_back(numbers(input, 3));
    document.json = {{"scenes", {{{"extensions", {{"EXT_lights_image_based", {{"light", 0}}}}}}}},
                     {"extensions", {{"EXT_lights_image_based", {{"lights", {light}}}}}}};
    GltfNotes notes;
    const std::optional<EnvironmentMap> map = readImageLight(document, notes);
    require(map.has_value());
    for (const glm::vec3& pixel : map->image.pixels)
        require(pixel.x >= 0.0f && pixel.y >= 0.0f && pixel.z >= 0.0f && pixel.x <= 1e15f &&
                pixel.y <= 1e15f && pixel.z <= 1e15f);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    limitThreads(1);
    readLight(Input({reinterpret_cast<const char*>(data), size}));
    return 0;
}

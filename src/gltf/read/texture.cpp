// Textures, samplers, KHR_texture_transform, KHR_texture_basisu, EXT_texture_webp.
#include "gltf/read/texture.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gltf/check/extensions.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

// Sampler constants of glTF, which are those of OpenGL.
constexpr int kNearest = 9728;
constexpr int kClampToEdge = 33071;
constexpr int kMirroredRepeat = 33648;
constexpr int kRepeat = 10497;

Wrap wrapOf(int mode) {
    return mode == kClampToEdge ? Wrap::clamp : mode == kMirroredRepeat ? Wrap::mirror : Wrap::repeat;
}

// Which image a texture names, whether there is one of that number or not. Extensions stand in the order in
// which files want them tried; the plain image is there for readers without.
std::optional<size_t> sourceOf(const Json& texture) {
    const Json none = Json::object();
    const Json& extensions = texture.contains("extensions") ? texture.at("extensions") : none;
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp"})
        if (isExtensionRead(name) && extensions.contains(name) && extensions.at(name).contains("source"))
            return extensions.at(name).at("source").get<size_t>();
    if (texture.contains("source"))
        return texture.at("source").get<size_t>();
    return std::nullopt;
}

void findImage(const Json& source, size_t imageCount, GltfTexture& texture) {
    texture.image = sourceOf(source);
    if (!texture.image) {
        texture.problem = "has no image that can be read";
    } else if (*texture.image >= imageCount) {
        texture.problem = fmt::format("shows image {}, but the file has {}", *texture.image, imageCount);
        texture.image.reset();
    }
}

// KHR_texture_transform: scaled, then turned, then moved. The sense of the rotation is that of the
// extension's sample renderer and of its test model.
void applyTransform(JsonView transform, Texture& texture) {
    const double angle = transform.number("rotation", 0.0);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const glm::dvec2 scale = transform.vector<2>("scale", glm::dvec2(1.0));
    const glm::dvec2 offset = transform.vector<2>("offset", glm::dvec2(0.0));
    texture.uRow = glm::vec3(c * scale.x, s * scale.y, offset.x);
    texture.vRow = glm::vec3(-s * scale.x, c * scale.y, offset.y);
    texture.uvSet = static_cast<uint32_t>(transform.count("texCoord", texture.uvSet));
}

} // namespace

std::vector<GltfTexture> readTextures(const Json& json) {
    std::vector<GltfTexture> textures;
    if (!json.contains("textures"))
        return textures;
    const size_t imageCount = json.contains("images") ? json.at("images").size() : 0;
    for (const Json& source : json.at("textures")) {
        GltfTexture& texture = textures.emplace_back();
        findImage(source, imageCount, texture);
        if (!source.contains("sampler"))
            continue;
        const Json& sampler = json.at("samplers").at(source.at("sampler").get<size_t>());
        texture.wrapU = wrapOf(sampler.value("wrapS", kRepeat));
        texture.wrapV = wrapOf(sampler.value("wrapT", kRepeat));
        texture.isNearest = sampler.value("magFilter", 0) == kNearest;
    }
    return textures;
}

std::optional<Texture> makeTexture(const std::vector<GltfTexture>& textures, JsonView info, bool isSrgb) {
    const std::optional<size_t> index = info.index("index");
    if (!index || !textures.at(*index).image)
        return std::nullopt;
    const GltfTexture& source = textures[*index];
    Texture texture;
    texture.picture = static_cast<uint32_t>(*source.image);
    texture.uvSet = static_cast<uint32_t>(info.count("texCoord", 0));
    texture.wrapU = source.wrapU;
    texture.wrapV = source.wrapV;
    texture.isNearest = source.isNearest;
    texture.isSrgb = isSrgb;
    if (const JsonView transform = info["extensions"]["KHR_texture_transform"])
        applyTransform(transform, texture);
    return texture;
}

} // namespace lavalight

#include "device_scene/gpu_textures.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "device_scene/octahedral.h"
#include "image/pixel_limit.h"

namespace lavalight {
namespace {

void requireTexels(uint64_t texels, const char* what, const char* remedy) {
    if (texels > kMostTexels)
        throw Error(fmt::format("{} need {:.1f} MiB on the device, but one buffer holds {:.1f} MiB: {}", what,
                                static_cast<double>(texels) / 65536.0,
                                static_cast<double>(kMostTexels) / 65536.0, remedy));
}

uint64_t elementsOf(const Picture& picture) {
    return (picture.bytes.size() + sizeof(uvec4) - 1) / sizeof(uvec4);
}

// First element of each picture that a material shows, and their number after the last.
struct PictureElements {
    std::vector<std::optional<uint32_t>> first;
    uint64_t count = 0;
};

PictureElements placePictures(const Scene& scene) {
    PictureElements elements;
    elements.first.resize(scene.pictures.size());
    for (const Material& material : scene.materials)
        for (const std::optional<Texture>& texture : material.textures)
            if (texture && !elements.first[texture->picture]) {
                elements.first[texture->picture] = static_cast<uint32_t>(elements.count);
                elements.count += elementsOf(scene.pictures[texture->picture]);
            }
    requireTexels(elements.count, "the scene's pictures", "scale them down");
    return elements;
}

uint32_t setsOf(const Scene& scene) {
    uint32_t sets = 0;
    for (const Material& material : scene.materials)
        for (const std::optional<Texture>& texture : material.textures)
            if (texture)
                sets = std::max(sets, texture->uvSet + 1);
    return sets;
}

uint32_t textureFlags(const Texture& texture, const Picture& picture) {
    return static_cast<uint32_t>(texture.wrapU) | static_cast<uint32_t>(texture.wrapV) << kWrapVShift |
           (texture.isNearest ? kTextureNearest : 0u) | (texture.isSrgb ? kTextureSrgb : 0u) |
           (picture.is16Bit ? kTexture16Bit : 0u);
}

TextureRecord packTexture(const Texture& texture, const Picture& picture, uint32_t firstElement,
                          uint32_t sets) {
    return {texture.uRow,   textureFlags(texture, picture), texture.vRow,    4 * firstElement, picture.width,
            picture.height, kUvTexels * texture.uvSet,      kUvTexels * sets};
}

TriangleUvs uvsOf(const Mesh& mesh, uint32_t set, const glm::uvec3& triangle) {
    if (set >= mesh.uvs.size() || mesh.uvs[set].empty())
        return {};
    const std::vector<glm::vec2>& uvs = mesh.uvs[set];
    return {uvs[triangle.x], uvs[triangle.y], uvs[triangle.z], {}};
}

glm::uvec2 packColor(const glm::vec4& color) {
    const glm::uvec4 c(glm::clamp(color, 0.0f, 1.0f) * 65535.0f + 0.5f);
    return {c.x | c.y << 16u, c.z | c.w << 16u};
}

TriangleTangents packTangents(const std::vector<glm::vec4>& tangents, const glm::uvec3& t) {
    const auto sign = [&](uint32_t corner) { return tangents[corner].w < 0.0f ? 1u : 0u; };
    return {encodeOctahedral(glm::vec3(tangents[t.x])), encodeOctahedral(glm::vec3(tangents[t.y])),
            encodeOctahedral(glm::vec3(tangents[t.z])), sign(t.x) | sign(t.y) << 1u | sign(t.z) << 2u};
}

} // namespace

uint32_t textureSlots(const Material& material) {
    uint32_t slots = 0;
    for (size_t i = 0; i < material.textures.size(); ++i)
        slots |= material.textures[i] ? 1u << i : 0u;
    return slots;
}

PackedTextures packTextures(const Scene& scene) {
    const PictureElements elements = placePictures(scene);
    const uint32_t sets = setsOf(scene);
    PackedTextures packed;
    packed.pictures.resize(elements.count);
    for (size_t i = 0; i < scene.pictures.size(); ++i)
        if (elements.first[i] && !scene.pictures[i].bytes.empty())
            std::memcpy(&packed.pictures[*elements.first[i]], scene.pictures[i].bytes.data(),
                        scene.pictures[i].bytes.size());
    for (const Material& material : scene.materials) {
        packed.firstRecords.push_back(static_cast<uint32_t>(packed.records.size()));
        for (const std::optional<Texture>& texture : material.textures)
            if (texture)
                packed.records.push_back(packTexture(*texture, scene.pictures[texture->picture],
                                                     *elements.first[texture->picture], sets));
    }
    return packed;
}

std::vector<TriangleUvs> packUvs(const Scene& scene) {
    const uint32_t sets = setsOf(scene);
    requireTexels(scene.triangleCount() * sets * kUvTexels, "the texture coordinates",
                  "use fewer sets (TEXCOORD_n), or fewer triangles");
    std::vector<TriangleUvs> packed;
    packed.reserve(scene.triangleCount() * sets);
    for (const Mesh& mesh : scene.meshes)
        for (const glm::uvec3& triangle : mesh.triangles)
            for (uint32_t set = 0; set < sets; ++set)
                packed.push_back(uvsOf(mesh, set, triangle));
    return packed;
}

std::vector<TriangleColors> packColors(const Scene& scene) {
    const glm::uvec2 white = packColor(glm::vec4(1.0f));
    std::vector<TriangleColors> packed;
    packed.reserve(scene.triangleCount());
    for (const Mesh& mesh : scene.meshes)
        for (const glm::uvec3& t : mesh.triangles)
            packed.push_back(mesh.colors.empty() ? TriangleColors{white, white, white, {}}
                                                 : TriangleColors{packColor(mesh.colors[t.x]),
                                                                  packColor(mesh.colors[t.y]),
                                                                  packColor(mesh.colors[t.z]),
                                                                  {}});
    return packed;
}

uint32_t tangentPlanes(const Scene& scene) {
    size_t further = 0;
    for (const Mesh& mesh : scene.meshes)
        further = std::max(further, mesh.furtherTangents.size());
    return 1 + static_cast<uint32_t>(further);
}

std::vector<TriangleTangents> packTangents(const Scene& scene) {
    const uint32_t planes = tangentPlanes(scene);
    requireTexels(scene.triangleCount() * planes, "the tangents", "use fewer triangles");
    std::vector<TriangleTangents> packed;
    packed.reserve(scene.triangleCount() * planes);
    for (uint32_t plane = 0; plane < planes; ++plane)
        for (const Mesh& mesh : scene.meshes) {
            const bool isFurther = plane > 0 && plane <= mesh.furtherTangents.size();
            const std::vector<glm::vec4>& tangents =
                isFurther ? mesh.furtherTangents[plane - 1] : mesh.tangents;
            for (const glm::uvec3& t : mesh.triangles)
                packed.push_back(tangents.empty() ? TriangleTangents{0, 0, 0, kNoTangents}
                                                  : packTangents(tangents, t));
        }
    return packed;
}

} // namespace lavalight

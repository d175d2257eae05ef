// Textures of glTF: which image, how it is wrapped and filtered, and where a material's coordinates lead in
// it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <tiny_gltf.h>

#include "scene/scene.h"

namespace lavalight {

// An element of "textures" with its sampler. How a picture is filtered where it is seen small is not read:
// paths average it.
struct GltfTexture {
    std::optional<size_t> image; // none: the file gives no source that can be read
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    bool isNearest = false;
};

// Each element of `json`'s "textures". EXT_texture_webp's image goes before the plain one.
[[nodiscard]] std::vector<GltfTexture> readTextures(const nlohmann::json& json);

// How a material refers to a texture.
struct GltfTextureInfo {
    int texture = -1; // none
    int uvSet = 0;
    const tinygltf::ExtensionMap* extensions = nullptr;

    GltfTextureInfo() = default;
    template <class Info> // of tinygltf: TextureInfo, NormalTextureInfo
    explicit GltfTextureInfo(const Info& info)
        : texture(info.index), uvSet(info.texCoord), extensions(&info.extensions) {}
};

// The same within an extension, whose textures tinygltf leaves as they are; none where `member` is missing.
struct GltfTextureValue {
    GltfTextureValue(const tinygltf::Value& extension, const char* member);
    GltfTextureInfo info;

  private:
    tinygltf::ExtensionMap extensions_;
};

// The texture of a slot, its `picture` being the number of a glTF image; none where there is no texture or no
// image. KHR_texture_transform is folded into its rows.
[[nodiscard]] std::optional<Texture> makeTexture(const std::vector<GltfTexture>& textures,
                                                 const GltfTextureInfo& info, bool isSrgb);

} // namespace lavalight

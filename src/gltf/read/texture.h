// Textures of glTF: which image, how it is wrapped and filtered, and where a material's coordinates lead in
// it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gltf/file/json_view.h"
#include "scene/scene.h"

namespace lavalight {

// An element of "textures" with its sampler. How a picture is filtered where it is seen small is not read:
// paths average it.
struct GltfTexture {
    std::optional<size_t> image; // none: `problem` says why
    std::string problem{};       // "has no image that can be read"
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    bool isNearest = false;
};

// Each element of `json`'s "textures". Images of KHR_texture_basisu and EXT_texture_webp go before the plain
// one.
[[nodiscard]] std::vector<GltfTexture> readTextures(const nlohmann::json& json);

// The texture that `info`, a material's reference to one, stands for; its `picture` is the number of a glTF
// image. None where there is no texture or no image. KHR_texture_transform is folded into its rows.
[[nodiscard]] std::optional<Texture> makeTexture(const std::vector<GltfTexture>& textures, JsonView info,
                                                 bool isSrgb);

} // namespace lavalight

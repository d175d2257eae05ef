// Reads the properties of one extension of one material, with their ranges, into a Material.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "gltf/file/json_view.h"
#include "gltf/read/factors.h"
#include "gltf/read/texture.h"
#include "scene/scene.h"

namespace lavalight {

// Everything it is made with must outlive it.
class ExtensionReader {
  public:
    ExtensionReader(JsonView extension, const std::vector<GltfTexture>& textures, Material& material,
                    FactorReader& factors)
        : extension_(extension), textures_(textures), material_(material), factors_(factors) {}

    [[nodiscard]] bool has(const char* member) const { return extension_.has(member); }

    // Clamped to [lower, upper] and noted where that changes it; `otherwise` where the extension lacks it.
    [[nodiscard]] float number(const char* member, double otherwise, double lower = 0.0, double upper = 1.0);
    [[nodiscard]] glm::vec3 color(const char* member, const glm::vec3& otherwise, double largest = 1.0);
    // Alpha of a colour with four channels; 1 where the extension lacks it.
    [[nodiscard]] float alphaOf(const char* member);
    void texture(const char* member, TextureSlot slot, bool isSrgb = false);

    // The factor of a normal texture, which stands beside it.
    [[nodiscard]] float normalScale(const char* member) const;

    [[nodiscard]] Material& material() { return material_; }

  private:
    JsonView extension_;
    const std::vector<GltfTexture>& textures_;
    Material& material_;
    FactorReader& factors_;
};

} // namespace lavalight

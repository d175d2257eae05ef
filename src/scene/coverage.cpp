#include "scene/coverage.h"

#include <algorithm>
#include <optional>

#include "image/texel.h"

namespace lavalight {
namespace {

double leastAlphaOf(const Picture& picture) {
    double least = 1.0;
    for (uint32_t y = 0; y < picture.height && least > 0.0; ++y)
        for (uint32_t x = 0; x < picture.width; ++x)
            least = std::min(least, texelOf(picture, x, y, false).a);
    return least;
}

double leastAlphaOf(const Mesh& mesh) {
    double least = 1.0;
    for (const glm::vec4& color : mesh.colors)
        least = std::min(least, double{color.a});
    return least;
}

// Pictures are looked through once, and only if a material asks.
class PictureAlphas {
  public:
    explicit PictureAlphas(const Scene& scene) : scene_(&scene), least_(scene.pictures.size()) {}

    double leastOf(const std::optional<Texture>& texture) {
        if (!texture)
            return 1.0;
        std::optional<double>& least = least_[texture->picture];
        if (!least)
            least = leastAlphaOf(scene_->pictures[texture->picture]);
        return *least;
    }

  private:
    const Scene* scene_;
    std::vector<std::optional<double>> least_;
};

bool isTransparent(const Mesh& mesh, const Material& material, PictureAlphas& pictures) {
    if (material.alphaMode == AlphaMode::opaque)
        return false;
    const double least = double{material.alpha} * leastAlphaOf(mesh) *
                         pictures.leastOf(material.texture(TextureSlot::baseColor));
    // Half a step of the 16 bits that vertex colours have on the device.
    constexpr double kRounding = 1e-5;
    return material.alphaMode == AlphaMode::mask ? least < material.alphaCutoff + kRounding
                                                 : least < 1.0 - kRounding;
}

} // namespace

std::vector<bool> transparentMeshes(const Scene& scene) {
    PictureAlphas pictures(scene);
    std::vector<bool> transparent;
    transparent.reserve(scene.meshes.size());
    for (const Mesh& mesh : scene.meshes)
        transparent.push_back(isTransparent(mesh, scene.materials[mesh.material], pictures));
    return transparent;
}

} // namespace lavalight

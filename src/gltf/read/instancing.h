// EXT_mesh_gpu_instancing: one node that shows its mesh many times.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "gltf/decode/accessor.h"

namespace lavalight {

// How often `node` shows its mesh: 1 without the extension.
[[nodiscard]] size_t instanceCount(const GltfDocument& document, JsonView node);

// The instances' transforms, read one at a time: their number is only bounded by the file.
class InstanceReader {
  public:
    // Throws Error, naming the node's accessors, for attributes of another type and of unequal counts. The
    // document must outlive it.
    InstanceReader(const GltfDocument& document, JsonView node);

    [[nodiscard]] size_t count() const { return count_; }
    // From the space of an instance to that of the node, i < count().
    [[nodiscard]] glm::dmat4 transform(size_t i) const;

  private:
    size_t count_ = 1;
    std::optional<AccessorView> translations_;
    std::optional<AccessorView> rotations_;
    std::optional<AccessorView> scales_;
};

} // namespace lavalight

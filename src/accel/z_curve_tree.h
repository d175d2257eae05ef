// A tree of boxes over triangles that is built within a few milliseconds, for searches around many places.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "accel/triangle.h"

namespace lavalight {

struct Box {
    glm::vec3 lower;
    glm::vec3 upper;
};

// The triangles lie along a Z curve through their middles, and boxes hold four neighbours each. What lies
// together in space then lies together in memory, for which a search would wait most of its time.
class ZCurveTree {
  public:
    explicit ZCurveTree(std::span<const Triangle> triangles);

    // By place along the curve.
    [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
    // The number that a triangle had in the constructor's span.
    [[nodiscard]] uint32_t id(size_t place) const { return ids_[place]; }

    // Calls visit(place) for each triangle whose bounds meet the box, until it returns false.
    template <class Visit>
    void visitIn(const Box& box, const Visit& visit) const {
        struct Entry {
            size_t level;
            size_t index;
        };
        std::array<Entry, kMostEntries> entries;
        size_t count = 0;
        if (!levels_.empty())
            entries[count++] = {levels_.size() - 1, 0};
        while (count > 0) {
            const auto [level, index] = entries[--count];
            const FourFlags meets = levels_[level][index].meets(box);
            for (size_t i = 0; i < kChildren; ++i) {
                if (meets[i] == 0)
                    continue;
                const size_t child = kChildren * index + i;
                if (level > 0)
                    entries[count++] = {level - 1, child};
                else if (!visit(child))
                    return;
            }
        }
    }

  private:
    static constexpr size_t kChildren = 4;
    static constexpr size_t kMostEntries = 64; // three a level, of 16 levels for 2^32 triangles
    using FourFlags = std::array<int32_t, kChildren>;

    // Boxes by component, all of which compilers compare at once.
    struct Node {
        using Floats = std::array<float, kChildren>;
        std::array<Floats, 3> lower;
        std::array<Floats, 3> upper;

        [[nodiscard]] FourFlags meets(const Box& box) const {
            FourFlags flags;
            for (size_t i = 0; i < kChildren; ++i)
                flags[i] = static_cast<int32_t>(lower[0][i] <= box.upper.x) &
                           static_cast<int32_t>(lower[1][i] <= box.upper.y) &
                           static_cast<int32_t>(lower[2][i] <= box.upper.z) &
                           static_cast<int32_t>(upper[0][i] >= box.lower.x) &
                           static_cast<int32_t>(upper[1][i] >= box.lower.y) &
                           static_cast<int32_t>(upper[2][i] >= box.lower.z);
            return flags;
        }
    };
    [[nodiscard]] static Node nodeOf(std::span<const Box> children);

    std::vector<uint32_t> ids_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<Node>> levels_; // nodes over triangles, over four of these, ..., over all
};

} // namespace lavalight

#include "scene/vertex_runs.h"

#include "scene/scene.h"

namespace lavalight {

void VertexRuns::begin(size_t mesh, size_t vertices) {
    mesh_ = mesh;
    left_ = vertices;
    length_ = 0;
}

// Long runs are cut, unless their rest would be short; so are runs where the file goes on elsewhere.
bool VertexRuns::belongs(const glm::dvec3& position) const {
    constexpr size_t kLong = 64;
    constexpr double kLeap = 256.0; // sizes of what is there so far
    if (length_ == 0 || (length_ >= kLong && left_ >= kLong))
        return false;
    return length_ < 3 || runs_.back().distance(position) <= kLeap * runs_.back().size();
}

void VertexRuns::add(const glm::dvec3& position) {
    const bool isUsable = glm::all(glm::lessThanEqual(glm::abs(position), glm::dvec3(kLargestPosition)));
    if (isUsable && !belongs(position)) {
        runs_.push_back({.mesh = mesh_});
        length_ = 0;
    }
    left_ -= left_ > 0 ? 1 : 0;
    if (!isUsable) // false for NaN
        return;
    runs_.back().lower = glm::min(runs_.back().lower, position);
    runs_.back().upper = glm::max(runs_.back().upper, position);
    ++length_;
}

} // namespace lavalight

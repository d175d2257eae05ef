#include "scene/mesh_vertices.h"

#include <algorithm>
#include <limits>

namespace lavalight {
namespace {

// An attribute that the mesh lacks stays empty.
template <class T>
void select(std::vector<T>& values, const std::vector<uint32_t>& order) {
    if (values.empty())
        return;
    std::vector<T> selected;
    selected.reserve(order.size());
    for (const uint32_t i : order)
        selected.push_back(values[i]);
    values = std::move(selected);
}

std::vector<uint32_t> compactBySorting(std::vector<glm::uvec3>& triangles) {
    std::vector<uint32_t> used;
    used.reserve(3 * triangles.size());
    for (const glm::uvec3& t : triangles)
        used.insert(used.end(), {t.x, t.y, t.z});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto numberOf = [&](uint32_t index) {
        return static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), index) - used.begin());
    };
    for (glm::uvec3& t : triangles)
        t = {numberOf(t.x), numberOf(t.y), numberOf(t.z)};
    return used;
}

} // namespace

std::vector<uint32_t> compactIndices(std::vector<glm::uvec3>& triangles) {
    if (triangles.empty())
        return {};
    uint32_t lowest = std::numeric_limits<uint32_t>::max();
    uint32_t highest = 0;
    for (const glm::uvec3& t : triangles) {
        lowest = std::min({lowest, t.x, t.y, t.z});
        highest = std::max({highest, t.x, t.y, t.z});
    }
    // Many primitives may share one large accessor: each costs what it uses of that, or what lies in its
    // range where that is little more.
    constexpr size_t kSparse = 64; // indices for each that is used; sorting takes about as long there
    if ((highest - lowest) / kSparse > 3 * triangles.size())
        return compactBySorting(triangles);
    std::vector<uint32_t> used;
    std::vector<uint32_t> numbers(size_t{highest - lowest} + 1, 0);
    for (const glm::uvec3& t : triangles) {
        for (int corner = 0; corner < 3; ++corner)
            numbers[t[corner] - lowest] = 1;
    }
    for (size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] == 0)
            continue;
        numbers[i] = static_cast<uint32_t>(used.size());
        used.push_back(lowest + static_cast<uint32_t>(i));
    }
    for (glm::uvec3& t : triangles)
        t = {numbers[t.x - lowest], numbers[t.y - lowest], numbers[t.z - lowest]};
    return used;
}

void selectVertices(Mesh& mesh, const std::vector<uint32_t>& order) {
    select(mesh.positions, order);
    select(mesh.normals, order);
    for (std::vector<glm::vec2>& set : mesh.uvs)
        select(set, order);
    select(mesh.colors, order);
    select(mesh.tangents, order);
    for (std::vector<glm::vec4>& tangents : mesh.furtherTangents)
        select(tangents, order);
}

} // namespace lavalight

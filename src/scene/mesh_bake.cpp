// Baking of meshes: transform, dropping of unusable triangles, normals.
#include "scene/mesh_bake.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lavalight {
namespace {

bool isUsable(const glm::vec3& position) {
    const glm::vec3 size = glm::abs(position);
    return size.x <= kLargestPosition && size.y <= kLargestPosition &&
           size.z <= kLargestPosition; // false for NaN
}

glm::vec3 areaNormal(const Mesh& mesh, const glm::uvec3& t) {
    const glm::vec3& origin = mesh.positions[t.x];
    return glm::cross(mesh.positions[t.y] - origin, mesh.positions[t.z] - origin);
}

// The kernels normalize the cross product of two edges in single precision: its squared length must be a
// normal number. That excludes points and lines, edges below about 1e-10 m, and edges beyond about 1e9 m.
enum class Verdict { keep, outOfRange, withoutArea };

Verdict judge(const Mesh& mesh, const glm::uvec3& t) {
    if (!isUsable(mesh.positions[t.x]) || !isUsable(mesh.positions[t.y]) || !isUsable(mesh.positions[t.z]))
        return Verdict::outOfRange;
    const glm::vec3 normal = areaNormal(mesh, t);
    const float squared = glm::dot(normal, normal);
    if (!std::isfinite(squared))
        return Verdict::outOfRange;
    return squared >= std::numeric_limits<float>::min() ? Verdict::keep : Verdict::withoutArea;
}

template <class T>
std::vector<T> gather(const std::vector<T>& values, const std::vector<uint32_t>& order) {
    std::vector<T> gathered;
    gathered.reserve(order.size());
    for (const uint32_t i : order)
        gathered.push_back(values[i]);
    return gathered;
}

void dropUnusable(Mesh& mesh, BakeCounts& counts) {
    const size_t before = mesh.triangles.size();
    std::erase_if(mesh.triangles, [&](const glm::uvec3& triangle) {
        const Verdict verdict = judge(mesh, triangle);
        counts.outOfRange += verdict == Verdict::outOfRange ? 1 : 0;
        counts.withoutArea += verdict == Verdict::withoutArea ? 1 : 0;
        return verdict != Verdict::keep;
    });
    if (mesh.triangles.size() == before)
        return;
    const std::vector<uint32_t> used = compactIndices(mesh.triangles);
    mesh.positions = gather(mesh.positions, used);
    if (!mesh.normals.empty())
        mesh.normals = gather(mesh.normals, used);
}

// Normals go with the inverse transpose. Up to a factor that is the matrix of cofactors, which also exists
// where the transform flattens the mesh; its factor, the determinant, brings in the sign.
glm::dmat3 normalTransform(const glm::dmat4& toWorld) {
    const glm::dvec3 x(toWorld[0]);
    const glm::dvec3 y(toWorld[1]);
    const glm::dvec3 z(toWorld[2]);
    const glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    return glm::dot(x, cofactors[0]) < 0.0 ? -cofactors : cofactors;
}

// Normalizes by the largest component first: squares of tiny or huge ones would vanish or overflow.
glm::vec3 unitOrZero(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !std::isfinite(largest) || !std::isfinite(v.x + v.y + v.z))
        return glm::vec3(0.0f);
    return glm::vec3(glm::normalize(v / largest));
}

// Replaces normals that are zero: by the mean of the triangles around, weighted by area, or, where these
// cancel, by one of them. A mesh whose normals are all zero has none, and becomes flat.
void repairNormals(Mesh& mesh, BakeCounts& counts) {
    const glm::vec3 none(0.0f);
    const auto broken = static_cast<size_t>(std::count(mesh.normals.begin(), mesh.normals.end(), none));
    if (broken == 0)
        return;
    counts.repairedNormals += broken;
    if (broken == mesh.normals.size()) {
        mesh.normals.clear();
        return;
    }
    std::vector<glm::dvec3> sums(mesh.normals.size(), glm::dvec3(0.0));
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner)
            sums[triangle[corner]] += glm::dvec3(areaNormal(mesh, triangle));
    }
    for (size_t i = 0; i < sums.size(); ++i) {
        if (mesh.normals[i] == none)
            mesh.normals[i] = unitOrZero(sums[i]);
    }
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            glm::vec3& normal = mesh.normals[triangle[corner]];
            if (normal == none)
                normal = glm::normalize(areaNormal(mesh, triangle));
        }
    }
}

} // namespace

std::vector<uint32_t> compactIndices(std::vector<glm::uvec3>& triangles) {
    std::vector<uint32_t> used;
    if (triangles.empty())
        return used;
    uint32_t lowest = std::numeric_limits<uint32_t>::max();
    uint32_t highest = 0;
    for (const glm::uvec3& t : triangles) {
        lowest = std::min({lowest, t.x, t.y, t.z});
        highest = std::max({highest, t.x, t.y, t.z});
    }
    // Many primitives may share one large accessor, each with a range of its own: only the range is looked
    // at.
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

Mesh bakeMesh(const Mesh& local, const glm::dmat4& toWorld, BakeCounts& counts) {
    Mesh mesh = local;
    for (glm::vec3& position : mesh.positions)
        position = glm::vec3(toWorld * glm::dvec4(position, 1.0));
    if (glm::determinant(glm::dmat3(toWorld)) < 0.0) {
        for (glm::uvec3& triangle : mesh.triangles)
            std::swap(triangle.y, triangle.z);
    }
    dropUnusable(mesh, counts);
    const glm::dmat3 transform = normalTransform(toWorld);
    for (glm::vec3& normal : mesh.normals)
        normal = unitOrZero(transform * glm::dvec3(normal));
    repairNormals(mesh, counts);
    return mesh;
}

} // namespace lavalight

// Baking of meshes: transform, dropping of unusable triangles, normals, tangents.
#include "scene/mesh_bake.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/mesh_vertices.h"
#include "scene/tangents.h"

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
    selectVertices(mesh, used);
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

// Gives tangents without direction one. Without normals tangents mean nothing: glTF has flat meshes ignore
// theirs.
void repairTangents(Mesh& mesh, BakeCounts& counts) {
    if (mesh.normals.empty())
        mesh.tangents.clear();
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        glm::vec4& tangent = mesh.tangents[i];
        if (glm::vec3(tangent) != glm::vec3(0.0f))
            continue;
        tangent = glm::vec4(anyTangent(mesh.normals[i]), tangent.w);
        ++counts.repairedTangents;
    }
}

} // namespace

VertexTransform::VertexTransform(const glm::dmat4& toWorld)
    : toWorld_(toWorld), normals_(normalTransform(toWorld)),
      isMirrored_(glm::determinant(glm::dmat3(toWorld)) < 0.0) {}

glm::dvec3 VertexTransform::apply(Mesh& mesh, size_t vertex) const {
    const glm::dvec3 position(toWorld_ * glm::dvec4(mesh.positions[vertex], 1.0));
    mesh.positions[vertex] = glm::vec3(position);
    if (!mesh.normals.empty())
        mesh.normals[vertex] = unitOrZero(normals_ * glm::dvec3(mesh.normals[vertex]));
    if (mesh.tangents.empty())
        return position;
    // A tangent is an edge of the surface and goes with the matrix itself. With the bitangent w *
    // cross(normal, tangent) and a normal that keeps its side, a mirror turns w.
    const glm::vec4 tangent = mesh.tangents[vertex];
    const bool isNegative = (tangent.w < 0.0f) != isMirrored_;
    mesh.tangents[vertex] =
        glm::vec4(unitOrZero(glm::dmat3(toWorld_) * glm::dvec3(tangent)), isNegative ? -1.0f : 1.0f);
    return position;
}

void cleanMesh(Mesh& mesh, BakeCounts& counts) {
    dropUnusable(mesh, counts);
    repairNormals(mesh, counts);
    repairTangents(mesh, counts);
}

Mesh bakeMesh(const Mesh& local, const glm::dmat4& toWorld, BakeCounts& counts, VertexRuns& runs) {
    Mesh mesh = local;
    const VertexTransform transform(toWorld);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        runs.add(transform.apply(mesh, i));
    if (transform.isMirrored()) {
        for (glm::uvec3& triangle : mesh.triangles)
            std::swap(triangle.y, triangle.z);
    }
    cleanMesh(mesh, counts);
    return mesh;
}

} // namespace lavalight

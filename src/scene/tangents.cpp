#include "scene/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scene/mesh_vertices.h"

namespace lavalight {
namespace {

// The direction of growing u on one triangle, and whether its picture shows mirrored from the front.
struct UvBasis {
    glm::vec3 tangent{0.0f}; // unit length; zero where the uvs have no area
    bool isMirrored = false;
};

// Two edges are two equations, edge = du * tangent + dv * bitangent; Cramer's rule solves them. Only the sign
// of the determinant is kept of its value: it may be tiny. glTF's v grows downwards, the bitangent upwards.
UvBasis uvBasis(const Mesh& mesh, const glm::uvec3& t, const std::vector<glm::vec2>& uvs) {
    const glm::dvec3 origin(mesh.positions[t.x]);
    const glm::dvec3 edge1 = glm::dvec3(mesh.positions[t.y]) - origin;
    const glm::dvec3 edge2 = glm::dvec3(mesh.positions[t.z]) - origin;
    const glm::dvec2 up(1.0, -1.0);
    const glm::dvec2 d1 = up * (glm::dvec2(uvs[t.y]) - glm::dvec2(uvs[t.x]));
    const glm::dvec2 d2 = up * (glm::dvec2(uvs[t.z]) - glm::dvec2(uvs[t.x]));
    const double determinant = d1.x * d2.y - d2.x * d1.y;
    const glm::dvec3 tangent = (edge1 * d2.y - edge2 * d1.y) * (determinant < 0.0 ? -1.0 : 1.0);
    const double length = glm::length(tangent);
    if (determinant == 0.0 || !(length > 0.0) || !std::isfinite(length))
        return {};
    return {glm::vec3(tangent / length), determinant < 0.0};
}

// `v` without its part along `normal`, of unit length, or zero.
glm::vec3 alongSurface(const glm::vec3& v, const glm::vec3& normal) {
    const glm::vec3 projected = v - normal * glm::dot(normal, v);
    const float length = glm::length(projected);
    // Below this length the difference is rounding: the direction would be noise.
    return length > 1e-6f * glm::length(v) ? projected / length : glm::vec3(0.0f);
}

float cornerAngle(const Mesh& mesh, const glm::uvec3& t, int corner) {
    const glm::vec3& at = mesh.positions[t[corner]];
    const glm::vec3 a = glm::normalize(mesh.positions[t[(corner + 1) % 3]] - at);
    const glm::vec3 b = glm::normalize(mesh.positions[t[(corner + 2) % 3]] - at);
    return std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
}

// Three vertices for each triangle, with its normal.
void makeFlat(Mesh& mesh) {
    std::vector<uint32_t> order;
    order.reserve(3 * mesh.triangles.size());
    for (glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            order.push_back(triangle[corner]);
            triangle[corner] = static_cast<uint32_t>(order.size() - 1);
        }
    }
    selectVertices(mesh, order);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3& origin = mesh.positions[t.x];
        const glm::vec3 normal = glm::cross(mesh.positions[t.y] - origin, mesh.positions[t.z] - origin);
        mesh.normals.insert(mesh.normals.end(), 3, glm::normalize(normal));
    }
}

// What makes two vertices one for their tangents: position, normal and uv.
using Place = std::array<float, 8>;

struct PlaceHash {
    size_t operator()(const Place& place) const {
        size_t hash = 0;
        for (const float value : place)
            hash = (hash ^ std::hash<float>()(value)) * 0x9E3779B97F4A7C15u;
        return hash ^ (hash >> 32);
    }
};

// The first of the vertices at the same place, for every vertex.
std::vector<uint32_t> weld(const Mesh& mesh, const std::vector<glm::vec2>& uvs) {
    std::unordered_map<Place, uint32_t, PlaceHash> firsts;
    firsts.reserve(mesh.positions.size());
    std::vector<uint32_t> welded;
    welded.reserve(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        const glm::vec3& n = mesh.normals[i];
        const Place place{p.x, p.y, p.z, n.x, n.y, n.z, uvs[i].x, uvs[i].y};
        welded.push_back(firsts.try_emplace(place, static_cast<uint32_t>(i)).first->second);
    }
    return welded;
}

// Gives corners of mirrored triangles vertices of their own where plain triangles use them too. Returns
// which vertices are mirrored.
std::vector<bool> splitMirrored(Mesh& mesh, const std::vector<UvBasis>& bases) {
    const size_t count = mesh.positions.size();
    std::vector<bool> isPlain(count, false);
    for (size_t i = 0; i < bases.size(); ++i) {
        for (int corner = 0; corner < 3 && !bases[i].isMirrored; ++corner)
            isPlain[mesh.triangles[i][corner]] = true;
    }
    std::vector<uint32_t> order(count);
    for (size_t i = 0; i < count; ++i)
        order[i] = static_cast<uint32_t>(i);
    std::vector<bool> isMirrored(count, false);
    std::unordered_map<uint32_t, uint32_t> copies;
    for (size_t i = 0; i < bases.size(); ++i) {
        for (int corner = 0; corner < 3 && bases[i].isMirrored; ++corner) {
            uint32_t& vertex = mesh.triangles[i][corner];
            if (isPlain[vertex]) {
                const auto [copy, isNew] = copies.try_emplace(vertex, static_cast<uint32_t>(order.size()));
                if (isNew)
                    order.push_back(vertex);
                isMirrored.resize(order.size(), true);
                vertex = copy->second;
            }
            isMirrored[vertex] = true;
        }
    }
    if (order.size() > count)
        selectVertices(mesh, order);
    return isMirrored;
}

// Sums of tangents at one place: of the plain triangles around it, and of the mirrored ones.
using Sums = std::array<glm::vec3, 2>;

// The triangles' tangents, laid along the surface and weighted by angle, added up at each welded vertex.
std::vector<Sums> sumTangents(const Mesh& mesh, const std::vector<UvBasis>& bases,
                              const std::vector<uint32_t>& welded) {
    std::vector<Sums> sums(mesh.positions.size(), Sums{glm::vec3(0.0f), glm::vec3(0.0f)});
    for (size_t i = 0; i < bases.size(); ++i) {
        const glm::uvec3& triangle = mesh.triangles[i];
        for (int corner = 0; corner < 3; ++corner) {
            const uint32_t vertex = triangle[corner];
            const glm::vec3 along = alongSurface(bases[i].tangent, mesh.normals[vertex]);
            sums[welded[vertex]][bases[i].isMirrored] += along * cornerAngle(mesh, triangle, corner);
        }
    }
    return sums;
}

bool hasCoordinates(const Mesh& mesh, const TangentSpace& space) {
    return space.uvSet < mesh.uvs.size() && !mesh.uvs[space.uvSet].empty();
}

std::vector<glm::vec2> coordinatesOf(const Mesh& mesh, const TangentSpace& space) {
    std::vector<glm::vec2> uvs = mesh.uvs[space.uvSet];
    for (glm::vec2& uv : uvs)
        uv = {glm::dot(space.uRow, uv), glm::dot(space.vRow, uv)};
    return uvs;
}

// Tangents of a mesh with normals; may give it further vertices.
std::vector<glm::vec4> tangentsAlong(Mesh& mesh, const TangentSpace& space) {
    std::vector<glm::vec2> uvs = coordinatesOf(mesh, space);
    std::vector<UvBasis> bases;
    bases.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles)
        bases.push_back(uvBasis(mesh, triangle, uvs));
    const std::vector<bool> isMirrored = splitMirrored(mesh, bases);
    uvs = coordinatesOf(mesh, space);
    const std::vector<uint32_t> welded = weld(mesh, uvs);
    const std::vector<Sums> sums = sumTangents(mesh, bases, welded);
    std::vector<glm::vec4> tangents(mesh.positions.size());
    for (size_t i = 0; i < tangents.size(); ++i) {
        const glm::vec3& normal = mesh.normals[i];
        const glm::vec3 mean = alongSurface(sums[welded[i]][isMirrored[i]], normal);
        const glm::vec3 tangent = mean == glm::vec3(0.0f) ? anyTangent(normal) : mean;
        tangents[i] = glm::vec4(tangent, isMirrored[i] ? -1.0f : 1.0f);
    }
    return tangents;
}

} // namespace

TangentSpaces tangentSpaces(const Material& material) {
    TangentSpaces wanted;
    const auto indexOf = [&](const TangentSpace& space) {
        const auto known = std::find(wanted.spaces.begin(), wanted.spaces.end(), space);
        const auto index = static_cast<uint32_t>(known - wanted.spaces.begin());
        if (known == wanted.spaces.end())
            wanted.spaces.push_back(space);
        return index;
    };
    const auto indexOfSlot = [&](TextureSlot slot) {
        const std::optional<Texture>& texture = material.texture(slot);
        return texture ? indexOf({texture->uvSet, texture->uRow, texture->vRow}) : 0;
    };
    (void)indexOfSlot(TextureSlot::normal);
    wanted.coat = indexOfSlot(TextureSlot::clearcoatNormal);
    if (material.anisotropy == 0.0f)
        return wanted;
    wanted.anisotropy = indexOfSlot(TextureSlot::anisotropy);
    if (wanted.spaces.empty())
        wanted.spaces.emplace_back();
    return wanted;
}

glm::vec3 anyTangent(const glm::vec3& normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - normal * glm::dot(normal, axis));
}

void generateTangents(Mesh& mesh, std::span<const TangentSpace> spaces) {
    const bool hasAny = std::any_of(spaces.begin(), spaces.end(),
                                    [&](const TangentSpace& space) { return hasCoordinates(mesh, space); });
    if (mesh.triangles.empty() || !hasAny)
        return;
    const bool isFlat = mesh.normals.empty();
    if (isFlat)
        makeFlat(mesh);
    for (size_t i = 0; i < spaces.size(); ++i) {
        std::vector<glm::vec4> tangents;
        if (hasCoordinates(mesh, spaces[i]))
            tangents = tangentsAlong(mesh, spaces[i]);
        if (i == 0)
            mesh.tangents = std::move(tangents);
        else
            mesh.furtherTangents.push_back(std::move(tangents));
    }
    if (isFlat)
        mesh.normals.clear();
}

} // namespace lavalight

// Primitives of glTF meshes (glTF 2.0 specification, section 3.7.2).
#include "scene/gltf_mesh.h"

#include <optional>

#include <fmt/format.h>

#include "scene/gltf_accessor.h"
#include "scene/gltf_topology.h"
#include "scene/mesh_bake.h"

namespace lavalight {
namespace {

using MeshInstances = std::vector<std::vector<const PlacedNode*>>; // by glTF mesh

MeshInstances groupByMesh(const GltfDocument& document, const std::vector<PlacedNode>& nodes) {
    MeshInstances instances(document.model.meshes.size());
    for (const PlacedNode& placed : nodes) {
        const int mesh = document.model.nodes[static_cast<size_t>(placed.node)].mesh;
        if (mesh >= 0)
            instances[static_cast<size_t>(mesh)].push_back(&placed);
    }
    return instances;
}

// Instances multiply: a small file may ask for more than any memory holds.
void requireFitting(const GltfDocument& document, const MeshInstances& instances) {
    double total = 0.0; // of products that may overflow integers
    for (size_t i = 0; i < instances.size(); ++i) {
        double ofMesh = 0.0;
        for (const tinygltf::Primitive& primitive : document.model.meshes[i].primitives)
            ofMesh += static_cast<double>(triangleCount(primitive, document));
        total += ofMesh * static_cast<double>(instances[i].size());
    }
    if (total > static_cast<double>(kMostTriangles))
        throw document.error(
            fmt::format("it draws {:.0f} triangles, at most {} are supported: simplify the scene", total,
                        kMostTriangles));
}

// The accessor of an attribute, which must hold three components a vertex; none if the primitive lacks it.
void readAttribute(const GltfDocument& document, const tinygltf::Primitive& primitive, const char* name,
                   std::optional<AccessorView>& view) {
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end())
        return;
    view.emplace(document, attribute->second);
    if (!view->isVec3())
        throw document.error(fmt::format("{} is used as {} and must be a VEC3", view->name(), name));
}

void requireEqualCounts(const GltfDocument& document, const tinygltf::Primitive& primitive,
                        const std::string& name, size_t vertexCount) {
    for (const auto& [attribute, accessor] : primitive.attributes) {
        const size_t count = document.model.accessors[static_cast<size_t>(accessor)].count;
        if (count != vertexCount)
            throw document.error(
                fmt::format("{} has {} vertices but {} elements of {}", name, vertexCount, count, attribute));
    }
}

void noteUnread(const GltfDocument& document, const tinygltf::Primitive& primitive, const std::string& name,
                GltfNotes& notes) {
    if (primitive.attributes.contains("COLOR_0"))
        notes.addObject("vertex colours are not read yet", name);
    if (!primitive.targets.empty())
        notes.addObject("morph targets are not evaluated yet, their meshes are shown unmorphed", name);
    const int indices = primitive.indices;
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && indices >= 0 &&
        document.model.accessors[static_cast<size_t>(indices)].count % 3 != 0)
        notes.addObject("the last triangle is incomplete and was left out", name);
}

// A primitive in its own space, with the vertices that its triangles use. Empty if it shows no triangles.
Mesh readPrimitive(const GltfDocument& document, const tinygltf::Primitive& primitive,
                   const std::string& name, GltfNotes& notes) {
    Mesh mesh;
    if (!hasTriangles(primitive)) {
        notes.addObject("points and lines are not rendered", name);
        return mesh;
    }
    std::optional<AccessorView> positions;
    std::optional<AccessorView> normals;
    readAttribute(document, primitive, "POSITION", positions);
    readAttribute(document, primitive, "NORMAL", normals);
    if (!positions) {
        notes.addObject("a primitive without positions shows nothing", name);
        return mesh;
    }
    requireEqualCounts(document, primitive, name, positions->count());
    noteUnread(document, primitive, name, notes);
    mesh.triangles = readTriangles(document, primitive, positions->count());
    for (const uint32_t vertex : compactIndices(mesh.triangles)) {
        mesh.positions.push_back(positions->vec3At(vertex));
        if (normals)
            mesh.normals.push_back(normals->vec3At(vertex));
    }
    return mesh;
}

void noteCounts(const BakeCounts& counts, GltfNotes& notes) {
    if (counts.outOfRange > 0)
        notes.add(fmt::format("{} triangles were left out: positions that are not finite or too large",
                              counts.outOfRange));
    if (counts.withoutArea > 0)
        notes.add(fmt::format("{} triangles without area were left out", counts.withoutArea));
    if (counts.repairedNormals > 0)
        notes.add(fmt::format("{} normals of no direction were replaced by those of the triangles",
                              counts.repairedNormals));
}

} // namespace

std::vector<Mesh> readMeshes(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                             uint32_t defaultMaterial, GltfNotes& notes) {
    const MeshInstances instances = groupByMesh(document, nodes);
    requireFitting(document, instances);
    std::vector<Mesh> meshes;
    BakeCounts counts;
    for (size_t i = 0; i < instances.size(); ++i) {
        if (instances[i].empty())
            continue;
        const tinygltf::Mesh& source = document.model.meshes[i];
        const std::string name = describe("mesh", i, source.name);
        for (const tinygltf::Primitive& primitive : source.primitives) {
            Mesh local = readPrimitive(document, primitive, name, notes);
            local.material =
                primitive.material < 0 ? defaultMaterial : static_cast<uint32_t>(primitive.material);
            for (const PlacedNode* placed : instances[i]) {
                const auto& node = document.model.nodes[static_cast<size_t>(placed->node)];
                local.name = printable(source.name.empty() ? node.name : source.name);
                Mesh baked = bakeMesh(local, placed->toWorld, counts);
                if (!baked.triangles.empty())
                    meshes.push_back(std::move(baked));
            }
        }
    }
    noteCounts(counts, notes);
    return meshes;
}

} // namespace lavalight

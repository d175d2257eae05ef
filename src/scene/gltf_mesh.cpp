// Primitives of glTF meshes (glTF 2.0 specification, section 3.7.2).
#include "scene/gltf_mesh.h"

#include <optional>

#include <fmt/format.h>

#include "scene/gltf_instancing.h"
#include "scene/gltf_topology.h"
#include "scene/gltf_vertices.h"
#include "scene/mesh_bake.h"
#include "scene/mesh_vertices.h"
#include "scene/tangents.h"

namespace lavalight {
namespace {

using MeshInstances = std::vector<std::vector<const PlacedNode*>>; // by glTF mesh

MeshInstances groupByMesh(const GltfDocument& document, const std::vector<PlacedNode>& nodes) {
    MeshInstances instances(document.model.meshes.size());
    for (const PlacedNode& placed : nodes) {
        const int mesh = document.model.nodes[static_cast<size_t>(placed.node)].mesh;
        if (mesh >= 0 && placed.isVisible)
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
        for (const PlacedNode* placed : instances[i]) {
            const tinygltf::Node& node = document.model.nodes[static_cast<size_t>(placed->node)];
            total += ofMesh * static_cast<double>(instanceCount(document, node));
        }
    }
    if (total > static_cast<double>(kMostTriangles))
        throw document.error(
            fmt::format("it draws {:.0f} triangles, at most {} are supported: simplify the scene", total,
                        kMostTriangles));
}

void noteUnread(const GltfDocument& document, const tinygltf::Primitive& primitive, const std::string& name,
                GltfNotes& notes) {
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
    if (!primitive.attributes.contains("POSITION")) {
        notes.addObject("a primitive without positions shows nothing", name);
        return mesh;
    }
    const size_t vertexCount = countVertices(document, primitive, name);
    noteUnread(document, primitive, name, notes);
    std::vector<glm::uvec3> triangles = readTriangles(document, primitive, vertexCount);
    mesh = readVertices(document, primitive, compactIndices(triangles), name, notes);
    mesh.triangles = std::move(triangles);
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
    if (counts.repairedTangents > 0)
        notes.add(fmt::format("{} tangents of no direction were replaced by others along the surface",
                              counts.repairedTangents));
}

// Reads primitives and places them in the scene.
class MeshReader {
  public:
    MeshReader(const GltfDocument& document, const std::vector<Material>& materials, GltfNotes& notes)
        : document_(document), materials_(materials), notes_(notes) {}

    // Everything that nodes show of glTF's mesh `index`.
    void read(size_t index, const std::vector<const PlacedNode*>& nodes) {
        const tinygltf::Mesh& source = document_.model.meshes[index];
        const std::string name = describe("mesh", index, source.name);
        for (const tinygltf::Primitive& primitive : source.primitives) {
            Mesh local = readPrimitive(document_, primitive, name, notes_);
            local.material = primitive.material < 0 ? static_cast<uint32_t>(materials_.size() - 1)
                                                    : static_cast<uint32_t>(primitive.material);
            if (local.triangles.empty())
                continue;
            for (const PlacedNode* placed : nodes) {
                const tinygltf::Node& node = document_.model.nodes[static_cast<size_t>(placed->node)];
                local.name = printable(source.name.empty() ? node.name : source.name);
                placeInstances(local, *placed, node);
            }
        }
    }

    [[nodiscard]] std::vector<Mesh> finish() {
        noteCounts(counts_, notes_);
        return std::move(meshes_);
    }

  private:
    void placeInstances(const Mesh& local, const PlacedNode& placed, const tinygltf::Node& node) {
        const InstanceReader instances(document_, node);
        for (size_t i = 0; i < instances.count(); ++i)
            place(local, placed.toWorld * instances.transform(i));
    }

    // To world space, with tangents where the material wants them.
    void place(const Mesh& local, const glm::dmat4& toWorld) {
        Mesh mesh = bakeMesh(local, toWorld, counts_);
        const std::optional<uint32_t> uvSet = tangentUvSet(materials_[local.material]);
        if (mesh.tangents.empty() && uvSet)
            generateTangents(mesh, *uvSet);
        if (!mesh.triangles.empty())
            meshes_.push_back(std::move(mesh));
    }

    const GltfDocument& document_;
    const std::vector<Material>& materials_;
    GltfNotes& notes_;
    BakeCounts counts_;
    std::vector<Mesh> meshes_;
};

} // namespace

std::vector<Mesh> readMeshes(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                             const std::vector<Material>& materials, GltfNotes& notes) {
    const MeshInstances instances = groupByMesh(document, nodes);
    requireFitting(document, instances);
    MeshReader reader(document, materials, notes);
    for (size_t i = 0; i < instances.size(); ++i) {
        if (!instances[i].empty())
            reader.read(i, instances[i]);
    }
    return reader.finish();
}

} // namespace lavalight

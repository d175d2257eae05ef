// Primitives of glTF meshes (glTF 2.0 specification, section 3.7.2).
#include "gltf/read/mesh.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "base/os/memory.h"
#include "gltf/read/instancing.h"
#include "gltf/read/morph.h"
#include "gltf/read/skin.h"
#include "gltf/read/topology.h"
#include "gltf/read/variants.h"
#include "gltf/read/vertices.h"
#include "scene/mesh_bake.h"
#include "scene/mesh_vertices.h"
#include "scene/scene_origin.h"
#include "scene/tangents.h"

namespace lavalight {
namespace {

using MeshInstances = std::vector<std::vector<const PlacedNode*>>; // by glTF mesh

MeshInstances groupByMesh(const GltfDocument& document, const std::vector<PlacedNode>& nodes) {
    MeshInstances instances(document.list("meshes").size());
    for (const PlacedNode& placed : nodes) {
        const std::optional<size_t> mesh = document.list("nodes")[placed.node].index("mesh");
        if (mesh && placed.isVisible)
            instances[*mesh].push_back(&placed);
    }
    return instances;
}

// What is drawn, in numbers whose products may overflow integers.
struct Extent {
    double triangles = 0.0;
    double bytes = 0.0; // bytes of meshes in world space, at most

    Extent& operator+=(const Extent& other) {
        triangles += other.triangles;
        bytes += other.bytes;
        return *this;
    }
    [[nodiscard]] Extent times(double count) const { return {count * triangles, count * bytes}; }
};

// Vertices that triangles use, at most.
double usedVertices(const GltfDocument& document, JsonView primitive) {
    const auto triangles = static_cast<double>(triangleCount(primitive, document));
    if (triangles == 0.0)
        return 0.0;
    const size_t positions = primitive["attributes"].count("POSITION", 0);
    const size_t vertices = document.list("accessors")[positions].count("count", 0);
    return std::min(3.0 * triangles, static_cast<double>(vertices));
}

Extent extentOf(const GltfDocument& document, JsonView primitive, const std::vector<Material>& materials) {
    const auto triangles = static_cast<double>(triangleCount(primitive, document));
    if (triangles == 0.0)
        return {};
    const Material& material =
        materials[materialOf(primitive, document.variant).value_or(materials.size() - 1)];
    const size_t spaces = std::max<size_t>(tangentSpaces(material).spaces.size(), 1); // or the file's own
    size_t vertexBytes = sizeof(glm::vec3) + spaces * sizeof(glm::vec4);
    for (const auto& [attribute, accessor] : primitive["attributes"].members()) {
        vertexBytes += attribute == "NORMAL" ? sizeof(glm::vec3) : 0;
        vertexBytes += attribute == "COLOR_0" ? sizeof(glm::vec4) : 0;
        vertexBytes += attribute.starts_with("TEXCOORD_") ? sizeof(glm::vec2) : 0;
    }
    constexpr double kAllocations = 128.0; // overhead of a mesh, and its name
    return {triangles, sizeof(Mesh) + kAllocations +
                           usedVertices(document, primitive) * static_cast<double>(vertexBytes) +
                           triangles * sizeof(glm::uvec3)};
}

// Instances multiply: a small file may ask for more than any memory holds.
void requireFitting(const GltfDocument& document, const MeshInstances& instances,
                    const std::vector<Material>& materials) {
    Extent total;
    for (size_t i = 0; i < instances.size(); ++i) {
        Extent ofMesh;
        for (const JsonView primitive : document.list("meshes")[i]["primitives"].elements())
            ofMesh += extentOf(document, primitive, materials);
        for (const PlacedNode* placed : instances[i]) {
            const JsonView node = document.list("nodes")[placed->node];
            total += ofMesh.times(static_cast<double>(instanceCount(document, node)));
        }
    }
    if (total.triangles > static_cast<double>(kMostTriangles))
        throw document.error(
            fmt::format("it draws {:.0f} triangles, at most {} are supported: simplify the scene",
                        total.triangles, kMostTriangles));
    if (const std::string shortage = memoryShortage(static_cast<uint64_t>(total.bytes)); !shortage.empty())
        throw document.error(fmt::format("the {:.0f} triangles that it draws {}: simplify the scene",
                                         total.triangles, shortage));
}

// Nodes that show one mesh multiply its targets, which may all be of the same few values.
void requireFewMorphs(const GltfDocument& document, const MeshInstances& instances, const Pose& pose) {
    constexpr double kMost = 1e10; // 4 ns each: 40 seconds
    double steps = 0.0;
    for (size_t i = 0; i < instances.size(); ++i) {
        for (const JsonView primitive : document.list("meshes")[i]["primitives"].elements()) {
            const size_t targets = primitive["targets"].size();
            if (targets == 0)
                continue;
            const double vertices = usedVertices(document, primitive);
            for (const PlacedNode* placed : instances[i]) {
                steps += morphSteps(primitive, vertices, morphWeights(document, placed->node, pose, targets));
                if (steps > kMost)
                    throw document.error(
                        fmt::format("its morph targets move vertices more than {:.0e} times: "
                                    "simplify the scene",
                                    kMost));
            }
        }
    }
}

void noteUnread(const GltfDocument& document, JsonView primitive, const std::string& name, GltfNotes& notes) {
    const std::optional<size_t> indices = primitive.index("indices");
    if (modeOf(primitive) == kTriangleList && indices &&
        document.list("accessors")[*indices].count("count", 0) % 3 != 0)
        notes.addObject("the last triangle is incomplete and was left out", name);
}

// Coordinates that are not there are (0, 0).
void noteMissingUvs(const Material& material, const Mesh& mesh, const std::string& name, GltfNotes& notes) {
    for (const std::optional<Texture>& texture : material.textures) {
        if (!texture || (texture->uvSet < mesh.uvs.size() && !mesh.uvs[texture->uvSet].empty()))
            continue;
        notes.addObject(fmt::format("textures without their coordinates, TEXCOORD_{}, show a single texel",
                                    texture->uvSet),
                        name);
    }
}

// A primitive in its own space, with where it comes from.
struct LocalMesh {
    VertexSource source;
    Mesh mesh; // empty if it shows no triangles
};

// What the file itself has rounded, no origin brings back.
void noteRounded(const std::vector<glm::vec3>& positions, const std::string& name, GltfNotes& notes) {
    VertexRuns runs;
    runs.begin(0, positions.size());
    for (const glm::vec3& position : positions)
        runs.add(glm::dvec3(position));
    if (const std::optional<CoarseGeometry> worst = findCoarse(runs.all()))
        notes.addObject(fmt::format("positions {:.3g} m from their node are rounded to steps of {:.3g} m by "
                                    "the file itself, too coarse for what is {:.3g} m wide; store them near "
                                    "their node, and move that",
                                    worst->distance, worst->resolution, worst->size),
                        name);
}

LocalMesh readPrimitive(const GltfDocument& document, JsonView primitive, const std::string& name,
                        GltfNotes& notes) {
    LocalMesh local{{primitive, {}, {}}, {}};
    if (!hasTriangles(primitive)) {
        notes.addObject("points and lines are not rendered", name);
        return local;
    }
    if (!primitive["attributes"].has("POSITION")) {
        notes.addObject("a primitive without positions shows nothing", name);
        return local;
    }
    noteUnread(document, primitive, name, notes);
    if (triangleCount(primitive, document) == 0) {
        notes.addObject("a primitive without triangles shows nothing", name);
        return local;
    }
    const size_t vertexCount = countVertices(document, primitive, name);
    std::vector<glm::uvec3> triangles = readTriangles(document, primitive, vertexCount);
    local.source.vertices = compactIndices(triangles);
    local.mesh = readVertices(document, primitive, local.source.vertices);
    local.mesh.triangles = std::move(triangles);
    noteRounded(local.mesh.positions, name, notes);
    if (primitive["targets"].size() > 0 && !local.mesh.positions.empty())
        local.source.anchor = takeAnchor(local.mesh);
    return local;
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
    MeshReader(const GltfDocument& document, const NodeTree& tree, const std::vector<Material>& materials,
               GltfNotes& notes)
        : document_(document), tree_(tree), materials_(materials), notes_(notes) {}

    // Everything that nodes show of glTF's mesh `index`.
    void read(size_t index, const std::vector<const PlacedNode*>& nodes) {
        number_ = index;
        const JsonView source = document_.list("meshes")[index];
        const std::string& ownName = source.text("name");
        const std::string name = describe("mesh", index, ownName);
        if (source["primitives"].size() == 0)
            notes_.addObject("a mesh without primitives shows nothing", name);
        for (const JsonView primitive : source["primitives"].elements()) {
            LocalMesh local = readPrimitive(document_, primitive, name, notes_);
            const std::optional<size_t> material = materialOf(primitive, document_.variant);
            local.mesh.material = static_cast<uint32_t>(material.value_or(materials_.size() - 1));
            if (local.mesh.triangles.empty())
                continue;
            noteMissingUvs(materials_[local.mesh.material], local.mesh, name, notes_);
            if (primitive["targets"].size() == 0)
                limitVertices(local.mesh, name, notes_);
            for (const PlacedNode* placed : nodes) {
                const JsonView node = document_.list("nodes")[placed->node];
                local.mesh.name = printable(ownName.empty() ? node.text("name") : ownName);
                local.mesh.object = objectOf(placed->node, node.text("name"));
                show(local, *placed, node, name);
            }
        }
    }

    [[nodiscard]] Geometry finish() {
        noteCounts(counts_, notes_);
        return std::move(geometry_);
    }

  private:
    // The object that the node is.
    uint32_t objectOf(size_t node, const std::string& name) {
        const auto next = static_cast<uint32_t>(geometry_.objects.size());
        const auto [known, isNew] = objects_.try_emplace(node, next);
        if (isNew)
            geometry_.objects.push_back(name.empty() ? fmt::format("node {}", node) : printable(name));
        return known->second;
    }

    // What one node shows of a primitive: morphed, then skinned or placed.
    void show(const LocalMesh& local, const PlacedNode& placed, JsonView node, const std::string& name) {
        const std::optional<size_t> skin = node.index("skin");
        const size_t targets = local.source.primitive["targets"].size();
        const bool isSkinned = skin && hasJoints(local.source.primitive);
        if (skin && !isSkinned)
            notes_.addObject("a skin moves no mesh without JOINTS_0 and WEIGHTS_0",
                             describe("node", placed.node, node.text("name")));
        const glm::dmat4 toNode = glm::translate(glm::dmat4(1.0), local.source.anchor);
        if (targets == 0 && !isSkinned)
            return placeInstances(local.mesh, placed, toNode);
        Mesh mesh = local.mesh;
        applyMorphTargets(document_, local.source.primitive, local.source.vertices,
                          morphWeights(document_, placed.node, tree_.pose, targets), mesh);
        limitVertices(mesh, name, notes_);
        if (!isSkinned)
            return placeInstances(mesh, placed, toNode);
        geometry_.runs.begin(number_, mesh.positions.size());
        applySkin(document_, local.source, jointsOf(*skin), mesh, geometry_.runs);
        cleanMesh(mesh, counts_);
        keep(std::move(mesh));
    }

    // Makes the joints of each skin once: thousands of nodes may share one.
    const std::vector<glm::dmat4>& jointsOf(size_t skin) {
        const auto known = joints_.find(skin);
        if (known != joints_.end())
            return known->second;
        return joints_.emplace(skin, jointTransforms(document_, skin, tree_.toWorld)).first->second;
    }

    void placeInstances(const Mesh& local, const PlacedNode& placed, const glm::dmat4& toNode) {
        const InstanceReader instances(document_, document_.list("nodes")[placed.node]);
        for (size_t i = 0; i < instances.count(); ++i) {
            geometry_.runs.begin(number_, local.positions.size());
            const glm::dmat4 toWorld = placed.toWorld * instances.transform(i) * toNode;
            keep(bakeMesh(local, toWorld, counts_, geometry_.runs));
        }
    }

    // Takes a mesh in world space, with tangents where its material wants them.
    void keep(Mesh mesh) {
        if (mesh.tangents.empty())
            generateTangents(mesh, tangentSpaces(materials_[mesh.material]).spaces);
        if (!mesh.triangles.empty())
            geometry_.meshes.push_back(std::move(mesh));
    }

    const GltfDocument& document_;
    const NodeTree& tree_;
    const std::vector<Material>& materials_;
    GltfNotes& notes_;
    BakeCounts counts_;
    std::map<size_t, std::vector<glm::dmat4>> joints_; // by skin
    std::map<size_t, uint32_t> objects_;               // by node
    size_t number_ = 0;                                // the file's, of the mesh that is read
    Geometry geometry_;
};

} // namespace

Geometry readMeshes(const GltfDocument& document, const NodeTree& tree,
                    const std::vector<Material>& materials, GltfNotes& notes) {
    const MeshInstances instances = groupByMesh(document, tree.shown);
    requireFitting(document, instances, materials);
    requireFewMorphs(document, instances, tree.pose);
    MeshReader reader(document, tree, materials, notes);
    for (size_t i = 0; i < instances.size(); ++i) {
        if (!instances[i].empty())
            reader.read(i, instances[i]);
    }
    return reader.finish();
}

} // namespace lavalight

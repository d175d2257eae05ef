#include "support/scene_builder.h"

#include <cmath>
#include <limits>

#include "scene/solids.h"

namespace lavalight::test {
namespace {

void append(Shape& shape, const Shape& more) {
    const auto first = static_cast<uint32_t>(shape.positions.size());
    shape.positions.insert(shape.positions.end(), more.positions.begin(), more.positions.end());
    for (const glm::uvec3& triangle : more.triangles)
        shape.triangles.push_back(triangle + first);
}

Camera aimed(const glm::vec3& position, const glm::vec3& target) {
    Camera camera;
    camera.name = "test";
    camera.position = position;
    camera.forward = glm::normalize(target - position);
    camera.right = glm::normalize(glm::cross(camera.forward, glm::vec3(0.0f, 1.0f, 0.0f)));
    camera.up = glm::cross(camera.right, camera.forward);
    camera.aspect = 1.0f;
    return camera;
}

} // namespace

Shape rectangle(const glm::vec3& center, const glm::vec3& halfU, const glm::vec3& halfV) {
    return {{center - halfU - halfV, center + halfU - halfV, center + halfU + halfV, center - halfU + halfV},
            {{0, 1, 2}, {0, 2, 3}}};
}

Shape cube(const glm::vec3& center, float halfSide) {
    Shape shape;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0.0f), u(0.0f), v(0.0f);
            n[axis] = side * halfSide;
            u[(axis + 1) % 3] = side * halfSide;
            v[(axis + 2) % 3] = halfSide;
            append(shape, rectangle(center + n, u, v));
        }
    return shape;
}

Shape ball(const glm::vec3& center, float radius) {
    Shape shape;
    for (int octant = 0; octant < 8; ++octant) {
        const glm::vec3 sign((octant & 1) != 0 ? -1 : 1, (octant & 2) != 0 ? -1 : 1,
                             (octant & 4) != 0 ? -1 : 1);
        const float s = std::sqrt(0.5f);
        Shape face;
        for (const glm::vec3& p : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1),
                                   glm::vec3(s, s, 0), glm::vec3(0, s, s), glm::vec3(s, 0, s)})
            face.positions.push_back(center + radius * sign * p);
        face.triangles = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
        append(shape, sign.x * sign.y * sign.z > 0.0f
                          ? face
                          : insideOut(face)); // mirrored octants turn the other way
    }
    return shape;
}

Shape insideOut(Shape shape) {
    for (glm::uvec3& triangle : shape.triangles)
        std::swap(triangle.y, triangle.z);
    return shape;
}

Material lambert(const glm::vec3& color) {
    Material material;
    material.name = "lambert";
    material.baseColor = color;
    material.metallic = 0.0f;
    material.specular = 0.0f;
    return material;
}

Material light(const glm::vec3& radiance) {
    Material material = lambert(glm::vec3(0.0f));
    material.name = "light";
    material.emission = radiance;
    return material;
}

Camera lookAt(const glm::vec3& position, const glm::vec3& target, float verticalFov) {
    Camera camera = aimed(position, target);
    camera.verticalFov = verticalFov;
    return camera;
}

Camera lookAtOrthographic(const glm::vec3& position, const glm::vec3& target, float halfHeight) {
    Camera camera = aimed(position, target);
    camera.projection = Projection::orthographic;
    camera.halfHeight = halfHeight;
    return camera;
}

SceneBuilder& SceneBuilder::add(const Shape& shape, const Material& material) {
    Mesh mesh;
    mesh.name = "mesh " + std::to_string(scene_.meshes.size());
    mesh.material = static_cast<uint32_t>(scene_.materials.size());
    mesh.positions = shape.positions;
    mesh.triangles = shape.triangles;
    scene_.meshes.push_back(mesh);
    scene_.materials.push_back(material);
    return *this;
}

SceneBuilder& SceneBuilder::addSmooth(const Shape& shape, const glm::vec3& center, const Material& material) {
    add(shape, material);
    for (const glm::vec3& position : shape.positions)
        scene_.meshes.back().normals.push_back(glm::normalize(position - center));
    return *this;
}

SceneBuilder& SceneBuilder::environment(const glm::vec3& radiance) {
    scene_.environment = radiance;
    return *this;
}

SceneBuilder& SceneBuilder::camera(const Camera& camera) {
    scene_.cameras.push_back(camera);
    return *this;
}

Scene SceneBuilder::build() const {
    Scene scene = scene_;
    scene.source = "test scene";
    scene.bounds = {glm::vec3(std::numeric_limits<float>::max()),
                    glm::vec3(std::numeric_limits<float>::lowest())};
    for (const Mesh& mesh : scene.meshes)
        for (const glm::vec3& position : mesh.positions) {
            scene.bounds.lower = glm::min(scene.bounds.lower, position);
            scene.bounds.upper = glm::max(scene.bounds.upper, position);
        }
    findSolids(scene);
    return scene;
}

} // namespace lavalight::test

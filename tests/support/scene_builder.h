// Small scenes built in code, for tests that know in closed form what an image of them must show.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight::test {

// A shape of flat-shaded triangles; fronts are where the vertices turn counter-clockwise.
struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

// The parallelogram center +- halfU +- halfV; its front faces cross(halfU, halfV).
[[nodiscard]] Shape rectangle(const glm::vec3& center, const glm::vec3& halfU, const glm::vec3& halfV);

// A box whose fronts face outwards.
[[nodiscard]] Shape cube(const glm::vec3& center, float halfSide);

// A convex body of 32 faces with its vertices on a sphere (an octahedron subdivided once); fronts face
// outwards.
[[nodiscard]] Shape ball(const glm::vec3& center, float radius);

// The shape with its triangles' fronts on the other side.
[[nodiscard]] Shape insideOut(Shape shape);

// A surface without specular reflection.
[[nodiscard]] Material lambert(const glm::vec3& color);

// A surface that reflects nothing and emits `radiance` to its front.
[[nodiscard]] Material light(const glm::vec3& radiance);

// A square perspective camera that looks from `position` to `target`; the view must not be parallel to y.
[[nodiscard]] Camera lookAt(const glm::vec3& position, const glm::vec3& target, float verticalFov);

// A camera that looks so without perspective, `halfHeight` metres from the middle to the upper border.
[[nodiscard]] Camera lookAtOrthographic(const glm::vec3& position, const glm::vec3& target, float halfHeight);

class SceneBuilder {
  public:
    // Each shape becomes a mesh with a material of its own.
    SceneBuilder& add(const Shape& shape, const Material& material);
    // Adds a shape shaded with the normals of the sphere around `center`.
    SceneBuilder& addSmooth(const Shape& shape, const glm::vec3& center, const Material& material);
    SceneBuilder& environment(const glm::vec3& radiance);
    SceneBuilder& camera(const Camera& camera);
    [[nodiscard]] Scene build() const;

  private:
    Scene scene_;
};

} // namespace lavalight::test

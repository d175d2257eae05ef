// Bodies of glass, views along a normal, and what Beer-Lambert and Fresnel leave of light on the way.
#pragma once

#include <glm/glm.hpp>

#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {

const glm::vec3 kMetreColor(0.5f, 0.25f, 1.0f); // of white light after a metre

// Smooth and solid. metreColor: the colour of white light after a metre inside.
[[nodiscard]] Material glassOf(float ior, const glm::vec3& metreColor = glm::vec3(1.0f));
[[nodiscard]] Material unlit(const glm::vec3& color);

// The box between two corners, outside in front.
[[nodiscard]] Shape box(const glm::vec3& lower, const glm::vec3& upper);
// A square at height z that faces up.
[[nodiscard]] Shape squareAt(float z, float half = 2.0f);
[[nodiscard]] Shape moved(Shape shape, const glm::vec3& offset);
// Turned about two axes, so that no face is parallel to one.
[[nodiscard]] glm::vec3 turned(const glm::vec3& p);
[[nodiscard]] Shape turned(Shape shape);

// From z = `height` down along -z, without perspective; a view of 0.2 m.
[[nodiscard]] Camera down(float height);

// What is left of white light over some metres.
[[nodiscard]] glm::dvec3 over(double metres, const glm::vec3& metreColor = kMetreColor);
// What is left where light passes from one index to another along the normal.
[[nodiscard]] double passing(double from, double to);

class MediaTest : public DeviceTest {
  protected:
    // Without roulette, so that nothing is random along a normal but which way glass sends a path.
    RenderResult render(const Scene& scene, uint32_t samples = 4, uint32_t size = 16,
                        Schedule schedule = Schedule::fused);
    // By both schedules.
    void expectEverywhere(const Scene& scene, const glm::dvec3& expected);
};

} // namespace lavalight::test

// The ground that a model without surroundings may be given: a horizontal plane below it.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight {

// The height of a ground right below what is in `bounds`: lower by 2^-13 of its radius, so that it cannot be
// confused with a bottom of the model that lies level.
[[nodiscard]] float groundHeight(const Bounds& bounds);

// Adds a Lambert ground at that height, seen from above. It ends some thousand radii of the scene away, where
// a camera beside the scene sees the horizon. Scene::bounds stay those of the model, so that views and
// the power of lights do not depend on it.
void addGround(Scene& scene, float height, const glm::vec3& albedo);

// Adds the ground of one moment of an animation to another, in the same place of the world.
void copyGround(const Scene& from, Scene& to);

} // namespace lavalight

// Selecting and renumbering the vertices of a mesh, with all that they carry.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight {

// Renumbers the vertices that `triangles` uses from 0 and returns their former numbers, in ascending order.
[[nodiscard]] std::vector<uint32_t> compactIndices(std::vector<glm::uvec3>& triangles);

// Makes vertex i of `mesh` what its vertex order[i] was, in every attribute. The triangles stay as they are.
void selectVertices(Mesh& mesh, const std::vector<uint32_t>& order);

} // namespace lavalight

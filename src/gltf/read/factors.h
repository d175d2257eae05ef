// Brings the factors of materials and lights into their range.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "gltf/read/notes.h"

namespace lavalight {

// Where no limit is given: products of a few such factors stay finite in single precision.
constexpr double kLargestFactor = 1e15;

// Reads the factors of one object, clamps them, and notes under the object's name that it had to. `name` and
// `notes` must outlive it.
class FactorReader {
  public:
    FactorReader(const std::string& name, GltfNotes& notes) : name_(name), notes_(notes) {}

    [[nodiscard]] float clamped(double value, double lower, double upper, const char* factor);

    // Each channel from 0 to `upper`.
    [[nodiscard]] glm::vec3 clamped(const glm::dvec3& values, double upper, const char* factor);

  private:
    const std::string& name_;
    GltfNotes& notes_;
};

} // namespace lavalight

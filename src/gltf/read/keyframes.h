// Keys of an animation's sampler and what lies between them.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gltf/decode/accessor.h"

namespace lavalight {

// The times of keys, read from each accessor once: thousands of channels may share one.
class KeyTimes {
  public:
    // The document must outlive it.
    explicit KeyTimes(const GltfDocument& document) : document_(document) {}

    // Seconds, ascending, not empty. Throws Error naming the accessor for times that do not ascend.
    [[nodiscard]] const std::vector<float>& of(size_t accessor);

  private:
    const GltfDocument& document_;
    std::map<size_t, std::vector<float>> times_; // by accessor
};

// What the keys of a channel are values of.
struct KeyType {
    std::string name;        // for messages: translation, or a pointer
    size_t components = 1;   // of a value, 1 to 4
    bool isArray = false;    // a key has several values of one component, as many as its accessor brings
    bool isRotation = false; // quaternions
};

// The keys of one channel. The document and the times must outlive it.
class Keyframes {
  public:
    // Throws Error naming the accessor for times that do not ascend, and for values whose type or number does
    // not fit `type` and times.
    Keyframes(const GltfDocument& document, JsonView sampler, KeyType type, KeyTimes& times);

    // Values of one key: 1, or the length of the array.
    [[nodiscard]] size_t lanes() const { return lanes_; }

    // The value at a time in seconds; components that the type lacks are 0. Rotations are of unit length.
    [[nodiscard]] glm::dvec4 at(double seconds, size_t lane) const;

  private:
    enum class Interpolation { step, linear, cubic };
    enum class Part { inTangent, value, outTangent }; // parts of a cubic key, in the order of storage

    void checkValues(const GltfDocument& document);
    [[nodiscard]] glm::dvec4 stored(size_t key, size_t lane, Part part = Part::value) const;
    [[nodiscard]] glm::dvec4 between(size_t key, double seconds, size_t lane) const;

    AccessorView output_;
    KeyType type_;
    Interpolation interpolation_ = Interpolation::linear;
    std::span<const float> times_;
    size_t lanes_ = 1;
};

} // namespace lavalight

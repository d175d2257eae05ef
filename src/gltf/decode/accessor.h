// Reads the elements of glTF accessors: all component types, strides, sparse and zero-filled ones.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "gltf/file/document.h"

namespace lavalight {

// glTF's numbers for the types of components, which are those of OpenGL.
enum class ComponentType : uint64_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126,
};

// One accessor of a document. The document must outlive it.
class AccessorView {
  public:
    // Checks that every element lies inside its buffer view and the view inside its buffer. Throws Error
    // naming the accessor and the figures.
    AccessorView(const GltfDocument& document, size_t accessor);
    AccessorView(const AccessorView&) = delete;
    AccessorView& operator=(const AccessorView&) = delete;

    [[nodiscard]] size_t count() const { return count_; }
    [[nodiscard]] const std::string& name() const { return name_; } // for messages
    [[nodiscard]] bool isScalar() const { return type_ == "SCALAR"; }
    [[nodiscard]] bool isVec2() const { return type_ == "VEC2"; }
    [[nodiscard]] bool isVec3() const { return type_ == "VEC3"; }
    [[nodiscard]] bool isVec4() const { return type_ == "VEC4"; }
    [[nodiscard]] bool isUnsignedScalar() const;
    [[nodiscard]] bool isUnsignedVec4() const; // and not normalized
    [[nodiscard]] bool isFloatMat4() const;

    // Throws Error unless the sparse elements are in range and in order. The rest takes that for granted.
    void checkSparse(const GltfDocument& document) const;

    // Element i < count() of a SCALAR, VEC2, VEC3 or VEC4; normalized integers are mapped to [0, 1] or [-1,
    // 1]. May be infinite or NaN.
    [[nodiscard]] float scalarAt(size_t i) const;
    [[nodiscard]] glm::vec2 vec2At(size_t i) const;
    [[nodiscard]] glm::vec3 vec3At(size_t i) const;
    [[nodiscard]] glm::vec4 vec4At(size_t i) const;

    [[nodiscard]] glm::mat4 mat4At(size_t i) const; // elements are floats

    // Element i < count() of a scalar of an unsigned integer type.
    [[nodiscard]] uint32_t unsignedAt(size_t i) const;

  private:
    template <class Vector>
    [[nodiscard]] Vector vectorAt(size_t i) const;
    void readSparse(const GltfDocument& document, JsonView sparse);
    [[nodiscard]] uint32_t replacedAt(size_t number) const; // ascending, where the document has been checked
    [[nodiscard]] std::string_view elementAt(size_t i) const;

    std::string name_;
    size_t count_ = 0;
    std::string_view type_; // "SCALAR", "VEC3", ..., in the document
    ComponentType componentType_ = ComponentType::float32;
    bool normalized_ = false;
    size_t elementSize_ = 0;  // bytes
    size_t packedStride_ = 0; // bytes from one element to the next where nothing lies between
    size_t stride_ = 0;       // bytes from one element to the next
    std::string_view bytes_;  // from the first byte of the first element

    // Elements that are replaced: looked up, for a copy of all would cost each use of a large accessor as
    // much.
    size_t replacedCount_ = 0;
    ComponentType replacedType_ = ComponentType::uint32; // type of their indices
    std::string_view replacedNumbers_;                   // their indices, packed
    std::string_view replacedElements_;                  // their values, packedStride_ bytes apart
};

// Throws Error unless all accessors and buffer views of the document are sound, used or not.
void checkAccessors(const GltfDocument& document);

} // namespace lavalight

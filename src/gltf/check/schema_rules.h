// What the properties of a glTF file must be, as a table (glTF 2.0 specification, section 5).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lavalight {

enum class Kind {
    object,
    text,
    flag,
    number,
    count,
    small, // a count that fits an int
    index,
    stride,        // a multiple of 4 from 4 to 252
    componentType, // 5120 to 5123, 5125 or 5126
    elementType,   // "SCALAR", "VEC3", ...
    mode,          // a primitive's: 0 to 6
};
enum class Need { optional, required };

constexpr size_t kNoArray = 0;
constexpr size_t kAnyLength = static_cast<size_t>(-1);

struct PropertyRule {
    std::string_view name;    // "*": every member of the object
    Kind kind = Kind::object; // kind of the value, or of each element where `length` asks for an array
    Need need = Need::optional;
    size_t length = kNoArray;     // elements of the array
    std::string_view target = {}; // the array that an index points into, from the root: "a.b.array"
};

[[nodiscard]] constexpr PropertyRule required(std::string_view name, Kind kind) {
    return {name, kind, Need::required};
}
[[nodiscard]] constexpr PropertyRule optional(std::string_view name, Kind kind) {
    return {name, kind};
}
[[nodiscard]] constexpr PropertyRule number(std::string_view name) {
    return optional(name, Kind::number);
}
[[nodiscard]] constexpr PropertyRule numbers(std::string_view name, size_t length) {
    return {name, Kind::number, Need::optional, length};
}
[[nodiscard]] constexpr PropertyRule index(std::string_view name, std::string_view target,
                                           Need need = Need::optional) {
    return {name, Kind::index, need, kNoArray, target};
}
[[nodiscard]] constexpr PropertyRule indices(std::string_view name, std::string_view target) {
    return {name, Kind::index, Need::optional, kAnyLength, target};
}

// `path` leads from the root to objects: "meshes[].primitives[]" is every primitive of every mesh.
struct ObjectRule {
    std::string path;
    std::vector<PropertyRule> properties;
};

[[nodiscard]] std::vector<ObjectRule> gltfSchemaRules();

} // namespace lavalight

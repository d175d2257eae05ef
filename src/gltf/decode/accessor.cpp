// Accessors (glTF 2.0 specification, section 3.6.2).
#include "gltf/decode/accessor.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <optional>

#include <fmt/format.h>
#include <glm/ext/vector_float1.hpp>

namespace lavalight {
namespace {

// An accessor without data may ask for any number of zeros, a few bytes of a file for hours of work. Files
// have them as the base of sparse morph targets: of as many elements as a mesh has vertices, two or three for
// each target.
constexpr size_t kMostZeros = size_t{1} << 24;
constexpr size_t kMostZerosInAll = size_t{1} << 28;
constexpr std::array<char, 64>
    kZeros{}; // the largest element, a MAT4 of 4-byte components; read with a stride of 0

// Bytes of one element, and from one to the next where they are packed.
struct ElementLayout {
    size_t size = 0;
    size_t stride = 0;
};

// Columns of matrices start at multiples of four bytes, but the last has no padding (section 3.6.2.4).
ElementLayout layoutOf(std::string_view type, size_t component) {
    const auto matrix = [component](size_t n) {
        const size_t column = (n * component + 3) / 4 * 4;
        return ElementLayout{(n - 1) * column + n * component, n * column};
    };
    // "SCALAR", "VEC2" to "VEC4", "MAT2" to "MAT4": the schema check admits no others.
    const auto digit = static_cast<size_t>(type.back() - '0');
    if (type.starts_with("MAT"))
        return matrix(digit);
    const size_t size = component * (type.starts_with("VEC") ? digit : 1);
    return {size, size};
}

size_t componentSize(ComponentType componentType) {
    switch (componentType) {
    case ComponentType::int8:
    case ComponentType::uint8:
        return 1;
    case ComponentType::int16:
    case ComponentType::uint16:
        return 2;
    default:
        return 4; // the schema check admits no others
    }
}

// A run of elements in a buffer view.
struct Range {
    size_t view = 0;
    size_t offset = 0; // bytes into the view
    size_t count = 0;
    size_t elementSize = 0;
    size_t stride = 0;
};

std::string nameOfView(const GltfDocument& document, size_t index) {
    return describe("buffer view", index, document.list("bufferViews")[index].text("name"));
}

BufferRange rangeOfView(const GltfDocument& document, size_t index) {
    const JsonView view = document.list("bufferViews")[index];
    return {view.count("buffer", 0), view.count("byteOffset", 0), view.count("byteLength", 0)};
}

const GltfBuffer& bufferOf(const GltfDocument& document, size_t view) {
    return document.buffers.at(rangeOfView(document, view).buffer);
}

void requireInsideBuffer(const GltfDocument& document, size_t index) {
    const BufferRange view = rangeOfView(document, index);
    const size_t size = document.buffers.at(view.buffer).byteLength;
    if (view.offset > size || view.length > size - view.offset)
        throw document.error(fmt::format("{} covers {} bytes from {}, but buffer {} has {}",
                                         nameOfView(document, index), view.length, view.offset, view.buffer,
                                         size));
}

std::string_view bytesOfView(const GltfDocument& document, size_t index) {
    return bytesOf(document.buffers, rangeOfView(document, index), nameOfView(document, index),
                   document.source);
}

// The bytes of `range`, from its first element to the end of the view. Multiplies nothing that could
// overflow.
std::string_view bytesOfRange(const GltfDocument& document, const std::string& name, const Range& range) {
    const std::string_view view = bytesOfView(document, range.view);
    const bool fits = range.offset <= view.size() && range.elementSize <= view.size() - range.offset &&
                      range.count - 1 <= (view.size() - range.offset - range.elementSize) / range.stride;
    if (!fits)
        throw document.error(fmt::format(
            "{} needs {} elements of {} bytes, {} apart, from byte {}, but buffer view {} has {}", name,
            range.count, range.elementSize, range.stride, range.offset, range.view, view.size()));
    return view.substr(range.offset);
}

template <class T>
T load(std::string_view bytes) {
    assert(bytes.size() >= sizeof(T));
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
}

uint32_t loadUnsigned(std::string_view bytes, ComponentType componentType) {
    switch (componentType) {
    case ComponentType::uint8:
        return load<uint8_t>(bytes);
    case ComponentType::uint16:
        return load<uint16_t>(bytes);
    default:
        return load<uint32_t>(bytes);
    }
}

// Normalized integers after section 3.11 of the specification ("c / 127, not below -1").
float loadComponent(std::string_view bytes, ComponentType componentType, bool normalized) {
    const auto scaled = [normalized](auto value, float largest) {
        return normalized ? std::max(static_cast<float>(value) / largest, -1.0f) : static_cast<float>(value);
    };
    switch (componentType) {
    case ComponentType::int8:
        return scaled(load<int8_t>(bytes), 127.0f);
    case ComponentType::uint8:
        return scaled(load<uint8_t>(bytes), 255.0f);
    case ComponentType::int16:
        return scaled(load<int16_t>(bytes), 32767.0f);
    case ComponentType::uint16:
        return scaled(load<uint16_t>(bytes), 65535.0f);
    case ComponentType::uint32:
        return scaled(load<uint32_t>(bytes), 4294967295.0f);
    default:
        return load<float>(bytes);
    }
}

bool isUnsigned(ComponentType componentType) {
    return componentType == ComponentType::uint8 || componentType == ComponentType::uint16 ||
           componentType == ComponentType::uint32;
}

// False for accessors into buffers that were declared without data. That is an error only where they are
// read.
bool hasData(const GltfDocument& document, JsonView accessor) {
    const auto present = [&](JsonView part) {
        const std::optional<size_t> view = part.index("bufferView");
        return !view || !bufferOf(document, *view).bytes.empty();
    };
    const JsonView sparse = accessor["sparse"];
    return present(accessor) && present(sparse["indices"]) && present(sparse["values"]);
}

ComponentType componentTypeOf(JsonView object) {
    return ComponentType{object.count("componentType", 0)};
}

} // namespace

AccessorView::AccessorView(const GltfDocument& document, size_t index) {
    const JsonView accessor = document.list("accessors")[index];
    name_ = describe("accessor", index, accessor.text("name"));
    count_ = accessor.count("count", 0);
    type_ = accessor.text("type");
    componentType_ = componentTypeOf(accessor);
    normalized_ = accessor.flag("normalized", false);
    const ElementLayout layout = layoutOf(type_, componentSize(componentType_));
    elementSize_ = layout.size;
    packedStride_ = layout.stride;
    if (count_ == 0)
        return;
    if (const std::optional<size_t> view = accessor.index("bufferView")) {
        stride_ = document.list("bufferViews")[*view].count("byteStride", packedStride_);
        if (stride_ < elementSize_)
            throw document.error(
                fmt::format("{} has elements of {} bytes only {} bytes apart", name_, elementSize_, stride_));
        bytes_ = bytesOfRange(document, name_,
                              {*view, accessor.count("byteOffset", 0), count_, elementSize_, stride_});
    } else if (count_ > kMostZeros) {
        throw document.error(fmt::format("{} asks for {} elements without data, at most {} are supported",
                                         name_, count_, kMostZeros));
    } else {
        bytes_ = std::string_view(kZeros.data(), kZeros.size());
        stride_ = 0;
    }
    if (const JsonView sparse = accessor["sparse"])
        readSparse(document, sparse);
}

void AccessorView::readSparse(const GltfDocument& document, JsonView sparse) {
    const JsonView indices = sparse["indices"];
    const JsonView values = sparse["values"];
    replacedCount_ = sparse.count("count", 0);
    replacedType_ = componentTypeOf(indices);
    if (replacedCount_ == 0)
        return;
    if (replacedCount_ > count_ || !isUnsigned(replacedType_))
        throw document.error(fmt::format("{} replaces {} of its {} elements, by indices of component type {}",
                                         name_, replacedCount_, count_,
                                         static_cast<uint64_t>(replacedType_)));
    const size_t indexSize = componentSize(replacedType_);
    replacedNumbers_ = bytesOfRange(document, name_ + " (sparse indices)",
                                    {indices.count("bufferView", 0), indices.count("byteOffset", 0),
                                     replacedCount_, indexSize, indexSize});
    replacedElements_ = bytesOfRange(document, name_ + " (sparse values)",
                                     {values.count("bufferView", 0), values.count("byteOffset", 0),
                                      replacedCount_, elementSize_, packedStride_});
}

uint32_t AccessorView::replacedAt(size_t number) const {
    return loadUnsigned(replacedNumbers_.substr(number * componentSize(replacedType_)), replacedType_);
}

std::string_view AccessorView::elementAt(size_t i) const {
    assert(i < count_);
    size_t first = 0; // replaced element whose number is i or above, found by halves
    for (size_t end = replacedCount_; first < end;) {
        const size_t middle = first + (end - first) / 2;
        if (replacedAt(middle) < i)
            first = middle + 1;
        else
            end = middle;
    }
    if (first < replacedCount_ && replacedAt(first) == i)
        return replacedElements_.substr(first * packedStride_, elementSize_);
    return bytes_.substr(i * stride_, elementSize_);
}

// The numbers of sparse elements must ascend (section 5.2), which looking them up takes for granted.
void AccessorView::checkSparse(const GltfDocument& document) const {
    for (size_t i = 0; i < replacedCount_; ++i) {
        if (replacedAt(i) >= count_)
            throw document.error(fmt::format("{} replaces element {} of {}", name_, replacedAt(i), count_));
        if (i > 0 && replacedAt(i) <= replacedAt(i - 1))
            throw document.error(fmt::format("{} replaces element {} after element {}, but they must ascend",
                                             name_, replacedAt(i), replacedAt(i - 1)));
    }
}

bool AccessorView::isUnsignedScalar() const {
    return isScalar() && isUnsigned(componentType_);
}

bool AccessorView::isUnsignedVec4() const {
    return isVec4() && isUnsigned(componentType_) && !normalized_;
}

bool AccessorView::isFloatMat4() const {
    return type_ == "MAT4" && componentType_ == ComponentType::float32;
}

template <class Vector>
Vector AccessorView::vectorAt(size_t i) const {
    constexpr auto kSize = static_cast<size_t>(Vector::length());
    assert(elementSize_ == kSize * componentSize(componentType_) && i < count_);
    const std::string_view element = elementAt(i);
    if (componentType_ == ComponentType::float32)
        return load<Vector>(element);
    const size_t size = elementSize_ / kSize;
    Vector value;
    for (size_t axis = 0; axis < kSize; ++axis)
        value[static_cast<glm::length_t>(axis)] =
            loadComponent(element.substr(axis * size), componentType_, normalized_);
    return value;
}

float AccessorView::scalarAt(size_t i) const {
    return vectorAt<glm::vec1>(i).x;
}

glm::vec2 AccessorView::vec2At(size_t i) const {
    return vectorAt<glm::vec2>(i);
}

glm::vec3 AccessorView::vec3At(size_t i) const {
    return vectorAt<glm::vec3>(i);
}

glm::vec4 AccessorView::vec4At(size_t i) const {
    return vectorAt<glm::vec4>(i);
}

glm::mat4 AccessorView::mat4At(size_t i) const {
    assert(isFloatMat4() && i < count_);
    return load<glm::mat4>(elementAt(i));
}

uint32_t AccessorView::unsignedAt(size_t i) const {
    assert(isUnsignedScalar() && i < count_);
    return loadUnsigned(elementAt(i), componentType_);
}

void checkAccessors(const GltfDocument& document) {
    for (size_t i = 0; i < document.list("bufferViews").size(); ++i)
        requireInsideBuffer(document, i);
    size_t zeros = 0;
    const JsonView accessors = document.list("accessors");
    for (size_t i = 0; i < accessors.size(); ++i) {
        if (!hasData(document, accessors[i]))
            continue;
        const AccessorView accessor(document, i);
        accessor.checkSparse(document);
        zeros += accessors[i].has("bufferView") ? 0 : accessor.count(); // kMostZeros each: no overflow
        if (zeros > kMostZerosInAll)
            throw document.error(fmt::format("its accessors ask for {} elements without data, at most {} are "
                                             "supported",
                                             zeros, kMostZerosInAll));
    }
}

} // namespace lavalight

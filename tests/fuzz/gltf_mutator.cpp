// Changes of glTF files that the parsers let through: bytes flipped at random would only ever meet the checks
// of the container and of the JSON's grammar.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t maxSize);
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned int seed);

namespace {

using Json = nlohmann::json;
using Random = std::minstd_rand;

constexpr size_t kGlbHeader = 12;
constexpr size_t kChunkHeader = 8;

// Parts of a .glb, or of a .gltf, which has no binary part.
struct Parts {
    std::string json;
    std::optional<std::string> binary;
};

size_t littleEndian32(std::string_view bytes, size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i)
        value |= uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
}

std::string fourBytes(size_t value) {
    std::string bytes;
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>((value >> shift) & 0xFF);
    return bytes;
}

// Lengths that do not fit take what there is.
Parts takeApart(std::string_view bytes) {
    if (!bytes.starts_with("glTF") || bytes.size() < kGlbHeader + kChunkHeader)
        return {std::string(bytes), std::nullopt};
    const std::string_view rest = bytes.substr(kGlbHeader + kChunkHeader);
    const size_t length = std::min(littleEndian32(bytes, kGlbHeader), rest.size());
    const std::string_view binary = rest.substr(length);
    return {std::string(rest.substr(0, length)),
            std::string(binary.substr(std::min(kChunkHeader, binary.size())))};
}

std::string putTogether(Parts parts) {
    if (!parts.binary)
        return parts.json;
    parts.json.resize((parts.json.size() + 3) / 4 * 4, ' ');
    parts.binary->resize((parts.binary->size() + 3) / 4 * 4, '\0');
    const std::string chunks = fourBytes(parts.json.size()) + "JSON" + parts.json +
                               fourBytes(parts.binary->size()) + std::string("BIN\0", 4) + *parts.binary;
    return "glTF" + fourBytes(2) + fourBytes(kGlbHeader + chunks.size()) + chunks;
}

void mutateBytes(std::string& bytes, size_t maxSize) {
    std::vector<uint8_t> changed(bytes.begin(), bytes.end());
    changed.resize(std::max<size_t>(maxSize, bytes.size()) + 1);
    const size_t size = LLVMFuzzerMutate(changed.data(), bytes.size(), changed.size());
    bytes.assign(reinterpret_cast<const char*>(changed.data()), size);
}

// All values of a document, unless it is nested beyond what a dump of it could recurse to.
std::vector<Json*> valuesOf(Json& root) {
    constexpr size_t kDeepest = 300;
    std::vector<Json*> values;
    std::vector<std::pair<Json*, size_t>> pending{{&root, 0}};
    while (!pending.empty()) {
        const auto [value, depth] = pending.back();
        pending.pop_back();
        if (depth > kDeepest)
            return {};
        values.push_back(value);
        if (value->is_structured())
            for (Json& member : *value)
                pending.emplace_back(&member, depth + 1);
    }
    return values;
}

template <class Values>
const auto& oneOf(const Values& values, Random& random) {
    return values[random() % std::size(values)];
}

Json oddNumber(const Json& number, Random& random) {
    static const std::array<Json, 26> kNumbers = {
        0,   1,    2,     3,      4,       5,          6,           7,           -1,
        16,  17,   255,   65536,  1 << 24, 2147483647, 2147483648u, 4294967295u, 4294967296,
        0.5, -0.0, 1e308, 1e-310, 3e38,    1e18,       INT64_MIN,   UINT64_MAX};
    static const std::array<Json, 7> kComponents = {5120, 5121, 5122, 5123, 5124, 5125, 5126};
    if (number.is_number_integer() && random() % 3 == 0)
        return static_cast<int64_t>(number.get<uint64_t>() + (random() % 2 == 0 ? 1u : ~uint64_t{0}));
    return random() % 4 == 0 ? oneOf(kComponents, random) : oneOf(kNumbers, random);
}

// Repeats an element, or drops one.
void changeMembers(Json& value, Random& random) {
    if (value.empty())
        return;
    const auto chosen = std::next(value.begin(), static_cast<std::ptrdiff_t>(random() % value.size()));
    if (value.is_array() && random() % 2 == 0)
        value.push_back(Json(*chosen));
    else
        value.erase(chosen);
}

void changeValue(Json& root, Random& random) {
    const std::vector<Json*> values = valuesOf(root);
    if (values.empty())
        return;
    Json& value = *oneOf(values, random);
    if (random() % 6 == 0)
        value = Json(*oneOf(values, random)); // a copy: the other may hold this one
    else if (value.is_number())
        value = oddNumber(value, random);
    else if (value.is_structured())
        changeMembers(value, random);
    else if (value.is_boolean())
        value = !value.get<bool>();
    else
        value = Json(*oneOf(values, random));
}

void changeJson(std::string& text, size_t maxSize, Random& random) {
    Json root = Json::parse(text, nullptr, false);
    if (root.is_discarded() || random() % 5 == 0)
        return mutateBytes(text, maxSize);
    const size_t changes = 1 + random() % 3;
    for (size_t i = 0; i < changes; ++i)
        changeValue(root, random);
    text = root.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned int seed) {
    Random random(seed);
    if (random() % 16 == 0)
        return LLVMFuzzerMutate(data, size, maxSize);
    Parts parts = takeApart({reinterpret_cast<const char*>(data), size});
    if (parts.binary && random() % 3 == 0)
        mutateBytes(*parts.binary, maxSize - std::min(maxSize, parts.json.size()));
    else
        changeJson(parts.json, maxSize, random);
    const std::string changed = putTogether(std::move(parts));
    if (changed.size() > maxSize)
        return size; // as it was
    std::memcpy(data, changed.data(), changed.size());
    return changed.size();
}

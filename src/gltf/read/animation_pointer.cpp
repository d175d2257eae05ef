// Which members can be animated follows from the schema's rules: numbers and flags that are read at all
// (glTF 2.0 Asset Object Model).
#include "gltf/read/animation_pointer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gltf/check/schema_rules.h"
#include "gltf/read/animation.h"
#include "gltf/read/keyframes.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

// A pointer taken apart: "/materials/0/alphaCutoff" is the member alphaCutoff of materials[].
struct Target {
    Json::json_pointer object;
    std::string path; // of the object, as rules have it
    std::string member;
    std::optional<size_t> element; // of an array that is animated one by one
};

// An index as RFC 6901 has it, without leading zeros.
bool isNumber(const std::string& token) {
    return !token.empty() && token.size() < 10 && (token == "0" || token.front() != '0') &&
           token.find_first_not_of("0123456789") == std::string::npos;
}

// None for what is not a pointer to a member.
std::optional<Target> parsePointer(const std::string& text) {
    std::vector<std::string> tokens;
    Json::json_pointer whole;
    try {
        whole = Json::json_pointer(text);
    } catch (const Json::exception&) {
        return std::nullopt;
    }
    for (; !whole.empty(); whole.pop_back())
        tokens.push_back(whole.back());
    std::reverse(tokens.begin(), tokens.end());
    Target target;
    if (!tokens.empty() && tokens.size() > 2 && isNumber(tokens.back()) &&
        tokens[tokens.size() - 2] == "weights") {
        target.element = std::stoul(tokens.back());
        tokens.pop_back();
    }
    if (tokens.size() < 2)
        return std::nullopt;
    target.member = tokens.back();
    tokens.pop_back();
    for (const std::string& token : tokens) {
        target.object /= token;
        target.path += isNumber(token) ? "[]" : target.path.empty() ? token : "." + token;
    }
    return target;
}

bool isMutable(const std::string& path) {
    constexpr std::string_view kRoots[] = {"materials[]",
                                           "cameras[]",
                                           "nodes[]",
                                           "meshes[]",
                                           "extensions.KHR_lights_punctual.lights[]",
                                           "extensions.EXT_lights_image_based.lights[]"};
    return std::any_of(std::begin(kRoots), std::end(kRoots),
                       [&](std::string_view root) { return path.starts_with(root); });
}

// None where the member is not read, or is not for animations: matrices and doubleSided.
std::optional<KeyType> typeOf(const Target& target, const std::string& pointer) {
    static const std::vector<ObjectRule> rules = gltfSchemaRules();
    if (!isMutable(target.path) || target.member == "matrix" || target.member == "doubleSided")
        return std::nullopt;
    for (const ObjectRule& rule : rules) {
        if (rule.path != target.path)
            continue;
        for (const PropertyRule& property : rule.properties) {
            if (property.name != target.member ||
                (property.kind != Kind::number && property.kind != Kind::flag))
                continue;
            if (property.length == kAnyLength)
                return KeyType{.name = pointer, .isArray = !target.element};
            const bool isRotation = target.member == "rotation" && property.length == 4;
            return KeyType{pointer, std::max<size_t>(property.length, 1), false, isRotation};
        }
    }
    return std::nullopt;
}

bool isFlag(const Target& target) {
    return target.member == "visible";
}

Json valueOf(const Keyframes& keys, const KeyType& type, const Target& target, double seconds) {
    if (isFlag(target))
        return keys.at(seconds, 0).x != 0.0;
    std::vector<double> numbers;
    for (size_t lane = 0; lane < keys.lanes(); ++lane) {
        const glm::dvec4 value = keys.at(seconds, lane);
        for (size_t i = 0; i < type.components; ++i)
            numbers.push_back(value[static_cast<glm::length_t>(i)]);
    }
    const bool isScalar = type.components == 1 && !type.isArray;
    return isScalar ? Json(numbers.front()) : Json(numbers);
}

bool isFinite(const Json& value) {
    if (value.is_array())
        return std::all_of(value.begin(), value.end(), isFinite);
    return !value.is_number() || std::isfinite(value.get<double>());
}

// Where the value belongs; nullptr where the document has no such object or element.
Json* placeOf(Json& json, const Target& target) {
    if (!json.contains(target.object) || !json.at(target.object).is_object())
        return nullptr;
    Json& object = json.at(target.object);
    if (!target.element)
        return &object[target.member];
    if (!object.contains(target.member) || *target.element >= object[target.member].size())
        return nullptr;
    return &object[target.member][*target.element];
}

} // namespace

void applyAnimationPointers(GltfDocument& document, const ImportOptions& options, GltfNotes& notes) {
    if (!options.seconds)
        return;
    const AnimationChannels channels = findChannels(document, options.animation);
    KeyTimes times(document);
    for (const JsonView channel : channels.all.elements()) {
        if (channel["target"].text("path") != "pointer")
            continue;
        const std::string& pointer = channel["target"]["extensions"]["KHR_animation_pointer"].text("pointer");
        const std::optional<Target> target = parsePointer(pointer);
        const std::optional<KeyType> type = target ? typeOf(*target, pointer) : std::nullopt;
        Json* place = type ? placeOf(document.json, *target) : nullptr;
        if (place == nullptr) {
            notes.addObject("animated properties that are not read, or not there, were left as they are",
                            printable(pointer));
            continue;
        }
        const Keyframes keys(document, channels.samplerOf(document, channel), *type, times);
        Json value = valueOf(keys, *type, *target, *options.seconds);
        if (!isFinite(value))
            throw document.error(
                fmt::format("{} sets {} to a value that is not finite", channels.name, printable(pointer)));
        *place = std::move(value); // channels and accessors are elsewhere in the document
    }
}

} // namespace lavalight

// The checks of glTF's JSON: a walk along the rules of schema_rules.h.
#include "gltf/check/schema.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/os/memory.h"
#include "gltf/check/schema_rules.h"
#include "gltf/read/notes.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

// Real files stay below 20. The parsers and walkers behind this check recurse once per level.
constexpr size_t kDeepestNesting = 200;

// Bytes that a value takes in the parsed document: 17 for a number in an array, 109 for {"a":""}, measured
// with libstdc++. "[[],[],[]]" has a value in three bytes, each a list of its own.
constexpr uint64_t kBytesPerValue = 128;

// Before any of it is parsed.
void requireParsable(std::string_view text, const std::string& source) {
    size_t depth = 0;
    uint64_t values = 1;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            ++values;
            if (++depth > kDeepestNesting)
                throw gltfError(source,
                                fmt::format("the JSON is nested deeper than {} levels", kDeepestNesting));
        } else if (c == ',') {
            ++values;
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
    const std::string shortage = memoryShortage(values * kBytesPerValue + 3 * text.size());
    if (!shortage.empty())
        throw gltfError(source, fmt::format("the {} values of its JSON {}", values, shortage));
}

class SchemaCheck {
  public:
    SchemaCheck(Json& root, const std::string& source) : root_(root), source_(source) {}

    void run() {
        for (const ObjectRule& rule : gltfSchemaRules())
            walk(root_, rule.path, "", rule);
    }

  private:
    [[noreturn]] void fail(const std::string& where, std::string_view text) const {
        throw gltfError(source_, fmt::format("{} {}", where, text));
    }

    // Visits every object that `path` leads to from `json`.
    void walk(Json& json, std::string_view path, const std::string& where, const ObjectRule& rule) {
        if (!json.is_object())
            fail(where, "is not an object");
        if (path.empty()) {
            for (const PropertyRule& property : rule.properties)
                checkProperty(json, property, where);
            return;
        }
        const size_t dot = path.find('.');
        const std::string_view rest = dot == std::string_view::npos ? "" : path.substr(dot + 1);
        std::string_view name = path.substr(0, dot);
        const bool array = name.ends_with("[]");
        name = name.substr(0, name.size() - (array ? 2 : 0));
        const auto member = json.find(name);
        if (member == json.end())
            return;
        const std::string here = where.empty() ? std::string(name) : fmt::format("{}.{}", where, name);
        if (!array)
            return walk(*member, rest, here, rule);
        if (!member->is_array())
            fail(here, "is not an array");
        for (size_t i = 0; i < member->size(); ++i)
            walk((*member)[i], rest, fmt::format("{}[{}]", here, i), rule);
    }

    void checkProperty(Json& object, const PropertyRule& rule, const std::string& where) {
        if (rule.name == "*") {
            for (auto& [name, value] : object.items())
                checkValue(value, rule, fmt::format("{}.{}", where, name));
            return;
        }
        const auto value = object.find(rule.name);
        if (value != object.end())
            checkValue(*value, rule,
                       where.empty() ? std::string(rule.name) : fmt::format("{}.{}", where, rule.name));
        else if (rule.need == Need::required)
            fail(where.empty() ? "the file" : where, fmt::format("has no \"{}\"", rule.name));
    }

    void checkValue(Json& value, const PropertyRule& rule, const std::string& where) {
        if (rule.length == kNoArray)
            return checkElement(value, rule, where);
        if (!value.is_array())
            fail(where, "is not an array");
        if (rule.length != kAnyLength && value.size() != rule.length)
            fail(where, fmt::format("has {} elements instead of {}", value.size(), rule.length));
        for (size_t i = 0; i < value.size(); ++i)
            checkElement(value[i], rule, fmt::format("{}[{}]", where, i));
    }

    void checkElement(Json& value, const PropertyRule& rule, const std::string& where) {
        switch (rule.kind) {
        case Kind::object:
            return require(value.is_object(), where, "is not an object");
        case Kind::text:
            return require(value.is_string(), where, "is not a string");
        case Kind::flag:
            return require(value.is_boolean(), where, "is neither true nor false");
        case Kind::number:
            require(value.is_number(), where, "is not a number");
            value = value.get<double>();
            return;
        case Kind::count:
            checkInteger(value, where);
            return;
        case Kind::small:
            return require(checkInteger(value, where) <= std::numeric_limits<int>::max(), where,
                           "is too large");
        case Kind::index:
            return checkIndex(value, rule.target, where);
        case Kind::stride:
            return checkStride(checkInteger(value, where), where);
        case Kind::componentType:
            return checkComponentType(checkInteger(value, where), where);
        case Kind::elementType:
            return checkElementType(value, where);
        case Kind::mode:
            if (checkInteger(value, where) > 6)
                fail(where, fmt::format("is {}, but modes end at 6", value.dump()));
            return;
        }
    }

    void require(bool condition, const std::string& where, std::string_view text) const {
        if (!condition)
            fail(where, text);
    }

    uint64_t checkInteger(Json& value, const std::string& where) {
        // JSON has one kind of number: 3.0 is an integer too. 2^53 and more would not be exact.
        if (value.is_number_float() && value.get<double>() == std::floor(value.get<double>()) &&
            std::abs(value.get<double>()) < 9007199254740992.0)
            value = static_cast<int64_t>(value.get<double>());
        if (value.is_number_integer() && !value.is_number_unsigned() && value.get<int64_t>() >= 0)
            value = static_cast<uint64_t>(value.get<int64_t>());
        if (value.is_number() && !value.is_number_unsigned())
            fail(where, fmt::format("is {} instead of an integer from 0", value.dump()));
        require(value.is_number(), where, "is not an integer");
        return value.get<uint64_t>();
    }

    void checkIndex(Json& value, std::string_view target, const std::string& where) {
        const uint64_t index = checkInteger(value, where);
        const size_t size = sizeOf(target);
        if (index >= size)
            fail(where, fmt::format("is {}, but the file has {} {}", index, size,
                                    target.substr(target.rfind('.') + 1)));
    }

    // Elements of the array that `path` leads to from the root; 0 where there is none.
    [[nodiscard]] size_t sizeOf(std::string_view path) const {
        const Json* json = &root_;
        while (json->is_object()) {
            const size_t dot = path.find('.');
            const auto member = json->find(path.substr(0, dot));
            if (member == json->end())
                return 0;
            json = &*member;
            if (dot == std::string_view::npos)
                break;
            path.remove_prefix(dot + 1);
        }
        return json->is_array() ? json->size() : 0;
    }

    void checkStride(uint64_t stride, const std::string& where) const {
        if (stride < 4 || stride > 252 || stride % 4 != 0)
            fail(where, fmt::format("is {} instead of a multiple of 4 up to 252", stride));
    }

    void checkComponentType(uint64_t type, const std::string& where) const {
        if (type < 5120 || type > 5126 || type == 5124)
            fail(where, fmt::format("is {}, which glTF does not know", type));
    }

    void checkElementType(const Json& value, const std::string& where) const {
        require(value.is_string(), where, "is not a string");
        const auto& name = value.get_ref<const std::string&>();
        for (const char* known : {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}) {
            if (name == known)
                return;
        }
        fail(where, fmt::format("is \"{}\", which glTF does not know", name.substr(0, 16)));
    }

    Json& root_;
    const std::string& source_;
};

} // namespace

Json parseCheckedJson(std::string_view text, const std::string& source) {
    requireParsable(text, source);
    Json root;
    try {
        root = Json::parse(text);
    } catch (const Json::exception& error) {
        throw gltfError(source, fmt::format("its JSON is damaged: {}", error.what()));
    }
    SchemaCheck(root, source).run();
    return root;
}

} // namespace lavalight

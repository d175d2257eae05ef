#include "film/film_machines.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace lavalight {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSamples = "samples";

// Samples by kind; a kind is the values of kMachineKeys.
using Kinds = std::map<std::array<std::string, kMachineKeys.size()>, uint64_t>;

Kinds kindsIn(const Metadata& metadata, uint64_t samples) {
    Kinds kinds;
    const std::string several = valueOf(metadata, kMachines);
    if (several.empty()) {
        Kinds::key_type kind;
        for (size_t i = 0; i < kind.size(); ++i)
            kind[i] = valueOf(metadata, std::string(kMachineKeys[i]));
        return {{kind, samples}};
    }
    try {
        for (const Json& entry : Json::parse(several)) {
            Kinds::key_type kind;
            for (size_t i = 0; i < kind.size(); ++i)
                kind[i] = entry.at(kMachineKeys[i]).get<std::string>();
            kinds[kind] += entry.at(kSamples).get<uint64_t>();
        }
    } catch (const Json::exception&) {
        throw Error("its header does not say which machines took its samples");
    }
    return kinds;
}

std::string textOf(const Kinds& kinds) {
    Json list = Json::array();
    for (const auto& [kind, samples] : kinds) {
        Json entry = {{kSamples, samples}};
        for (size_t i = 0; i < kind.size(); ++i)
            entry[kMachineKeys[i]] = kind[i];
        list.push_back(std::move(entry));
    }
    return list.dump();
}

// The different values of one key, joined by "and".
std::string valuesOf(const Kinds& kinds, size_t key) {
    std::vector<std::string> values;
    for (const auto& [kind, samples] : kinds)
        if (std::find(values.begin(), values.end(), kind[key]) == values.end())
            values.push_back(kind[key]);
    std::string text;
    for (const std::string& value : values)
        text += (text.empty() ? "" : " and ") + value;
    return text;
}

} // namespace

void joinMachines(FilmFile& sum, const FilmFile& part) {
    Kinds kinds = kindsIn(sum.metadata, sum.film.samples());
    for (const auto& [kind, samples] : kindsIn(part.metadata, part.film.samples()))
        kinds[kind] += samples;
    if (kinds.size() < 2)
        return;
    setValue(sum.metadata, kMachines, textOf(kinds));
    for (size_t i = 0; i < kMachineKeys.size(); ++i)
        if (const std::string values = valuesOf(kinds, i); !values.empty())
            setValue(sum.metadata, std::string(kMachineKeys[i]), values);
}

std::vector<LedgerEntry> machineEntries(const Metadata& metadata) {
    const Kinds kinds = kindsIn(metadata, 0);
    if (kinds.size() < 2)
        return {};
    std::string detail;
    for (const auto& [kind, samples] : kinds) {
        detail += fmt::format("{}{} samples by", detail.empty() ? "" : ", ", samples);
        for (const std::string& value : kind)
            if (!value.empty())
                detail += fmt::format("{} {}", detail.ends_with("by") ? "" : ",", value);
    }
    return {{"mixed-machines", detail}};
}

} // namespace lavalight

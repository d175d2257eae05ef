// Wording and grouping of the import's errors and warnings.
#include "gltf/read/notes.h"

#include <algorithm>

#include <fmt/format.h>

namespace lavalight {
namespace {

constexpr size_t kLongestName = 64; // bytes; a line stays readable
constexpr size_t kNamedObjects = 8; // objects named in a group; the rest is counted

// The first `length` bytes at most, without cutting through a UTF-8 sequence: reports are written as JSON.
std::string shortened(std::string text, size_t length) {
    if (text.size() <= length)
        return text;
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80)
        --length;
    return text.substr(0, length) + "...";
}

} // namespace

std::string printable(std::string_view text) {
    std::string line(text);
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            c = ' ';
    }
    return line;
}

Error gltfError(std::string_view source, std::string_view text) {
    return Error(fmt::format("cannot read {}: {}", printable(source), printable(text)));
}

std::string describe(std::string_view kind, size_t index, std::string_view name) {
    if (name.empty())
        return fmt::format("{} {}", kind, index);
    return fmt::format("{} {} \"{}\"", kind, index, shortened(printable(name), kLongestName));
}

void GltfNotes::addObject(std::string_view finding, std::string_view object) {
    const auto [number, isNew] = numbers_.try_emplace(std::string(finding), groups_.size());
    if (isNew)
        groups_.emplace_back().finding = finding;
    auto& objects = groups_[number->second].objects;
    if (!object.empty() && (objects.empty() || objects.back() != object))
        objects.emplace_back(object);
}

std::vector<std::string> GltfNotes::lines() const {
    std::vector<std::string> lines;
    for (const Group& group : groups_) {
        std::string line = group.finding;
        const size_t named = std::min(group.objects.size(), kNamedObjects);
        for (size_t i = 0; i < named; ++i)
            line += (i == 0 ? ": " : ", ") + group.objects[i];
        if (named < group.objects.size())
            line += fmt::format(" and {} more", group.objects.size() - named);
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace lavalight

// What the import has to say: errors with the file's name, and warnings collected into few lines.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/error.h"

namespace lavalight {

// "cannot read SOURCE: TEXT", on one line whatever the file put into the text.
[[nodiscard]] Error gltfError(std::string_view source, std::string_view text);

// `text` without control characters: names and addresses in files may hold anything.
[[nodiscard]] std::string printable(std::string_view text);

// How messages name an object: `mesh 3 "Wheel"`, or `mesh 3` where it has no name. Long names are cut.
[[nodiscard]] std::string describe(std::string_view kind, size_t index, std::string_view name);

// The warnings of one import, in the order of their first mention.
class GltfNotes {
  public:
    // One line of its own; the same line twice is one line.
    void add(std::string_view line) { addObject(line, {}); }

    // One line per finding, however many objects it holds for: "FINDING: mesh 1, mesh 7 and 40 more".
    void addObject(std::string_view finding, std::string_view object);

    [[nodiscard]] std::vector<std::string> lines() const;

  private:
    struct Group {
        std::string finding;
        std::vector<std::string> objects;
    };
    std::vector<Group> groups_;
    std::unordered_map<std::string, size_t>
        numbers_; // numbers of the groups, by finding: files may bring thousands
};

} // namespace lavalight

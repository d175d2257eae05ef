// URIs of glTF files: which are followed, and to what.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lavalight {

// Where a file's own words come from and what it may reach.
struct GltfSource {
    std::string name;                            // for messages
    std::optional<std::filesystem::path> folder; // the scene's folder; none: embedded, no file may be read
    bool allowsExternal = false;                 // files outside the folder may be read
};

// Whether the URI holds its bytes itself (RFC 2397).
[[nodiscard]] bool isDataUri(std::string_view uri);

// The bytes of a data URI, or of the regular file that a relative URI means. A file from somewhere else must
// not make this program read the user's other files: one that lies outside the scene's folder, wherever links
// lead, is refused unless allowed. Addresses with a scheme or a host are always refused, file: among them; a
// URI is split into its parts before it is decoded. Backslashes are slashes, as some exporters on Windows
// write them. Throws Error, which names neither the scene nor the URI.
[[nodiscard]] std::string loadUri(std::string_view uri, const GltfSource& source);

// The paths from the scene's folder that a URI may spell: as RFC 3986 has it, decoded up to a query or
// fragment; decoded as a whole, and as it stands, since exporters leave names unencoded. None where it is no
// file's name.
[[nodiscard]] std::vector<std::filesystem::path> filesNamedBy(std::string_view uri);

} // namespace lavalight

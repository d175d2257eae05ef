// What may be read, and where it is: RFC 3986's URIs, as far as glTF uses them (specification, section 2.8).
#include "gltf/file/uri.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <vector>

#include <tiny_gltf.h>

#include "base/error.h"
#include "base/file.h"

namespace lavalight {
namespace {

constexpr std::string_view kBase64 = ";base64";

std::string percentDecoded(std::string_view uri) {
    const auto isHex = [&](size_t i) {
        return i < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i]));
    };
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && isHex(i + 1) && isHex(i + 2)) {
            text += static_cast<char>(std::stoi(std::string(uri.substr(i + 1, 2)), nullptr, 16));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

std::string decodeDataUri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        throw Error("its data URI has no data");
    if (!uri.substr(0, comma).ends_with(kBase64))
        return percentDecoded(uri.substr(comma + 1));
    // tinygltf decodes only the media types that it knows; for bytes the type makes no difference.
    const std::string known =
        std::string("data:application/octet-stream;base64,").append(uri.substr(comma + 1));
    std::vector<unsigned char> bytes;
    std::string mediaType;
    if (!tinygltf::DecodeDataURI(&bytes, mediaType, known, 0, false))
        throw Error("its data URI cannot be decoded");
    return {bytes.begin(), bytes.end()};
}

bool hasScheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon > 0 && std::isalpha(static_cast<unsigned char>(uri[0])) &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                       [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

// Whether `file` is `folder` or lies somewhere below it; both canonical.
bool isInside(const std::filesystem::path& file, const std::filesystem::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// The relative path that the URI spells.
std::filesystem::path pathOf(std::string_view uri) {
    std::string name = percentDecoded(uri);
    if (name.empty() || name.find('\0') != std::string::npos)
        throw Error("that is not a file name");
    std::replace(name.begin(), name.end(), '\\', '/');
    if (name.starts_with("//") || hasScheme(name))
        throw Error("only files are read, by paths from the scene's folder, no other addresses");
    return name;
}

// Links are followed before the folder is compared.
std::filesystem::path fileOf(std::string_view uri, const GltfSource& source) {
    if (!source.folder)
        throw Error("an embedded scene cannot refer to files");
    const std::filesystem::path path = pathOf(uri);
    std::error_code code;
    const auto folder = std::filesystem::canonical(source.folder->empty() ? "." : *source.folder, code);
    const auto file = std::filesystem::weakly_canonical(folder / path, code);
    if (code)
        throw Error(code.message());
    if (!isInside(file, folder) && !source.allowsExternal)
        throw Error("it lies outside the scene's folder; --allow-external lets it be read");
    return file;
}

} // namespace

std::string loadUri(std::string_view uri, const GltfSource& source) {
    return uri.starts_with("data:") ? decodeDataUri(uri) : readFile(fileOf(uri, source));
}

std::vector<std::filesystem::path> filesNamedBy(std::string_view uri) {
    std::vector<std::filesystem::path> files;
    for (std::string name :
         {std::string(uri), percentDecoded(uri), percentDecoded(uri.substr(0, uri.find_first_of("?#")))}) {
        if (name.empty() || name.find('\0') != std::string::npos)
            continue;
        std::replace(name.begin(), name.end(), '\\', '/');
        files.emplace_back(name);
    }
    return files;
}

} // namespace lavalight

// What may be read, and where it is: RFC 3986's URIs, as far as glTF uses them (specification, section 2.8).
#include "gltf/file/uri.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "base/error.h"
#include "base/file.h"

namespace lavalight {
namespace {

constexpr std::string_view kData = "data:";
constexpr std::string_view kBase64 = ";base64";

// Schemes and the mark of base64 are written in either case.
bool startsWithInAnyCase(std::string_view text, std::string_view lowerCase) {
    return text.size() >= lowerCase.size() &&
           std::equal(lowerCase.begin(), lowerCase.end(), text.begin(),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

// The byte that a percent sign at `i` and two digits behind it stand for, if they do.
std::optional<char> encodedByte(std::string_view uri, size_t i) {
    const auto isHex = [&](size_t at) {
        return at < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[at]));
    };
    if (uri[i] != '%' || !isHex(i + 1) || !isHex(i + 2))
        return std::nullopt;
    return static_cast<char>(std::stoi(std::string(uri.substr(i + 1, 2)), nullptr, 16));
}

template <class Take>
void forEachDecodedByte(std::string_view uri, const Take& take) {
    for (size_t i = 0; i < uri.size(); ++i) {
        const std::optional<char> byte = encodedByte(uri, i);
        take(byte.value_or(uri[i]));
        i += byte ? 2 : 0;
    }
}

std::string percentDecoded(std::string_view uri) {
    std::string text;
    forEachDecodedByte(uri, [&](char c) { text += c; });
    return text;
}

// Appends the digits of base64 that are in the data of a URI, in the alphabet of RFC 4648's section 4. Line
// breaks, the alphabet for URLs and missing padding are common.
void appendBase64(std::string_view data, std::string& digits) {
    bool hasEnded = false;
    forEachDecodedByte(data, [&](char c) {
        const auto byte = static_cast<unsigned char>(c);
        const char digit = c == '-' ? '+' : c == '_' ? '/' : c;
        if (std::isspace(byte) != 0)
            return;
        const bool isDigit = byte < 0x80 && (std::isalnum(byte) != 0 || digit == '+' || digit == '/');
        if (!isDigit && c != '=')
            throw Error(fmt::format("its data URI is not base64: it has the byte 0x{:02X} in it", byte));
        if (isDigit && hasEnded)
            throw Error("its data URI is not base64: it goes on behind its padding");
        hasEnded = !isDigit;
        if (isDigit)
            digits += digit;
    });
}

std::string decodeBase64(std::string_view data) {
    // tinygltf decodes only the media types that it knows; for bytes the type makes no difference.
    std::string known = "data:application/octet-stream;base64,";
    const size_t head = known.size();
    known.reserve(head + data.size());
    appendBase64(data, known);
    const size_t digits = known.size() - head;
    if (digits == 0)
        return {};
    if (digits % 4 == 1)
        throw Error("its data URI is cut off: base64 never has one digit left over");
    std::vector<unsigned char> bytes;
    std::string mediaType;
    if (!tinygltf::DecodeDataURI(&bytes, mediaType, known, 0, false))
        throw Error("its data URI cannot be decoded");
    return {bytes.begin(), bytes.end()};
}

// RFC 2397. A fragment is no part of the data.
std::string decodeDataUri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        throw Error("its data URI has no data");
    std::string_view type = uri.substr(0, comma);
    while (type.ends_with(' '))
        type.remove_suffix(1);
    const std::string_view rest = uri.substr(comma + 1);
    const std::string_view data = rest.substr(0, rest.find('#'));
    const bool isBase64 = type.size() >= kBase64.size() &&
                          startsWithInAnyCase(type.substr(type.size() - kBase64.size()), kBase64);
    return isBase64 ? decodeBase64(data) : percentDecoded(data);
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

// What is percent-encoded is part of a name, whatever it decodes to (RFC 3986, section 2.4).
void requireNoAddress(std::string_view uri) {
    const auto isSlash = [&](size_t i) { return i < uri.size() && (uri[i] == '/' || uri[i] == '\\'); };
    if ((isSlash(0) && isSlash(1)) || hasScheme(uri))
        throw Error("only files are read, by paths from the scene's folder, no other addresses; write a "
                    "colon of a file's name as %3A");
}

// The first of the paths that the URI may spell that is a file, or else the one that it should spell.
std::filesystem::path pathOf(std::string_view uri, const std::filesystem::path& folder) {
    const std::vector<std::filesystem::path> names = filesNamedBy(uri);
    if (names.empty())
        throw Error("that is not a file name");
    requireNoAddress(uri);
    const auto isFile = [&](const std::filesystem::path& name) {
        std::error_code code;
        return std::filesystem::is_regular_file(folder / name, code);
    };
    const auto found = std::find_if(names.begin(), names.end(), isFile);
    return found == names.end() ? names.front() : *found;
}

// Links are followed before the folder is compared.
std::filesystem::path fileOf(std::string_view uri, const GltfSource& source) {
    if (!source.folder)
        throw Error("an embedded scene cannot refer to files");
    std::error_code code;
    const auto folder = std::filesystem::canonical(source.folder->empty() ? "." : *source.folder, code);
    auto file = std::filesystem::weakly_canonical(folder / pathOf(uri, folder), code);
    if (code)
        throw Error(code.message());
    if (!isInside(file, folder) && !source.allowsExternal)
        throw Error("it lies outside the scene's folder; --allow-external lets it be read");
    return file;
}

} // namespace

bool isDataUri(std::string_view uri) {
    return startsWithInAnyCase(uri, kData);
}

std::string loadUri(std::string_view uri, const GltfSource& source) {
    return isDataUri(uri) ? decodeDataUri(uri) : readFile(fileOf(uri, source));
}

std::vector<std::filesystem::path> filesNamedBy(std::string_view uri) {
    std::vector<std::filesystem::path> files;
    if (percentDecoded(uri).find('\0') != std::string::npos)
        return files;
    for (std::string name :
         {percentDecoded(uri.substr(0, uri.find_first_of("?#"))), percentDecoded(uri), std::string(uri)}) {
        std::replace(name.begin(), name.end(), '\\', '/');
        if (!name.empty())
            files.emplace_back(name);
    }
    return files;
}

} // namespace lavalight

// The files that a glTF file refers to, found without loading any of them.
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "gltf/file/container.h"
#include "gltf/file/uri.h"
#include "gltf/import.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

// Keeps the value of every member "uri", wherever it stands. Trees of JSON would take memory, and files may
// nest them deeper than the stack.
class UriCollector : public nlohmann::json_sax<Json> {
  public:
    [[nodiscard]] std::vector<std::string> take() { return std::move(uris_); }

    bool key(string_t& name) override {
        isUri_ = name == "uri";
        return true;
    }
    bool string(string_t& value) override {
        if (isUri_ && !isDataUri(value))
            uris_.push_back(value);
        return other();
    }
    bool null() override { return other(); }
    bool boolean(bool) override { return other(); }
    bool number_integer(number_integer_t) override { return other(); }
    bool number_unsigned(number_unsigned_t) override { return other(); }
    bool number_float(number_float_t, const string_t&) override { return other(); }
    bool binary(binary_t&) override { return other(); }
    bool start_object(std::size_t) override { return other(); }
    bool end_object() override { return other(); }
    bool start_array(std::size_t) override { return other(); }
    bool end_array() override { return other(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        return false;
    }

  private:
    bool other() {
        isUri_ = false;
        return true;
    }

    bool isUri_ = false;
    std::vector<std::string> uris_;
};

} // namespace

std::vector<std::filesystem::path> referencedFiles(const std::filesystem::path& gltf) {
    std::vector<std::filesystem::path> files;
    try {
        const std::string bytes = readFile(gltf);
        UriCollector collector;
        (void)Json::sax_parse(splitContainer(bytes, gltf.string()).json, &collector);
        for (const std::string& uri : collector.take())
            for (const std::filesystem::path& file : filesNamedBy(uri))
                files.push_back(gltf.parent_path() / file);
    } catch (const Error&) {
        files.clear();
    }
    return files;
}

} // namespace lavalight

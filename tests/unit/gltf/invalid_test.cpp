// Runs the import and the readers of images over the malformed files of nine projects that LAVALIGHT_ASSETS
// holds.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "gltf/import.h"
#include "image/environment_file.h"
#include "image/picture.h"
#include "support/sound_scene.h"

namespace lavalight::test {
namespace {

namespace fs = std::filesystem;

class InvalidFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("LAVALIGHT_ASSETS");
        if (folder == nullptr)
            GTEST_SKIP() << "LAVALIGHT_ASSETS is not set: no malformed files";
        folder_ = fs::path(folder) / "invalid";
        if (!fs::exists(folder_))
            GTEST_SKIP() << folder_ << " is not there";
    }

    [[nodiscard]] std::vector<fs::path> filesOf(const std::vector<std::string>& extensions) const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            if (std::find(extensions.begin(), extensions.end(), entry.path().extension()) != extensions.end())
                files.push_back(entry.path());
        return files;
    }

    fs::path folder_;
};

// "load", or the message; sound scenes and messages of one line alone are expected.
template <class Read>
std::string resultOf(const fs::path& path, const Read& read) {
    try {
        read(path);
        return "load";
    } catch (const Error& error) {
        std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << path << ": " << message;
        return message;
    }
}

std::string importResult(const fs::path& path, const ImportOptions& options = {}) {
    return resultOf(path, [&](const fs::path& file) {
        const Scene scene = importGltf(file, options);
        EXPECT_EQ(unsoundPart(scene), "") << file;
        for (size_t i = 0; i < scene.animations.size() && !options.seconds; ++i)
            static_cast<void>(importResult(file, {.seconds = 0.5, .animation = std::to_string(i)}));
    });
}

TEST_F(InvalidFiles, EveryFileIsRefusedInOneLineOrItsSceneIsSound) {
    int refused = 0;
    int loaded = 0;
    for (const fs::path& path : filesOf({".gltf", ".glb", ".obj", ".ply", ".json"}))
        (importResult(path) == "load" ? loaded : refused) += 1;
    EXPECT_GT(refused, 250);
    EXPECT_GT(loaded, 300);
}

// Files in which Khronos' validator finds no error. Where one is refused, the message must name an
// unsupported feature or data that is not there.
TEST_F(InvalidFiles, FilesThatTheValidatorCallsValidLoadOrNameWhatIsMissing) {
    const std::array<std::string, 3> reasons = {"it requires the extension",
                                                "is needed but has neither a uri nor a BIN chunk",
                                                "it needs a reader of glTF 2.1"};
    const std::map<std::string, std::string> exceptions = {
        {"generated/acc_zero_fill_huge.gltf", "at most 16777216 are supported"},
        {"generated/draco_corrupt/Box.gltf", "cannot be decoded"}, // which the validator does not try
        // Unused there; "type" may be any text by the schema's letter, but no size follows from it.
        {"khronos-validator/base/data/accessor/unknown_type.gltf", "\"NotaVEC3\", which glTF does not know"}};
    std::ifstream table(folder_ / "VALIDATOR.tsv");
    int valid = 0;
    for (std::string line; std::getline(table, line);) {
        std::istringstream columns(line);
        std::string name;
        std::string errors;
        std::getline(columns, name, '\t');
        std::getline(columns, errors, '\t');
        if (errors != "0")
            continue;
        ++valid;
        const std::string result = importResult(folder_ / name);
        const auto exception = exceptions.find(name);
        const auto names = [&](const std::string& reason) {
            return result.find(reason) != std::string::npos;
        };
        EXPECT_TRUE(result == "load" || std::any_of(reasons.begin(), reasons.end(), names) ||
                    (exception != exceptions.end() && names(exception->second)))
            << result;
    }
    EXPECT_GT(valid, 150);
}

TEST_F(InvalidFiles, ImagesAreRefusedInOneLineOrRead) {
    int images = 0;
    for (const fs::path& path : filesOf({".png", ".jpg", ".jpeg", ".webp", ".hdr", ".exr"})) {
        static_cast<void>(
            resultOf(path, [](const fs::path& file) { static_cast<void>(decodePicture(readFile(file))); }));
        static_cast<void>(
            resultOf(path, [](const fs::path& file) { static_cast<void>(readEnvironmentFile(file)); }));
        ++images;
    }
    EXPECT_GT(images, 25);
}

} // namespace
} // namespace lavalight::test

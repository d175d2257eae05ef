// Tests of EXR headers whose two readers would see different attributes: the second must not see them.
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/exr_header_check.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

class ExrHeader : public testing::Test {
  protected:
    void SetUp() override {
        Rendering rendering{Image(2, 2), Image(2, 2), {1, 1, 1, 1}};
        writeExr(folder_ / "good.exr", rendering, {{"seed", "7"}});
        bytes_ = readFile(folder_ / "good.exr");
    }

    // The good file with `more` bytes in the size of the attribute whose name, type and lowest byte of the
    // size are these.
    [[nodiscard]] std::string resized(std::string_view attribute, int more) const {
        std::string bytes = bytes_;
        const size_t at = bytes.find(attribute);
        EXPECT_NE(at, std::string::npos);
        char& size = bytes[at + attribute.size()];
        size = static_cast<char>(size + more);
        return bytes;
    }

    void expectRefusal(const std::string& bytes, const std::string& text) const {
        writeFileAtomically(folder_ / "bad.exr", bytes);
        try {
            requireSaneAttributes(folder_ / "bad.exr");
            ADD_FAILURE() << "was let through: " << text;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
        }
        EXPECT_THROW((void)readExr(folder_ / "bad.exr"), Error);
    }

    const TemporaryFolder folder_;
    std::string bytes_;
};

TEST_F(ExrHeader, GoodFilesPass) {
    EXPECT_NO_THROW(requireSaneAttributes(folder_ / "good.exr"));
    EXPECT_EQ(readExr(folder_ / "good.exr").radiance().width, 2u);
}

// Found by fuzzing: the C reader took the list's last byte for the end of the header, the C++ reader went on
// to a claim of 2 GB.
TEST_F(ExrHeader, ListOfChannelsThatEndsElsewhereIsRefused) {
    expectRefusal(resized(std::string_view("channels\0chlist\0", 16), -1),
                  "its attribute channels of type chlist has");
    expectRefusal(resized(std::string_view("channels\0chlist\0", 16), 1),
                  "its attribute channels of type chlist has");
}

TEST_F(ExrHeader, ValuesOfAnotherSizeThanTheirTypesAreRefused) {
    expectRefusal(resized(std::string_view("compression\0compression\0", 24), 1),
                  "its attribute compression of type compression has 2 bytes, by its value 1");
    expectRefusal(resized(std::string_view("dataWindow\0box2i\0", 17), -4), "has 12 bytes, by its value 16");
    expectRefusal(resized(std::string_view("pixelAspectRatio\0float\0", 23), 8),
                  "has 12 bytes, by its value 4");
}

TEST_F(ExrHeader, ClaimsBeyondTheFileAreRefused) {
    std::string bytes = bytes_;
    const std::string attribute("lavalight:seed\0string\0", 22);
    const size_t at = bytes.find(attribute) + attribute.size();
    bytes.replace(at, 4, "\xFF\xFF\xFF\x7F");
    expectRefusal(bytes, "its attribute lavalight:seed claims 2147483647 bytes, the file has");
    expectRefusal(bytes_.substr(0, at), "it ends within its header");
}

// The sizes of the parts come to another sum than the attribute's size.
TEST_F(ExrHeader, PartsOfPreviewsAndListsOfTextsAreCounted) {
    const auto insert = [&](const std::string& attribute) {
        std::string bytes = bytes_;
        return bytes.insert(8, attribute); // the first of the header
    };
    const std::string list("list\0stringvector\0", 18);
    expectRefusal(insert(list + std::string("\x08\0\0\0\xF0\xFF\xFF\x7Fword", 12)),
                  "it ends within its header");
    expectRefusal(insert(list + std::string("\x07\0\0\0\x04\0\0\0word", 12)), "has 7 bytes, by its value 8");
    const std::string preview("preview\0preview\0", 16);
    expectRefusal(insert(preview + std::string("\x0C\0\0\0\0\0\1\0\0\0\1\0rgba", 16)),
                  "it ends within its header");
    expectRefusal(insert(preview + std::string("\x0B\0\0\0\1\0\0\0\1\0\0\0rgba", 16)),
                  "has 11 bytes, by its value 12");
}

} // namespace
} // namespace lavalight::test

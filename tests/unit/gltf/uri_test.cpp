// Tests of what a glTF file may refer to: data URIs, files in its folder, and, where that is allowed,
// elsewhere.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "gltf/file/uri.h"
#include "support/temporary_folder.h"
#include "unit/gltf/errors.h"

namespace lavalight::test {
namespace {

class GltfFiles : public ::testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& bytes) {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }

    // A .gltf whose positions lie in the buffer `uri`.
    std::filesystem::path writeGltf(const std::string& name, const std::string& uri, size_t byteLength = 36) {
        Json json = {
            {"asset", {{"version", "2.0"}}},
            {"buffers", {{{"byteLength", byteLength}, {"uri", uri}}}},
            {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
            {"accessors", {{{"bufferView", 0}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}}}},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
            {"nodes", {{{"mesh", 0}}}}};
        return write(name, json.dump());
    }

    [[nodiscard]] static std::string triangleBytes() {
        const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        return {reinterpret_cast<const char*>(corners.data()), 36};
    }

    // Refused unless allowed, with the remedy and the address.
    void expectExternal(const std::string& uri) {
        const auto path = writeGltf("scene/external.gltf", uri);
        expectError(fileError(path), "external.gltf", "--allow-external");
        expectError(fileError(path), "external.gltf", "buffer 0 \"" + uri + "\"");
        EXPECT_EQ(fileError(path, {.allowsExternal = true}), "") << uri;
    }

    void expectForbidden(const std::string& uri, const std::string& text) {
        const auto path = writeGltf("scene/forbidden.gltf", uri);
        expectError(fileError(path), "forbidden.gltf", text);
        expectError(fileError(path, {.allowsExternal = true}), "forbidden.gltf", text);
    }

    TemporaryFolder folder_;
};

TEST_F(GltfFiles, BuffersBesideTheSceneAndInFoldersBelowAreRead) {
    write("a b.bin", triangleBytes());
    write("sub/c.bin", triangleBytes() + "padding");
    EXPECT_EQ(importGltf(writeGltf("one.gltf", "a%20b.bin")).triangleCount(), 1u);
    EXPECT_EQ(importGltf(writeGltf("two.gltf", "sub/../sub/c.bin")).triangleCount(), 1u);
}

TEST_F(GltfFiles, DataUrisAreRead) {
    const std::string data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    for (const char* type : {"application/octet-stream", "application/gltf-buffer", ""}) {
        const auto path = writeGltf("data.gltf", "data:" + std::string(type) + ";base64," + data);
        EXPECT_EQ(importGltf(path).triangleCount(), 1u) << type;
    }
    expectError(fileError(writeGltf("short.gltf", "data:;base64," + data, 100)), "short.gltf",
                "buffer 0 holds 36 bytes, its byteLength is 100");
}

// RFC 2397 and RFC 4648; schemes are written in either case (RFC 3986, section 3.1).
TEST_F(GltfFiles, DataUrisAreReadHoweverTheyAreWritten) {
    const std::string data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    const auto every = [&](size_t step, const std::string& between) {
        std::string text;
        for (size_t i = 0; i < data.size(); i += step)
            text += data.substr(i, step) + between;
        return text;
    };
    std::string encoded;
    for (const char c : data)
        encoded += c == 'A' ? "%41" : std::string(1, c);
    std::string raw;
    for (const char c : triangleBytes())
        raw += c == 0 ? "%00" : c == '?' ? "%3f" : c == '\x80' ? "%80" : "";
    for (const std::string& uri :
         {"DATA:;base64," + data, "Data:application/octet-stream;BASE64," + data,
          "data:application/octet-stream;charset=utf-8;Base64 ," + data, "data:;base64," + every(16, "\n"),
          "data:;base64," + every(8, "\r\n\t "), "data:;base64," + every(12, "%0D%0A"),
          "data:;base64," + encoded, "data:;base64," + data + "#fragment", "data:," + raw,
          "data:application/octet-stream," + raw})
        EXPECT_EQ(fileError(writeGltf("data.gltf", uri)), "") << uri;
}

TEST_F(GltfFiles, DigitsOfBase64MeanTheSameEncodedForUrlsAndWithoutPadding) {
    for (const char* digits : {"+/8=", "-_8=", "%2B%2f8%3D", "+/8", "%2b%2F8", "+ /8%20="}) {
        const std::string uri = std::string("data:;base64,") + digits;
        EXPECT_EQ(loadUri(uri, {"test", std::nullopt, false}), "\xfb\xff") << digits;
    }
    EXPECT_EQ(loadUri("data:;base64,", {"test", std::nullopt, false}), "");
}

TEST_F(GltfFiles, DataUrisThatAreNoBase64SayWhy) {
    const std::vector<std::pair<const char*, const char*>> bad = {
        {"data:;base64,AAAA!AAA", "not base64: it has the byte 0x21"},
        {"data:;base64,AA%FFAA", "not base64: it has the byte 0xFF"},
        {"data:;base64,AA==AAAA", "goes on behind its padding"},
        {"data:;base64,AAAAA", "cut off"},
        {"data:;base64", "has no data"}};
    for (const auto& [uri, text] : bad)
        expectError(fileError(writeGltf("bad.gltf", uri)), "bad.gltf", text);
}

// RFC 3986, section 2.4: parts first, then their percent signs.
TEST_F(GltfFiles, NamesAreDecodedAfterTheUriIsTakenApart) {
    const std::vector<std::pair<const char*, const char*>> files = {
        {"ns:base.bin", "ns%3Abase.bin"},
        {"ns:low.bin", "ns%3alow.bin"},
        {"C:x.bin", "C%3Ax.bin"},
        {"a#b.bin", "a%23b.bin"},
        {"what?.bin", "what%3F.bin"},
        {"100%.bin", "100%25.bin"},
        {"a%20b.bin", "a%2520b.bin"},
        {"sub/d.bin", "sub%2Fd.bin"},
        {"sub/e.bin", "sub%5ce.bin"},
        {"sub/ns:f.bin", "sub/ns:f.bin"},
        {"ns:g.bin", "./ns:g.bin"},
        {"h.bin", "h.bin?version=2#top"},
        {"\xC3\xBC.bin", "%c3%BC.bin"},
        {"sub/i.bin", "sub/./../sub/i.bin"},
        // Exporters that encode nothing.
        {"a b#c.bin", "a b#c.bin"},
        {"who?.bin", "who?.bin"},
        {"50%.bin", "50%.bin"},
        {"b%20c.bin", "b%20c.bin"},
    };
    for (const auto& [name, uri] : files) {
        const auto file = write(name, triangleBytes());
        EXPECT_EQ(fileError(writeGltf("names.gltf", uri)), "") << uri;
        std::filesystem::remove(file);
        expectError(fileError(writeGltf("names.gltf", uri)), "names.gltf", "no such file");
    }
    write("both", triangleBytes());
    write("both?x", "short");
    EXPECT_EQ(fileError(writeGltf("names.gltf", "both?x")), "");
    write("ns:raw.bin", triangleBytes());
    expectForbidden("ns:raw.bin", "write a colon of a file's name as %3A");
}

TEST_F(GltfFiles, ContentDecidesNotTheExtension) {
    const std::string bytes = goodFile().glb();
    EXPECT_EQ(importGltf(write("really.gltf", bytes)).triangleCount(), 1u);
    write("x.bin", triangleBytes());
    EXPECT_EQ(importGltf(writeGltf("really.glb", "x.bin")).triangleCount(), 1u);
    expectError(fileError(write("text.glb", "no scene")), "text.glb", "neither");
}

TEST_F(GltfFiles, MissingFileFolderAndEmptyFileAreNamed) {
    expectError(fileError(folder_ / "none.gltf"), "none.gltf", "no such file");
    expectError(fileError(folder_.path()), folder_.path().string(), "directory");
    expectError(fileError(write("empty.gltf", "")), "empty.gltf", "empty");
}

TEST_F(GltfFiles, MissingShortAndUnreadableBuffersAreNamed) {
    write("short.bin", "1234");
    std::filesystem::create_directory(folder_ / "folder.bin");
    expectError(fileError(writeGltf("a.gltf", "gone.bin")), "a.gltf", "gone.bin: no such file");
    expectError(fileError(writeGltf("b.gltf", "short.bin")), "b.gltf",
                "buffer 0 \"short.bin\" holds 4 bytes, its byteLength is 36");
    expectError(fileError(writeGltf("c.gltf", "folder.bin")), "c.gltf", "directory");
    expectError(fileError(writeGltf("d.gltf", "")), "d.gltf", "not a file name");
}

TEST_F(GltfFiles, BytesInMemoryCannotReferToFiles) {
    GltfBuilder builder = goodFile();
    builder.json["buffers"] = {{{"byteLength", builder.bytes.size()}, {"uri", "x.bin"}}};
    expectError(builder, "cannot refer to files");
}

TEST_F(GltfFiles, BackslashesAreSlashes) {
    write("sub/c.bin", triangleBytes());
    EXPECT_EQ(importGltf(writeGltf("one.gltf", "sub\\c.bin")).triangleCount(), 1u);
    EXPECT_EQ(importGltf(writeGltf("two.gltf", ".\\sub\\..%5Csub/c.bin")).triangleCount(), 1u);
}

TEST_F(GltfFiles, FilesOutsideTheScenesFolderAreReadOnlyWhereThatIsAllowed) {
    write("secret.bin", triangleBytes());
    std::filesystem::create_directory(folder_ / "scene");
    std::filesystem::create_symlink(folder_ / "secret.bin", folder_ / "scene/link.bin");
    std::filesystem::create_directory_symlink(folder_.path(), folder_ / "scene/up");
    for (const char* uri : {"../secret.bin", "..\\secret.bin", "%2e%2e/secret.bin", "..%2Fsecret.bin",
                            "sub/../../secret.bin", "link.bin", "up/secret.bin"})
        expectExternal(uri);
    expectExternal((folder_ / "secret.bin").string());
}

TEST_F(GltfFiles, FolderOfTheSameBeginningIsOutside) {
    write("scene-of-others/secret.bin", triangleBytes());
    expectExternal("../scene-of-others/secret.bin");
}

TEST_F(GltfFiles, OtherAddressesAreNeverFollowed) {
    const std::string file = write("scene/x.bin", triangleBytes()).string();
    for (const std::string& uri :
         {"file://" + file, "FILE:" + file, std::string("http://host/x.bin"),
          std::string("https://host/x.bin"), std::string("//host/x.bin"), std::string("\\\\host\\x.bin"),
          std::string("C:\\x.bin"), "/" + file, std::string("Data2:x"), std::string("s3+a.b-c:x.bin")})
        expectForbidden(uri, "no other addresses");
    expectForbidden("%66ile:" + file, "no such file"); // a folder of that name
    expectForbidden("%2F%2Fhost/x.bin", "");
    expectForbidden("/dev/zero", "");
    expectForbidden(std::string("x.bin\0", 6), "not a file name");
    expectForbidden("x.bin%00", "not a file name");
}

TEST_F(GltfFiles, LinksThatRunInACircleAreAnError) {
    std::filesystem::create_directory(folder_ / "scene");
    std::filesystem::create_symlink("b.bin", folder_ / "scene/a.bin");
    std::filesystem::create_symlink("a.bin", folder_ / "scene/b.bin");
    expectForbidden("a.bin", "symbolic links");
}

TEST_F(GltfFiles, PicturesFollowTheSameRulesButLeaveTheSceneToBeShown) {
    GltfBuilder builder = goodFile();
    const std::string png = "\x89PNG\r\n\x1A\n"; // found to be damaged once it may be read
    write("secret.png", png);
    builder.json["images"] = {{{"uri", "../secret.png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}, {"emissiveFactor", {1, 1, 1}}}};
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    const auto path = write("scene/a.glb", builder.glb());
    const Scene refused = importGltf(path);
    EXPECT_EQ(refused.triangleCount(), 1u);
    EXPECT_EQ(warningsWith(refused, "image 0 \"../secret.png\" cannot be read"), 1);
    EXPECT_EQ(warningsWith(refused, "--allow-external"), 1);
    EXPECT_EQ(warningsWith(importGltf(path, {.allowsExternal = true}), "damaged"), 1);
}

} // namespace
} // namespace lavalight::test

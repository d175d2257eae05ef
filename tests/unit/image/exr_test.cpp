// What is written comes back bit for bit; what others wrote is read or refused with one line.
#include "image/exr.h"

#include <array>
#include <string>

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "support/exr_files.h"
#include "support/full_disk.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using test::assetFolder;
using test::expectOneLineNaming;
using test::readError;
using test::sampleRendering;
using test::TemporaryFolder;

struct ForeignFile {
    std::vector<std::string> channels;
    Imf::PixelType type = Imf::HALF;
    Imf::Compression compression = Imf::PIZ_COMPRESSION;
    Imath::V2i origin{0, 0};
    Imf::LineOrder lineOrder = Imf::INCREASING_Y;
    int rowsWritten = 3;
};

// A file of 4 x 3 pixels as another program may write it; channel k of pixel i holds k + i / 16.
void writeForeign(const fs::path& path, const ForeignFile& foreign) {
    constexpr int kWidth = 4;
    constexpr int kHeight = 3;
    const Imath::Box2i window(foreign.origin, foreign.origin + Imath::V2i(kWidth - 1, kHeight - 1));
    Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), window);
    header.compression() = foreign.compression;
    header.lineOrder() = foreign.lineOrder;
    std::vector<std::array<float, kWidth * kHeight>> values(foreign.channels.size());
    std::vector<std::array<half, kWidth * kHeight>> halves(foreign.channels.size());
    Imf::FrameBuffer buffer;
    for (size_t k = 0; k < foreign.channels.size(); ++k) {
        for (size_t i = 0; i < values[k].size(); ++i)
            halves[k][i] = values[k][i] = static_cast<float>(k) + static_cast<float>(i) / 16.0f;
        const bool isHalf = foreign.type == Imf::HALF;
        const void* first = isHalf ? static_cast<const void*>(halves[k].data()) : values[k].data();
        const size_t size = isHalf ? sizeof(half) : sizeof(float);
        header.channels().insert(foreign.channels[k], Imf::Channel(foreign.type));
        buffer.insert(foreign.channels[k],
                      Imf::Slice::Make(foreign.type, first, window, size, size * kWidth));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(foreign.rowsWritten);
}

TEST(Exr, ARenderingComesBackBitForBit) {
    const TemporaryFolder folder;
    const Rendering rendering = sampleRendering(67, 300); // more rows than one band of the reader
    writeExr(folder / "image.exr", rendering, {});
    const ExrFile file = readExr(folder / "image.exr");
    EXPECT_EQ(file.radiance().width, 67u);
    EXPECT_EQ(file.radiance().height, 300u);
    EXPECT_EQ(file.radiance().pixels, rendering.radiance().pixels);
    ASSERT_TRUE(file.hasVariance());
    EXPECT_EQ(file.variance().width, 67u);
    EXPECT_EQ(file.variance().pixels, rendering.variance().pixels);
    ASSERT_FALSE(file.sampleCounts.empty());
    EXPECT_EQ(file.sampleCounts, rendering.sampleCounts);
}

TEST(Exr, MetadataComeBackInAlphabeticalOrder) {
    const TemporaryFolder folder;
    const Metadata metadata = {
        {"seed", "7"},
        {"device", "llvmpipe (LLVM 15.0.6, 256 bits), \"quoted\"\nand a second line ❤"},
        {"ledger", ""},
        {"a-key-that-is-longer-than-the-31-bytes-of-version-1-files", std::string(5000, 'x')}};
    writeExr(folder / "image.exr", sampleRendering(2, 2), metadata);
    EXPECT_EQ(readExr(folder / "image.exr").metadata,
              (Metadata{metadata[3], metadata[1], metadata[2], metadata[0]}));
}

TEST(Exr, EqualRenderingsGiveEqualBytes) {
    const TemporaryFolder folder;
    writeExr(folder / "a.exr", sampleRendering(64, 64), {{"seed", "7"}});
    writeExr(folder / "b.exr", sampleRendering(64, 64), {{"seed", "7"}});
    EXPECT_EQ(readFile(folder / "a.exr"), readFile(folder / "b.exr"));
}

TEST(Exr, OtherProgramsFindTheChannelsAndAttributesThatTheHeaderPromises) {
    const TemporaryFolder folder;
    writeExr(folder / "image.exr", sampleRendering(3, 2), {{"seed", "7"}});
    const Imf::InputFile file((folder / "image.exr").c_str());
    const Imf::Header& header = file.header();
    EXPECT_EQ(header.compression(), Imf::ZIP_COMPRESSION);
    for (const char* name : {"R", "G", "B", "variance.R", "variance.G", "variance.B"}) {
        ASSERT_NE(header.channels().findChannel(name), nullptr) << name;
        EXPECT_EQ(header.channels().findChannel(name)->type, Imf::FLOAT) << name;
    }
    ASSERT_NE(header.channels().findChannel("samples"), nullptr);
    EXPECT_EQ(header.channels().findChannel("samples")->type, Imf::UINT);
    EXPECT_NE(header.find("lavalight:seed"), header.end());
}

// The library writes its last bytes in a destructor, which can tell nobody. Of 65 rows, the last block is one
// row, so short that it waits for them.
TEST(Exr, OnADiskThatIsFullAnywhereNothingIsLeft) {
    const TemporaryFolder folder;
    const Rendering rendering = sampleRendering(16, 65);
    writeExr(folder / "whole.exr", rendering, {});
    const size_t size = readFile(folder / "whole.exr").size();
    for (const size_t room : {size_t{0}, size_t{100}, size / 2, size - 9000, size - 1}) {
        const test::FullDisk disk(room);
        EXPECT_THROW(writeExr(folder / "part.exr", rendering, {}), Error) << room << " of " << size;
    }
    EXPECT_EQ(folder.count(), 1);
    const test::FullDisk disk(size);
    writeExr(folder / "part.exr", rendering, {});
    EXPECT_EQ(readFile(folder / "part.exr"), readFile(folder / "whole.exr"));
}

TEST(Exr, AnUnwritablePathIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    const Rendering rendering = sampleRendering(2, 2);
    EXPECT_THROW(writeExr(folder / "none" / "image.exr", rendering, {}), Error);
    EXPECT_THROW(writeExr(folder.path(), rendering, {}), Error);
    EXPECT_THROW(writeExr("/proc/image.exr", rendering, {}), Error);
    EXPECT_EQ(folder.count(), 0);
}

TEST(Exr, ForeignFilesAreReadWhateverTheirTypeCompressionAndOrigin) {
    const TemporaryFolder folder;
    for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT})
        for (const Imf::Compression compression :
             {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
              Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION})
            for (const Imath::V2i& origin : {Imath::V2i(0, 0), Imath::V2i(-5, 17)}) {
                SCOPED_TRACE(testing::Message() << "type " << type << ", compression " << compression);
                writeForeign(folder / "image.exr",
                             {{"A", "B", "G", "R"}, type, compression, origin, Imf::DECREASING_Y});
                const ExrFile file = readExr(folder / "image.exr");
                ASSERT_EQ(file.radiance().width, 4u);
                ASSERT_EQ(file.radiance().height, 3u);
                EXPECT_EQ(file.radiance().pixels.front(), glm::vec3(3.0f, 2.0f, 1.0f));
                EXPECT_EQ(file.radiance().at(1, 2), glm::vec3(3.0f, 2.0f, 1.0f) + 9.0f / 16.0f);
                EXPECT_FALSE(file.hasVariance());
                EXPECT_TRUE(file.sampleCounts.empty());
            }
}

// OpenEXR's C reader decompresses neither DWAA nor DWAB.
TEST(Exr, ForeignFilesOfLossyCompressionsAreReadToo) {
    const TemporaryFolder folder;
    for (const Imf::Compression compression :
         {Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
        SCOPED_TRACE(testing::Message() << "compression " << compression);
        writeForeign(folder / "image.exr", {{"B", "G", "R"}, Imf::HALF, compression});
        const Image image = readExr(folder / "image.exr").radiance();
        ASSERT_EQ(image.pixels.size(), 12u);
        for (size_t i = 0; i < image.pixels.size(); ++i)
            for (glm::length_t c = 0; c < 3; ++c)
                EXPECT_NEAR(image.pixels[i][c], static_cast<float>(2 - c) + static_cast<float>(i) / 16.0f,
                            0.15f); // B44: blocks of 4 x 4 in steps of 6 bits
    }
}

TEST(Exr, LayersComeBackByTheirNames) {
    const TemporaryFolder folder;
    Rendering rendering = sampleRendering(5, 3);
    const auto image = [](float first) {
        Image pixels(5, 3);
        for (size_t i = 0; i < pixels.pixels.size(); ++i)
            pixels.pixels[i] = {first + static_cast<float>(i), -1.0f, 0.25f};
        return pixels;
    };
    rendering.layers.push_back({"normal", {"normal.X", "normal.Y", "normal.Z"}, image(1.0f), image(2.0f)});
    rendering.layers.push_back({"albedo", {"albedo.R", "albedo.G", "albedo.B"}, image(3.0f), std::nullopt});
    Image alpha = image(4.0f);
    for (glm::vec3& pixel : alpha.pixels)
        pixel = {pixel.x, 0.0f, 0.0f};
    rendering.layers.push_back({"A", {"A"}, alpha, alpha});
    writeExr(folder / "image.exr", rendering, {});
    const ExrFile file = readExr(folder / "image.exr");
    ASSERT_EQ(file.layers.size(), rendering.layers.size());
    for (const Layer& layer : rendering.layers) {
        const Layer* same = file.find(layer.name);
        ASSERT_NE(same, nullptr) << layer.name;
        EXPECT_EQ(same->channels, layer.channels);
        EXPECT_EQ(same->mean.pixels, layer.mean.pixels) << layer.name;
        ASSERT_EQ(same->variance.has_value(), layer.variance.has_value()) << layer.name;
        if (layer.variance) {
            EXPECT_EQ(same->variance->pixels, layer.variance->pixels) << layer.name;
        }
    }
    EXPECT_EQ(readExrEnvironment(folder / "image.exr", 15).pixels, rendering.radiance().pixels);
    EXPECT_THROW((void)readExrEnvironment(folder / "image.exr", 14), Error);
}

TEST(Exr, LayersOfOtherProgramsAreThoseOfUpToThreeChannels) {
    const TemporaryFolder folder;
    writeForeign(folder / "image.exr",
                 {{"A", "B", "G", "R", "View.Mist.Z", "View.Normal.X", "View.Normal.Y", "View.Normal.Z",
                   "id.0", "id.1", "id.2", "id.3", "diffuse.B", "diffuse.G", "diffuse.R", "variance.id.0"}});
    const ExrFile file = readExr(folder / "image.exr");
    std::vector<std::string> names;
    for (const Layer& layer : file.layers)
        names.push_back(layer.name);
    EXPECT_EQ(names, (std::vector<std::string>{"color", "A", "View.Mist", "View.Normal", "diffuse"}));
    EXPECT_EQ(file.find("View.Normal")->mean.pixels.front(), glm::vec3(5.0f, 6.0f, 7.0f));
    EXPECT_EQ(file.find("View.Mist")->mean.pixels.front(), glm::vec3(4.0f, 0.0f, 0.0f));
    EXPECT_EQ(file.find("diffuse")->mean.pixels.front(), glm::vec3(14.0f, 13.0f, 12.0f));
    EXPECT_FALSE(file.find("A")->variance.has_value());
}

TEST(Exr, LuminanceAloneIsGrey) {
    const TemporaryFolder folder;
    writeForeign(folder / "image.exr", {{"A", "Y"}});
    EXPECT_EQ(readExr(folder / "image.exr").radiance().at(2, 1), glm::vec3(1.0f + 6.0f / 16.0f));
}

TEST(Exr, AFileWithoutColourIsRefusedByTheNamesItHas) {
    const TemporaryFolder folder;
    writeForeign(folder / "depth.exr", {{"R", "G", "Z"}});
    expectOneLineNaming(readError(folder / "depth.exr"), folder / "depth.exr");
    EXPECT_NE(readError(folder / "depth.exr").find("it has G, R, Z"), std::string::npos);
    writeForeign(folder / "chroma.exr", {{"Y", "RY", "BY"}});
    EXPECT_NE(readError(folder / "chroma.exr").find("it has BY, RY, Y"), std::string::npos);
}

TEST(Exr, AFileThatItsWriterLeftUnfinishedIsRefused) {
    const TemporaryFolder folder;
    ForeignFile foreign{{"R", "G", "B"}, Imf::FLOAT, Imf::NO_COMPRESSION};
    foreign.rowsWritten = 2;
    writeForeign(folder / "image.exr", foreign);
    expectOneLineNaming(readError(folder / "image.exr"), folder / "image.exr");
}

TEST(ExrAssets, RealImagesOfEveryCompressionAreRead) {
    if (assetFolder().empty())
        GTEST_SKIP() << "LAVALIGHT_ASSETS is not set";
    const Image reference = readExr(assetFolder() / "_env/exr-variants/venice_256_none_float.exr").radiance();
    int count = 0;
    for (const auto& entry : fs::directory_iterator(assetFolder() / "_env/exr-variants")) {
        const Image image = readExr(entry.path()).radiance();
        ASSERT_EQ(image.width, reference.width) << entry.path();
        ASSERT_EQ(image.height, reference.height) << entry.path();
        glm::dvec3 sum(0.0);
        glm::dvec3 expected(0.0);
        for (size_t i = 0; i < image.pixels.size(); ++i) {
            sum += glm::dvec3(image.pixels[i]);
            expected += glm::dvec3(reference.pixels[i]);
        }
        EXPECT_NEAR(sum.g / expected.g, 1.0, 0.01) << entry.path(); // B44 loses most
        ++count;
    }
    EXPECT_GE(count, 8);
    EXPECT_GT(readExr(assetFolder() / "CornellBox-Bitterli/reference.exr").radiance().width, 0u);
}

} // namespace
} // namespace lavalight

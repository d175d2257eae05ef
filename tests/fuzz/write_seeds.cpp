// Writes small files for the fuzzers to start from: write_seeds FOLDER makes FOLDER/environment and
// FOLDER/film.
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <fmt/format.h>

#include "film/film_file.h"
#include "support/film_files.h"

namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 16;
constexpr int kHeight = 9;

Imf::FrameBuffer colorBuffer(Imf::Header& header, const std::vector<float>& values) {
    Imf::FrameBuffer buffer;
    for (const char* name : {"R", "G", "B"}) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name,
                      Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(values.data())),
                                 sizeof(float), sizeof(float) * kWidth));
    }
    return buffer;
}

void writeExrs(const fs::path& folder) {
    std::vector<float> values;
    for (int i = 0; i < kWidth * kHeight; ++i)
        values.push_back(static_cast<float>(i % 7) * 0.25f);
    for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
        Imf::Header header(kWidth, kHeight);
        header.compression() = static_cast<Imf::Compression>(compression);
        const Imf::FrameBuffer buffer = colorBuffer(header, values);
        Imf::OutputFile lines((folder / fmt::format("lines_{}.exr", compression)).c_str(), header);
        lines.setFrameBuffer(buffer);
        lines.writePixels(kHeight);
        header.setTileDescription(Imf::TileDescription(8, 4, Imf::MIPMAP_LEVELS));
        Imf::TiledOutputFile tiles((folder / fmt::format("tiles_{}.exr", compression)).c_str(), header);
        tiles.setFrameBuffer(buffer);
        tiles.writeTiles(0, tiles.numXTiles() - 1, 0, tiles.numYTiles() - 1);
    }
}

// Writes rows that are plain, with marks of the old runs, and with the new ones.
void writeHdrs(const fs::path& folder) {
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2.0\n\n";
    const std::string plain("\x10\x20\x30\x80", 4);
    std::ofstream(folder / "plain.hdr") << head << "-Y 2 +X 2\n" << plain << plain << plain << plain;
    std::ofstream(folder / "old.hdr") << head << "+Y 1 +X 9\n" << plain << "\x01\x01\x01\x08";
    const std::string row("\x02\x02\x00\x08\x88\x10\x88\x20\x88\x30\x04\x80\x80\x80\x80\x84\x81", 17);
    std::ofstream(folder / "new.hdr") << head << "-Y 2 +X 8\n" << row << row;
}

void writeFilms(const fs::path& folder) {
    for (uint32_t seed = 0; seed < 3; ++seed)
        lavalight::writeFilmFile(folder / fmt::format("film_{}.exr", seed),
                                 lavalight::test::someFilm(seed, {4 * seed, 4 * seed + 3}));
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: write_seeds FOLDER\n", stderr);
        return 2;
    }
    try {
        const fs::path folder(argv[1]);
        fs::create_directories(folder / "environment");
        fs::create_directories(folder / "film");
        writeExrs(folder / "environment");
        writeHdrs(folder / "environment");
        writeFilms(folder / "film");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "write_seeds: %s\n", error.what());
        return 1;
    }
    return 0;
}

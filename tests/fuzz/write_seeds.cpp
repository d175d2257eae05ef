// Writes small files for the fuzzers to start from: write_seeds FOLDER makes FOLDER/environment,
// FOLDER/extensions, FOLDER/image_light and FOLDER/film.
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

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

// Inputs of extensions_fuzz, in the order in which it takes their values: a reader, figures, then the rest.
void writeStream(const fs::path& path, uint16_t stride, uint16_t count, char mode, char filter,
                 const std::vector<unsigned char>& stream) {
    std::ofstream file(path, std::ios::binary);
    file.put(0)
        .write(reinterpret_cast<const char*>(&stride), 2)
        .write(reinterpret_cast<const char*>(&count), 2);
    file.put(1).put(mode).put(filter);
    file.write(reinterpret_cast<const char*>(stream.data()), static_cast<std::streamsize>(stream.size()));
}

void writeStreams(const fs::path& folder) {
    constexpr uint16_t kCount = 300; // more than a block of vertices
    std::vector<unsigned int> corners(kCount);
    for (unsigned int i = 0; i < kCount; ++i)
        corners[i] = i * 7 % 64;
    std::vector<unsigned char> stream(meshopt_encodeIndexBufferBound(kCount, 64));
    stream.resize(meshopt_encodeIndexBuffer(stream.data(), stream.size(), corners.data(), kCount));
    writeStream(folder / "triangles", 4, kCount, 1, 0, stream);
    stream.resize(meshopt_encodeIndexSequenceBound(kCount, 64));
    stream.resize(meshopt_encodeIndexSequence(stream.data(), stream.size(), corners.data(), kCount));
    writeStream(folder / "indices", 4, kCount, 2, 0, stream);
    constexpr uint16_t kStride = 8;
    const std::vector<unsigned int> values = [&] {
        std::vector<unsigned int> twoEach;
        for (unsigned int i = 0; i < 2 * kCount; ++i)
            twoEach.push_back(i * i);
        return twoEach;
    }();
    for (int version = 0; version < 2; ++version) {
        meshopt_encodeVertexVersion(version);
        stream.resize(meshopt_encodeVertexBufferBound(kCount, kStride));
        stream.resize(
            meshopt_encodeVertexBuffer(stream.data(), stream.size(), values.data(), kCount, kStride));
        for (char filter = 0; filter < 5; ++filter)
            writeStream(folder / fmt::format("vertices_{}_{}", version, int{filter}), kStride, kCount, 0,
                        filter, stream);
    }
}

// Two keys of four numbers each.
void writePointers(const fs::path& folder) {
    constexpr float kSeconds = 0.5f;
    constexpr std::array<float, 10> kKeys = {0.0f, 1.0f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f};
    constexpr std::array kPointers = {
        std::pair{"/materials/0/pbrMetallicRoughness/baseColorFactor", 3},
        std::pair{
            "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset", 1},
        std::pair{"/materials/0/extensions/KHR_materials_ior/ior", 0},
        std::pair{"/cameras/0/perspective/yfov", 0},
        std::pair{"/nodes/0/rotation", 3},
        std::pair{"/nodes/0/weights", 0},
        std::pair{"/nodes/0/weights/1", 0},
        std::pair{"/meshes/0/weights", 0},
        std::pair{"/nodes/0/extensions/KHR_node_visibility/visible", 0},
        std::pair{"/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", 0},
        std::pair{"/extensions/EXT_lights_image_based/lights/0/intensity", 0}};
    for (size_t i = 0; i < kPointers.size(); ++i) {
        const auto& [pointer, type] = kPointers[i];
        std::ofstream file(folder / fmt::format("pointer_{}", i), std::ios::binary);
        // The reader, the type of values, floats, two keys, values (their number less one), the time, linear.
        file.put(1).put(static_cast<char>(type)).put(0).put(1).put(1);
        file.write(reinterpret_cast<const char*>(&kSeconds), sizeof(kSeconds)).put(0);
        file << pointer << '\n';
        file.write(reinterpret_cast<const char*>(kKeys.data()), sizeof(kKeys));
    }
}

void writeLights(const fs::path& folder) {
    constexpr std::array<float, 5> kIntensityAndRotation = {2.0f, 0.0f, 0.7f, 0.0f, 0.7f};
    const std::vector<float> coefficients(27, 0.25f);
    for (char faces : {0, 6}) {
        std::ofstream file(folder / fmt::format("light_{}", int{faces}), std::ios::binary);
        file.put(2);
        file.write(reinterpret_cast<const char*>(kIntensityAndRotation.data()),
                   sizeof(kIntensityAndRotation));
        file.put(faces) << std::string(static_cast<size_t>(faces), '\1');
        file.write(reinterpret_cast<const char*>(coefficients.data()),
                   static_cast<std::streamsize>(coefficients.size() * sizeof(float)));
    }
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
        fs::create_directories(folder / "extensions");
        fs::create_directories(folder / "image_light");
        fs::create_directories(folder / "film");
        writeExrs(folder / "environment");
        writeHdrs(folder / "environment");
        writeStreams(folder / "extensions");
        writePointers(folder / "extensions");
        writeLights(folder / "image_light");
        writeFilms(folder / "film");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "write_seeds: %s\n", error.what());
        return 1;
    }
    return 0;
}

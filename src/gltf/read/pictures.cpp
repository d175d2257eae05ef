// Pictures of textures, decoded in parallel.
#include "gltf/read/pictures.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/os/memory.h"
#include "base/parallel.h"

namespace lavalight {
namespace {

// One image to decode.
struct Job {
    size_t image;
    Picture picture;
    std::string problem;
};

void decode(const GltfDocument& document, Job& job) {
    const GltfImage& image = document.images[job.image];
    job.problem = image.problem;
    if (!job.problem.empty())
        return;
    try {
        job.picture = decodePicture(image.bytes);
        job.picture.name = image.name;
    } catch (const Error& error) {
        job.problem = error.what();
    } catch (const std::bad_alloc&) {
        job.problem = "the memory does not suffice";
    }
}

// Bytes of a picture once decoded; 0 where it cannot be read, which decoding reports.
uint64_t bytesOf(const GltfImage& image) {
    if (!image.problem.empty())
        return 0;
    try {
        return measurePicture(image.bytes).bytes();
    } catch (const Error&) {
        return 0;
    }
}

// A few bytes of a file may stand for a picture of one colour as large as it likes.
void requireFitting(const GltfDocument& document, const std::vector<Job>& jobs) {
    constexpr uint64_t kWorkspace = 3; // decoders hold a picture as it is stored, as RGBA, and with 16 bits
    uint64_t total = 0;
    uint64_t largest = 0;
    for (const Job& job : jobs) {
        const uint64_t bytes = bytesOf(document.images[job.image]);
        total += bytes;
        largest = std::max(largest, bytes);
    }
    if (total > kMostPictureBytes)
        throw document.error(
            fmt::format("its pictures take {} MiB, at most {} are supported: scale them down", total >> 20u,
                        kMostPictureBytes >> 20u));
    if (const std::string shortage = memoryShortage(total + kWorkspace * largest); !shortage.empty())
        throw document.error(fmt::format("its pictures {}: scale them down", shortage));
}

void decodeAll(const GltfDocument& document, std::vector<Job>& jobs) {
    forEachInParallel(jobs.size(), [&](size_t i) { decode(document, jobs[i]); });
}

std::vector<Job> jobsOf(const std::vector<Material>& materials) {
    std::vector<bool> wanted;
    for (const Material& material : materials)
        for (const std::optional<Texture>& texture : material.textures)
            if (texture) {
                wanted.resize(std::max<size_t>(wanted.size(), size_t{texture->picture} + 1), false);
                wanted[texture->picture] = true;
            }
    std::vector<Job> jobs;
    for (size_t image = 0; image < wanted.size(); ++image)
        if (wanted[image])
            jobs.push_back({image, {}, {}});
    return jobs;
}

} // namespace

std::vector<Picture> readPictures(const GltfDocument& document, std::vector<Material>& materials,
                                  GltfNotes& notes) {
    std::vector<Job> jobs = jobsOf(materials);
    requireFitting(document, jobs);
    decodeAll(document, jobs);
    std::vector<Picture> pictures;
    std::map<size_t, uint32_t> numbers; // numbers of pictures, by image
    for (Job& job : jobs) {
        if (!job.problem.empty()) {
            notes.add(fmt::format("{} cannot be read, its materials show their plain factors: {}",
                                  document.images[job.image].name, printable(job.problem)));
            continue;
        }
        if (!job.picture.damage.empty())
            notes.add(fmt::format("{} is damaged and shown as far as it could be decoded: {}",
                                  document.images[job.image].name, printable(job.picture.damage)));
        numbers[job.image] = static_cast<uint32_t>(pictures.size());
        pictures.push_back(std::move(job.picture));
    }
    for (Material& material : materials)
        for (std::optional<Texture>& texture : material.textures) {
            if (!texture)
                continue;
            const auto number = numbers.find(texture->picture);
            if (number == numbers.end())
                texture.reset();
            else
                texture->picture = number->second;
        }
    return pictures;
}

} // namespace lavalight

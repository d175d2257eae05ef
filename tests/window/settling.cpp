// How near the window's picture is to the converged one, a second after the mouse was let go: a measurement,
// no test. Prints the mean FLIP of ten pairs of drags, there and back. Arguments: those of lavalight view
// beside the scene, its size and its samples.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "image/png.h"
#include "support/desktop/desktop.h"
#include "support/run_program.h"
#include "support/running_program.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

constexpr int kDrags = 10;
constexpr std::chrono::milliseconds kSecond(1000);
const std::vector<std::string> kImage{"cornell-box", "--size", "640x480"};

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

double flipOf(const Screenshot& shown, const std::filesystem::path& folder) {
    std::vector<uint32_t> pixels;
    for (const glm::u8vec3& p : shown.pixels)
        pixels.push_back(uint32_t{p.r} | uint32_t{p.g} << 8u | uint32_t{p.b} << 16u | 0xff000000u);
    writePng((folder / "shown.png").string(), shown.width, shown.height, pixels);
    const ProgramResult result = runLavalight({"compare", "--json", "shown.png", "converged.png"}, folder);
    return nlohmann::json::parse(result.out).at("flip").at("mean").get<double>();
}

int measure(const std::vector<std::string>& options) {
    const Desktop desktop;
    const TemporaryFolder folder;
    // FLIP of its own noise is 0.011, and it takes less than the two minutes that a program has.
    const ProgramResult converged = runLavalight(
        joined({"render", "--spp", "256", "--quiet", "--png", "converged.png"}, kImage), folder.path());
    if (converged.exitCode != 0)
        throw std::runtime_error(converged.err);
    RunningProgram program(joined(joined({"view"}, kImage), options), folder.path());
    const std::string window = desktop.findWindow("Lavalight");
    while (desktop.titleOf(window).find(" 4 samples") == std::string::npos)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    desktop.input("windowfocus --sync " + window + " key Tab mousemove --window " + window + " 320 240");
    std::vector<double> flips;
    for (int i = 0; i < kDrags; ++i) {
        desktop.input("mousedown 1 sleep 0.3 mousemove_relative 40 0 sleep 0.3 mouseup 1 sleep 1 "
                      "mousedown 1 sleep 0.3 mousemove_relative -- -40 0 sleep 0.3 mouseup 1");
        const auto letGo = std::chrono::steady_clock::now();
        std::this_thread::sleep_until(letGo + kSecond);
        flips.push_back(flipOf(desktop.shoot(window), folder.path()));
    }
    std::sort(flips.begin(), flips.end());
    std::printf("%d drags: FLIP after a second %.4f on average, %.4f to %.4f\n", kDrags,
                std::accumulate(flips.begin(), flips.end(), 0.0) / kDrags, flips.front(), flips.back());
    return EXIT_SUCCESS;
}

} // namespace
} // namespace lavalight::test

int main(int argc, char** argv) {
    try {
        return lavalight::test::measure({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "settling: %s\n", error.what());
        return EXIT_FAILURE;
    }
}

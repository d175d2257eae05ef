#include "app/compare_command.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "image/exr.h"
#include "image/statistics.h"

namespace lavalight {
namespace {

constexpr float kZLimit = 3.3f; // a standard normal deviate is beyond it once in a thousand times
constexpr uint32_t kZTileSize =
    16; // pixels; averages 256 of them: finds biases a sixteenth of what one pixel shows
constexpr const char* kChannelNames = "RGB";

struct ZTests {
    std::string varianceFrom; // "both", "image" or "reference"; an image without variance counts as exact
    ZTest pixels;
    ZTest tiles;
    ZTest whole;
};

struct Comparison {
    uint32_t width = 0;
    uint32_t height = 0;
    double rmse = 0.0;
    double relMse = 0.0;
    double trimmedRelMse = 0.0;
    MeanDifference meanDifference;
    uint64_t nonFiniteImage = 0;
    uint64_t nonFiniteReference = 0;
    std::optional<ZTests> zTests; // absent if neither image has variances
};

std::optional<ZTests> testNoise(const ExrFile& image, const ExrFile& reference) {
    if (!image.variance && !reference.variance)
        return std::nullopt;
    const Image exact(image.radiance.width, image.radiance.height);
    const Image& varianceA = image.variance ? *image.variance : exact;
    const Image& varianceB = reference.variance ? *reference.variance : exact;
    const auto test = [&](uint32_t tileSize) {
        return tileZTest(image.radiance, varianceA, reference.radiance, varianceB, tileSize);
    };
    const char* from = !reference.variance ? "image" : !image.variance ? "reference" : "both";
    return ZTests{from, test(1), test(kZTileSize), test(std::max(exact.width, exact.height))};
}

Comparison compare(const ExrFile& image, const ExrFile& reference) {
    Comparison result;
    result.width = image.radiance.width;
    result.height = image.radiance.height;
    result.rmse = rmse(image.radiance, reference.radiance);
    result.relMse = relMse(image.radiance, reference.radiance);
    result.trimmedRelMse = trimmedRelMse(image.radiance, reference.radiance);
    result.meanDifference = relativeMeanDifference(image.radiance, reference.radiance);
    result.nonFiniteImage = countNonFinite(image.radiance);
    result.nonFiniteReference = countNonFinite(reference.radiance);
    result.zTests = testNoise(image, reference);
    return result;
}

void printZTest(const char* name, const ZTest& test) {
    fmt::print("  {:<16}{:.3f} % of {} tests below {}; worst {:.2f} at pixel {}, {} in {}\n", name,
               100.0 * test.fractionBelow(kZLimit), test.absZ.size(), kZLimit, test.maxAbsZ, test.worstTile.x,
               test.worstTile.y, kChannelNames[test.worstChannel]);
}

void printText(const Comparison& c) {
    const glm::dvec3 percent = 100.0 * c.meanDifference.perChannel;
    fmt::print("size              {} x {}\n", c.width, c.height);
    fmt::print("RMSE              {:.6g}\n", c.rmse);
    fmt::print("relMSE            {:.6g}\n", c.relMse);
    fmt::print("trimmed relMSE    {:.6g} (without the worst 0.1 % of the pixels)\n", c.trimmedRelMse);
    fmt::print("mean difference   {:+.4f} % (R {:+.4f} %, G {:+.4f} %, B {:+.4f} %)\n",
               100.0 * c.meanDifference.overall, percent.r, percent.g, percent.b);
    if (c.nonFiniteImage + c.nonFiniteReference > 0)
        fmt::print("NaN or infinite   {} pixels of the image, {} of the reference\n", c.nonFiniteImage,
                   c.nonFiniteReference);
    if (!c.zTests) {
        fmt::print("Z-test            none: neither image has variances\n");
        return;
    }
    fmt::print("Z-test            variances of {}\n",
               c.zTests->varianceFrom == "both" ? "both images"
                                                : fmt::format("the {} alone", c.zTests->varianceFrom));
    printZTest("each pixel", c.zTests->pixels);
    printZTest(fmt::format("{0} x {0} pixels", kZTileSize).c_str(), c.zTests->tiles);
    printZTest("whole image", c.zTests->whole);
}

nlohmann::ordered_json zTestJson(const ZTest& test) {
    return {{"tests", test.absZ.size()},
            {"fractionBelowLimit", test.fractionBelow(kZLimit)},
            {"maxAbsZ", test.maxAbsZ},
            {"worstPixel", {test.worstTile.x, test.worstTile.y}},
            {"worstChannel", std::string(1, kChannelNames[test.worstChannel])}};
}

// Infinities and NaN, which JSON lacks, come out as null.
nlohmann::ordered_json comparisonJson(const Comparison& c) {
    const glm::dvec3& mean = c.meanDifference.perChannel;
    nlohmann::ordered_json json = {
        {"width", c.width},
        {"height", c.height},
        {"rmse", c.rmse},
        {"relMse", c.relMse},
        {"trimmedRelMse", c.trimmedRelMse},
        {"meanDifference", {{"overall", c.meanDifference.overall}, {"perChannel", {mean.r, mean.g, mean.b}}}},
        {"nonFinitePixels", {{"image", c.nonFiniteImage}, {"reference", c.nonFiniteReference}}},
        {"zTest", nullptr}};
    if (c.zTests)
        json["zTest"] = {{"variancesOf", c.zTests->varianceFrom},
                         {"limit", kZLimit},
                         {"pixels", zTestJson(c.zTests->pixels)},
                         {"tiles", zTestJson(c.zTests->tiles)},
                         {"whole", zTestJson(c.zTests->whole)}};
    return json;
}

// CLI11's own range check lets NaN pass.
std::string refuseUnlessAtLeastZero(const std::string& text) {
    double value = 0.0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isNumber = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
    return isNumber && value >= 0.0 ? "" : fmt::format("{} is no number of at least 0", text);
}

} // namespace

CompareCommand::CompareCommand(CLI::App& app)
    : Command(app, "compare", "RMSE, relMSE, mean difference and Z-test of two EXR images of equal size") {
    parser().add_option("image", image_, "The image in question")->type_name("A.exr")->required();
    parser().add_option("reference", reference_, "What it should be")->type_name("B.exr")->required();
    parser()
        .add_option("--threshold", threshold_,
                    "Exit 1 if relMSE = mean((a - b)^2 / (b^2 + 0.01)) is above this, or NaN")
        ->check(CLI::Validator(refuseUnlessAtLeastZero, ">= 0"));
    parser().add_flag("--json", json_, "Print JSON");
}

int CompareCommand::run() {
    const Comparison comparison = compare(readExr(image_), readExr(reference_));
    const bool withinThreshold = comparison.relMse <= threshold_; // NaN is not
    if (json_) {
        nlohmann::ordered_json json = comparisonJson(comparison);
        json["threshold"] = threshold_;
        json["withinThreshold"] = withinThreshold;
        fmt::print("{}\n", json.dump(2));
    } else {
        printText(comparison);
    }
    if (!withinThreshold)
        spdlog::error("relMSE {:.6g} of {} is not within the threshold {}", comparison.relMse, image_,
                      threshold_);
    return withinThreshold ? 0 : 1;
}

} // namespace lavalight

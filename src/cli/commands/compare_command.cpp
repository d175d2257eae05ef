#include "cli/commands/compare_command.h"

#include <functional>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "base/input_files.h"
#include "base/log.h"
#include "base/parse.h"
#include "compare/compare_report.h"
#include "compare/comparison_output.h"

namespace lavalight {
namespace {

// CLI11's own range check lets NaN pass.
CLI::Validator numberThat(const std::function<bool(double)>& isMeant, const std::string& range) {
    return {[isMeant, range](const std::string& text) -> std::string {
                const std::optional<double> value = parseNumber<double>(text);
                return value && isMeant(*value) ? "" : fmt::format("{} is not a number {}", text, range);
            },
            range};
}

CLI::Validator atLeastZero() {
    return numberThat([](double value) { return value >= 0.0; }, "of at least 0");
}

} // namespace

CompareCommand::CompareCommand(CLI::App& app)
    : Command(app, "compare",
              "Whether an image may pass for its reference: RMSE, relMSE, FLIP, Z-test. Exit code: 0 equal, "
              "1 different, "
              "2 wrong usage, 3 could not compare. Without criteria: the Z-test where both images have "
              "variances, else "
              "--threshold") {
    parser()
        .add_option("image", image_, "The image in question: EXR (radiance) or PNG")
        ->type_name("A.exr|A.png")
        ->default_str("")
        ->required();
    parser()
        .add_option("reference", reference_, "What it should be, of equal size and kind")
        ->type_name("B.exr|B.png")
        ->default_str("")
        ->required();
    parser().add_flag(
        "--z-test", isZTested_,
        "Criterion: noise explains all differences, by the variances of EXR files (Welch's test of each "
        "pixel, of 16 x 16 pixels, and of the whole image)");
    parser()
        .add_option(
            "--significance", significance_,
            "Of the Z-test, which it asks for: the share of equal renders that are taken for different")
        ->check(numberThat([](double value) { return value > 0.0 && value < 1.0; }, "between 0 and 1"));
    parser()
        .add_option("--threshold", relMse_,
                    "Criterion: relMSE = mean((a - b)^2 / (b^2 + 0.01)), of linear values, is at most this")
        ->check(atLeastZero());
    parser()
        .add_option(
            "--flip-threshold", flip_,
            "Criterion: mean FLIP (HDR-FLIP of EXR files) is at most this; 0 equal, 1 the largest difference")
        ->default_str("")
        ->check(atLeastZero());
    parser()
        .add_option("--heatmap", heatmap_,
                    "Write FLIP of each pixel in colours: black 0, purple, orange, pale yellow 1")
        ->type_name("OUT.png")
        ->default_str("");
    parser()
        .add_option("--html", html_,
                    "Write a page with all this and a slider between the images; it needs no network")
        ->type_name("OUT.html")
        ->default_str("");
    parser().add_flag("--json", json_, "Print JSON");
}

Criteria CompareCommand::criteria() {
    Criteria criteria;
    if (parser().count("--threshold") > 0)
        criteria.relMse = relMse_;
    if (parser().count("--flip-threshold") > 0)
        criteria.flip = flip_;
    if (isZTested_ || parser().count("--significance") > 0)
        criteria.significance = significance_;
    return criteria;
}

void CompareCommand::writeFiles(const Comparison& comparison, const ComparedImage& image,
                                const ComparedImage& reference) const {
    if (!heatmap_.empty())
        writeFileAtomically(heatmap_, heatmapPng(comparison.flip));
    if (!html_.empty())
        writeFileAtomically(html_, reportHtml(comparison, image, reference));
}

void CompareCommand::requireOutputsApart() const {
    InputFiles inputs;
    inputs.add(image_, "the image that is compared");
    inputs.add(reference_, "the reference that is compared");
    for (const std::string& file : {heatmap_, html_})
        if (!file.empty())
            inputs.requireApart(file);
    if (!heatmap_.empty() && !html_.empty() && isSameFile(heatmap_, html_))
        throw UsageError(fmt::format("{} cannot hold two outputs: give each a file of its own", html_));
}

int CompareCommand::run() {
    requireOutputsApart();
    const ComparedImage image = readCompared(image_);
    const ComparedImage reference = readCompared(reference_);
    const Comparison comparison = compare(image, reference, criteria());
    writeFiles(comparison, image, reference);
    if (json_) {
        nlohmann::ordered_json json = comparisonJson(comparison);
        json["metadataDifferences"] = metadataDifferences(image.content.metadata, reference.content.metadata);
        fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    } else {
        fmt::print("{}", comparisonText(comparison));
    }
    for (const Verdict& v : comparison.verdicts)
        if (!v.passed)
            spdlog::error("{} differs from {}: {} {:.6g}, the limit is {:g}; furthest: {}", image_,
                          reference_, v.isZTest() ? fmt::format("p of the {} is", v.criterion) : v.criterion,
                          v.value, v.limit, v.where);
    return comparison.isEqual() ? 0 : 1;
}

} // namespace lavalight

#include "compare/comparison_output.h"

#include <map>

#include <fmt/format.h>

namespace lavalight {
namespace {

using Json = nlohmann::ordered_json;

std::string zTestLine(const ZTestLevel& level) {
    const WelchTest& test = level.test;
    return fmt::format(
        "  {:<16}{:.3f} % of {} tests below {}; least likely: |z| {:.2f} at pixel {}, {} in {}, p {:.2g}\n",
        level.name, 100.0 * test.fractionBelow(kZLimit), test.absZ.size(), kZLimit, test.worstAbsZ,
        test.worstTile.x, test.worstTile.y, kChannelNames[test.worstChannel], test.p);
}

std::string zTestText(const std::optional<ZTests>& tests) {
    if (!tests)
        return "Z-test            none: neither image has variances\n";
    std::string text = fmt::format(
        "Z-test            variances of {}; p: after Bonferroni\n",
        tests->variancesOf == "both" ? "both images" : fmt::format("the {} alone", tests->variancesOf));
    for (const ZTestLevel& level : tests->levels)
        text += zTestLine(level);
    return text;
}

std::string verdictLine(const Verdict& v) {
    return fmt::format("{:<18}{}: {:.6g}, {} {:g}{}\n", v.criterion, v.passed ? "equal" : "different",
                       v.value, v.isZTest() ? "at least" : "at most", v.limit,
                       v.passed || v.where.empty() ? "" : fmt::format("; furthest: {}", v.where));
}

Json zTestJson(const ZTestLevel& level) {
    const WelchTest& test = level.test;
    return {{"tests", test.absZ.size()},
            {"fractionBelowLimit", test.fractionBelow(kZLimit)},
            {"maxAbsZ", test.maxAbsZ},
            {"p", test.p},
            {"worstPixel", {test.worstTile.x, test.worstTile.y}},
            {"worstChannel", std::string(1, kChannelNames[test.worstChannel])},
            {"worstAbsZ", test.worstAbsZ},
            {"tileSize", level.tileSize}};
}

Json zTestsJson(const std::optional<ZTests>& tests) {
    if (!tests)
        return nullptr;
    Json json = {{"variancesOf", tests->variancesOf}, {"limit", kZLimit}, {"p", tests->p()}};
    for (const ZTestLevel& level : tests->levels)
        json[level.jsonName] = zTestJson(level);
    return json;
}

Json flipJson(const Comparison& c) {
    const size_t worst = c.flip.worst();
    return {{"range", c.isHdrFlip ? "HDR" : "LDR"},
            {"mean", c.flip.mean()},
            {"max", c.flip.errors[worst]},
            {"worstPixel", {worst % c.width, worst / c.width}}};
}

Json verdictJson(const Verdict& v) {
    return {{"criterion", v.criterion},
            {"passed", v.passed},
            {"value", v.value},
            {"limit", v.limit},
            {"where", v.where}};
}

} // namespace

std::string comparisonText(const Comparison& c) {
    const glm::dvec3 percent = 100.0 * c.meanDifference.perChannel;
    std::string text = fmt::format("size              {} x {}\n", c.width, c.height);
    text += fmt::format("RMSE              {:.6g}\n", c.rmse);
    text += fmt::format("relMSE            {:.6g}\n", c.relMse);
    text +=
        fmt::format("trimmed relMSE    {:.6g} (without the worst 0.1 % of the pixels)\n", c.trimmedRelMse);
    text += fmt::format("mean difference   {:+.4f} % (R {:+.4f} %, G {:+.4f} %, B {:+.4f} %)\n",
                        100.0 * c.meanDifference.overall, percent.r, percent.g, percent.b);
    const size_t worst = c.flip.worst();
    text += fmt::format("FLIP ({})        mean {:.6g}, worst {:.4g} at pixel {}, {}\n",
                        c.isHdrFlip ? "HDR" : "LDR", c.flip.mean(), c.flip.errors[worst], worst % c.width,
                        worst / c.width);
    if (c.nonFiniteImage > 0)
        text += fmt::format("NaN or infinite   {} pixels of the image\n", c.nonFiniteImage);
    text += zTestText(c.zTests);
    for (const LayerComparison& layer : c.layers)
        text +=
            fmt::format("layer {:<12}RMSE {:.6g}, relMSE {:.6g}{}\n", layer.name, layer.rmse, layer.relMse,
                        layer.zTests ? fmt::format(", p of the Z-test {:.2g}", layer.zTests->p()) : "");
    text += fmt::format("\n{}\n", c.isEqual() ? "EQUAL" : "DIFFERENT");
    for (const Verdict& verdict : c.verdicts)
        text += verdictLine(verdict);
    return text;
}

nlohmann::ordered_json comparisonJson(const Comparison& c) {
    const glm::dvec3& mean = c.meanDifference.perChannel;
    Json json = {
        {"equal", c.isEqual()},
        {"criteria", Json::array()},
        {"width", c.width},
        {"height", c.height},
        {"rmse", c.rmse},
        {"relMse", c.relMse},
        {"trimmedRelMse", c.trimmedRelMse},
        {"meanDifference", {{"overall", c.meanDifference.overall}, {"perChannel", {mean.r, mean.g, mean.b}}}},
        {"nonFinitePixels", c.nonFiniteImage},
        {"flip", flipJson(c)},
        {"zTest", zTestsJson(c.zTests)}};
    for (const LayerComparison& layer : c.layers)
        json["layers"][layer.name] = {
            {"rmse", layer.rmse}, {"relMse", layer.relMse}, {"zTest", zTestsJson(layer.zTests)}};
    for (const Verdict& verdict : c.verdicts)
        json["criteria"].push_back(verdictJson(verdict));
    return json;
}

nlohmann::ordered_json metadataDifferences(const Metadata& image, const Metadata& reference) {
    const std::map<std::string, std::string> a(image.begin(), image.end());
    const std::map<std::string, std::string> b(reference.begin(), reference.end());
    std::map<std::string, std::string> keys = a;
    keys.insert(b.begin(), b.end());
    Json differences = Json::array();
    const auto valueIn = [](const auto& metadata, const std::string& key) {
        const auto found = metadata.find(key);
        return found == metadata.end() ? Json(nullptr) : Json(found->second);
    };
    for (const auto& [key, ignored] : keys)
        if (valueIn(a, key) != valueIn(b, key))
            differences.push_back({{"key", key}, {"image", valueIn(a, key)}, {"reference", valueIn(b, key)}});
    return differences;
}

} // namespace lavalight

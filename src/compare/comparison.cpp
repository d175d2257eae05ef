#include "compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "image/picture.h"
#include "image/texel.h"

namespace lavalight {
namespace {

bool isPicture(std::string_view bytes) {
    constexpr std::string_view kPng = "\x89PNG";
    return bytes.starts_with(kPng);
}

Layer alphaLayer(Image mean) {
    return {kAlphaLayer, {kAlphaLayer}, std::move(mean), std::nullopt};
}

// Linear colours, and alpha unless all is opaque.
std::vector<Layer> linearLayers(const Picture& picture) {
    Image color(picture.width, picture.height);
    Image alpha(picture.width, picture.height);
    bool isOpaque = true;
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width; ++x) {
            const size_t index = size_t{y} * picture.width + x;
            const glm::dvec4 texel = texelOf(picture, x, y, true);
            color.pixels[index] = glm::vec3(texel);
            alpha.pixels[index].x = static_cast<float>(texel.w);
            isOpaque = isOpaque && texel.w == 1.0;
        }
    std::vector<Layer> layers{colorLayer(std::move(color), std::nullopt)};
    if (!isOpaque)
        layers.push_back(alphaLayer(std::move(alpha)));
    return layers;
}

std::vector<Layer> readPicture(const std::string& path, std::string_view bytes) {
    try {
        return linearLayers(decodePicture(bytes));
    } catch (const Error& error) {
        throw Error(fmt::format("cannot read {}: {}", path, error.what()));
    }
}

Estimate estimateOf(const Layer& layer, const std::vector<uint32_t>& sampleCounts) {
    return {&layer.mean, layer.variance ? &*layer.variance : nullptr, sampleCounts};
}

std::optional<ZTests> testNoise(const Estimate& image, const Estimate& reference) {
    if (image.variance == nullptr && reference.variance == nullptr)
        return std::nullopt;
    if (!hasTestablePixel(image, reference))
        return std::nullopt;
    const uint32_t whole = std::max(image.mean->width, image.mean->height);
    const auto test = [&](uint32_t tileSize) { return welchTest(image, reference, tileSize); };
    const char* of = reference.variance == nullptr ? "image"
                     : image.variance == nullptr   ? "reference"
                                                   : "both";
    return ZTests{of,
                  {{{"each pixel", "pixels", 1, test(1)},
                    {"16 x 16 pixels", "tiles", kZTileSize, test(kZTileSize)},
                    {"whole image", "whole", whole, test(whole)}}}};
}

void requireComparable(const ComparedImage& image, const ComparedImage& reference) {
    const Image& a = image.content.radiance();
    const Image& b = reference.content.radiance();
    if (image.isDisplayed != reference.isDisplayed)
        throw Error(
            fmt::format("cannot compare {} with {}: one holds radiance, the other what a display shows of it",
                        image.name, reference.name));
    if (a.width != b.width || a.height != b.height)
        throw Error(fmt::format("cannot compare images of different sizes, {} x {} and {} x {}", a.width,
                                a.height, b.width, b.height));
    if (const uint64_t count = countNonFinite(b); count > 0)
        throw Error(fmt::format("the reference {} has {} pixels that are NaN or infinite: make it anew",
                                reference.name, count));
}

std::string pixelText(size_t index, uint32_t width) {
    return fmt::format("pixel {}, {}", index % width, index / width);
}

Verdict finiteVerdict(const Comparison& c, const Image& image) {
    Verdict verdict{"finite", static_cast<double>(c.nonFiniteImage), 0.0, c.nonFiniteImage == 0, ""};
    const auto found = std::find_if(image.pixels.begin(), image.pixels.end(), [](const glm::vec3& p) {
        return !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
    });
    if (found != image.pixels.end())
        verdict.where = pixelText(static_cast<size_t>(found - image.pixels.begin()), c.width);
    return verdict;
}

Verdict relMseVerdict(const Comparison& c, double limit, const Image& image, const Image& reference) {
    return {"relMSE", c.relMse, limit, c.relMse <= limit, // NaN is not
            pixelText(worstOfRelMse(image, reference), c.width)};
}

Verdict flipVerdict(const Comparison& c, double limit) {
    const double mean = c.flip.mean();
    const size_t worst = c.flip.worst();
    return {"FLIP", mean, limit, mean <= limit,
            fmt::format("{} with {:.3f}", pixelText(worst, c.width), c.flip.errors[worst])};
}

Verdict zVerdict(const ZTests& tests, double significance, const std::vector<std::string>& channels) {
    const ZTestLevel& level = tests.worst();
    const WelchTest& test = level.test;
    const std::string size = level.tileSize == 1 ? "" : fmt::format("{} from ", level.name);
    const std::string place = level.tileSize > kZTileSize
                                  ? level.name
                                  : fmt::format("{}pixel {}, {}", size, test.worstTile.x, test.worstTile.y);
    return {"Z-test", tests.p(), significance, tests.p() >= significance,
            fmt::format("{} in {}: |z| {:.2f}", place, channels[static_cast<size_t>(test.worstChannel)],
                        test.worstAbsZ)};
}

Criteria completed(Criteria criteria, const ComparedImage& image, const ComparedImage& reference,
                   bool canBeTested) {
    if (criteria.relMse || criteria.flip || criteria.significance)
        return criteria;
    if (canBeTested && image.content.hasVariance() && reference.content.hasVariance())
        criteria.significance = kDefaultSignificance;
    else
        criteria.relMse = kDefaultRelMse;
    return criteria;
}

std::vector<Verdict> judge(const Comparison& c, const Criteria& criteria, const Image& image,
                           const Image& reference) {
    std::vector<Verdict> verdicts{finiteVerdict(c, image)};
    if (criteria.significance) {
        if (!c.zTests)
            throw Error("no Z-test: neither image has variances, or no pixel has two samples in both; "
                        "compare EXR files "
                        "of lavalight render, or give --threshold or --flip-threshold");
        verdicts.push_back(zVerdict(*c.zTests, *criteria.significance, colorLayer({}, {}).channels));
    }
    if (criteria.relMse)
        verdicts.push_back(relMseVerdict(c, *criteria.relMse, image, reference));
    if (criteria.flip)
        verdicts.push_back(flipVerdict(c, *criteria.flip));
    return verdicts;
}

// Components that the layer lacks are 0 in both, and add nothing to sums over three channels.
LayerComparison compareLayers(const Estimate& image, const Estimate& reference, const Layer& layer) {
    const double share = 3.0 / static_cast<double>(layer.channels.size());
    return {layer.name,
            layer.channels,
            rmse(*image.mean, *reference.mean) * std::sqrt(share),
            relMse(*image.mean, *reference.mean) * share,
            pixelText(worstOfRelMse(*image.mean, *reference.mean), image.mean->width),
            testNoise(image, reference)};
}

struct LayerPair {
    const Layer* image;
    const Layer* reference;
};

// Whether `layer` is the opacity of something that is in `other`, where nothing is said of that.
bool lacksAlphaOf(const Rendering& other, const Layer& layer) {
    if (other.find(layer.name) != nullptr)
        return false;
    return layer.name == kAlphaLayer ||
           (layer.name.ends_with(".A") && other.find(layer.name.substr(0, layer.name.size() - 2)) != nullptr);
}

Layer opaqueAs(const Layer& alpha) {
    Layer opaque{alpha.name, alpha.channels, Image(alpha.mean.width, alpha.mean.height), std::nullopt};
    for (glm::vec3& pixel : opaque.mean.pixels)
        pixel.x = 1.0f;
    return opaque;
}

// The layers that both have besides the colour, and alpha where either has it, beside one of `opaques`.
std::vector<LayerPair> pairsOf(const Rendering& image, const Rendering& reference,
                               std::deque<Layer>& opaques) {
    std::vector<LayerPair> pairs;
    for (const Layer& layer : image.layers)
        if (const Layer* other = reference.find(layer.name); other != nullptr && layer.name != kColorLayer)
            pairs.push_back({&layer, other});
    for (const Layer& alpha : image.layers)
        if (lacksAlphaOf(reference, alpha))
            pairs.push_back({&alpha, &opaques.emplace_back(opaqueAs(alpha))});
    for (const Layer& alpha : reference.layers)
        if (lacksAlphaOf(image, alpha))
            pairs.push_back({&opaques.emplace_back(opaqueAs(alpha)), &alpha});
    return pairs;
}

void judgeLayer(const LayerComparison& layer, const Criteria& criteria, std::vector<Verdict>& verdicts) {
    const bool isTested = criteria.significance && layer.zTests;
    if (isTested) {
        verdicts.push_back(zVerdict(*layer.zTests, *criteria.significance, layer.channels));
        verdicts.back().criterion += " of " + layer.name;
    }
    if (criteria.relMse || !isTested) {
        const double limit = criteria.relMse.value_or(kDefaultRelMse);
        const std::string criterion = fmt::format("relMSE of {}", layer.name);
        verdicts.push_back(
            {criterion, layer.relMse, limit, layer.relMse <= limit, layer.where}); // NaN is not
    }
}

} // namespace

ComparedImage readCompared(const std::string& path) {
    const std::string bytes = readFile(path);
    if (!isPicture(bytes))
        return {path, readExr(path), false};
    ComparedImage image{path, {}, true};
    image.content.layers = readPicture(path, bytes);
    return image;
}

double ZTests::p() const {
    return std::min(1.0, worst().test.p * static_cast<double>(levels.size()));
}

const ZTestLevel& ZTests::worst() const {
    return *std::min_element(levels.begin(), levels.end(), [](const ZTestLevel& a, const ZTestLevel& b) {
        return std::pair(a.test.p, -a.test.worstAbsZ) < std::pair(b.test.p, -b.test.worstAbsZ);
    });
}

bool Comparison::isEqual() const {
    return std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.passed; });
}

Comparison compare(const ComparedImage& image, const ComparedImage& reference, const Criteria& criteria) {
    requireComparable(image, reference);
    const Image& a = image.content.radiance();
    const Image& b = reference.content.radiance();
    Comparison result;
    result.width = a.width;
    result.height = a.height;
    result.rmse = rmse(a, b);
    result.relMse = relMse(a, b);
    result.trimmedRelMse = trimmedRelMse(a, b);
    result.meanDifference = relativeMeanDifference(a, b);
    result.nonFiniteImage = countNonFinite(a);
    result.isHdrFlip = !image.isDisplayed;
    result.flip = result.isHdrFlip ? flipOfRadiance(a, b) : flip(a, b);
    result.zTests = testNoise(estimateOf(image.content.layers.front(), image.content.sampleCounts),
                              estimateOf(reference.content.layers.front(), reference.content.sampleCounts));
    const Criteria asked = completed(criteria, image, reference, result.zTests.has_value());
    result.verdicts = judge(result, asked, a, b);
    std::deque<Layer> opaques;
    for (const LayerPair& pair : pairsOf(image.content, reference.content, opaques)) {
        result.layers.push_back(compareLayers(estimateOf(*pair.image, image.content.sampleCounts),
                                              estimateOf(*pair.reference, reference.content.sampleCounts),
                                              *pair.image));
        judgeLayer(result.layers.back(), asked, result.verdicts);
    }
    return result;
}

} // namespace lavalight

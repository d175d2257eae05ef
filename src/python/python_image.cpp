#include "python/python_image.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "compare/comparison.h"
#include "compare/comparison_output.h"
#include "film/film_bytes.h"
#include "image/png.h"
#include "python/pixel_maker.h"
#include "python/text.h"

namespace lavalight::python {

namespace nb = nanobind;

namespace {

// Arrays keep the image alive, whose memory they view. They cannot be written to: an image does not change.
using Floats = nb::ndarray<nb::numpy, const float>;
using Words = nb::ndarray<nb::numpy, const uint32_t>;
using Bytes = nb::ndarray<nb::numpy, const uint8_t>;

constexpr int64_t kImageChannels = 3; // of an Image in memory

// Rows, columns and the first `channels` of three components; one channel is an array of two dimensions.
Floats viewOf(nb::handle owner, const Image& image, size_t channels) {
    const float* first = image.pixels.empty() ? nullptr : &image.pixels.front().x;
    const int64_t row = int64_t{image.width} * kImageChannels;
    if (channels == 1)
        return Floats(first, {image.height, image.width}, owner, {row, kImageChannels});
    return Floats(first, {image.height, image.width, channels}, owner, {row, kImageChannels, 1});
}

const PythonImage& imageOf(nb::handle self) {
    return nb::cast<const PythonImage&>(self);
}

const Layer& layerOf(const PythonImage& image, const std::string& name) {
    if (const Layer* layer = image.rendering().find(name))
        return *layer;
    throw nb::key_error(name.c_str());
}

std::vector<std::string> layerNames(const PythonImage& image) {
    std::vector<std::string> names;
    for (const Layer& layer : image.rendering().layers)
        names.push_back(layer.name);
    for (const auto& channel : image.finished().ids.uints)
        names.push_back(channel.name);
    return names;
}

nb::object layerArray(nb::handle self, const std::string& name) {
    const PythonImage& image = imageOf(self);
    const Image& radiance = image.rendering().radiance();
    for (const auto& channel : image.finished().ids.uints)
        if (channel.name == name)
            return nb::cast(Words(channel.values.data(), {radiance.height, radiance.width}, self));
    const Layer& layer = layerOf(image, name);
    return nb::cast(viewOf(self, layer.mean, layer.channels.size()));
}

nb::object varianceOf(nb::handle self, const std::string& name) {
    const Layer& layer = layerOf(imageOf(self), name);
    return layer.variance ? nb::cast(viewOf(self, *layer.variance, layer.channels.size())) : nb::none();
}

nb::object samplesOf(nb::handle self) {
    const Rendering& rendering = imageOf(self).rendering();
    const Image& radiance = rendering.radiance();
    return nb::cast(Words(rendering.sampleCounts.data(), {radiance.height, radiance.width}, self));
}

nb::object pixelArray(nb::handle self) {
    const PythonImage& image = imageOf(self);
    const Image& radiance = image.rendering().radiance();
    std::span<const uint32_t> pixels;
    {
        const nb::gil_scoped_release release;
        pixels = image.pixels();
    }
    const auto* bytes = reinterpret_cast<const uint8_t*>(pixels.data());
    return nb::cast(Bytes(bytes, {radiance.height, radiance.width, 4}, self));
}

nb::bytes pngOf(const PythonImage& image) {
    const Image& radiance = image.rendering().radiance();
    const std::string png = [&] {
        const nb::gil_scoped_release release;
        return encodePng(radiance.width, radiance.height, image.pixels(),
                         pngTexts(image.finished().tone.value()));
    }();
    return nb::bytes(png.data(), png.size());
}

nb::bytes filmOf(const PythonImage& image) {
    std::string bytes;
    {
        const nb::gil_scoped_release release;
        if (!image.finished().film)
            throw Error("cannot give the film of this image: the render did not keep it; try "
                        "samples=(0, N) in place of spp=N");
        bytes = filmBytes(*image.finished().film);
    }
    return nb::bytes(bytes.data(), bytes.size());
}

nb::bytes pack(const PythonImage& image) {
    std::string bytes;
    {
        const nb::gil_scoped_release release;
        bytes = imageBytes(image.record());
    }
    return nb::bytes(bytes.data(), bytes.size());
}

std::unique_ptr<PythonImage> unpack(nb::bytes bytes) {
    const std::string_view view(bytes.c_str(), bytes.size());
    const nb::gil_scoped_release release;
    return std::make_unique<PythonImage>(imageFromBytes(view));
}

void save(const PythonImage& image, const std::string& path) {
    const nb::gil_scoped_release release;
    if (path.ends_with(".json")) {
        writeFileAtomically(path, image.record().report);
        return;
    }
    Outputs outputs;
    addPicture(outputs, path, "save");
    if (!outputs.exr.empty())
        writeImageExr(path, image.finished(), image.record().header);
    else
        writePng(path, image.rendering().radiance().width, image.rendering().radiance().height,
                 image.pixels(), pngTexts(image.finished().tone.value()));
}

ComparedImage comparedOf(const PythonImage& image, const std::string& name) {
    ComparedImage compared;
    compared.name = name;
    static_cast<Rendering&>(compared.content) = image.rendering();
    compared.content.metadata = image.record().header;
    return compared;
}

// JSON: what `lavalight compare --json` prints, with "equal".
std::string compareImages(const PythonImage& image, nb::object reference, std::optional<double> relMse,
                          std::optional<double> flip, std::optional<double> significance) {
    const PythonImage* other = nullptr;
    std::string path;
    if (!nb::try_cast(reference, other))
        path = nb::cast<std::string>(nb::str(reference));
    const nb::gil_scoped_release release;
    const ComparedImage against = other != nullptr ? comparedOf(*other, "reference") : readCompared(path);
    const Comparison comparison = compare(comparedOf(image, "image"), against, {relMse, flip, significance});
    nlohmann::ordered_json json = comparisonJson(comparison);
    json["equal"] = comparison.isEqual();
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace

std::span<const uint32_t> PythonImage::pixels() const {
    const std::lock_guard lock(mutex_);
    FinishedImage& image = record_.image;
    if (image.pixels.empty())
        image.pixels = PixelMaker::ofProcess().pixelsOf(image);
    return image.pixels;
}

void declareImage(nb::module_& module) {
    nb::class_<PythonImage>(module, "Image")
        .def_prop_ro("width", [](const PythonImage& image) { return image.rendering().radiance().width; })
        .def_prop_ro("height", [](const PythonImage& image) { return image.rendering().radiance().height; })
        .def_prop_ro("complete", &PythonImage::isComplete)
        .def_prop_ro("report_json", [](const PythonImage& image) { return image.record().report; })
        .def_prop_ro("layer_names", &layerNames)
        .def("layer", &layerArray, nb::arg("name"))
        .def("layer_variance", &varianceOf, nb::arg("name"))
        .def_prop_ro("samples", &samplesOf)
        .def_prop_ro("pixels", &pixelArray)
        .def("film_bytes", &filmOf)
        .def("pack", &pack)
        .def_static("unpack", &unpack, nb::arg("data"))
        .def("png", &pngOf)
        .def("save", &save, nb::arg("path"))
        .def("compare", &compareImages, nb::arg("reference"), nb::arg("relmse"), nb::arg("flip"),
             nb::arg("significance"));
}

} // namespace lavalight::python

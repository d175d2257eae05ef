#include "python/python_film.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "cli/options/picture_words.h"
#include "film/film_bytes.h"
#include "python/text.h"
#include "session/developed_film.h"

namespace lavalight::python {

namespace nb = nanobind;

namespace {

constexpr const char* kLayersKey = "option:aov";
constexpr std::string_view kLayersWord = "--aov=";

std::unique_ptr<PythonFilm> fromBytes(nb::bytes data, const std::string& name) {
    const std::string_view bytes(data.c_str(), data.size());
    const nb::gil_scoped_release release;
    return std::make_unique<PythonFilm>(NamedFilm{name, filmFromBytes(bytes, name)});
}

std::unique_ptr<PythonFilm> fromFile(const std::string& path) {
    return std::make_unique<PythonFilm>(NamedFilm{path, readFilmFile(path)});
}

nb::bytes bytesOf(const PythonFilm& film) {
    std::string bytes;
    {
        const nb::gil_scoped_release release;
        bytes = filmBytes(film.film().file);
    }
    return nb::bytes(bytes.data(), bytes.size());
}

std::vector<std::pair<uint32_t, uint32_t>> rangesOf(const PythonFilm& film) {
    std::vector<std::pair<uint32_t, uint32_t>> ranges;
    for (const SampleRange& range : film.film().file.ranges)
        ranges.emplace_back(range.first, range.end);
    return ranges;
}

} // namespace

void PythonFilm::add(const NamedFilm& part, Machines machines) {
    join(film_, part, machines);
}

std::unique_ptr<PythonImage> PythonFilm::develop(std::vector<std::string> words, bool holdsFilm,
                                                 bool isComplete) const {
    const std::string layers = valueOf(film_.file.metadata, kLayersKey);
    const bool isAsked = std::any_of(words.begin(), words.end(),
                                     [](const std::string& word) { return word.starts_with(kLayersWord); });
    if (!layers.empty() && !isAsked)
        words.push_back(fmt::format("{}{}", kLayersWord, layers));
    OutputStyle style = parsePicture(valueOf(film_.file.metadata, "scene"), words).plan.style;
    style.keepsFilm = holdsFilm;
    DevelopedFilm developed = developFilm(film_, std::move(style));
    return std::make_unique<PythonImage>(ImageRecord{std::move(developed.image), std::move(developed.header),
                                                     std::move(developed.report), isComplete});
}

void declareFilm(nb::module_& module) {
    nb::class_<PythonFilm>(module, "Film")
        .def_static("from_bytes", &fromBytes, nb::arg("data"), nb::arg("name"))
        .def_static("read", &fromFile, nb::arg("path"), nb::call_guard<nb::gil_scoped_release>())
        .def_prop_ro("name", [](const PythonFilm& film) { return film.film().name; })
        .def_prop_ro("ranges", &rangesOf)
        .def(
            "value",
            [](const PythonFilm& film, const std::string& key) {
                return valueOf(film.film().file.metadata, key);
            },
            nb::arg("key"))
        .def("bytes", &bytesOf)
        .def(
            "add",
            [](PythonFilm& film, const PythonFilm& part, bool isStatistical) {
                film.add(part.film(), isStatistical ? Machines::any : Machines::ofOneKind);
            },
            nb::arg("part"), nb::arg("statistical"), nb::call_guard<nb::gil_scoped_release>())
        .def("develop", &PythonFilm::develop, nb::arg("words"), nb::arg("holds_film"), nb::arg("complete"),
             nb::call_guard<nb::gil_scoped_release>());
}

} // namespace lavalight::python

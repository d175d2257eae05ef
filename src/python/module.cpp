// The extension module lavalight._lavalight. The package in python/lavalight is its face: keywords,
// notebooks, types.
#include <memory>
#include <string>
#include <string_view>

#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <nlohmann/json.hpp>
#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>

#include "base/error.h"
#include "base/log.h"
#include "base/version.h"
#include "cli/options/device_options.h"
#include "cli/options/picture_words.h"
#include "cli/run_command_line.h"
#include "gltf/pack.h"
#include "gpu/device.h"
#include "gpu/direct_driver.h"
#include "lab/experiment.h"
#include "python/device_use.h"
#include "python/pixel_maker.h"
#include "python/python_film.h"
#include "python/python_image.h"
#include "python/python_render.h"
#include "python/python_scene.h"
#include "python/session_pool.h"
#include "python/text.h"
#include "python/watch.h"
#include "render/presets.h"
#include "session/builtin.h"

namespace lavalight::python {

namespace nb = nanobind;

namespace {

// Text for people. Messages quote files, whose names need not be UTF-8.
nb::object readable(std::string_view text) {
    return nb::steal(
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace"));
}

// Messages go to Python's logger "lavalight", whichever thread says them. Python's lock is the sink's.
class PythonLog : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
  protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        if (!Py_IsInitialized())
            return;
        const nb::gil_scoped_acquire lock;
        const char* method = message.level >= spdlog::level::err    ? "error"
                             : message.level >= spdlog::level::warn ? "warning"
                                                                    : "info";
        try {
            const nb::object logger = nb::module_::import_("logging").attr("getLogger")("lavalight");
            logger.attr(method)("%s", readable({message.payload.data(), message.payload.size()}));
        } catch (nb::python_error& error) {
            error.discard_as_unraisable("lavalight's log");
        }
    }
    void flush_() override {}
};

void sendLogToPython() {
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("lavalight", std::make_shared<PythonLog>()));
    spdlog::set_level(spdlog::level::info);
}

std::string devicesJson() {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const gpu::DeviceDescription& device : gpu::listDevices())
        json.push_back({{"index", device.index},
                        {"name", device.name},
                        {"driver", device.driver},
                        {"type", device.type},
                        {"refusals", device.refusals}});
    return json.dump();
}

// Thrown through an experiment to end it.
struct Interruption {};

std::vector<Table> runLab(const std::string& name, const LabOptions& options) {
    beginDeviceUse();
    Watch watch(0.0, nb::none());
    std::vector<Table> tables;
    {
        const nb::gil_scoped_release release;
        const Experiment& experiment = findExperiment(name);
        gpu::Device device({});
        const LabDevice lab{device, [&] {
                                if (!watch.goesOn(0.0))
                                    throw Interruption();
                            }};
        try {
            tables = runExperiment(experiment, lab, options);
        } catch (const Interruption&) { // the watch has what Python raised
        }
    }
    watch.rethrow();
    return tables;
}

std::string labJson(const std::string& name, uint64_t samples, uint32_t seed) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Table& table : runLab(name, {samples, seed})) {
        nlohmann::ordered_json one = tableJson(table);
        one["text"] = tableText(table);
        json.push_back(std::move(one));
    }
    return json.dump();
}

std::vector<std::pair<std::string, std::string>> experimentNames() {
    std::vector<std::pair<std::string, std::string>> names;
    for (const Experiment& experiment : experiments())
        names.emplace_back(experiment.name, experiment.question);
    return names;
}

std::vector<std::pair<std::string, std::string>> presetNames() {
    std::vector<std::pair<std::string, std::string>> names;
    for (const Preset& preset : presets())
        names.emplace_back(preset.name, optionsOf(preset));
    return names;
}

std::vector<std::tuple<std::string, bool, std::string, std::string>> optionTuples() {
    std::vector<std::tuple<std::string, bool, std::string, std::string>> tuples;
    for (const PictureOption& option : pictureOptions())
        tuples.emplace_back(option.name, option.isFlag, option.value, option.help);
    return tuples;
}

// The first sample that a render of those options takes of each pixel, and how many it takes. Throws as a
// render does whose options are refused.
std::pair<uint32_t, uint32_t> sampleRange(const std::string& scene, const std::vector<std::string>& words) {
    const nb::gil_scoped_release release;
    const RenderSettings settings = parsePicture(scene, words).plan.settings;
    return {settings.image.firstSample, settings.stop.samples};
}

nb::bytes pack(const std::string& path, bool allowsExternal) {
    PackedScene packed;
    {
        const nb::gil_scoped_release release;
        packed = packGltf(path, allowsExternal);
        for (const std::string& warning : packed.warnings)
            spdlog::warn("{}", warning);
    }
    return nb::bytes(packed.glb.data(), packed.glb.size());
}

// The program, with its own messages in place of Python's logger.
int runCommand(std::vector<std::string> words) {
    const nb::gil_scoped_release release;
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    return runCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

void raise(PyObject* kind, const char* message) {
    if (const nb::object text = readable(message); text.is_valid())
        PyErr_SetObject(kind, text.ptr());
}

void declareErrors(nb::module_& module) {
    static PyObject* failure = PyErr_NewException("lavalight.Error", PyExc_RuntimeError, nullptr);
    static PyObject* usage = [] {
        const nb::object bases = nb::make_tuple(nb::handle(failure), nb::handle(PyExc_ValueError));
        return PyErr_NewException("lavalight.UsageError", bases.ptr(), nullptr);
    }();
    module.attr("Error") = nb::handle(failure);
    module.attr("UsageError") = nb::handle(usage);
    nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            std::rethrow_exception(thrown);
        } catch (const UsageError& error) {
            raise(usage, error.what());
        } catch (const Error& error) {
            raise(failure, error.what());
        }
    });
}

} // namespace

NB_MODULE(_lavalight, module) {
    module.attr("__version__") = std::string(kVersion);
    sendLogToPython();
    declareErrors(module);
    declareImage(module);
    declareScene(module);
    declareRender(module);
    declareFilm(module);
    module.def("picture_options", &optionTuples);
    module.def("builtin_scenes", &builtinNames);
    module.def("presets", &presetNames);
    module.def("sample_range", &sampleRange, nb::arg("scene"), nb::arg("words"));
    module.def("pack", &pack, nb::arg("path"), nb::arg("allow_external"));
    module.def("limit_threads", &limitAllThreads, nb::arg("threads"));
    module.def("experiments", &experimentNames);
    module.def("devices_json", &devicesJson, nb::call_guard<nb::gil_scoped_release>());
    module.def("lab_json", &labJson, nb::arg("experiment"), nb::arg("samples"), nb::arg("seed"));
    module.def(
        "use_driver", [](const std::string& library) { gpu::useDriver(library); }, nb::arg("library"));
    module.def("forbid_renders", &forbidDeviceUse, nb::arg("reason"));
    module.def("run_command", &runCommand, nb::arg("words"));
    module.def(
        "close",
        [] {
            SessionPool::ofProcess().clear();
            PixelMaker::ofProcess().clear();
        },
        nb::call_guard<nb::gil_scoped_release>());
}

} // namespace lavalight::python

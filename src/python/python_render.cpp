#include "python/python_render.h"

#include <chrono>
#include <optional>
#include <utility>

#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "base/error.h"
#include "cli/options/picture_words.h"
#include "film/film_bytes.h"
#include "python/device_use.h"
#include "python/session_pool.h"
#include "session/report.h"

namespace lavalight::python {

namespace nb = nanobind;

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kAskEvery{50}; // how often Python is asked for signals

// Asked between waves, without Python's lock: whether to go on.
class Watch {
  public:
    Watch(double seconds, nb::handle progress) : seconds_(seconds), progress_(progress) {}

    bool goesOn(double fraction) {
        const auto now = Clock::now();
        if (now - asked_ >= kAskEvery) {
            asked_ = now;
            if (!ask(fraction))
                return false;
        }
        return seconds_ <= 0.0 || std::chrono::duration<double>(now - start_).count() < seconds_;
    }
    [[nodiscard]] bool hasRaised() const { return raised_.has_value(); }
    // Throws what Python raised. With Python's lock.
    void rethrow() {
        if (raised_)
            throw std::move(*raised_);
    }

  private:
    bool ask(double fraction) {
        const nb::gil_scoped_acquire lock;
        try {
            if (PyErr_CheckSignals() != 0)
                throw nb::python_error();
            if (!progress_.is_none())
                progress_(fraction);
        } catch (nb::python_error& error) {
            raised_.emplace(std::move(error));
            return false;
        }
        return true;
    }

    double seconds_;
    nb::handle progress_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point asked_ = start_;
    std::optional<nb::python_error> raised_;
};

} // namespace

PythonRender::PythonRender(const PythonScene& scene, const std::vector<std::string>& words, Use use) {
    beginDeviceUse();
    const std::shared_ptr<const Scene> loaded = scene.scene();
    const std::string name = scene.name();
    const LightingSettings lighting = scene.lighting();
    const ImportOptions moment = scene.moment();
    const nb::gil_scoped_release release;
    ParsedPicture parsed = parsePicture(name, words);
    parsed.plan.loaded = loaded;
    parsed.plan.settings.lighting = lighting;
    parsed.plan.settings.stop.isProgressive = use.isProgressive;
    if (use.hasGuides)
        parsed.plan.settings.layers |= kDenoisingLayers;
    device_ = parsed.plan.device;
    session_ = SessionPool::ofProcess().take(std::move(parsed.plan));
    Outputs wanted;
    if (!use.isPart)
        wanted.png = "pixels"; // asks for them; no file is written
    job_ = session_->prepare(moment, wanted);
}

PythonRender::~PythonRender() {
    const nb::gil_scoped_release release;
    if (job_)
        session_->finish(std::move(*job_));
    job_.reset();
    if (session_)
        SessionPool::ofProcess().giveBack(std::move(session_), device_);
}

void PythonRender::takeSamples(const RenderJob::KeepGoing& keepGoing) {
    Checkpoint none({}, {});
    session_->render(*job_, none, false, keepGoing);
    seconds_ += job_->report.renderSeconds;
    job_->report.renderSeconds = seconds_;
}

void PythonRender::requireIdle() const {
    if (isBusy_)
        throw Error("cannot go on with this render: another thread does; start a render for each");
}

void PythonRender::work(double seconds, nb::handle progress, const std::function<void()>& finish) {
    requireIdle();
    isBusy_ = true;
    Watch watch(seconds, progress);
    std::exception_ptr failure;
    {
        const nb::gil_scoped_release release;
        try {
            takeSamples([&](double fraction) { return watch.goesOn(fraction); });
            if (job_->renderer->isDone() && job_->report.stop == StopReason::interrupted)
                takeSamples([](double) { return true; }); // the time was up with the last wave
            if (!watch.hasRaised())
                finish();
        } catch (...) {
            failure = std::current_exception();
        }
    }
    isBusy_ = false;
    watch.rethrow();
    if (failure)
        std::rethrow_exception(failure);
}

std::unique_ptr<PythonImage> PythonRender::advance(double seconds, nb::object progress) {
    std::unique_ptr<PythonImage> image;
    work(seconds, progress, [&] {
        FinishedImage finished = session_->image(*job_);
        const RenderReport& report = job_->report;
        image = std::make_unique<PythonImage>(ImageRecord{std::move(finished), exrMetadata(report),
                                                          reportJson(report),
                                                          report.stop != StopReason::interrupted});
    });
    return image;
}

void PythonRender::take(uint32_t first, uint32_t end) {
    requireIdle();
    const nb::gil_scoped_release release;
    session_->restart(*job_, {first, end});
    seconds_ = 0.0;
}

std::string PythonRender::film(nb::object progress) {
    std::string bytes;
    work(0.0, progress, [&] { bytes = filmBytes(job_->film()); });
    return bytes;
}

void declareRender(nb::module_& module) {
    using Words = std::vector<std::string>;
    nb::class_<PythonRender>(module, "Render")
        .def(
            "__init__",
            [](PythonRender* self, const PythonScene& scene, const Words& words, bool isProgressive) {
                new (self) PythonRender(scene, words, {.isProgressive = isProgressive});
            },
            nb::arg("scene"), nb::arg("words"), nb::arg("progressive"))
        .def_static(
            "of_part",
            [](const PythonScene& scene, const Words& words, bool hasGuides) {
                return std::make_unique<PythonRender>(
                    scene, words, PythonRender::Use{.isPart = true, .hasGuides = hasGuides});
            },
            nb::arg("scene"), nb::arg("words"), nb::arg("guides"))
        .def("take", &PythonRender::take, nb::arg("first"), nb::arg("end"))
        .def("advance", &PythonRender::advance, nb::arg("seconds"), nb::arg("progress").none())
        .def(
            "film",
            [](PythonRender& self, nb::object progress) {
                const std::string bytes = self.film(std::move(progress));
                return nb::bytes(bytes.data(), bytes.size());
            },
            nb::arg("progress").none());
}

} // namespace lavalight::python

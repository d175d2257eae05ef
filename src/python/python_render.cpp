#include "python/python_render.h"

#include <chrono>
#include <optional>
#include <utility>

#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "base/error.h"
#include "cli/options/picture_words.h"
#include "python/session_pool.h"

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

// Why no render may begin any more; empty: they may. With Python's lock.
std::string& reasonAgainstRenders() {
    static auto* reason = new std::string;
    return *reason;
}
bool hasOpenedDevice = false; // with Python's lock

} // namespace

void forbidRenders(const std::string& reason) {
    if (hasOpenedDevice)
        reasonAgainstRenders() = reason;
}

PythonRender::PythonRender(const PythonScene& scene, const std::vector<std::string>& words,
                           bool isProgressive) {
    if (!reasonAgainstRenders().empty())
        throw Error(reasonAgainstRenders());
    hasOpenedDevice = true;
    const std::shared_ptr<const Scene> loaded = scene.scene();
    const std::string name = scene.name();
    const LightingSettings lighting = scene.lighting();
    const ImportOptions moment = scene.moment();
    const nb::gil_scoped_release release;
    ParsedPicture parsed = parsePicture(name, words);
    parsed.plan.loaded = loaded;
    parsed.plan.settings.lighting = lighting;
    parsed.plan.settings.stop.isProgressive = isProgressive;
    device_ = parsed.plan.device;
    session_ = SessionPool::ofProcess().take(std::move(parsed.plan));
    Outputs pixels;
    pixels.png = "pixels"; // asks for them; no file is written
    job_ = session_->prepare(moment, pixels);
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

std::unique_ptr<PythonImage> PythonRender::advance(double seconds, nb::object progress) {
    if (std::exchange(isBusy_, true))
        throw Error("cannot go on with this render: another thread does; start a render for each");
    Watch watch(seconds, progress);
    std::unique_ptr<PythonImage> image;
    std::exception_ptr failure;
    {
        const nb::gil_scoped_release release;
        try {
            takeSamples([&](double fraction) { return watch.goesOn(fraction); });
            if (job_->renderer->isDone() && job_->report.stop == StopReason::interrupted)
                takeSamples([](double) { return true; }); // the time was up with the last wave
            FinishedImage finished = session_->image(*job_);
            image = std::make_unique<PythonImage>(std::move(finished), job_->report);
        } catch (...) {
            failure = std::current_exception();
        }
    }
    isBusy_ = false;
    watch.rethrow();
    if (failure)
        std::rethrow_exception(failure);
    return image;
}

void declareRender(nb::module_& module) {
    nb::class_<PythonRender>(module, "Render")
        .def(nb::init<const PythonScene&, const std::vector<std::string>&, bool>(), nb::arg("scene"),
             nb::arg("words"), nb::arg("progressive"))
        .def("advance", &PythonRender::advance, nb::arg("seconds"), nb::arg("progress").none());
}

} // namespace lavalight::python

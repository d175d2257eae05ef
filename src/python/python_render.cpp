#include "python/python_render.h"

#include <optional>
#include <utility>

#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "base/error.h"
#include "cli/options/picture_words.h"
#include "film/film_bytes.h"
#include "python/device_use.h"
#include "python/session_pool.h"
#include "python/text.h"
#include "python/watch.h"
#include "session/report.h"

namespace lavalight::python {

namespace nb = nanobind;

namespace {

// A scene as it was when a render of it began: Python may change it meanwhile.
struct SceneView {
    explicit SceneView(const PythonScene& of)
        : scene(of.scene()), name(of.name()), lighting(of.lighting()), moment(of.moment()) {}

    std::shared_ptr<const Scene> scene;
    std::string name;
    LightingSettings lighting;
    ImportOptions moment;
};

RenderPlan planOf(const SceneView& view, const std::vector<std::string>& words) {
    RenderPlan plan = parsePicture(view.name, words).plan;
    plan.loaded = view.scene;
    plan.settings.lighting = view.lighting;
    return plan;
}

// Asks for pixels; no file is written.
Outputs pixelsAlone() {
    Outputs outputs;
    outputs.png = "pixels";
    return outputs;
}

} // namespace

PythonRender::PythonRender(const PythonScene& scene, const std::vector<std::string>& words, Use use) {
    beginDeviceUse();
    const SceneView view(scene);
    const nb::gil_scoped_release release;
    RenderPlan plan = planOf(view, words);
    plan.settings.stop.isProgressive = use.isProgressive;
    if (use.hasGuides)
        plan.settings.layers |= kDenoisingLayers;
    open(std::move(plan));
    job_ = session_->prepare(view.moment, use.isPart ? Outputs() : pixelsAlone());
}

PythonRender::PythonRender(const PythonScene& first, const PythonScene& scene, const PythonScene* next,
                           const std::vector<std::string>& words) {
    beginDeviceUse();
    const SceneView ofFirst(first);
    const SceneView view(scene);
    std::optional<RenderSession::NextMoment> moment;
    if (next != nullptr)
        moment = RenderSession::NextMoment{next->moment(), {}, next->scene()};
    const nb::gil_scoped_release release;
    open(planOf(ofFirst, words));
    session_->follow(ofFirst.moment, view.scene);
    job_ = session_->prepare(view.moment, pixelsAlone(), moment);
}

void PythonRender::open(RenderPlan plan) {
    device_ = plan.device;
    session_ = SessionPool::ofProcess().take(std::move(plan));
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
        .def_static(
            "of_frame",
            [](const PythonScene& first, const PythonScene& scene, const PythonScene* next,
               const Words& words) { return std::make_unique<PythonRender>(first, scene, next, words); },
            nb::arg("first"), nb::arg("scene"), nb::arg("next").none(), nb::arg("words"))
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

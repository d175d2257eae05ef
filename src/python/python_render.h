// Renders under way, without Python's lock, that Ctrl-C ends.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>

#include "python/python_image.h"
#include "python/python_scene.h"
#include "session/render_session.h"

namespace lavalight::python {

class PythonRender {
  public:
    // What a render is for.
    struct Use {
        bool isProgressive = false; // every pixel soon has a sample
        bool isPart = false;        // film() alone is wanted of it, and no picture
        bool hasGuides = false;     // its film has what denoising reads
    };
    // Opens the device and compiles kernels. Throws Error or UsageError.
    PythonRender(const PythonScene& scene, const std::vector<std::string>& words, Use use);
    // A frame of an animation, whose camera, ground and size are those of its first one. `next`: the scene of
    // the frame that follows, for the layer of motion; null: there is no such layer.
    PythonRender(const PythonScene& first, const PythonScene& scene, const PythonScene* next,
                 const std::vector<std::string>& words);
    ~PythonRender();
    PythonRender(const PythonRender&) = delete;
    PythonRender& operator=(const PythonRender&) = delete;

    // Takes samples for so many seconds, or to the end where `seconds` is 0, and gives the image so far.
    // `progress`: called with the fraction done, or none. Throws what Python's signal handlers raise.
    [[nodiscard]] std::unique_ptr<PythonImage> advance(double seconds, nanobind::object progress);
    // Begins with other samples of each pixel, and an empty film.
    void take(uint32_t first, uint32_t end);
    // Takes all samples, and gives the bytes of their film.
    [[nodiscard]] std::string film(nanobind::object progress);

  private:
    // Takes samples as advance() does, and calls `finish` for what is to come of them, without Python's lock.
    void work(double seconds, nanobind::handle progress, const std::function<void()>& finish);
    void open(RenderPlan plan);
    void requireIdle() const;
    void takeSamples(const RenderJob::KeepGoing& keepGoing);

    gpu::DeviceConfig device_;
    std::unique_ptr<RenderSession> session_;
    std::optional<RenderJob> job_;
    double seconds_ = 0.0; // of rendering, so far
    bool isBusy_ = false;
};

// Declares the class in the module.
void declareRender(nanobind::module_& module);

} // namespace lavalight::python

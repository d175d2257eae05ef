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
    // Opens the device and compiles kernels. `isProgressive`: every pixel soon has a sample. Throws Error or
    // UsageError.
    PythonRender(const PythonScene& scene, const std::vector<std::string>& words, bool isProgressive);
    ~PythonRender();
    PythonRender(const PythonRender&) = delete;
    PythonRender& operator=(const PythonRender&) = delete;

    // Takes samples for so many seconds, or to the end where `seconds` is 0, and gives the image so far.
    // `progress`: called with the fraction done, or none. Throws what Python's signal handlers raise.
    [[nodiscard]] std::unique_ptr<PythonImage> advance(double seconds, nanobind::object progress);

  private:
    void takeSamples(const RenderJob::KeepGoing& keepGoing);

    gpu::DeviceConfig device_;
    std::unique_ptr<RenderSession> session_;
    std::optional<RenderJob> job_;
    double seconds_ = 0.0; // of rendering, so far
    bool isBusy_ = false;
};

// Makes every render of this process throw Error with that message, once a device has been opened in it.
void forbidRenders(const std::string& reason);

// Declares the class in the module.
void declareRender(nanobind::module_& module);

} // namespace lavalight::python

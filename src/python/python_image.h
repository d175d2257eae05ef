// An image in Python: arrays that view its memory, and the files that it can become.
#pragma once

#include <string>

#include <nanobind/nanobind.h>

#include "session/outputs.h"
#include "session/report.h"

namespace lavalight::python {

// Immutable once made, so that threads may share it and arrays may view it.
class PythonImage {
  public:
    PythonImage(FinishedImage image, RenderReport report)
        : image_(std::move(image)), report_(std::move(report)) {}

    [[nodiscard]] const Rendering& rendering() const { return image_.rendering; }
    [[nodiscard]] const FinishedImage& finished() const { return image_; }
    [[nodiscard]] const RenderReport& report() const { return report_; }
    // Whether all samples that were asked for are taken.
    [[nodiscard]] bool isComplete() const { return report_.stop != StopReason::interrupted; }

  private:
    FinishedImage image_;
    RenderReport report_;
};

// Declares the class in the module.
void declareImage(nanobind::module_& module);

} // namespace lavalight::python

// An image in Python: arrays that view its memory, and the files that it can become.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <utility>

#include <nanobind/nanobind.h>

#include "python/image_record.h"

namespace lavalight::python {

// Immutable as Python sees it, so that threads may share it and arrays may view it.
class PythonImage {
  public:
    explicit PythonImage(ImageRecord record) : record_(std::move(record)) {}

    [[nodiscard]] const Rendering& rendering() const { return record_.image.rendering; }
    [[nodiscard]] const FinishedImage& finished() const { return record_.image; }
    [[nodiscard]] const ImageRecord& record() const { return record_; }
    // Whether all samples that were asked for are taken.
    [[nodiscard]] bool isComplete() const { return record_.isComplete; }
    // sRGB with alpha. Those of a merged film are made when they are first asked for, on a device of this
    // process. Throws Error where it has none. Without Python's lock.
    [[nodiscard]] std::span<const uint32_t> pixels() const;

  private:
    mutable std::mutex mutex_; // of pixels that are being made
    mutable ImageRecord record_;
};

// Declares the class in the module.
void declareImage(nanobind::module_& module);

} // namespace lavalight::python

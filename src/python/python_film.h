// Films in Python: parts of an image on their way to being one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>

#include "film/film_merge.h"
#include "python/python_image.h"

namespace lavalight::python {

// Parts are added in the caller's order, by one thread at a time.
class PythonFilm {
  public:
    explicit PythonFilm(NamedFilm film) : film_(std::move(film)) {}

    [[nodiscard]] const NamedFilm& film() const { return film_; }
    // Joins a part with what is there. Throws Error as join() does.
    void add(const NamedFilm& part, Machines machines);
    // The image of what is there, by the options of a picture. Throws Error or UsageError.
    [[nodiscard]] std::unique_ptr<PythonImage> develop(std::vector<std::string> words, bool holdsFilm,
                                                       bool isComplete) const;

  private:
    NamedFilm film_;
};

// Declares the class in the module.
void declareFilm(nanobind::module_& module);

} // namespace lavalight::python

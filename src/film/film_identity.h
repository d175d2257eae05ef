// Whether two films hold samples of the same image.
#pragma once

#include <string>
#include <vector>

#include "image/exr.h"

namespace lavalight {

// A header of exrMetadata(), and what to call the film that it belongs to.
struct FilmHeader {
    const Metadata& metadata;
    std::string name;
};

// Which machines may take samples of one film: those of one kind, whose samples have equal bits, or any,
// whose samples have equal means.
enum class Machines { ofOneKind, any };

// What differs between two headers of what decides the bits of samples, with both values, in one line:
// version, machine, settings, scene, view, shaders, accelerator. Empty if nothing does. Where the content of
// the scene differs, so may its name, which alone does not count; `alsoDecisive`: names of further options
// that do.
[[nodiscard]] std::string differences(const FilmHeader& a, const FilmHeader& b,
                                      const std::vector<std::string>& alsoDecisive = {},
                                      Machines machines = Machines::ofOneKind);

} // namespace lavalight

// From a renderer to a film file and back.
#pragma once

#include <string>

#include "film/film_cost.h"
#include "film/film_file.h"
#include "film/film_identity.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "session/report.h"

namespace lavalight {

// The renderer's film as it is, with its header. The report holds the inputs, seconds and rays so far, and,
// if it has stopped, why.
[[nodiscard]] FilmFile recordFilm(const Renderer& renderer, const Scene& scene, RenderReport report);

// Lets the renderer go on where the film of the file `name` stands; the report holds the renderer's inputs.
// Throws Error, naming what differs, where that film has other samples than the renderer would take.
// `machines`: of which kind those may be that took them.
void continueFilm(Renderer& renderer, const FilmFile& file, const std::string& name,
                  const RenderReport& report, Machines machines);

} // namespace lavalight

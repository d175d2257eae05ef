// A scene in Python: loaded once, rendered as often as one likes.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>

#include "gltf/import_options.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight::python {

class PythonScene {
  public:
    // By name or path, with options of scene and light. Throws Error or UsageError.
    PythonScene(const std::string& nameOrPath, const std::vector<std::string>& words);
    // From the bytes of a .glb file.
    PythonScene(const std::string& name, std::string_view bytes, const std::vector<std::string>& words);

    [[nodiscard]] std::shared_ptr<const Scene> scene() const { return scene_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const LightingSettings& lighting() const { return lighting_; }
    [[nodiscard]] const ImportOptions& moment() const { return moment_; }
    // A material for a change of the property of that name. Renders that are under way keep the scene that
    // they began with.
    [[nodiscard]] Material& change(size_t material, const std::string& property);
    // Which properties of which materials were changed.
    using Changes = std::set<std::pair<size_t, std::string>>;
    [[nodiscard]] const Changes& changes() const { return changes_; }
    // What headers call the environment map, wherever it was read from.
    void nameEnvironment(const std::string& name) { lighting_.mapFile = name; }

  private:
    std::string name_;
    LightingSettings lighting_;
    ImportOptions moment_;
    std::shared_ptr<Scene> scene_;
    Changes changes_;
};

// Declares scenes, their materials, and renders in the module.
void declareScene(nanobind::module_& module);

} // namespace lavalight::python

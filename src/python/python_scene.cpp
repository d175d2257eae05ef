#include "python/python_scene.h"

#include <array>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "base/error.h"
#include "cli/options/picture_words.h"
#include "gltf/import.h"
#include "python/text.h"
#include "scene/world_position.h"
#include "session/camera_choice.h"
#include "session/lit_scene.h"

namespace lavalight::python {

namespace nb = nanobind;

namespace {

using Vector3 = std::array<float, 3>;
using Place = std::array<double, 3>;

// A material of a scene by its number: a view that stays right when the scene's memory moves.
struct MaterialView {
    nb::object owner; // a PythonScene
    size_t index;

    [[nodiscard]] PythonScene& scene() const { return nb::cast<PythonScene&>(owner); }
    [[nodiscard]] const Material& get() const { return scene().scene()->materials.at(index); }
    [[nodiscard]] Material& change(const char* property) const { return scene().change(index, property); }
};

void requireIn(const char* name, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw UsageError(fmt::format("{}: {:g} is not from {:g} to {:g}", name, value, least, most));
}

// A number of a material that stays within a range.
template <float Material::*Member>
void defineNumber(nb::class_<MaterialView>& view, const char* name, double least, double most) {
    view.def_prop_rw(
        name, [](const MaterialView& material) { return material.get().*Member; },
        [=](const MaterialView& material, float value) {
            requireIn(name, value, least, most);
            material.change(name).*Member = value;
        });
}

// A colour, or a radiance where `most` is above 1.
template <glm::vec3 Material::*Member>
void defineColor(nb::class_<MaterialView>& view, const char* name, double most) {
    view.def_prop_rw(
        name,
        [](const MaterialView& material) {
            const glm::vec3& value = material.get().*Member;
            return Vector3{value.x, value.y, value.z};
        },
        [=](const MaterialView& material, Vector3 value) {
            for (const float channel : value)
                requireIn(name, channel, 0.0, most);
            material.change(name).*Member = {value[0], value[1], value[2]};
        });
}

void declareMaterial(nb::module_& module) {
    nb::class_<MaterialView> view(module, "Material");
    view.def_prop_ro("name", [](const MaterialView& material) { return material.get().name; });
    defineColor<&Material::baseColor>(view, "base_color", 1.0);
    defineNumber<&Material::metallic>(view, "metallic", 0.0, 1.0);
    defineNumber<&Material::roughness>(view, "roughness", 0.0, 1.0);
    defineColor<&Material::emission>(view, "emission", 1e30);
    defineNumber<&Material::ior>(view, "ior", 1.0, 100.0);
    defineNumber<&Material::specular>(view, "specular", 0.0, 1.0);
    defineNumber<&Material::transmission>(view, "transmission", 0.0, 1.0);
    defineNumber<&Material::clearcoat>(view, "clearcoat", 0.0, 1.0);
    defineNumber<&Material::clearcoatRoughness>(view, "clearcoat_roughness", 0.0, 1.0);
    defineColor<&Material::sheenColor>(view, "sheen_color", 1.0);
    defineNumber<&Material::sheenRoughness>(view, "sheen_roughness", 0.0, 1.0);
}

std::vector<MaterialView> materialsOf(nb::handle self) {
    std::vector<MaterialView> views;
    for (size_t i = 0; i < nb::cast<PythonScene&>(self).scene()->materials.size(); ++i)
        views.push_back({nb::borrow(self), i});
    return views;
}

Place toPlace(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
Vector3 toVector(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

std::vector<std::string> cameraNames(const PythonScene& scene) {
    std::vector<std::string> names;
    if (scene.scene()->hasOwnCamera)
        for (const Camera& camera : scene.scene()->cameras)
            names.push_back(camera.name);
    return names;
}

// Name, place, direction of view, up, and vertical field of view in degrees.
using PlacedView = std::tuple<std::string, Place, Vector3, Vector3, double>;

std::vector<PlacedView> perspectiveCameras(const PythonScene& scene) {
    std::vector<PlacedView> views;
    const Scene& loaded = *scene.scene();
    for (const Camera& camera : loaded.cameras)
        if (loaded.hasOwnCamera && camera.projection == Projection::perspective)
            views.emplace_back(camera.name, toPlace(toWorld(camera.position, loaded.origin)),
                               toVector(camera.forward), toVector(camera.up),
                               glm::degrees(double{camera.verticalFov}));
    return views;
}

std::vector<std::pair<std::string, float>> animationsOf(const PythonScene& scene) {
    std::vector<std::pair<std::string, float>> animations;
    for (const Animation& animation : scene.scene()->animations)
        animations.emplace_back(animation.name, animation.seconds);
    return animations;
}

} // namespace

PythonScene::PythonScene(const std::string& nameOrPath, const std::vector<std::string>& words)
    : name_(nameOrPath) {
    const nb::gil_scoped_release release;
    const ParsedPicture parsed = parsePicture(nameOrPath, words);
    lighting_ = parsed.plan.settings.lighting;
    moment_ = parsed.moment;
    scene_ =
        std::make_shared<Scene>(loadLitScene(nameOrPath, seenFrom(parsed.plan.camera, moment_), lighting_));
}

PythonScene::PythonScene(const std::string& name, std::string_view bytes,
                         const std::vector<std::string>& words)
    : name_(name) {
    const nb::gil_scoped_release release;
    const ParsedPicture parsed = parsePicture(name, words);
    lighting_ = parsed.plan.settings.lighting;
    moment_ = parsed.moment;
    Scene scene = importGltf(name, bytes, seenFrom(parsed.plan.camera, moment_));
    lightScene(scene, lighting_);
    scene_ = std::make_shared<Scene>(std::move(scene));
}

Material& PythonScene::change(size_t material, const std::string& property) {
    if (scene_.use_count() > 1)
        scene_ = std::make_shared<Scene>(*scene_);
    changes_.emplace(material, property);
    return scene_->materials.at(material);
}

void declareScene(nb::module_& module) {
    declareMaterial(module);
    nb::class_<PythonScene>(module, "Scene")
        .def(nb::init<const std::string&, const std::vector<std::string>&>(), nb::arg("name"),
             nb::arg("words"))
        .def_static(
            "from_bytes",
            [](const std::string& name, nb::bytes bytes, const std::vector<std::string>& words) {
                return new PythonScene(name, std::string_view(bytes.c_str(), bytes.size()), words);
            },
            nb::arg("name"), nb::arg("data"), nb::arg("words"))
        .def_prop_ro("name", &PythonScene::name)
        .def_prop_ro("environment", [](const PythonScene& scene) { return scene.lighting().mapFile; })
        .def("name_environment", &PythonScene::nameEnvironment, nb::arg("name"))
        .def_prop_ro("changes",
                     [](const PythonScene& scene) {
                         const PythonScene::Changes& changes = scene.changes();
                         return std::vector<std::pair<size_t, std::string>>(changes.begin(), changes.end());
                     })
        .def_prop_ro("warnings", [](const PythonScene& scene) { return scene.scene()->warnings; })
        .def_prop_ro("triangles", [](const PythonScene& scene) { return scene.scene()->triangleCount(); })
        .def_prop_ro("materials", &materialsOf)
        .def_prop_ro("cameras", &cameraNames)
        .def_prop_ro("perspective_cameras", &perspectiveCameras)
        .def_prop_ro("variants", [](const PythonScene& scene) { return scene.scene()->variants; })
        .def_prop_ro("scenes", [](const PythonScene& scene) { return scene.scene()->scenes; })
        .def_prop_ro("animations", &animationsOf)
        .def_prop_ro("has_own_light", [](const PythonScene& scene) { return scene.scene()->hasOwnLight; })
        .def_prop_ro("bounds", [](const PythonScene& scene) {
            const Scene& s = *scene.scene();
            return std::pair(toPlace(glm::dvec3(s.bounds.lower) + s.origin),
                             toPlace(glm::dvec3(s.bounds.upper) + s.origin));
        });
}

} // namespace lavalight::python

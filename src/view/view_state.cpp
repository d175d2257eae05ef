#include "view/view_state.h"

#include <algorithm>

#include "scene/world_position.h"

namespace lavalight {

// A camera of the scene is taken from the scene again, which has it in full.
void moveOrigin(ViewState& view, const Scene& before) {
    const glm::dvec3 way = view.scene->origin - before.origin;
    const bool isAtHome = view.rig.camera() == view.home;
    const std::vector<Camera>& cameras = view.scene->cameras;
    const auto home = static_cast<size_t>(std::find(before.cameras.begin(), before.cameras.end(), view.home) -
                                          before.cameras.begin());
    view.rig.moveOrigin(way);
    view.home.position = fromWorld(glm::dvec3(view.home.position), way);
    if (home < std::min(cameras.size(), before.cameras.size()))
        view.home = cameras[home];
    if (isAtHome)
        view.rig = CameraRig(view.home, view.scene->bounds);
}

void stepShown(ViewState& view, size_t side, int steps) {
    view.shown[side] = stepped(view.shown[side], steps, view.whyNotDenoised.empty());
}

void toggleDenoised(ViewState& view, size_t side) {
    if (view.whyNotDenoised.empty())
        view.shown[side] = view.shown[side].isDenoised ? ShownLayer{} : kDenoisedColor;
}

void askForPlanes(ViewState& view) {
    for (size_t side = 0; side < (view.isSplit ? 2u : 1u); ++side) {
        view.settings.layers |= planesFor(view.shown[side]);
        if (!view.shown[side].isDenoised)
            view.asked |= planesFor(view.shown[side]);
    }
}

} // namespace lavalight

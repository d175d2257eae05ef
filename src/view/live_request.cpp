#include "view/live_request.h"

#include "render/renderer.h"

namespace lavalight {

Restart restartsImage(const LiveRequest& a, const LiveRequest& b) {
    if (a.scene != b.scene || !keepsLights(a.settings, b.settings))
        return Restart::scene;
    if (a.camera != b.camera || a.settings != b.settings || a.shaders != b.shaders ||
        a.isMoving != b.isMoving)
        return Restart::image;
    return Restart::nothing;
}

} // namespace lavalight

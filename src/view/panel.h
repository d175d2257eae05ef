// The window's panels, put together.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "view/live_picture.h"
#include "view/view_state.h"

namespace lavalight {

struct PanelAnswer {
    bool wantsSave = false;
    bool wantsScene = false; // read again, for its variant or moment
};

// The main panel, with the statistics of both sides as far as there are any.
[[nodiscard]] PanelAnswer
drawPanel(ViewState& view,
          const std::pair<std::optional<LiveStatistics>, std::optional<LiveStatistics>>& statistics);

// The inspector's window. Whether another sample's path is asked for.
bool drawInspector(const PixelInspection& inspection, uint32_t& sample);

// The line between two images, to be dragged.
void drawSplit(ViewState& view, const glm::vec2& window);

// What keys and mouse do.
void drawKeys(bool& isOpen);

// Messages with whether each is an error, until they are closed.
void drawMessages(std::vector<std::pair<std::string, bool>>& messages, const glm::vec2& window);

} // namespace lavalight

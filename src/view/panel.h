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
    bool wantsScene = false; // the scene is to be read again, for its variant or moment
};

// Draws the main panel, with the statistics of both sides as far as there are any.
[[nodiscard]] PanelAnswer
drawPanel(ViewState& view,
          const std::pair<std::optional<LiveStatistics>, std::optional<LiveStatistics>>& statistics);

// Draws the inspector's window. Returns whether another sample's path is asked for.
bool drawInspector(const PixelInspection& inspection, uint32_t& sample);

// Draws the line between two images, to be dragged.
void drawSplit(ViewState& view, const glm::vec2& window);

// Draws what keys and mouse do.
void drawKeys(bool& isOpen);

// Draws messages, each with whether it is an error, until they are closed.
void drawMessages(std::vector<std::pair<std::string, bool>>& messages, const glm::vec2& window);

} // namespace lavalight

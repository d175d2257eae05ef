// `lavalight merge`: parts of an image in, the image out.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "film/film_merge.h"

namespace lavalight {

class MergeCommand : public Command {
  public:
    explicit MergeCommand(CLI::App& app);
    [[nodiscard]] int run() override;

  private:
    [[nodiscard]] NamedFilm joined() const;

    std::vector<std::string> parts_;
    std::string output_;
    bool isStatistical_ = false;
};

} // namespace lavalight

// `lavalight compare`: how far one image is from another.
#pragma once

#include <string>

#include "app/command.h"

namespace lavalight {

class CompareCommand : public Command {
  public:
    explicit CompareCommand(CLI::App& app);
    // Prints the errors of the first image against the second; 1 if relMSE is not within the threshold.
    [[nodiscard]] int run() override;

  private:
    std::string image_;
    std::string reference_;
    double threshold_ =
        0.01; // relMSE; two unrelated images are around 1, two noisy renders of one scene below 0.1
    bool json_ = false;
};

} // namespace lavalight

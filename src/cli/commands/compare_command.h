// `lavalight compare`: whether one image may pass for another, for people and for continuous integration.
#pragma once

#include <string>

#include "cli/command.h"
#include "compare/comparison.h"

namespace lavalight {

class CompareCommand : public Command {
  public:
    explicit CompareCommand(CLI::App& app);
    // Prints how far the first image is from the second: 0 equal, 1 different. What cannot be compared throws
    // Error.
    [[nodiscard]] int run() override;
    [[nodiscard]] int failureCode() const override { return 3; }

  private:
    [[nodiscard]] Criteria criteria();
    void requireOutputsApart() const;
    void writeFiles(const Comparison& comparison, const ComparedImage& image,
                    const ComparedImage& reference) const;

    std::string image_;
    std::string reference_;
    double relMse_ = kDefaultRelMse;
    double flip_ = 0.0;
    bool isZTested_ = false;
    double significance_ = kDefaultSignificance;
    std::string heatmap_;
    std::string html_;
    bool json_ = false;
};

} // namespace lavalight

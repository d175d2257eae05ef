// `lavalight lab`: the lectures' experiments, computed by kernels.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/command.h"
#include "cli/options/device_options.h"
#include "lab/experiment.h"

namespace lavalight {

class LabCommand : public Command {
  public:
    explicit LabCommand(CLI::App& app);
    // Prints the tables of the chosen experiment, or the experiments there are.
    [[nodiscard]] int run() override;

  private:
    void list() const;
    void print(const Experiment& experiment, const gpu::Device& device,
               const std::vector<Table>& tables) const;

    std::string experiment_ = "list";
    LabOptions options_;
    std::optional<DeviceOptions> deviceOptions_; // always there
    bool json_ = false;
    bool csv_ = false;
};

} // namespace lavalight

// The experiments of the lab: the lectures' examples, each a question that its tables answer.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lab/lab_device.h"
#include "lab/table.h"

namespace lavalight {

struct LabOptions {
    uint64_t samples = 0;
    uint32_t seed = 0;
};

struct Experiment {
    std::string_view name;
    std::string_view question;
    std::string_view sampleUnit; // what LabOptions::samples counts
    uint64_t defaultSamples;
    uint64_t leastSamples;
    uint64_t mostSamples;
    std::vector<Table> (*run)(const LabDevice& lab, const LabOptions& options);
};

// All experiments, in the order of the lectures.
[[nodiscard]] std::span<const Experiment> experiments();

// Finds an experiment by name. Throws UsageError naming the experiments there are.
[[nodiscard]] const Experiment& findExperiment(std::string_view name);

// Equal options give equal tables on one device and driver, but for times. `samples` 0 asks for the default.
// Throws UsageError where `samples` is out of the experiment's range, and what lab.betweenPasses throws.
[[nodiscard]] std::vector<Table> runExperiment(const Experiment& experiment, const LabDevice& lab,
                                               LabOptions options);

// The experiments themselves, one a file.
[[nodiscard]] std::vector<Table> runDice(const LabDevice& lab, const LabOptions& options);
[[nodiscard]] std::vector<Table> runStrata(const LabDevice& lab, const LabOptions& options);
[[nodiscard]] std::vector<Table> runHemisphere(const LabDevice& lab, const LabOptions& options);
[[nodiscard]] std::vector<Table> runLights(const LabDevice& lab, const LabOptions& options);
[[nodiscard]] std::vector<Table> runRoulette(const LabDevice& lab, const LabOptions& options);
[[nodiscard]] std::vector<Table> runMis(const LabDevice& lab, const LabOptions& options);
[[nodiscard]] std::vector<Table> runSurvival(const LabDevice& lab, const LabOptions& options);
[[nodiscard]] std::vector<Table> runFresnel(const LabDevice& lab, const LabOptions& options);
[[nodiscard]] std::vector<Table> runSampler(const LabDevice& lab, const LabOptions& options);

} // namespace lavalight

#include "cli/commands/lab_command.h"

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace lavalight {

LabCommand::LabCommand(CLI::App& app)
    : Command(app, "lab", "The lectures' experiments, computed on the device") {
    parser()
        .add_option("experiment", experiment_, "What to run; list describes the experiments")
        ->type_name("EXPERIMENT");
    CLI::Option* json = parser().add_flag("--json", json_, "Print JSON");
    parser().add_flag("--csv", csv_, "Print CSV")->excludes(json);
    parser()
        .add_option("--samples", options_.samples,
                    "Samples of each estimate; 0: as many as the experiment likes")
        ->type_name("N");
    parser().add_option("--seed", options_.seed, "Another seed gives other noise")->type_name("N");
    deviceOptions_.emplace(parser());
}

int LabCommand::run() {
    if (experiment_ == "list") {
        list();
        return 0;
    }
    const Experiment& experiment = findExperiment(experiment_);
    gpu::Device device(deviceOptions_->config());
    const std::vector<Table> tables = runExperiment(experiment, {device}, options_);
    device.requireNoValidationMessages();
    print(experiment, device, tables);
    return 0;
}

void LabCommand::list() const {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    if (csv_)
        fmt::print("experiment,samples\n");
    for (const Experiment& e : experiments()) {
        if (json_)
            json.push_back({{"experiment", e.name},
                            {"question", e.question},
                            {"samples", e.defaultSamples},
                            {"sampleUnit", e.sampleUnit}});
        else if (csv_)
            fmt::print("{},{}\n", e.name, e.defaultSamples);
        else
            fmt::print("{:<11} {}\n{:<11} --samples {} to {} {}; default {}\n", e.name, e.question, "",
                       e.leastSamples, e.mostSamples, e.sampleUnit, e.defaultSamples);
    }
    if (json_)
        fmt::print("{}\n", json.dump(2));
}

void LabCommand::print(const Experiment& experiment, const gpu::Device& device,
                       const std::vector<Table>& tables) const {
    if (csv_) {
        fmt::print("{}", tablesCsv(tables));
        return;
    }
    if (!json_) {
        for (size_t i = 0; i < tables.size(); ++i)
            fmt::print("{}{}", i > 0 ? "\n" : "", tableText(tables[i]));
        return;
    }
    nlohmann::ordered_json json = {
        {"experiment", experiment.name},
        {"question", experiment.question},
        {"seed", options_.seed},
        {"device", {{"name", device.description().name}, {"driver", device.description().driver}}},
        {"tables", nlohmann::ordered_json::array()}};
    for (const Table& table : tables)
        json["tables"].push_back(tableJson(table));
    fmt::print("{}\n", json.dump(2));
}

} // namespace lavalight

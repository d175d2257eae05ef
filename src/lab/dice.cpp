// The lecture's dice: the mean of 6 * D1 + D2, compared at equal numbers of rolls.
#include <array>

#include <fmt/format.h>

#include "lab/experiment.h"
#include "lab/sample_kernel.h"
#include "lab/theory.h"

namespace lavalight {
namespace {

// How the mean is estimated: by both dice, or by one, the sixfold one with probability p.
struct DiceWay {
    std::string name;
    uint32_t kind = kDieAtATime;
    double p = 0.5;
};

EstimatorRow rowOf(const DiceWay& way, const SampleKernel& kernel, const LabOptions& options) {
    const bool isTogether = way.kind == kDiceTogether;
    const uint64_t rollsEach = isTogether ? 2 : 1;
    LabRun run{};
    run.seed = options.seed;
    run.kind = way.kind;
    run.a.x = static_cast<float>(way.p);
    const Moments m = kernel.estimate(run, options.samples / rollsEach);
    const Theory theory = isTogether ? diceTogether() : dieAtATime(way.p);
    EstimatorRow row = estimatorRow(way.name, m, theory, static_cast<double>(rollsEach));
    row.more = {m.count * rollsEach, theory.variance * static_cast<double>(rollsEach)};
    return row;
}

} // namespace

std::vector<Table> runDice(const LabDevice& lab, const LabOptions& options) {
    const SampleKernel kernel(lab, "lab/dice");
    const double best = bestDieProbability();
    const std::array<DiceWay, 5> ways{
        {{"both dice", kDiceTogether, 0.0},
         {"one die, sixfold with p = 0.5", kDieAtATime, 0.5},
         {"one die, sixfold with p = 0.8", kDieAtATime, 0.8},
         {"one die, sixfold with p = 0.2", kDieAtATime, 0.2},
         {fmt::format("one die, sixfold with p = {:.4f}", best), kDieAtATime, best}}};
    std::vector<EstimatorRow> rows;
    rows.reserve(ways.size());
    for (const DiceWay& way : ways)
        rows.push_back(rowOf(way, kernel, options));
    Table table = estimatorTable("dice", "Mean of 6 * D1 + D2 of two dice, at equal numbers of rolls", rows,
                                 {{"rolls", "rolls"}, {"theoryVariancePerRoll", "theory a roll"}});
    table.notes = {
        "A sample of one die is 6 * D1 / p or D2 / (1 - p). Any p between 0 and 1 has the right mean.",
        "The ratio compares at equal numbers of rolls: \"both dice\" takes two a sample.",
        "p = 0.2 is the slide's code, which gives 0.8 to the wrong die. It is unbiased, but the sixfold die, "
        "which brings "
        "6/7 of the mean, is rolled one time in five and then counts 30 D1: few, large samples.",
        fmt::format("p = 6/7 is the best: the variance is E[36 D^2] / p + E[D^2] / (1 - p) - mean^2, least "
                    "for p : (1 - p) "
                    "= 6 : 1. It beats rolling both dice, {:.1f} against {:.1f} a roll: a roll of the plain "
                    "die is rarely "
                    "worth its price.",
                    dieAtATime(best).variance, 2.0 * diceTogether().variance)};
    return {table};
}

} // namespace lavalight

// A one-dimensional integral by strata, whose number goes to infinity.
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "lab/experiment.h"
#include "lab/sample_kernel.h"
#include "lab/theory.h"

namespace lavalight {
namespace {

// Probabilities proportional to weight(i) for `count` strata.
std::vector<float> normalised(uint32_t count, const std::function<double(uint32_t)>& weight) {
    double sum = 0.0;
    for (uint32_t i = 0; i < count; ++i)
        sum += weight(i);
    std::vector<float> pmf;
    for (uint32_t i = 0; i < count; ++i)
        pmf.push_back(static_cast<float>(weight(i) / sum));
    return pmf;
}

std::vector<float> uniformPmf(uint32_t count) {
    return normalised(count, [](uint32_t) { return 1.0; });
}

// Strata picked by the integrand in their middle, which is all that one knows without its integral.
std::vector<float> functionPmf(uint32_t count) {
    return normalised(count, [count](uint32_t i) { return std::exp(kStrataRate * (i + 0.5) / count); });
}

// Strata picked against the integrand, an odd choice: the first one is the likeliest.
std::vector<float> backwardsPmf(uint32_t count) {
    return normalised(count, [count](uint32_t i) { return static_cast<double>(count - i); });
}

class StrataRows {
  public:
    StrataRows(const LabDevice& lab, const LabOptions& options)
        : kernel_(lab, "lab/strata"), seed_(options.seed), evaluations_(options.samples) {}

    void addPicked(const std::string& name, const std::vector<float>& pmf) {
        const auto count = static_cast<uint32_t>(pmf.size());
        add(name, {kStrataPicked, count, 1}, strataPicked(pmf), pmf);
    }
    void addEach(const std::string& name, uint32_t count) {
        add(name, {kStrataEach, count, count}, strataEach(count), uniformPmf(count));
    }
    void addPdf(const std::string& name) {
        add(name, {kStrataPdf, 1, 1}, {strataEach(1).mean, 0.0}, uniformPmf(1));
    }

    [[nodiscard]] const std::vector<EstimatorRow>& rows() const { return rows_; }

  private:
    struct Way {
        uint32_t kind;
        uint32_t count;
        uint32_t evaluationsEach;
    };

    void add(const std::string& name, const Way& way, const Theory& theory, const std::vector<float>& pmf) {
        LabRun run{};
        run.seed = seed_;
        run.kind = way.kind;
        run.count = way.count;
        const Moments m = kernel_.estimate(run, evaluations_ / way.evaluationsEach, pmf);
        rows_.push_back(estimatorRow(name, m, theory, static_cast<double>(way.evaluationsEach)));
        rows_.back().more = {m.count * way.evaluationsEach};
    }

    SampleKernel kernel_;
    uint32_t seed_;
    uint64_t evaluations_;
    std::vector<EstimatorRow> rows_;
};

} // namespace

std::vector<Table> runStrata(const LabDevice& lab, const LabOptions& options) {
    StrataRows rows(lab, options);
    rows.addPicked("1 stratum", uniformPmf(1));
    for (const uint32_t count : {8u, 64u})
        rows.addPicked(fmt::format("{} strata, uniform", count), uniformPmf(count));
    for (const uint32_t count : {8u, 64u})
        rows.addPicked(fmt::format("{} strata, by the function", count), functionPmf(count));
    rows.addPdf("infinitely many: the pdf");
    rows.addPicked("8 strata, backwards (8 7 .. 1)", backwardsPmf(8));
    for (const uint32_t count : {8u, 64u})
        rows.addEach(fmt::format("a point in each of {} strata", count), count);
    Table table = estimatorTable(
        "strata",
        fmt::format("Integral of exp({} x) over [0, 1], at equal numbers of evaluations", kStrataRate),
        rows.rows(), {{"evaluations", "evaluations"}});
    table.notes = {
        "A stratum i is picked with probability p_i, then a point in it; the sample is f(x) / (n p_i).",
        "Uniform picking gains nothing, however many strata: the point is as random as before.",
        ("Probabilities that follow the function leave only the variance within strata. In the limit they "
         "are the pdf f / integral, sampled by inverting its cumulative function, and every sample is "
         "the integral: variance 0, up to rounding. (Who can do that needs no sampling; in practice the "
         "pdf follows the function as far as it is known.)"),
        "The backwards probabilities are a bad choice, yet unbiased like any others that are nowhere zero.",
        ("One point in each stratum, the classical stratification, takes the variance between strata away "
         "without any knowledge of the function.")};
    return {table};
}

} // namespace lavalight

#include "cli/commands/merge_command.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "session/outputs.h"

namespace lavalight {
namespace {

constexpr size_t kBytesAtOnce = 256u << 20; // of films that are read and not added yet
constexpr size_t kMostAtOnce = 16;

} // namespace

MergeCommand::MergeCommand(CLI::App& app)
    : Command(app, "merge",
              "Join renders of disjoint --samples A:B ranges: the bits of one render of all samples") {
    parser()
        .add_option("parts", parts_, "Images of render --samples, of merge, or finished checkpoints")
        ->type_name("PART.exr")
        ->default_str("")
        ->required();
    parser()
        .add_option("-o,--output", output_, "EXR file; it can be merged again")
        ->type_name("OUT.exr")
        ->required();
    parser().add_flag(
        "--statistical", isStatistical_,
        "Join parts of different devices, drivers and processors, too: their means are equal, their bits are "
        "not; the ledger names each kind");
}

// Reading takes most of the time: several parts are read at once, as many as suit the memory.
NamedFilm MergeCommand::joined() const {
    const Machines machines = isStatistical_ ? Machines::any : Machines::ofOneKind;
    NamedFilm sum{parts_.front(), readFilmFile(parts_.front())};
    const size_t bytes = std::max<size_t>(sum.file.film.words.size() * sizeof(uint32_t), 1);
    const size_t atOnce = std::clamp<size_t>(kBytesAtOnce / bytes, 1, kMostAtOnce);
    for (size_t first = 1; first < parts_.size(); first += atOnce) {
        std::vector<FilmFile> films(std::min(atOnce, parts_.size() - first));
        forEachInParallel(films.size(), [&](size_t i) { films[i] = readFilmFile(parts_[first + i]); });
        for (size_t i = 0; i < films.size(); ++i) {
            join(sum, {parts_[first + i], std::move(films[i])}, machines);
            sum.name = fmt::format("{} to {}", parts_.front(), parts_[first + i]);
        }
    }
    return sum;
}

int MergeCommand::run() {
    if (parts_.size() < 2)
        throw UsageError("merge: one image has nothing to be joined with; give two or more");
    InputFiles inputs;
    for (const std::string& part : parts_)
        inputs.add(part, "one of the parts");
    Outputs outputs;
    addPicture(outputs, output_, "-o");
    if (outputs.exr.empty())
        throw UsageError(fmt::format("-o: {} does not end in .exr; give the name of an EXR file", output_));
    requireApart(outputs, inputs);
    requireWritable(output_);
    const NamedFilm sum = joined();
    const SampleRanges& ranges = sum.file.ranges;
    if (ranges.size() > 1)
        spdlog::warn("the samples {} have gaps: {} holds only these", textOf(ranges), output_);
    writeFilmFile(output_, sum.file);
    fmt::print("{}: {}x{}, samples {} of {} files, bias ledger: {}\n", output_, sum.file.film.width,
               sum.file.film.height, textOf(ranges), parts_.size(),
               valueOf(sum.file.metadata, "bias-ledger"));
    return 0;
}

} // namespace lavalight

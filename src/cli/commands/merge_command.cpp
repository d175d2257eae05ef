#include "cli/commands/merge_command.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "film/film_merge.h"
#include "session/outputs.h"

namespace lavalight {

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

int MergeCommand::run() {
    if (parts_.size() < 2)
        throw UsageError("merge: one image has nothing to be joined with; give two or more");
    InputFiles inputs;
    for (const std::string& part : parts_)
        inputs.add(part, "one of the parts");
    Outputs outputs;
    addPicture(outputs, output_, "-o");
    if (outputs.exr.empty())
        throw UsageError(fmt::format("-o: {} is no .exr file, which parts are joined in", output_));
    requireApart(outputs, inputs);
    requireWritable(output_);
    NamedFilm sum{parts_.front(), readFilmFile(parts_.front())};
    const Machines machines = isStatistical_ ? Machines::any : Machines::ofOneKind;
    for (size_t i = 1; i < parts_.size(); ++i) {
        join(sum, {parts_[i], readFilmFile(parts_[i])}, machines);
        sum.name = fmt::format("{} to {}", parts_.front(), parts_[i]);
    }
    const SampleRanges& ranges = sum.file.ranges;
    if (ranges.size() > 1)
        spdlog::warn("the samples {} leave gaps: {} holds what there is", textOf(ranges), output_);
    writeFilmFile(output_, sum.file);
    fmt::print("{}: {}x{}, samples {} of {} files, bias ledger: {}\n", output_, sum.file.film.width,
               sum.file.film.height, textOf(ranges), parts_.size(),
               valueOf(sum.file.metadata, "bias-ledger"));
    return 0;
}

} // namespace lavalight

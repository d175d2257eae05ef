#include "cli/commands/split_command.h"

#include <array>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "base/error.h"
#include "cli/options/given_options.h"
#include "cli/options/named_option.h"
#include "session/builtin.h"
#include "session/render_session.h"
#include "split/split_bundle.h"
#include "split/split_job.h"

namespace lavalight {

template <>
std::span<const SettingName<SplitEngine>> settingNames<SplitEngine>() {
    static constexpr std::array<SettingName<SplitEngine>, 3> kNames{
        {{"shell", SplitEngine::shell}, {"slurm", SplitEngine::slurm}, {"github", SplitEngine::github}}};
    return kNames;
}

namespace {

namespace fs = std::filesystem;

// A folder in the making, which gets its name when all is in it; else it is removed.
class NewFolder {
  public:
    explicit NewFolder(const fs::path& name) : name_(name) {
        path_ = fs::path(name_.string() + fmt::format(".{}.part", ::getpid()));
        std::error_code code;
        if (fs::exists(name_, code) && !(fs::is_directory(name_, code) && fs::is_empty(name_, code)))
            throw Error(
                fmt::format("cannot write {}: it is there already; try another folder", name_.string()));
        fs::create_directories(path_, code);
        if (code)
            throw Error(fmt::format("cannot write {}: {}", name_.string(), code.message()));
    }
    ~NewFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }
    void finish() const {
        std::error_code code;
        fs::rename(path_, name_, code);
        if (code)
            throw Error(fmt::format("cannot write {}: {}", name_.string(), code.message()));
    }

  private:
    fs::path name_;
    fs::path path_;
};

} // namespace

SplitCommand::SplitCommand(CLI::App& app)
    : Command(app, "split",
              "Write a folder with a render in parts, which many machines may render, and what joins them"),
      options_(parser()), frames_(parser()), shaders_(parser()) {
    parser()
        .add_option("input", scene_,
                    "Built-in scene, or .gltf or .glb file; the folder gets a copy of all that it refers to")
        ->type_name("SCENE");
    parser()
        .add_option("--parts", parts_, "Parts of each picture: ranges of its samples")
        ->type_name("N")
        ->default_str("")
        ->required();
    addNamed(parser(), "--for", engine_,
             "What runs the parts: a script, Slurm, or jobs of a workflow on GitHub");
    parser().add_flag("--png", hasPng_,
                      "Make a PNG of the merged film, too, with --tonemap, --exposure and --denoise");
    parser().add_flag("--statistical", isStatistical_,
                      "Merge parts of different devices, drivers and processors, too");
    parser()
        .add_option("--constraint", constraint_,
                    "Of --for slurm: run on nodes with this feature alone, such as one kind of processor")
        ->type_name("FEATURE")
        ->default_str("");
    parser().add_option("--program", program_, "What the scripts call")->type_name("FILE");
    parser()
        .add_option("--checkpoint-every", checkpointSeconds_, "Seconds between two checkpoints of a part")
        ->type_name("SECONDS");
    parser()
        .add_option("-o,--output", output_, "The folder, which is new or empty")
        ->type_name("JOB")
        ->required();
}

void SplitCommand::checkOptions() const {
    for (const char* option : {"--time", "--target-error"})
        if (parser().count(option) > 0)
            throw UsageError(fmt::format(
                "{}: parts are ranges of samples, and what it will stop at is not known before; give "
                "--spp",
                option));
    if (!hasPng_)
        for (const char* option : {"--tonemap", "--exposure", "--denoise"})
            if (parser().count(option) > 0)
                throw UsageError(fmt::format("{}: is for a PNG; give --png, or leave it out", option));
    if (options_.hasBackdrop() && !hasPng_)
        throw UsageError("--background: a colour is for a PNG; give --png, or --background transparent");
    if (!constraint_.empty() && engine_ != SplitEngine::slurm)
        throw UsageError("--constraint: is for Slurm; give --for slurm, or leave it out");
    if (engine_ == SplitEngine::github && fs::path(output_).is_absolute())
        throw UsageError(fmt::format(
            "-o: {} is not a path from the repository's root, which --for github needs; call it from there",
            output_));
    if (frames_.single())
        throw UsageError("--frame: is one frame; give --frames A:B, or leave it out");
    if (!(checkpointSeconds_ >= 0.0 && checkpointSeconds_ <= 1e9))
        throw UsageError(
            fmt::format("--checkpoint-every: {} is outside the range 0 to 1000000000", checkpointSeconds_));
}

SplitPlan SplitCommand::plan() const {
    SplitPlan plan;
    plan.parts = parts_;
    plan.engine = engine_;
    plan.hasPng = hasPng_;
    plan.isStatistical = isStatistical_;
    plan.constraint = constraint_;
    plan.program = program_;
    plan.checkpointSeconds = checkpointSeconds_;
    plan.folder = output_;
    plan.hasThreads = parser().count("--threads") > 0;
    if (frames_.isAsked())
        plan.frames = SplitFrames{frames_.range().first, frames_.range().end};
    const std::set<std::string> ofSplit{
        "help",          "input",      "parts",   "for",    "png",
        "statistical",   "constraint", "program", "output", "checkpoint-every",
        "spp",           "samples",    "frames",  "env",    "shaders",
        "allow-external"};
    std::set<std::string> ofPictures{"tonemap", "exposure"};
    if (options_.hasBackdrop())
        ofPictures.insert("background");
    std::set<std::string> ofNoPart = ofSplit;
    ofNoPart.insert(ofPictures.begin(), ofPictures.end());
    plan.words = wordsGiven(parser(), ofNoPart);
    for (const std::string& word : wordsGiven(parser(), ofSplit))
        if (ofPictures.contains(word.substr(2, word.find('=') - 2)))
            plan.pictureWords.push_back(word);
    if (options_.hasBackdrop())
        plan.partWords = {"--background", "transparent"};
    return plan;
}

void SplitCommand::bundle(const RenderPlan& render, SplitPlan& plan, const fs::path& folder) const {
    plan.scene = isBuiltin(scene_)
                     ? scene_
                     : bundleScene(scene_, options_.scene().importOptions().allowsExternal, folder);
    if (const std::string& map = render.settings.lighting.mapFile; !map.empty())
        plan.words.insert(plan.words.end(), {"--env", bundleEnvironment(map, folder)});
    else if (parser().count("--env") > 0)
        plan.words.insert(plan.words.end(), {"--env", parser().get_option("--env")->results().front()});
    if (const std::string shaders = shaders_.folder(); !shaders.empty())
        plan.words.insert(plan.words.end(), {"--shaders", bundleShaders(shaders, folder)});
}

int SplitCommand::run() {
    checkOptions();
    SplitPlan plan = this->plan();
    const RenderPlan render = options_.plan(scene_);
    const uint32_t first = render.settings.image.firstSample;
    plan.samples = {first, first + render.settings.stop.samples};
    requirePossible(plan);
    // What a machine would refuse is told here, before there are any.
    const ImportOptions moment =
        plan.frames && !frames_.isTurntable()
            ? options_.scene().importOptionsAt(frames_.range().secondsOf(plan.frames->first))
            : options_.scene().importOptions();
    static_cast<void>(prepareScene(render, moment));
    static_cast<void>(shaders_.overlay());
    const NewFolder folder(output_);
    bundle(render, plan, folder.path());
    writeSplitJob(plan, scene_, folder.path());
    folder.finish();
    const size_t parts = partsOf(plan).size();
    const char* start = engine_ == SplitEngine::shell   ? "run.sh"
                        : engine_ == SplitEngine::slurm ? "submit.sh"
                                                        : "workflow.yml";
    fmt::print("{}: {} parts; start with {}/{}\n", output_, parts, output_, start);
    return 0;
}

} // namespace lavalight

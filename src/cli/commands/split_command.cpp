#include "cli/commands/split_command.h"

#include <algorithm>
#include <array>
#include <cctype>
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

// `job` of `job/`.
fs::path withoutSlash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

// A folder under a temporary name. finish() gives it its own name; without finish() it is removed.
class NewFolder {
  public:
    explicit NewFolder(const fs::path& name) : name_(withoutSlash(fs::weakly_canonical(fs::absolute(name)))) {
        path_ = fs::path(name_.string() + fmt::format(".{}.part", ::getpid()));
        std::error_code code;
        if (name_ == fs::current_path(code))
            throw Error("cannot write .: it is the working folder; try the name of a new one");
        if (fs::exists(name_, code) && !(fs::is_directory(name_, code) && fs::is_empty(name_, code)))
            throw Error(
                fmt::format("cannot write {}: it is not an empty folder; try another name", name_.string()));
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
    : Command(app, "split", "Write a folder that renders a scene in parts, on many machines, and joins them"),
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
                    "With --for slurm: run only on nodes with this feature, such as one kind of processor")
        ->type_name("FEATURE")
        ->default_str("");
    parser()
        .add_option("--program", program_, "Program that the scripts call: a name on the path, or a file")
        ->type_name("FILE");
    parser()
        .add_option("--checkpoint-every", checkpointSeconds_, "Seconds between two checkpoints of a part")
        ->type_name("SECONDS");
    parser()
        .add_option("-o,--output", output_, "Folder to write; it must be new or empty")
        ->type_name("JOB")
        ->required();
}

void SplitCommand::checkOptions() const {
    for (const char* option : {"--time", "--target-error"})
        if (parser().count(option) > 0)
            throw UsageError(fmt::format(
                "{}: the number of samples has to be known before parts are cut; give --spp instead",
                option));
    if (!hasPng_)
        for (const char* option : {"--tonemap", "--exposure", "--denoise"})
            if (parser().count(option) > 0)
                throw UsageError(fmt::format("{}: only a PNG uses it; give --png, or leave it out", option));
    if (options_.hasBackdrop() && !hasPng_)
        throw UsageError("--background: a colour is for a PNG; give --png, or --background transparent");
    if (!constraint_.empty() && engine_ != SplitEngine::slurm)
        throw UsageError("--constraint: only Slurm uses it; give --for slurm, or leave it out");
    if (engine_ == SplitEngine::github &&
        (fs::path(output_).is_absolute() || fs::path(output_).lexically_normal().string().starts_with("..")))
        throw UsageError(fmt::format("-o: {} is an absolute path, and --for github needs one from the "
                                     "repository's root; call split there",
                                     output_));
    if ((options_.layers() >> kMotionPlane & 1u) != 0 && !frames_.isAsked())
        throw UsageError("--aov motion: motion leads to the next frame; give --frames or --turntable");
    const auto isControl = [](unsigned char c) { return std::iscntrl(c) != 0; };
    for (const std::string& text : {constraint_, output_})
        if (std::any_of(text.begin(), text.end(), isControl))
            throw UsageError(
                "--constraint and -o: line breaks and other control characters have no place in scripts");
    if (frames_.single())
        throw UsageError("--frame: split takes a sequence of frames; give --frames A:B");
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
    // The scripts run in the job's folder.
    plan.program = program_.find('/') == std::string::npos
                       ? program_
                       : fs::absolute(program_).lexically_normal().string();
    plan.checkpointSeconds = checkpointSeconds_;
    plan.folder = withoutSlash(fs::path(output_).lexically_normal()).string();
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

void SplitCommand::bundle(const RenderPlan& render, bool allowsExternal, SplitPlan& plan,
                          const fs::path& folder) const {
    plan.scene = isBuiltin(scene_) ? scene_ : bundleScene(scene_, allowsExternal, folder);
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
    // What a part's render would refuse is refused here, before anything is written.
    const ImportOptions moment =
        plan.frames && !frames_.isTurntable()
            ? options_.scene().importOptionsAt(frames_.range().secondsOf(plan.frames->first))
            : options_.scene().importOptions();
    static_cast<void>(prepareScene(render, moment));
    static_cast<void>(shaders_.overlay());
    const NewFolder folder(output_);
    bundle(render, moment.allowsExternal, plan, folder.path());
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

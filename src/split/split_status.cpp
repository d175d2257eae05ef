#include "split/split_status.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "film/film_file.h"
#include "split/split_job.h"
#include "split/split_scripts.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr size_t kMostSpeeds = 16; // headers of finished parts that are read for the estimate
constexpr size_t kMostNamed = 10;  // parts of one state in the text

// A sign of life of a process that renders a part: NAME.HOST-PROCESS.started, or
// NAME.HOST-PROCESS.checkpoint.exr.
struct Sign {
    fs::path file;
    std::string part;
    std::string host;
    bool isCheckpoint = false;
    double age = 0.0; // seconds
};

double ageOf(const fs::path& file) {
    std::error_code gone;
    const auto written = fs::last_write_time(file, gone);
    return gone ? 0.0 : std::chrono::duration<double>(fs::file_time_type::clock::now() - written).count();
}

std::optional<Sign> signOf(const fs::path& file) {
    const std::string name = file.filename().string();
    const bool isCheckpoint = name.ends_with(".checkpoint.exr");
    const size_t dot = name.find('.');
    const size_t dash = name.rfind('-');
    if ((!isCheckpoint && !name.ends_with(".started")) || dot == std::string::npos ||
        dash == std::string::npos || dash < dot)
        return std::nullopt;
    return Sign{file, name.substr(0, dot), name.substr(dot + 1, dash - dot - 1), isCheckpoint,
                std::max(ageOf(file), 0.0)};
}

// The signs of each part, the newest first.
std::map<std::string, std::vector<Sign>> signsIn(const fs::path& folder) {
    std::map<std::string, std::vector<Sign>> signs;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / kRunningFolder, none))
        if (const std::optional<Sign> sign = signOf(entry.path()))
            signs[sign->part].push_back(*sign);
    for (auto& [part, ofPart] : signs)
        std::sort(ofPart.begin(), ofPart.end(), [](const Sign& a, const Sign& b) { return a.age < b.age; });
    return signs;
}

// A checkpoint that is being replaced, or was damaged, says nothing.
std::optional<FilmState> stateOf(const fs::path& file) {
    try {
        return readFilmState(file);
    } catch (const Error&) {
        return std::nullopt;
    }
}

// Mean seconds of a whole part, by those that are done, else by what the running ones have taken so far.
class PartTime {
  public:
    void add(const FilmState& state) {
        if (state.fraction > 0.0 && state.seconds > 0.0) {
            sum_ += state.seconds / state.fraction;
            ++count_;
        }
    }
    [[nodiscard]] bool isKnown() const { return count_ > 0; }
    [[nodiscard]] bool isSure() const { return count_ >= kMostSpeeds; }
    [[nodiscard]] double seconds() const { return sum_ / static_cast<double>(count_); }

  private:
    double sum_ = 0.0;
    size_t count_ = 0;
};

std::vector<std::string> partNamesIn(const fs::path& folder) {
    std::istringstream lines(readFile(folder / kPartsList));
    std::vector<std::string> names;
    for (std::string line; std::getline(lines, line);)
        if (const std::string name = line.substr(0, line.find(' ')); !name.empty())
            names.push_back(name);
    return names;
}

std::string durationText(double seconds) {
    const auto whole = static_cast<uint64_t>(seconds + 0.5);
    if (whole < 60)
        return fmt::format("{} s", whole);
    if (whole < 3600)
        return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

const char* nameOf(PartState state) {
    switch (state) {
    case PartState::done:
        return "done";
    case PartState::running:
        return "running";
    case PartState::stopped:
        return "stopped";
    case PartState::missing:
        break;
    }
    return "missing";
}

std::string lineOf(const PartStatus& part) {
    if (part.state == PartState::missing)
        return fmt::format("  {}  missing\n", part.name);
    return fmt::format("  {}  {} on {}, {:.0f} %, last sign of life {} ago\n", part.name, nameOf(part.state),
                       part.host, 100.0 * part.fraction, durationText(part.secondsSinceSign));
}

} // namespace

size_t SplitStatus::count(PartState state) const {
    return static_cast<size_t>(std::count_if(parts.begin(), parts.end(),
                                             [&](const PartStatus& part) { return part.state == state; }));
}

SplitStatus statusOf(const fs::path& folder) {
    const double silence = 3.0 * readSplitJob(folder).checkpointSeconds + 60.0;
    const auto signs = signsIn(folder);
    SplitStatus status{folder.string(), {}, {}};
    PartTime ofDone;
    PartTime ofRunning;
    double left = 0.0; // parts
    for (const std::string& name : partNamesIn(folder)) {
        PartStatus part{name, PartState::missing, 0.0, 0.0, {}};
        const fs::path file = folder / kPartsFolder / (name + ".exr");
        std::error_code none;
        if (const auto bytes = fs::file_size(file, none); !none && bytes > 0) {
            part.state = PartState::done;
            part.fraction = 1.0;
            if (!ofDone.isSure())
                if (const auto state = stateOf(file))
                    ofDone.add(*state);
        } else if (const auto found = signs.find(name); found != signs.end()) {
            const Sign& newest = found->second.front();
            // A process that ends by itself takes its .started with it.
            const bool hasBegun = std::any_of(found->second.begin(), found->second.end(),
                                              [](const Sign& sign) { return !sign.isCheckpoint; });
            part.state = hasBegun && newest.age <= silence ? PartState::running : PartState::stopped;
            part.host = newest.host;
            part.secondsSinceSign = newest.age;
            for (const Sign& sign : found->second)
                if (const auto state = sign.isCheckpoint ? stateOf(sign.file) : std::nullopt) {
                    part.fraction = std::max(part.fraction, state->fraction);
                    ofRunning.add(*state);
                }
        }
        left += 1.0 - part.fraction;
        status.parts.push_back(std::move(part));
    }
    const PartTime& time = ofDone.isKnown() ? ofDone : ofRunning;
    if (const size_t running = status.count(PartState::running); running > 0 && time.isKnown())
        status.secondsLeft = left * time.seconds() / static_cast<double>(running);
    return status;
}

std::string textOf(const SplitStatus& status) {
    const size_t done = status.count(PartState::done);
    std::string text = fmt::format("{}: {} of {} parts done, {} running, {} stopped, {} missing\n",
                                   status.folder, done, status.parts.size(), status.count(PartState::running),
                                   status.count(PartState::stopped), status.count(PartState::missing));
    for (const PartState state : {PartState::running, PartState::stopped, PartState::missing}) {
        size_t named = 0;
        for (const PartStatus& part : status.parts)
            if (part.state == state && named++ < kMostNamed)
                text += lineOf(part);
        if (named > kMostNamed)
            text += fmt::format("  and {} more that are {}\n", named - kMostNamed, nameOf(state));
    }
    if (done > 0 && done == status.parts.size())
        text += "all parts are done: merge.sh joins them\n";
    else if (status.secondsLeft)
        text += fmt::format("about {} left, with {} parts at once\n", durationText(*status.secondsLeft),
                            status.count(PartState::running));
    return text;
}

std::string jsonOf(const SplitStatus& status) {
    Json parts = Json::array();
    for (const PartStatus& part : status.parts) {
        Json entry = {{"name", part.name}, {"state", nameOf(part.state)}, {"fraction", part.fraction}};
        if (!part.host.empty())
            entry.update({{"host", part.host}, {"secondsSinceSign", part.secondsSinceSign}});
        parts.push_back(std::move(entry));
    }
    Json json = {{"folder", status.folder}};
    for (const PartState state :
         {PartState::done, PartState::running, PartState::stopped, PartState::missing})
        json[nameOf(state)] = status.count(state);
    json["secondsLeft"] = status.secondsLeft ? Json(*status.secondsLeft) : Json(nullptr);
    json["parts"] = std::move(parts);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace lavalight

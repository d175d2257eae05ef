#include "cli/commands/bench_command.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/options/named_option.h"
#include "cli/options/scene_options.h"
#include "device_scene/gpu_scene.h"
#include "inspect/embree_oracle.h"
#include "inspect/ray_sets.h"
#include "inspect/ray_tracer.h"
#include "kernels/kernel_source.h"
#include "render/schedule_choice.h"
#include "render/setting_names.h"
#include "session/builtin.h"

namespace lavalight {
namespace {

constexpr const char* kThreadVariable = "LP_NUM_THREADS"; // lavapipe's, read when the device is opened

// What one kind of rays came to.
struct Row {
    std::string kind;
    size_t rays = 0;
    double hitShare = 0.0;  // share of the rays that hit, by Embree
    double agreement = 0.0; // share of the rays with the same answer from both
    double ours = 0.0;      // Mrays/s, median over the repeats
    double embree = 0.0;
    std::optional<double> nodes{}; // and triangles that a ray of ours visits on average, where we traverse
    std::optional<double> triangles{};
    [[nodiscard]] double ratio() const { return ours / embree; }
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

// Either triangle may be named where a ray meets an edge.
bool isSame(const TracedHit& ours, const OracleHit& theirs) {
    if (std::isinf(ours.t) || std::isinf(theirs.t))
        return std::isinf(ours.t) && std::isinf(theirs.t);
    return ours.surface.primitive == theirs.triangle || std::abs(ours.t - theirs.t) <= 1e-5f * theirs.t;
}

bool isSame(uint32_t ours, uint8_t theirs) {
    return (ours != 0) == (theirs != 0);
}

bool isHit(const OracleHit& hit) {
    return !std::isinf(hit.t);
}

bool isHit(uint8_t occluded) {
    return occluded != 0;
}

OracleRay toOracle(const Ray& ray) {
    return {ray.origin, ray.direction};
}

OracleRay toOracle(const ShadowRay& ray) {
    return {ray.origin, ray.direction, 1.0f};
}

// Both tracers over one scene, and how often to ask them.
class RayBench {
  public:
    RayBench(gpu::Device& device, const Scene& scene, AcceleratorKind accelerator, uint32_t repeats)
        : scene_(&scene), repeats_(repeats), triangles_(sceneTriangles(scene)),
          gpuScene_(device, packScene(scene, accelerator)), tracer_(device, gpuScene_),
          oracle_(triangles_, EmbreeOracle::Traversal::fast) {
        if (accelerator == AcceleratorKind::bvh8)
            counter_.emplace(device, gpuScene_, true);
    }

    // Camera rays, then rays of the other kinds from where those hit.
    [[nodiscard]] std::vector<Row> run(size_t count) {
        const std::vector<Ray> camera =
            makeCameraRays(scene_->cameras.front(), std::min(count, tracer_.maxRays()), 1);
        const std::vector<SurfacePoint> points = hitPoints(camera, tracer_.closest(camera), triangles_);
        if (points.empty())
            throw Error(
                fmt::format("cannot bench {}: no ray of its first camera hits anything", scene_->source));
        return {benchClosest("camera", Likeness::alike, camera),
                benchClosest("bounce", Likeness::unlike, makeBounceRays(points, 2)),
                benchAny("shadow", makeShadowRays(points, *scene_, triangles_, 3))};
    }

  private:
    Row benchClosest(const char* kind, Likeness likeness, const std::vector<Ray>& rays) {
        return bench(
            kind, rays,
            [likeness](RayTracer& tracer, const auto& ours) { return tracer.closest(ours, likeness); },
            [this](const auto& theirs) { return oracle_.closest(theirs); });
    }
    Row benchAny(const char* kind, const std::vector<ShadowRay>& rays) {
        return bench(
            kind, rays, [](RayTracer& tracer, const auto& ours) { return tracer.occluded(ours); },
            [this](const auto& theirs) { return oracle_.occluded(theirs); });
    }

    // Takes turns, so that whatever else the machine does meanwhile slows both.
    template <typename T, typename Ours, typename Theirs>
    Row bench(const char* kind, const std::vector<T>& rays, const Ours& traceOurs,
              const Theirs& traceTheirs) {
        std::vector<OracleRay> oracleRays;
        oracleRays.reserve(rays.size());
        for (const T& ray : rays)
            oracleRays.push_back(toOracle(ray));
        std::vector<double> ourSpeeds;
        std::vector<double> theirSpeeds;
        const double millions = static_cast<double>(rays.size()) * 1e-6;
        Row row{kind, rays.size()};
        for (uint32_t i = 0; i < repeats_; ++i) {
            const auto ours = traceOurs(tracer_, rays);
            ourSpeeds.push_back(millions / tracer_.lastSeconds());
            const auto start = std::chrono::steady_clock::now();
            const auto theirs = traceTheirs(oracleRays);
            theirSpeeds.push_back(
                millions / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
            compare(ours, theirs, row);
        }
        if (counter_) {
            static_cast<void>(traceOurs(*counter_, rays));
            row.nodes = counter_->lastVisits().nodes / static_cast<double>(rays.size());
            row.triangles = counter_->lastVisits().triangles / static_cast<double>(rays.size());
        }
        row.ours = median(ourSpeeds);
        row.embree = median(theirSpeeds);
        return row;
    }

    template <typename Ours, typename Theirs>
    static void compare(const std::vector<Ours>& ours, const std::vector<Theirs>& theirs, Row& row) {
        size_t same = 0;
        size_t hits = 0;
        for (size_t i = 0; i < ours.size(); ++i) {
            same += isSame(ours[i], theirs[i]) ? 1 : 0;
            hits += isHit(theirs[i]) ? 1 : 0;
        }
        row.agreement = static_cast<double>(same) / static_cast<double>(ours.size());
        row.hitShare = static_cast<double>(hits) / static_cast<double>(ours.size());
    }

    const Scene* scene_; // outlives the bench
    uint32_t repeats_;
    std::vector<Triangle> triangles_;
    GpuScene gpuScene_;
    RayTracer tracer_;
    std::optional<RayTracer> counter_; // slower: its times do not count
    EmbreeOracle oracle_;
};

void printText(const Scene& scene, const gpu::DeviceDescription& device, const std::string& accelerator,
               const std::vector<Row>& rows) {
    const auto orNothing = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.1f}", *value) : "-";
    };
    fmt::print("{}: {} triangles; {} with {}, accelerator {}; million rays per second\n", scene.source,
               scene.triangleCount(), device.name, device.driver, accelerator);
    fmt::print("{:<8}{:>10}{:>8}{:>12}{:>10}{:>8}{:>13}{:>9}{:>11}\n", "rays", "count", "hit", "Lavalight",
               "Embree", "ratio", "agreement", "nodes", "triangles");
    for (const Row& row : rows)
        fmt::print("{:<8}{:>10}{:>7.1f}%{:>12.2f}{:>10.2f}{:>8.2f}{:>12.4f}%{:>9}{:>11}\n", row.kind,
                   row.rays, 100.0 * row.hitShare, row.ours, row.embree, row.ratio(), 100.0 * row.agreement,
                   orNothing(row.nodes), orNothing(row.triangles));
}

void printJson(const Scene& scene, const gpu::DeviceDescription& device, const std::string& accelerator,
               const std::vector<Row>& rows, uint32_t repeats) {
    auto kinds = nlohmann::ordered_json::array();
    for (const Row& row : rows) {
        kinds.push_back({{"kind", row.kind},
                         {"rays", row.rays},
                         {"hitShare", row.hitShare},
                         {"megaraysPerSecond", row.ours},
                         {"embreeMegaraysPerSecond", row.embree},
                         {"ratio", row.ratio()},
                         {"agreement", row.agreement}});
        if (row.nodes) {
            kinds.back()["nodesPerRay"] = *row.nodes;
            kinds.back()["trianglesPerRay"] = *row.triangles;
        }
    }
    const char* threads = std::getenv(kThreadVariable);
    const nlohmann::ordered_json json = {
        {"scene", scene.source},      {"triangles", scene.triangleCount()},
        {"device", device.name},      {"driver", device.driver},
        {"accelerator", accelerator}, {"threads", threads != nullptr ? threads : ""},
        {"repeats", repeats},         {"rays", kinds}};
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

// Embree traces on one thread; a CPU device has to do the same for the ratio to mean anything.
void limitDeviceThreads() {
    const char* set = std::getenv(kThreadVariable);
    if (set != nullptr && std::string(set) != "1")
        spdlog::warn("{} is {}: the ratio does not compare single threads", kThreadVariable, set);
    if (set != nullptr) {
        if (const unsigned long threads = std::strtoul(set, nullptr, 10); threads > 1 && threads < 1000)
            limitThreads(static_cast<unsigned>(threads));
        return;
    }
    ::setenv(kThreadVariable, "1", 0);
    spdlog::info("setting {}=1: one thread for each side", kThreadVariable);
}

} // namespace

BenchCommand::BenchCommand(CLI::App& app) : Command(app, "bench", "Measure speed beside other programs") {
    parser().require_subcommand(1);
    CLI::App& rays =
        addSubcommand("rays", "Camera, bounce and shadow rays per second, beside Embree on the same rays");
    rays.add_option("input", scene_, "A .gltf or .glb file, or a built-in name such as dense-300000")
        ->type_name("SCENE")
        ->required();
    rays.add_option("--rays", rays_, "Camera rays; the others start where these hit")
        ->check(CLI::Range(1000u, 4000000u));
    rays.add_option("--repeats", repeats_, "Runs of each side, alternating; their median counts")
        ->check(CLI::Range(1u, 1000u));
    addNamed(rays, "--accelerator", accelerator_,
             "What finds the triangles that our rays meet, each asked for by itself");
    deviceOptions_.emplace(rays);
    rays.add_flag("--json", json_, "Print JSON");
    addAllowExternal(rays, import_);
}

int BenchCommand::run() {
    limitDeviceThreads();
    const Scene scene = loadScene(scene_, import_);
    for (const std::string& warning : scene.warnings)
        spdlog::warn("{}", warning);
    gpu::Device device(deviceOptions_->config());
    if (device.limits().timestampNanoseconds == 0.0)
        throw Error(fmt::format("cannot bench on {}: it has no timestamps", device.description().name));
    RenderSettings asked;
    asked.work.accelerator = accelerator_;
    const RenderSettings settings = resolveSchedule(asked, device.description(), embeddedKernel);
    RayBench bench(device, scene, acceleratorOf(settings), repeats_);
    if (std::getenv(kThreadVariable) == std::string_view("1"))
        limitThreads(1); // of rays that the host traces
    const std::vector<Row> rows = bench.run(rays_);
    const std::string accelerator(nameOf(settings.work.accelerator));
    if (json_)
        printJson(scene, device.description(), accelerator, rows, repeats_);
    else
        printText(scene, device.description(), accelerator, rows);
    return 0;
}

} // namespace lavalight

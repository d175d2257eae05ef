#include "cli/commands/pack_command.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/input_files.h"
#include "base/log.h"
#include "cli/options/scene_options.h"
#include "gltf/import.h"
#include "gltf/pack.h"

namespace lavalight {

PackCommand::PackCommand(CLI::App& app)
    : Command(app, "pack",
              "Write a scene file and all that it refers to as one .glb, which renders to the same bits") {
    parser()
        .add_option("input", scene_, ".gltf or .glb file")
        ->type_name("SCENE")
        ->default_str("")
        ->required();
    parser().add_option("-o,--output", output_, "GLB file to write")->type_name("OUT.glb")->required();
    addAllowExternal(parser(), options_);
}

int PackCommand::run() {
    if (std::filesystem::path(output_).extension() != ".glb")
        throw UsageError(fmt::format("-o: {} does not end in .glb; give a name that does", output_));
    InputFiles inputs;
    inputs.add(scene_, "the scene");
    for (const std::filesystem::path& file : referencedFiles(scene_))
        inputs.add(file, "a file of the scene");
    inputs.requireApart(output_);
    requireWritable(output_);
    const PackedScene packed = packGltf(scene_, options_.allowsExternal);
    for (const std::string& warning : packed.warnings)
        spdlog::warn("{}", warning);
    writeFileAtomically(output_, packed.glb);
    fmt::print("{}: {} bytes\n", output_, packed.glb.size());
    return 0;
}

} // namespace lavalight

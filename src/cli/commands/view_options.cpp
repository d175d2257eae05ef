// The options of `lavalight view`, whether its window is built or not.
#include "cli/commands/view_command.h"

namespace lavalight {

ViewCommand::ViewCommand(CLI::App& app)
    : Command(app, "view", "Show a scene in a window while it is rendered"), options_(parser()),
      sceneOptions_(parser()), shaders_(parser()), tone_(parser()), background_(parser()), ground_(parser()),
      denoise_(parser(),
               {"Show the picture denoised, by Intel Open Image Denoise; N goes back. Without a word: fast",
                DenoiseQuality::fast}) {
    shaders_.declareWatch(parser());
    parser().add_flag("--no-watch", isNotWatching_,
                      "Do not watch shaders, which is done where --shaders or ./shaders is there");
    parser().add_option("input", scene_, "Built-in scene, or .gltf or .glb file")->type_name("SCENE");
}

} // namespace lavalight

#include <fmt/format.h>

#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>
#include <memory>

#include "commands.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace luciole::cli {
namespace {

struct WriteSceneOptions {
    SceneOptions scene;
    Console console;
    std::string file;
};

void run(const WriteSceneOptions& options) {
    if (!options.file.ends_with(".glb"))
        throw Error(ErrorKind::usage, fmt::format("{}: expected a name that ends in .glb", options.file));
    requireWritable(options.file);
    const Scene scene = loadScene(options.scene, options.console);
    const FinishFirst guard;
    options.console.warn(writeGlb(scene, options.file));
}

}  // namespace

void addSceneCommand(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("scene", "write a scene as one glTF file, built-in scenes and rigs included");
    const auto options = std::make_shared<WriteSceneOptions>();
    addSceneOptions(*command, options->scene);
    command->add_option("-o,--output", options->file, "file to write")->type_name("FILE.glb")->required();
    addConsoleOptions(*command, options->console);
    command->callback([options] { run(*options); });
}

}  // namespace luciole::cli

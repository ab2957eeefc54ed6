#include <fmt/format.h>

#include <luciole/renderer.hpp>

#include "commands.hpp"

namespace luciole::cli {

void addTechniquesCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("techniques", "list the lighting techniques");
    command->callback([] {
        for (const LightingTechniqueInfo& technique : lightingTechniques())
            fmt::print("{:<25} {}\n{:<25} source: {}\n", technique.name, technique.help, "", technique.source);
    });
}

}  // namespace luciole::cli

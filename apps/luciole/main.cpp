#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <luciole/error.hpp>
#include <luciole/scene_io.hpp>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "commands.hpp"
#include "console.hpp"
#include "interrupt.hpp"

namespace {

using namespace luciole;

/// CLI11's help without its remarks on counts, defaults and exclusions, which the texts give where they matter.
class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter() { column_width(36); }
    std::string make_option_opts(const CLI::Option* option) const override {
        return option->get_type_name().empty() ? "" : " " + option->get_type_name();
    }
};

int fail(int exitCode, std::string_view message) {
    cli::say(fmt::format("luciole: error: {}\n", cli::printable(message)));  // one line, whatever a library says
    return exitCode;
}

int fail(ErrorKind kind, std::string_view message) { return fail(int(kind), message); }

std::string helpFooter() {
    std::string text =
        "Examples:\n"
        "  luciole render builtin:hall -o hall.png\n"
        "  luciole render model.glb -o model.png --size 1920x1080 --tonemap agx\n"
        "  luciole render model.glb --rig lights.json -o model.exr --aov depth,normal\n"
        "  luciole info model.glb\n"
        "\nBuilt-in scenes (give parameters as in builtin:hall?lights=255):\n";
    for (const BuiltinScene& scene : builtinScenes()) {
        text += fmt::format("  {:<22} {}\n", fmt::format("builtin:{}", scene.name), scene.help);
        for (const BuiltinParameter& p : scene.parameters)
            text += fmt::format("    {:<20} {} ({:.10g} to {:.10g}; {:.10g} if not given)\n", p.name, p.help, p.low,
                                p.high, p.fallback);
    }
    return text +
           "\nExit codes: 0 done, 1 compare: the pictures differ, 2 wrong usage, 3 faulty scene or rig, 4 file can't be read or written,\n"
           "  5 no usable device, 6 device lost or out of memory, 8 a limit is exceeded, 130 interrupted.\n"
           "docs/command-line.md says more.\n";
}

/// Keeps the numbers of closed standard streams from going to files, which would then receive what is printed. They
/// stay unusable for what they are for: a result that can't be written is an error.
void occupyStandardStreams() {
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(fd, F_GETFD) < 0) ::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // takes `fd`
}

int run(int argc, char** argv) {
    CLI::App app("Luciole renders scenes with many lights.", "luciole");
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_version_flag("--version", "luciole " LUCIOLE_VERSION);
    app.require_subcommand(0, 1);  // none is refused below: CLI11 would not name a misspelt one
    app.footer(helpFooter);
    int exitCode = 0;
    cli::addRenderCommand(app);
    cli::addInfoCommand(app);
    cli::addAdviseCommand(app);
    cli::addSceneCommand(app);
    cli::addDevicesCommand(app);
    cli::addSettingsCommand(app);
    cli::addTechniquesCommand(app);
    cli::addBenchCommand(app);
    cli::addGraphCommand(app);
    cli::addCompareCommand(app, exitCode);
    const auto refuse = [&](std::string_view what) {
        const auto commands = app.get_subcommands();
        const std::string command = commands.empty() ? "" : commands.front()->get_name() + " ";
        throw Error(ErrorKind::usage, fmt::format("{} (see luciole {}--help)", what, command));
    };
    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty()) refuse("A command is required");
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) refuse(error.what());
        app.exit(error);  // --help and --version arrive as exceptions
    }
    if (std::fflush(stdout) != 0)
        throw Error(ErrorKind::io,
                    fmt::format("standard output: can't write: {}", std::generic_category().message(errno)));
    return exitCode;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        occupyStandardStreams();
        cli::exitOnInterrupt();
        return run(argc, argv);
    } catch (const Error& error) {
        return fail(error.kind(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ErrorKind::deviceLost, "out of memory");
    } catch (const std::filesystem::filesystem_error& error) {
        return fail(ErrorKind::io, error.what());
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <luciole/error.hpp>
#include <luciole/output.hpp>
#include <memory>
#include <system_error>

#include "commands.hpp"
#include "interrupt.hpp"
#include "outputs.hpp"
#include "request.hpp"

namespace luciole::cli {
namespace {

struct GraphOptions {
    FrameRequest request;
    std::string file;
};

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void fail(const std::string& what, int code) { throw Error(ErrorKind::io, fmt::format("{}: {}", what, std::generic_category().message(code))); }

/// A file without a name, that goes when it is closed.
Stream temporary() {
    Stream stream(std::tmpfile(), std::fclose);
    if (!stream) fail("graph: can't make a temporary file", errno);
    return stream;
}

/// The drawing that Graphviz's program makes of its language.
std::string drawn(const std::string& graph) {
    const Stream input = temporary(), output = temporary();
    if (std::fwrite(graph.data(), 1, graph.size(), input.get()) != graph.size() || std::fflush(input.get()) != 0) fail("graph: can't write a temporary file", errno);
    std::rewind(input.get());
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_adddup2(&files, ::fileno(input.get()), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&files, ::fileno(output.get()), STDOUT_FILENO);
    std::string program = "dot", format = "-Tsvg";
    char* arguments[] = {program.data(), format.data(), nullptr};
    pid_t process = 0;
    const int code = ::posix_spawnp(&process, arguments[0], &files, nullptr, arguments, environ);
    ::posix_spawn_file_actions_destroy(&files);
    if (code != 0)
        throw Error(ErrorKind::io, fmt::format("graph: expected Graphviz's program dot, to draw .svg: {}; a file that ends in .dot needs no program",
                                               std::generic_category().message(code)));
    int status = 0;
    while (::waitpid(process, &status, 0) < 0)
        if (errno != EINTR) fail("graph: can't wait for dot", errno);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw Error(ErrorKind::io, fmt::format("graph: dot failed, status {}", status));
    std::string text;
    std::rewind(output.get());
    char block[1 << 14];
    while (const size_t count = std::fread(block, 1, sizeof block, output.get())) text.append(block, count);
    return text;
}

void run(const GraphOptions& options) {
    const std::filesystem::path file = options.file;
    if (file.extension() != ".svg" && file.extension() != ".dot")
        throw Error(ErrorKind::usage, fmt::format("{}: expected a name that ends in .svg or .dot", options.file));
    RenderSettings settings = resolve(options.request.settings);
    settings.measure = true;
    requireTechnique(options.request.settings, settings.lighting);
    if (settings.lighting == "reference") throw Error(ErrorKind::usage, "graph: the reference has no frame graph");
    requireWritable(file);
    const auto [scene, view] = loadSceneAndView(options.request);
    Renderer renderer(rendererOptions(options.request));
    renderer.setScene(scene);
    const std::string graph = renderer.render(view, settings).graph;
    const std::string text = file.extension() == ".svg" ? drawn(graph) : graph;
    const FinishFirst guard;
    writeFileAtomically(file, std::as_bytes(std::span(text)));
}

}  // namespace

void addGraphCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("graph", "draw a frame's passes, what they read and write, and how long they take");
    const auto options = std::make_shared<GraphOptions>();
    addSceneAndViewOptions(*command, options->request);
    command->add_option("-o,--output", options->file, "drawing to write, .svg (made by Graphviz) or .dot (its language)")->type_name("FILE")->required();
    addDeviceOptions(*command, options->request.renderer);
    addConsoleOptions(*command, options->request.console);
    command->footer("Example:\n  luciole graph builtin:hall --lighting clustered -o frame.svg\n");
    command->callback([options] { run(*options); });
}

}  // namespace luciole::cli

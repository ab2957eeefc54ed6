// The figures of docs/performance.md and docs/techniques.
//   luciole_bench [SUITE] [FRAMES] [WIDTHxHEIGHT] [FOLDER]      defaults: frames, 10, 1024x768; FOLDER of glTF halls, for tiles
#include <luciole/error.hpp>

#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "machine.hpp"
#include "suites.hpp"

namespace {

using namespace luciole;

struct Suite {
    std::string_view name;
    void (*run)(Renderer&, const bench::Options&);
};
constexpr Suite kSuites[] = {{"frames", bench::benchFrames},
                             {"shapes", bench::benchShapes},
                             {"light-indexed", bench::benchLightIndexed},
                             {"tiles", bench::benchTiles},
                             {"scaling", bench::benchScaling},
                             {"moving-lights", bench::benchMovingLights},
                             {"shadows", bench::benchShadows},
                             {"advice", bench::benchAdvice}};

const Suite& suiteNamed(std::string_view name) {
    std::string names;
    for (const Suite& suite : kSuites) {
        if (suite.name == name) return suite;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", suite.name);
    }
    throw Error(ErrorKind::usage, fmt::format("expected one of {}, got \"{}\"", names, name));
}

void run(int argc, char** argv) {
    int next = 1;
    const Suite& suite = argc > 1 && std::string_view("0123456789").find(argv[1][0]) == std::string_view::npos ? suiteNamed(argv[next++]) : kSuites[0];
    bench::Options options{.frames = 10, .extent = uvec2(1024, 768)};
    char rest = 0;
    if (argc > next && (std::sscanf(argv[next], "%d%c", &options.frames, &rest) != 1 || options.frames < 1))
        throw Error(ErrorKind::usage, fmt::format("expected a number of frames >= 1, got \"{}\"", argv[next]));
    if (argc > ++next && std::sscanf(argv[next], "%5ux%5u%c", &options.extent.x, &options.extent.y, &rest) != 2)
        throw Error(ErrorKind::usage, fmt::format("expected WIDTHxHEIGHT, got \"{}\"", argv[next]));
    if (argc > ++next) options.folder = argv[next];
    Renderer renderer;
    fmt::print("{}; {}x{}; {} frames, techniques in turn.\n", bench::describe(bench::machineOf(renderer.device())), options.extent.x, options.extent.y,
               options.frames);
    suite.run(renderer, options);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "luciole_bench: error: {}\n", error.what());
        return int(error.kind());
    } catch (const std::exception& error) {
        fmt::print(stderr, "luciole_bench: error: {}\n", error.what());
        return 1;
    }
}

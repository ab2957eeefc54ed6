// The figures of docs/performance.md and docs/techniques.
//   luciole_bench [frames|shapes|light-indexed] [FRAMES] [WIDTHxHEIGHT]      defaults: frames, 10, 1024x768
#include <luciole/error.hpp>

#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "suites.hpp"

int main(int argc, char** argv) {
    using namespace luciole;
    try {
        int next = 1;
        const std::string_view suite = argc > 1 && std::string_view("0123456789").find(argv[1][0]) == std::string_view::npos ? argv[next++] : "frames";
        if (suite != "frames" && suite != "shapes" && suite != "light-indexed")
            throw Error(ErrorKind::usage, fmt::format("expected frames, shapes or light-indexed, got \"{}\"", suite));
        int frames = 10;
        uvec2 extent(1024, 768);
        char rest = 0;
        if (argc > next && (std::sscanf(argv[next], "%d%c", &frames, &rest) != 1 || frames < 1))
            throw Error(ErrorKind::usage, fmt::format("expected a number of frames >= 1, got \"{}\"", argv[next]));
        if (argc > ++next && std::sscanf(argv[next], "%5ux%5u%c", &extent.x, &extent.y, &rest) != 2)
            throw Error(ErrorKind::usage, fmt::format("expected WIDTHxHEIGHT, got \"{}\"", argv[next]));
        Renderer renderer;
        fmt::print("{}, {}; {}x{}; {} frames, interleaved\n", renderer.device().name, renderer.device().driver, extent.x, extent.y,
                   frames);
        const auto run = suite == "frames" ? bench::benchFrames : suite == "shapes" ? bench::benchShapes : bench::benchLightIndexed;
        run(renderer, frames, extent);
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "luciole_bench: error: {}\n", error.what());
        return int(error.kind());
    } catch (const std::exception& error) {
        fmt::print(stderr, "luciole_bench: error: {}\n", error.what());
        return 1;
    }
}

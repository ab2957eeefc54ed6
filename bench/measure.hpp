#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <luciole/renderer.hpp>

/// What `luciole bench` and the suites of luciole_bench have in common.
namespace luciole::bench {

inline double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}
inline double least(const std::vector<double>& values) { return *std::ranges::min_element(values); }

struct Contender {
    std::string name;
    RenderSettings settings;
};
Contender contender(const std::string& technique);

/// The techniques with lists of lights by tile or cluster.
std::vector<Contender> listContenders();
/// The techniques that are measured where nobody names one: those, and the fastest of the others. `light-indexed` with lists by pixel: the one
/// packing that holds any overlap.
std::vector<Contender> fastContenders();
/// All others but those that take seconds a frame from some hundred lights on, which are `slowContenders`.
std::vector<Contender> otherContenders();
std::vector<Contender> slowContenders();

/// The bound that lighting times are compared with: exact lists of each pixel's lights, and only their evaluation counted.
Contender ideal();

/// Passes of one name together.
struct MeasuredPass {
    std::string name;
    std::vector<double> ms;  ///< one entry a frame
    std::vector<double> ablatedMs;  ///< Renderer::ablate, one entry for each of Effort::ablations
    uint64_t bytes = 0, draws = 0;  ///< PassStats, of the last frame
};

/// What the frames of one contender cost and did. Of milliseconds one entry a frame.
struct Measured {
    std::string name;
    std::vector<double> wallMs;     ///< whole frames as they run without `measure`
    std::vector<double> passesMs;   ///< sum of all passes with `measure`, but for what is read back
    std::vector<double> listsMs;    ///< lighting passes that find lights (of `ideal` none: they are given)
    std::vector<double> shadingMs;  ///< those that evaluate them, with the light that is there without lights
    std::vector<double> lightingMs; ///< both
    std::vector<MeasuredPass> passes;  ///< in the frame's order
    double evaluations = 0, useful = 0;  ///< a pixel
    double covered = 0;                  ///< pixels at which a light was evaluated
    std::optional<double> missed;        ///< pairs of a light and a pixel that it reaches, and where it was not evaluated; not known with
                                         ///< several samples, of which each may show another surface
    FrameStats stats;                    ///< of the last frame
};

/// How many frames of each contender are measured.
struct Effort {
    int frames = 10;        ///< at least
    int most = frames;      ///< and at most; between them, until the interval of the wall clock's median is narrow enough
    double halfWidth = 0;   ///< of that interval, relative to the median
    int ablations = 0;      ///< frames that are cut off behind each of their passes as well, of the first ones
    double seconds = HUGE_VAL;  ///< once its frames took so long, a contender has no more turns, but three at least
};

/// Frames of all contenders in turn, so that the machine's drift meets all alike. A change of technique makes the frame's resources anew:
/// one frame that does not count goes before each that does.
/// \param progress told now and then how much is done, [0, 1]; may be empty
std::vector<Measured> measure(Renderer& renderer, const View& view, const std::vector<Contender>& contenders, const Effort& effort,
                              const std::function<void(double)>& progress = {});

/// Fills in `evaluations`, `useful`, `covered` and `missed`. \param contenders as they were measured; takes a look at each light from each pixel
void count(Renderer& renderer, const View& view, const std::vector<Contender>& contenders, std::vector<Measured>& results);

/// "median (least)"
std::string milliseconds(const std::vector<double>& values);

/// Markdown: what the whole frames cost, and, if it is known, how many times longer something else takes for one.
std::string frameTable(const std::vector<Measured>& results, std::optional<double> otherMs = {});

/// How many times the lighting time of `ideal`: of the medians (of the least); "-" if that is not one of `results`.
std::string timesIdeal(const Measured& result, const std::vector<Measured>& results);

/// Markdown: what each technique's lighting costs, and how many times that of `ideal`.
std::string lightingTable(const std::vector<Measured>& results);

}  // namespace luciole::bench
